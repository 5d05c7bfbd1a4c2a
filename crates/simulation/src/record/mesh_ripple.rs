//! Curves without the ripple of their mesh.
//!
//! The nodes carry the pressure of a contact, and what they make of its outermost edge depends on how much of
//! that edge touches: force and area ripple by a period of one surface edge as the front crosses edge after
//! edge. What repeats with the phase of the front is known as such and can be told from the curve. The
//! logarithm of force or area over the loading rows is fitted by
//! ```text
//! ln v = spline(ln h) + Σ_k [a_k cos 2πks + b_k sin 2πks] (1, t, t², t³),   k = 1 … 4
//! ```
//! s: edges between the middle of the contact and its front, the touched share of the last one included; t:
//! ln h from -1 at the first row to 1 at the peak, for a shape that changes slowly. Only the periodic part is
//! removed, so that whatever else a curve does stays.
//!
//! The curve itself decides on the numbers of knots, harmonics and powers of t: fits count the more the
//! better they predict rows left out. Nothing is removed where that is not clearly better than the spline
//! alone. Harmonics that the rows sample so that they look like a slow change (three rows per period and the
//! third harmonic, two and the second) cannot be told from the curve and stay out.

use crate::fitted::FITTED;
use crate::record::rows::{AsperityRow, CurveRow};
use asperity_numerics::least_squares::{Columns, LeftOut};
use asperity_numerics::vectors::dot;
use asperity_solver::contact::edge::{ContactEdge, EdgeContact};
use asperity_solver::point::kinematics::Symmetry;
use std::f64::consts::TAU;

/// Fewest rows, and periods that a front passes, in which a ripple is looked for.
const LEAST_ROWS: usize = 14;
const LEAST_PERIODS: f64 = 3.0;

/// Most harmonics, and highest power of t in their amplitudes.
const MOST_HARMONICS: usize = 4;
const HIGHEST_POWER: i32 = 3;

/// Rows that a fit has more than columns.
const FREE_ROWS: usize = 5;

/// Both ends of a contact along the surface: edges from the first one of the surface, the touched share of an
/// edge included. NaN without contact.
pub(super) type Ends = [f64; 2];

/// The ends of the contact of the edges that `belongs` picks by their index.
pub(super) fn ends(edges: &[ContactEdge], contact: &[EdgeContact], belongs: impl Fn(usize) -> bool) -> Ends {
    let mut ends = [f64::NAN; 2];
    for (i, touching) in contact.iter().enumerate().filter(|(i, _)| belongs(*i)) {
        for part in touching.parts.into_iter().flatten() {
            // an edge may run against the order of the surface
            let [from, to] = if is_reversed(edges, i) { [-part[1], -part[0]] } else { part };
            let place = |xi: f64| i as f64 + 0.5 * (xi + 1.0);
            ends = [ends[0].min(place(from)), ends[1].max(place(to))];
        }
    }
    ends
}

/// True where the edge `i` begins where the next one does, or ends where the one before it does.
fn is_reversed(edges: &[ContactEdge], i: usize) -> bool {
    let shares = |other: Option<&ContactEdge>, node: usize| {
        other.is_some_and(|other| other.nodes[..2].contains(&edges[i].nodes[node]))
    };
    shares(edges.get(i + 1), 0) || (i > 0 && shares(edges.get(i - 1), 1))
}

