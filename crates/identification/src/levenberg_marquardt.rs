//! Least squares with bounds: Levenberg and Marquardt's method on differences (Nocedal, Wright, Numerical
//! Optimization, 10.3).

use nalgebra::{DMatrix, DVector};

/// Residuals at a point; `None` where there is no metal.
pub type Function<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + 'a;

/// Residuals in standard deviations.
pub trait ResidualFunction: Sync {
    /// Those at `point`; `None` where there is no metal.
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>>;

    /// The same with all deviations held at those of `point`: what derivatives are taken of. As they stand
    /// where deviations do not depend on the point.
    fn about(&self, _point: &[f64]) -> Option<Box<Function<'_>>> {
        Some(Box::new(|point| self.residuals(point)))
    }
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>> + Sync> ResidualFunction for F {
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        self(point)
    }
}

/// Residuals of any kind.
pub type Residuals<'a> = dyn ResidualFunction + 'a;

/// The end of a search.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The point.
    pub point: Vec<f64>,
    /// Sum of squares.
    pub chi2: f64,
}

/// Sum of squares; infinite where there is no metal.
pub fn chi2(residuals: &Residuals<'_>, point: &[f64]) -> f64 {
    sum_of_squares(residuals.residuals(point).as_ref())
}

fn sum_of_squares(residuals: Option<&Vec<f64>>) -> f64 {
    residuals.map_or(f64::INFINITY, |r| r.iter().map(|x| x * x).sum())
}

/// Share of the width of the bounds over which a slope is taken: wide enough for the rounding of logarithms.
const DIFFERENCE: f64 = 1e-4;
/// Most steps.
const MOST_STEPS: usize = 60;

/// Derivatives of the residuals by differences into the bounds; a coordinate whose bounds meet has none.
pub fn jacobian(residuals: &Residuals<'_>, point: &[f64], bounds: &[[f64; 2]]) -> Option<DMatrix<f64>> {
    let residuals = residuals.about(point)?;
    let here = residuals(point)?;
    let mut slopes = DMatrix::zeros(here.len(), point.len());
    for (j, [low, high]) in bounds.iter().enumerate() {
        let step = DIFFERENCE * (high - low);
        if step <= 0.0 {
            continue;
        }
        let at = |x: f64| {
            let mut moved = point.to_vec();
            moved[j] = x;
            residuals(&moved).map(|r| (x, r))
        };
        let up = at((point[j] + step).min(*high)).unwrap_or((point[j], here.clone()));
        let down = at((point[j] - step).max(*low)).unwrap_or((point[j], here.clone()));
        let width = up.0 - down.0;
        if width > 0.0 {
            for i in 0..here.len() {
                slopes[(i, j)] = (up.1[i] - down.1[i]) / width;
            }
        }
    }
    Some(slopes)
}

/// Goes from `start` to the nearest minimum within `bounds`.
pub fn minimise(residuals: &Residuals<'_>, start: &[f64], bounds: &[[f64; 2]]) -> Minimum {
    let inside = |x: &[f64]| -> Vec<f64> {
        x.iter().zip(bounds).map(|(x, [low, high])| x.clamp(*low, *high)).collect()
    };
    let mut point = inside(start);
    let mut here = residuals.residuals(&point);
    let mut least = sum_of_squares(here.as_ref());
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let (Some(values), Some(slopes)) = (&here, jacobian(residuals, &point, bounds)) else { break };
        let gradient = slopes.tr_mul(&DVector::from_row_slice(values));
        let normal = slopes.tr_mul(&slopes);
        let before = least;
        for _ in 0..12 {
            let next = inside(&stepped(&point, &normal, &gradient, damping, bounds));
            let there = residuals.residuals(&next);
            let found = sum_of_squares(there.as_ref());
            if found < least {
                (point, here, least) = (next, there, found);
                damping = (0.2 * damping).max(1e-9);
                break;
            }
            damping = (4.0 * damping).min(1e9);
        }
        if before - least <= 1e-7 * (1e-3 + least) {
            break;
        }
    }
    Minimum { point, chi2: least }
}

/// The damped step; a coordinate that leans on its bound stays there.
fn stepped(
    point: &[f64],
    normal: &DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
    bounds: &[[f64; 2]],
) -> Vec<f64> {
    let leans = |i: usize| {
        let [low, high] = bounds[i];
        (point[i] <= low && gradient[i] > 0.0) || (point[i] >= high && gradient[i] < 0.0) || high <= low
    };
    let free: Vec<usize> = (0..point.len()).filter(|&i| !leans(i)).collect();
    let matrix = DMatrix::from_fn(free.len(), free.len(), |a, b| {
        let entry = normal[(free[a], free[b])];
        if a == b { entry * (1.0 + damping) + 1e-12 } else { entry }
    });
    let rhs = DVector::from_fn(free.len(), |a, _| -gradient[free[a]]);
    let mut next = point.to_vec();
    if let Some(step) = matrix.cholesky().map(|factor| factor.solve(&rhs)) {
        for (a, &i) in free.iter().enumerate() {
            // no farther than a quarter of the bounds at once
            let most = 0.25 * (bounds[i][1] - bounds[i][0]);
            next[i] += step[a].clamp(-most, most);
        }
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley, whose minimum is at (1, 1); with the first coordinate bounded by 0.5 it is at
    /// (0.5, 0.25).
    #[test]
    fn a_curved_valley_is_followed_to_its_end_and_to_a_bound() {
        let valley = |x: &[f64]| Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
        let free = minimise(&valley, &[-1.2, 1.0], &[[-2.0, 2.0], [-2.0, 2.0]]);
        assert!((free.point[0] - 1.0).abs() < 1e-4 && free.chi2 < 1e-8, "{free:?}");
        let bounded = minimise(&valley, &[-1.2, 1.0], &[[-2.0, 0.5], [-2.0, 2.0]]);
        assert!(
            (bounded.point[0] - 0.5).abs() < 1e-9 && (bounded.point[1] - 0.25).abs() < 1e-3,
            "{bounded:?}"
        );
    }

    #[test]
    fn a_place_without_a_metal_is_gone_around() {
        let hole = |x: &[f64]| (x[0] > 0.2).then(|| vec![x[0] - 0.1]);
        let found = minimise(&hole, &[0.9], &[[0.0, 1.0]]);
        assert!(found.point[0] > 0.2 && found.point[0] < 0.25, "{found:?}");
    }
}
