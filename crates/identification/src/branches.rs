//! Other metals that the measurements allow: minima all over the bounds, and those that a wall parts from the
//! best one.

use crate::levenberg_marquardt::{Minimum, Residuals, chi2, minimise};
use crate::objective::Objective;
use crate::parameters::{Unknowns, far_apart, sobol_points};
use crate::profile_likelihood::GROWTH;
use rayon::prelude::*;

/// Points of a look all over the bounds.
pub const FIRST_POINTS: usize = 512;
/// Of the points of a look: the best ones, from which minima are sought, and those among the better ones that
/// lie farthest apart, for the best may all lie in one valley.
const STARTS: usize = 6;
const BETTER_POINTS: usize = 96;
const STARTS_APART: usize = 10;
/// Places between two minima at which a wall is looked for.
const PLACES_BETWEEN: usize = 7;
/// Share of the widths of the bounds within which two minima are one.
const SAME_PLACE_SHARE: f64 = 0.01;

/// Minima from the best of `points` and from good ones far apart, the lowest one first.
pub(crate) fn minima(objective: &Objective<'_>, points: &[Vec<f64>]) -> Vec<Minimum> {
    let bounds = objective.bounds();
    let mut ranked: Vec<(f64, &Vec<f64>)> = points.par_iter().map(|p| (chi2(objective, p), p)).collect();
    ranked.retain(|r| r.0.is_finite());
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let better: Vec<&[f64]> = ranked.iter().take(BETTER_POINTS).map(|r| r.1.as_slice()).collect();
    // the best of them is the first one far apart
    let apart = far_apart(&better, STARTS_APART).into_iter().filter(|k| *k >= STARTS);
    let starts: Vec<&[f64]> = (0..STARTS.min(better.len())).chain(apart).map(|k| better[k]).collect();
    let mut found: Vec<Minimum> =
        starts.par_iter().map(|p| minimise(objective, p, &bounds)).filter(|m| m.chi2.is_finite()).collect();
    found.sort_by(|a, b| a.chi2.total_cmp(&b.chi2));
    found
}

/// Minima anywhere within the bounds that the measurements allow beside the `best` one, with sums of squares
/// grown by less than that of a 95 % interval; each place once, the lowest one first.
pub fn allowed_minima(objective: &Objective<'_>, unknowns: &Unknowns, best: &Minimum) -> Vec<Minimum> {
    let mut kept = vec![best.clone()];
    for minimum in minima(objective, &sobol_points(&unknowns.parameters, FIRST_POINTS)) {
        let new = kept.iter().all(|other| !is_near(&minimum.point, &other.point, unknowns));
        if minimum.chi2 < best.chi2 + GROWTH && new {
            kept.push(minimum);
        }
    }
    kept.split_off(1)
}

fn is_near(a: &[f64], b: &[f64], unknowns: &Unknowns) -> bool {
    let widths = unknowns.parameters.iter().map(|p| SAME_PLACE_SHARE * p.width());
    a.iter().zip(b).zip(widths).all(|((x, y), width)| (x - y).abs() <= width)
}

/// The `best` minimum and those of `others` that a wall, higher than what the measurements allow, parts from
/// it and from each other: metals of their own.
pub fn branches(
    residuals: &Residuals<'_>,
    bounds: &[[f64; 2]],
    best: &Minimum,
    others: &[Minimum],
) -> Vec<Minimum> {
    let mut kept = vec![best.clone()];
    for other in others {
        if kept.iter().all(|branch| is_parted(residuals, bounds, [branch, other], best.chi2 + GROWTH)) {
            kept.push(other.clone());
        }
    }
    kept
}

/// True where every way between two minima that follows one coordinate, the others at their best, climbs
/// above `wall`.
fn is_parted(residuals: &Residuals<'_>, bounds: &[[f64; 2]], [a, b]: [&Minimum; 2], wall: f64) -> bool {
    let share = |i: usize| (a.point[i] - b.point[i]).abs() / (bounds[i][1] - bounds[i][0]).max(1e-300);
    let Some(i) = (0..bounds.len()).max_by(|i, j| share(*i).total_cmp(&share(*j))) else { return false };
    let climbs = |[from, to]: [&Minimum; 2]| {
        let mut point = from.point.clone();
        (1..=PLACES_BETWEEN).any(|k| {
            let share = k as f64 / (PLACES_BETWEEN + 1) as f64;
            let x = from.point[i] + share * (to.point[i] - from.point[i]);
            let mut held = bounds.to_vec();
            held[i] = [x, x];
            point[i] = x;
            let lowest = minimise(residuals, &point, &held);
            point.clone_from(&lowest.point);
            lowest.chi2 > wall
        })
    };
    climbs([a, b]) && climbs([b, a])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn minimum(point: &[f64]) -> Minimum {
        Minimum { point: point.to_vec(), chi2: 0.0 }
    }

    /// x² measured as 1: metals at 1 and at -1, with a wall of 100 between them. A ring x² + y² = 1 has the
    /// same minima, and a way around.
    #[test]
    fn a_wall_makes_two_metals_and_a_way_around_it_one() {
        let bounds = [[-2.0, 2.0], [-2.0, 2.0]];
        let parted = |p: &[f64]| Some(vec![10.0 * (p[0] * p[0] - 1.0), p[1]]);
        let ring = |p: &[f64]| Some(vec![10.0 * (p[0] * p[0] + p[1] * p[1] - 1.0), 0.0]);
        let (best, other) = (minimum(&[1.0, 0.0]), minimum(&[-1.0, 0.0]));
        let of_two = branches(&parted, &bounds, &best, std::slice::from_ref(&other));
        assert_eq!(of_two.len(), 2);
        let (best, other) = (minimum(&[0.8, 0.6]), minimum(&[-0.8, 0.6]));
        assert_eq!(branches(&ring, &bounds, &best, &[other]).len(), 1);
    }
}