/// Takes the ripple off force and area of the `rows`, and of the rows of their `asperities` if there are
/// several.
///
/// `ends` holds the ends of the contact of each asperity at each row. The ripple is that of the loading, up
/// to the row `peak`. The rows after it keep the share of the peak: what the mesh adds there is held by the
/// metal, and the front stays where it is until most of the force is gone. So the curve does not jump at the
/// peak, and a loop closes as before.
pub(super) fn remove(
    rows: &mut [CurveRow],
    asperities: &mut [AsperityRow],
    ends: &[Ends],
    peak: usize,
    symmetry: Symmetry,
    axis: Option<usize>,
) {
    let count = ends.len().checked_div(rows.len()).unwrap_or(0);
    if peak >= rows.len() || (count > 1 && asperities.len() != count * (rows.len() - 1)) {
        return;
    }
    let mut changed = false;
    for part in 0..count {
        let fronts: Vec<Ends> = ends.iter().skip(part).step_by(count).copied().collect();
        let depth: Vec<f64> = rows[..=peak].iter().map(|row| row.depth).collect();
        // the first touch has no rows of asperities
        let of = |i: usize| {
            if count > 1 { i.checked_sub(1).map(|before| before * count + part) } else { Some(i) }
        };
        let values = |force: bool| -> Vec<f64> {
            let value = |i: usize| match (count > 1, force) {
                (true, true) => asperities[i].force,
                (true, false) => asperities[i].contact_area,
                (false, true) => rows[i].force,
                (false, false) => rows[i].contact_area,
            };
            (0..=peak).map(|i| of(i).map_or(0.0, value)).collect()
        };
        let [force, area] = [true, false].map(|force| ripple(&depth, &values(force), &fronts[..=peak]));
        if force.iter().chain(&area).all(|r| *r == 0.0) {
            continue;
        }
        changed = true;
        for i in 0..rows.len() {
            let Some(place) = of(i) else { continue };
            let [f, a] = [&force, &area].map(|ripple| (-ripple[i.min(peak)]).exp());
            let row = &mut rows[i];
            if count > 1 {
                let own = &mut asperities[place];
                row.force += own.force * (f - 1.0);
                row.contact_area += own.contact_area * (a - 1.0);
                own.force *= f;
                own.contact_area *= a;
            } else {
                row.force *= f;
                row.contact_area *= a;
            }
            match symmetry {
                Symmetry::Axisymmetric if axis == Some(part) => row.contact_radius *= a.sqrt(),
                Symmetry::Axisymmetric => {}
                Symmetry::PlaneStrain => row.contact_radius = 0.5 * row.contact_area,
            }
        }
    }
    for row in rows.iter_mut().filter(|_| changed) {
        row.mean_pressure = if row.contact_area > 0.0 { row.force / row.contact_area } else { 0.0 };
    }
}

/// The periodic part of ln `value` at each row of a loading; 0 where none is known.
fn ripple(depth: &[f64], value: &[f64], ends: &[Ends]) -> Vec<f64> {
    let mut found = vec![0.0; value.len()];
    if let Some((first, part)) = periodic_part(depth, value, ends) {
        found[first..].copy_from_slice(&part);
    }
    found
}

/// The first row of the ripple, and the periodic part from there to the last row.
fn periodic_part(depth: &[f64], value: &[f64], ends: &[Ends]) -> Option<(usize, Vec<f64>)> {
    let touches = |i: usize| {
        depth[i] > 0.0 && value[i] > 0.0 && value[i].is_finite() && ends[i].iter().all(|s| s.is_finite())
    };
    let begin = value.len() - (0..value.len()).rev().take_while(|&i| touches(i)).count();
    // over those of the last row: a logarithm of metres would know the unit by its last digits
    let x = logarithms(&depth[begin..])?;
    // both ends advance; the axis does not
    let outward = [
        ends[begin..].iter().map(|[inner, _]| -inner).collect(),
        ends[begin..].iter().map(|[_, outer]| *outer).collect(),
    ];
    let fronts: Vec<Vec<f64>> =
        outward.into_iter().filter(|s: &Vec<f64>| travelled(s) > LEAST_PERIODS).collect();
    let skipped = fronts.iter().map(|s| steady_from(&x, s)).max()?;
    let (x, first) = (&x[skipped..], begin + skipped);
    let fronts: Vec<&[f64]> = fronts.iter().map(|s| &s[skipped..]).collect();
    if x.len() < LEAST_ROWS || fronts.iter().any(|s| travelled(s) < LEAST_PERIODS) {
        return None;
    }
    let y = logarithms(&value[first..])?;
    // the front itself moves by jerks: harmonics of its even advance are fewer
    let even: Vec<Vec<f64>> = fronts.iter().map(|s| spline(x, 2).fitted(s)).collect();
    let mut part = average_fit(x, &y, &even)?;
    // the ripple sets in over one period, so that the curve does not jump
    for (i, part) in part.iter_mut().enumerate() {
        let in_all = even.iter().map(|s| s[i] - s[0]).fold(f64::INFINITY, f64::min);
        *part *= in_all.clamp(0.0, 1.0);
    }
    Some((first, part)).filter(|(_, part)| part.iter().all(|p| p.is_finite()))
}

/// Logarithms of numbers over the last of them; `None` of none.
fn logarithms(numbers: &[f64]) -> Option<Vec<f64>> {
    let last = numbers.last()?;
    Some(numbers.iter().map(|number| (number / last).ln()).collect())
}

/// Edges that a front passes in all.
fn travelled(front: &[f64]) -> f64 {
    front.last().zip(front.first()).map_or(0.0, |(last, first)| last - first)
}

