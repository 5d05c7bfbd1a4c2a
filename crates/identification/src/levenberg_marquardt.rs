//! Least squares with bounds: Levenberg and Marquardt's method on differences (Nocedal, Wright, Numerical
//! Optimization, 10.3).

use nalgebra::{DMatrix, DVector};

/// Residuals at a point; `None` where there is no metal.
pub type Function<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + 'a;

/// Residuals in standard deviations.
pub trait ResidualFunction: Sync {
    /// Those at `point`; `None` where there is no metal.
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>>;

    /// The same with all deviations held at those of `point`: their slopes are what the measurements see. As
    /// they stand where deviations do not depend on the point.
    fn about(&self, _point: &[f64]) -> Option<Box<Function<'_>>> {
        Some(Box::new(|point| self.residuals(point)))
    }

    /// The same near `point` with deviations that change to first order: their slopes are those of the sum of
    /// squares. Without them a search would end where a step by the slopes of [`Self::about`] alone lowers
    /// the sum no more, which is no minimum.
    fn first_order(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        self.about(point)
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

/// Derivatives of the residuals, their deviations held, by differences into the bounds; a coordinate whose
/// bounds meet has none.
pub fn jacobian(residuals: &Residuals<'_>, point: &[f64], bounds: &[[f64; 2]]) -> Option<DMatrix<f64>> {
    slopes(&*residuals.about(point)?, point, bounds)
}

fn slopes(residuals: &Function<'_>, point: &[f64], bounds: &[[f64; 2]]) -> Option<DMatrix<f64>> {
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
        let near = residuals.first_order(&point).and_then(|near| slopes(&*near, &point, bounds));
        let (Some(values), Some(slopes)) = (&here, near) else { break };
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

/// The point after a damped step. A coordinate that leans on its bound stays there, one that would cross it
/// goes to it, and the others are at their best beside those; none goes farther than a quarter of its bounds.
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
    let mut free: Vec<usize> = (0..point.len()).filter(|&i| !leans(i)).collect();
    let mut step = DVector::zeros(point.len());
    while !free.is_empty() {
        let matrix = DMatrix::from_fn(free.len(), free.len(), |a, b| {
            let entry = normal[(free[a], free[b])];
            if a == b { entry * (1.0 + damping) + 1e-12 } else { entry }
        });
        // beside the steps of those that go to a bound
        let rest = gradient + normal * &step;
        let rhs = DVector::from_fn(free.len(), |a, _| -rest[free[a]]);
        let Some(found) = matrix.cholesky().map(|factor| factor.solve(&rhs)) else { return point.to_vec() };
        let crossed = |a: usize| {
            let [low, high] = bounds[free[a]].map(|bound| bound - point[free[a]]);
            (found[a] < low || found[a] > high).then_some(found[a].clamp(low, high))
        };
        let to_a_bound: Vec<Option<f64>> = (0..free.len()).map(crossed).collect();
        if to_a_bound.iter().all(Option::is_none) {
            free.iter().zip(found.iter()).for_each(|(&i, &way)| step[i] = way);
            break;
        }
        free.iter().zip(&to_a_bound).for_each(|(&i, way)| step[i] = way.unwrap_or(0.0));
        let mut kept = to_a_bound.iter().map(Option::is_none);
        free.retain(|_| kept.next().unwrap_or(false));
    }
    let share = |i: usize| step[i].abs() / (0.25 * (bounds[i][1] - bounds[i][0])).max(f64::MIN_POSITIVE);
    let most = (0..point.len()).map(share).fold(1.0, f64::max);
    point.iter().zip(step.iter()).map(|(x, way)| x + way / most).collect()
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

    /// Readings of x and y, 1 and 2, whose deviation s = 0.5 + 0.5 x grows with x:
    /// (1 - x)²/s² + (2 - y)²/s² + ln s².
    struct Widening;

    impl Widening {
        fn residuals_with(at: &[f64], deviation: f64, growth: f64) -> Option<Vec<f64>> {
            Some(vec![(1.0 - at[0]) / deviation, (2.0 - at[1]) / deviation, growth.sqrt()])
        }

        fn deviation(at: &[f64]) -> f64 {
            0.5 + 0.5 * at[0]
        }
    }

    impl ResidualFunction for Widening {
        fn residuals(&self, at: &[f64]) -> Option<Vec<f64>> {
            let s = Widening::deviation(at);
            Widening::residuals_with(at, s, 2.0 + 2.0 * s.ln())
        }

        fn about(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
            let s = Widening::deviation(point);
            Some(Box::new(move |at| Widening::residuals_with(at, s, 2.0 + 2.0 * s.ln())))
        }

        fn first_order(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
            let s = Widening::deviation(point);
            let still = self.about(point)?;
            let here = still(point)?;
            Some(Box::new(move |at| {
                let by = (Widening::deviation(at) - s) / s;
                let mut all = still(at)?;
                all[0] -= by * here[0];
                all[1] -= by * here[1];
                all[2] = (here[2] * here[2] + 2.0 * by).sqrt();
                Some(all)
            }))
        }
    }

    /// With deviations that depend on the point the end is where the sum of squares is least, not where steps
    /// by held deviations lower it no more.
    #[test]
    fn deviations_that_depend_on_the_point_do_not_end_a_search_early() {
        let bounds = [[0.0, 3.0], [1.6, 1.6]];
        let found = minimise(&Widening, &[2.5, 1.6], &bounds);
        let least = (0..=30_000)
            .map(|k| f64::from(k) * 1e-4)
            .min_by(|a, b| chi2(&Widening, &[*a, 1.6]).total_cmp(&chi2(&Widening, &[*b, 1.6])))
            .unwrap();
        assert!((found.point[0] - least).abs() < 2e-3, "{found:?}, least at {least}");
    }

    /// On the way to a minimum beyond a bound the other coordinate is at its best beside the bound, after one
    /// step of a straight problem.
    #[test]
    fn a_step_that_meets_a_bound_turns_along_it() {
        let straight = |x: &[f64]| Some(vec![x[0] + x[1] - 1.0, 0.01 * (x[0] - x[1])]);
        let found = minimise(&straight, &[0.5, 0.4], &[[-4.0, 4.0], [-0.2, 0.4]]);
        let tilted = minimise(&straight, &[3.0, 0.4], &[[0.6, 4.0], [-0.2, 4.0]]);
        assert!((found.point[0] - 0.6).abs() < 1e-3 && found.point[1] == 0.4, "{found:?}");
        assert!((tilted.point[1] - 0.4).abs() < 1e-3 && tilted.point[0] == 0.6, "{tilted:?}");
    }

    #[test]
    fn a_place_without_a_metal_is_gone_around() {
        let hole = |x: &[f64]| (x[0] > 0.2).then(|| vec![x[0] - 0.1]);
        let found = minimise(&hole, &[0.9], &[[0.0, 1.0]]);
        assert!(found.point[0] > 0.2 && found.point[0] < 0.25, "{found:?}");
    }
}