/// The first row from which `front` advances, with `x`, as steadily as in its last periods.
fn steady_from(x: &[f64], front: &[f64]) -> usize {
    let last = front.len() - 1;
    let rate = |from: usize, to: usize| (front[to] - front[from]) / (x[to] - x[from]);
    let Some(back) = (0..last).rev().find(|&i| front[i] <= front[last] - LEAST_PERIODS) else { return last };
    let end_rate = rate(back, last);
    let mut first = last;
    while first > 0 {
        let i = first - 1;
        let advances = front[i + 1] > front[i] && x[i + 1] > x[i];
        // over a period, as it moves by jerks
        let steady = (i + 1..=last).find(|&j| front[j] >= front[i] + 1.0).is_none_or(|j| {
            let share = rate(i, j) / end_rate;
            share > 1.0 / FITTED.ripple.steady && share < FITTED.ripple.steady
        });
        if !advances || !steady {
            break;
        }
        first = i;
    }
    first
}

/// The periodic part of the fits of all sizes, averaged; `None` if none is clearly better than a spline
/// alone.
fn average_fit(x: &[f64], y: &[f64], fronts: &[Vec<f64>]) -> Option<Vec<f64>> {
    let fitted = FITTED.ripple;
    let periods = fronts.iter().map(|s| travelled(s)).fold(0.0, f64::max);
    let most = (x.len() / fitted.rows_per_knot).min((periods / fitted.periods_per_knot) as usize).max(1);
    let [from, to] = [x[0], x[x.len() - 1]];
    let t: Vec<f64> = x.iter().map(|x| 2.0 * (x - from) / (to - from) - 1.0).collect();
    let waves: Vec<Vec<(i32, Vec<f64>)>> =
        (1..=MOST_HARMONICS).map(|harmonic| waves(fronts, &t, harmonic)).collect();
    let mut without = f64::INFINITY;
    let mut fits: Vec<(f64, Vec<f64>)> = Vec::new();
    for intervals in 1..=most {
        let smooth = spline(x, intervals);
        let mut of_spline = LeftOut::new(y);
        without = without.min(of_spline.error(&smooth));
        // what the spline leaves of the columns that are apart from it
        let mut apart = Vec::new();
        for columns in &waves {
            let rests = columns.iter().map(|(own, column)| (*own, column, smooth.remainder(column)));
            let share = |column: &[f64], rest: &[f64]| dot(rest, rest) / dot(column, column);
            let far = rests.filter(|(_, column, rest)| share(column, rest) > fitted.apart_from_spline);
            apart.push(far.collect::<Vec<_>>());
        }
        for power in 0..=HIGHEST_POWER {
            let mut fit = smooth.clone();
            let mut left_out = of_spline.clone();
            for columns in &apart {
                for (_, column, rest) in columns.iter().filter(|(own, ..)| *own <= power) {
                    fit.add_beyond(smooth.count(), column, rest, fitted.apart);
                }
                if x.len() < fit.count() + FREE_ROWS {
                    break;
                }
                if fit.count() > smooth.count() {
                    fits.push((left_out.error(&fit), fit.contribution(y, smooth.count())));
                }
            }
        }
    }
    let least = fits.iter().map(|(error, _)| *error).fold(f64::INFINITY, f64::min);
    if fits.is_empty() || least >= fitted.better * without {
        return None;
    }
    // a fit without error takes all of the weight
    let least = least.max(f64::MIN_POSITIVE);
    let weight = |error: f64| (least / error.max(least)).powf(fitted.selective * x.len() as f64);
    let all: f64 = fits.iter().map(|(error, _)| weight(*error)).sum();
    let mut part = vec![0.0; y.len()];
    for (error, own) in &fits {
        let share = weight(*error) / all;
        part.iter_mut().zip(own).for_each(|(sum, own)| *sum += share * own);
    }
    Some(part)
}

/// Columns of one harmonic of every front, each with the power of t of its amplitude.
fn waves(fronts: &[Vec<f64>], t: &[f64], harmonic: usize) -> Vec<(i32, Vec<f64>)> {
    let mut columns = Vec::new();
    for front in fronts {
        for power in 0..=HIGHEST_POWER {
            for wave in [f64::cos, f64::sin] {
                let at = |(s, t): (&f64, &f64)| wave(TAU * harmonic as f64 * s) * t.powi(power);
                columns.push((power, front.iter().zip(t).map(at).collect()));
            }
        }
    }
    columns
}

/// Cubic B-splines over equal intervals between the ends of `x`.
fn spline(x: &[f64], intervals: usize) -> Columns {
    let [from, to] = [x[0], x[x.len() - 1]];
    let mut columns = Columns::new();
    for k in 0..intervals + 3 {
        let at = |x: &f64| cubic((x - from) / (to - from) * intervals as f64 - k as f64 + 3.0);
        columns.add(x.iter().map(at).collect(), 0.0);
    }
    columns
}

/// The cubic B-spline of the knots 0, 1, 2, 3, 4, times 6.
fn cubic(u: f64) -> f64 {
    let v = 2.0 - (u - 2.0).abs();
    if v <= 0.0 {
        0.0
    } else if v <= 1.0 {
        v.powi(3)
    } else {
        v.powi(3) - 4.0 * (v - 1.0).powi(3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS_OF_CURVE: usize = 60;

    /// Depths of a loading, geometric from a fiftieth of the peak.
    fn depths() -> Vec<f64> {
        (0..ROWS_OF_CURVE).map(|i| 5e-6 * 0.02_f64.powf(1.0 - i as f64 / 59.0)).collect()
    }

    /// The ends of a contact on the axis that passes `density` edges per ln h.
    fn front(density: f64) -> Vec<Ends> {
        let place = |h: &f64| density * (h / 5e-6).ln() + 4.0 * density + 0.3;
        depths().iter().map(|h| [0.0, place(h)]).collect()
    }

    fn curve(exponent: impl Fn(f64) -> f64) -> Vec<f64> {
        depths().iter().map(|h| exponent((h / 5e-6).ln()).exp()).collect()
    }

    /// A ripple of 1 % whose second harmonic grows.
    fn wave(s: f64, x: f64) -> f64 {
        0.01 * (TAU * s).cos() + 0.004 * (1.0 + 0.2 * x) * (2.0 * TAU * s).sin()
    }

    #[test]
    fn a_ripple_is_found_to_a_twentieth_up_to_the_last_row() {
        for density in [3.5, 4.7, 6.1] {
            let ends = front(density);
            let expected: Vec<f64> =
                ends.iter().zip(depths()).map(|(e, h)| wave(e[1], (h / 5e-6).ln())).collect();
            // a tip that turns into a flank
            let smooth = curve(|x| 2.0 * x - 0.3 * (-2.0 * (x + 2.5)).exp().ln_1p());
            let value: Vec<f64> = smooth.iter().zip(&expected).map(|(v, e)| v * e.exp()).collect();
            let found = ripple(&depths(), &value, &ends);
            let errors: Vec<f64> = (20..ROWS_OF_CURVE).map(|i| found[i] - expected[i]).collect();
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            let worst = errors.iter().map(|e| (e - mean).abs()).fold(0.0, f64::max);
            assert!(worst < 5e-4, "{density}: {worst}");
        }
    }

    #[test]
    fn curves_without_ripple_are_left_as_they_are() {
        let ends = front(4.0);
        // bent, and with a kink where a neighbour takes up a part of the load
        let curves = [
            curve(|x| 1.3 * x),
            curve(|x| 2.0 * x + 0.3 * (3.0 * (x + 0.7)).tanh()),
            curve(|x| 2.0 * x + 0.2 * (x + 0.6).max(0.0)),
        ];
        for value in &curves {
            assert!(ripple(&depths(), value, &ends).iter().all(|r| r.abs() < 1e-12));
        }
        // and chance errors of 0.3 %
        let mut state = 1_u64;
        let mut chance = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let changed = (0..50).filter(|_| {
            let value: Vec<f64> = curves[0].iter().map(|v| v * (1.0 + 0.01 * chance())).collect();
            ripple(&depths(), &value, &ends).iter().any(|r| *r != 0.0)
        });
        assert!(changed.count() <= 2);
    }

    #[test]
    fn short_curves_and_fronts_that_stay_are_left_as_they_are() {
        let ends = front(4.0);
        let value: Vec<f64> = ends.iter().map(|e| wave(e[1], 0.0).exp()).collect();
        let depth = depths();
        for count in 0..LEAST_ROWS {
            let from = ROWS_OF_CURVE - count;
            assert!(ripple(&depth[from..], &value[from..], &ends[from..]).iter().all(|r| *r == 0.0));
        }
        for still in [[0.0, 7.5], [f64::NAN; 2]] {
            assert!(ripple(&depth, &value, &vec![still; ROWS_OF_CURVE]).iter().all(|r| *r == 0.0));
        }
        assert!(ripple(&depth, &vec![0.0; ROWS_OF_CURVE], &ends).iter().all(|r| *r == 0.0));
    }

    #[test]
    fn two_fronts_of_equal_phase_are_fitted_as_one() {
        let one = front(4.7);
        let both: Vec<Ends> = one.iter().map(|e| [-e[1], e[1]]).collect();
        let value: Vec<f64> = one.iter().map(|e| wave(e[1], 0.0).exp()).collect();
        let [single, double] = [&one, &both].map(|ends| ripple(&depths(), &value, ends));
        assert!(single.iter().any(|r| r.abs() > 0.008));
        assert!(single.iter().zip(double).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}
