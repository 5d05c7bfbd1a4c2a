//! Kick's law of a cone, F = K h²: its constant, its contact radius and their error, from two loading curves.
//!
//! K is the square of the slope of √F over h. The companion is the same cone with every number of the
//! discretisation half as good, and costs a sixth. D = ln(K_companion/K) holds what mesh, load steps, penalty
//! and substrate do.
//! * `ORDER` of D is subtracted from ln K: Richardson's extrapolation of errors of second order. Of crushed
//!   metal that hardly hardens less is, and nothing of perfectly plastic metal, whose flow gathers where the
//!   mesh lets it: the companion is in no asymptotic range. Six such cones (2°, 5°, 10°, E/σ_y 1000, 3000)
//!   differ at `standard` from `reference` by -0.6 to 0.7 % without, in the mean by 0.1 %, while D is 0.4 to
//!   3.2 %; with a third of D subtracted they lay 0.2 to 1.1 % below, each of them.
//! * The residual is bounded by a share of D, twice the standard errors of both slopes and something at least
//!   (`Left`), added in squares. Against `reference`, 123 of 124 crushed cones drawn from the default sweep
//!   lay within that bound at `standard`, with a mean error of 0.05 % ± 0.14 %. Without the extrapolation the
//!   mean would be 0.27 %.
//!
//! A penalty makes an error of first order, which lowers K under a steep indenting cone where the elements
//! raise it. While the two were of one size the companion could not tell them, and K was 0.45 to 0.75 % too
//! large (19.7° and 30°); so the penalty there is stiff. Against runs with elements a third of the size, K of
//! four cones of 15° to 30° is met within 0.15 %.
//!
//! The bound says nothing of what both runs share: the law of the material, the stress that yields, a
//! frictionless tool.

use crate::case::{Case, Tool};
use crate::cone::{CaseError, Curve, crush, disc_radius};
use asperity_numerics::least_squares::{Line, solve as least_squares, value};
use asperity_simulation::load_path::Increment;
use asperity_simulation::scene::ElementChoice;
use asperity_simulation::setup::discretisation::ConeDiscretisation;
use asperity_solver::body::analysis::Analyses;
use std::f64::consts::TAU;

/// The result of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadingCurvature {
    /// K/E = F/(E h²).
    pub k_over_e: f64,
    /// Relative 95 % bound of what mesh, load steps, penalty and substrate leave in K.
    pub error: f64,
    /// a tan β/h, with π a² the contact area.
    pub contact_ratio: f64,
    /// Converged increments of run and companion.
    pub increments: usize,
    /// Newton iterations of both.
    pub iterations: usize,
}

/// 1/(2ᵖ - 1) for the order p = 2.
pub(crate) const ORDER: f64 = 1.0 / 3.0;

/// Hardening exponent from which errors are of that order: the least of the default sweep.
const HARDENS: f64 = 0.1;

/// The same for the contact radius, which the penalty widens: p = 3/2 takes its mean error from 0.9 % to -0.1
/// %.
const ORDER_OF_RADIUS: f64 = 0.547;

/// Bound of the error left in K: a share of the difference between run and companion, and something at least.
pub(crate) struct Left {
    /// The share.
    of_the_difference: f64,
    /// Relative.
    at_least: f64,
    /// Share of the difference that is subtracted from ln K.
    taken_off: f64,
}

impl Left {
    /// That of a cone of the slope `tan_beta` that `indents` or is crushed. With linear elements all that
    /// makes an error is of the second order but the penalty, which is stiff, so that the difference tells it
    /// well; the residual goes with the promise of a level, which is the fourth power of the size of elements
    /// here. Runs of quadratic elements under an indenting cone differ less than they err, and those of steep
    /// cones of metal that hardly hardens differ by other things.
    pub(crate) fn for_cone(tan_beta: f64, indents: bool, discretisation: &ConeDiscretisation) -> Left {
        let [of_the_difference, at_least] = match (discretisation.numbers.element, indents) {
            (ElementChoice::Q4, _) => {
                let size = 24.0 / discretisation.numbers.elements_in_contact as f64;
                [0.15, (0.001 * size.powi(4)).hypot(0.024 * remeshing(tan_beta))]
            }
            (ElementChoice::Q8r, true) => [0.4, 0.005],
            (ElementChoice::Q8r, false) => {
                let size = 10.0 / discretisation.numbers.elements_in_contact as f64;
                [0.4, (0.002 * size.powi(4)).hypot(0.045 * tan_beta.powi(4))]
            }
        };
        Left { of_the_difference, at_least, taken_off: ORDER }
    }

    /// That of a crushed cone of metal of the hardening exponent `exponent`; `None`: it is elastic.
    fn of_metal(self, exponent: Option<f64>) -> Left {
        let hardening = exponent.map_or(1.0, |exponent| (exponent / HARDENS).min(1.0));
        Left { taken_off: hardening * self.taken_off, ..self }
    }
}

/// The number of times that the body under a steep cone is remeshed, each time with a small jump of its
/// force: 1 at 40°, a tenth at 30°.
pub(crate) fn remeshing(tan_beta: f64) -> f64 {
    (tan_beta / 40_f64.to_radians().tan()).powi(6)
}

/// Share of the final depth from which the lines are fitted: by then what the longer first steps left behind
/// has faded.
const FIT_FROM: f64 = 0.43;

/// Exponents farther from 2 than this are no sharp cone: something other than the depth gave a length.
const EXPONENT_TOLERANCE: f64 = 0.06;

/// Points that a line with a ripple has at least.
const POINTS: usize = 6;

/// The numbers read from one curve.
pub(crate) struct Fitted {
    /// Slope of √F, and its relative standard error.
    pub root: f64,
    root_error: f64,
    /// Slope of the contact radius.
    pub radius: f64,
    /// Exponent of the force over the depth.
    exponent: f64,
    curve: Curve,
}

impl Fitted {
    /// True where the force is a parabola of the depth.
    ///
    /// # Errors
    /// It is not.
    pub fn check(&self) -> Result<(), CaseError> {
        let similar = (self.exponent - 2.0).abs() <= EXPONENT_TOLERANCE;
        if similar { Ok(()) } else { Err(CaseError::NotSimilar(self.exponent)) }
    }

    /// K/E, extrapolated from the `companion` to no error of the discretisation, and what may be left of
    /// that, relative.
    pub(crate) fn extrapolated(&self, companion: &Fitted, left: &Left) -> [f64; 2] {
        // K is the square of the slope
        let difference = 2.0 * (companion.root / self.root).ln();
        let [own, other] = [self.root_error, companion.root_error].map(|error| 2.0 * error);
        let of_the_slopes = 2.0 * own.hypot(ORDER * other);
        let error = (left.of_the_difference * difference).hypot(of_the_slopes).hypot(left.at_least);
        [self.root * self.root * (-left.taken_off * difference).exp(), error]
    }
}

/// Solves `case` and its companion. Their meshes are analysed unless they are among `analyses`.
///
/// # Errors
/// No equilibrium, or a force that is no parabola of the depth.
pub fn solve(
    case: &Case,
    discretisation: &ConeDiscretisation,
    analyses: &Analyses,
) -> Result<LoadingCurvature, CaseError> {
    let run = fitted(case, discretisation, analyses)?;
    // a rounded summit shifts h, which the slope of √F does not notice and the exponent does
    let sharp = discretisation.sizes.rounding == 0.0;
    if sharp || run.exponent.is_nan() {
        run.check()?;
    }
    let companion = companion(discretisation, |coarser| fitted(case, coarser, analyses))?;
    let indents = case.tool == Tool::Cone;
    let mut left = Left::for_cone(case.tan_beta(), indents, discretisation);
    if !indents {
        left = left.of_metal(case.yielding.map(|y| y.exponent));
    }
    let [k_over_e, error] = run.extrapolated(&companion, &left);
    Ok(LoadingCurvature {
        k_over_e,
        error,
        contact_ratio: run.radius * (run.radius / companion.radius).powf(ORDER_OF_RADIUS) * case.tan_beta(),
        increments: run.curve.increments + companion.curve.increments,
        iterations: run.curve.iterations + companion.curve.iterations,
    })
}

/// Result of `solved` for the companion of `discretisation`; if that does not come to its end, of that with
/// as many steps as the run, whose difference says less of the steps.
pub(crate) fn companion<T>(
    discretisation: &ConeDiscretisation,
    solved: impl Fn(&ConeDiscretisation) -> Result<T, CaseError>,
) -> Result<T, CaseError> {
    let mut coarser = discretisation.coarser();
    solved(&coarser).or_else(|_| {
        coarser.numbers.steps = discretisation.numbers.steps;
        coarser.numbers.spacing = discretisation.numbers.spacing;
        solved(&coarser)
    })
}

fn fitted(
    case: &Case,
    discretisation: &ConeDiscretisation,
    analyses: &Analyses,
) -> Result<Fitted, CaseError> {
    crush(case, discretisation, analyses).map(read)
}

/// Reads slope, radius and exponent from `curve`; the depth of its last point counts as all of it.
pub(crate) fn read(curve: Curve) -> Fitted {
    let deepest = curve.points.last().map_or(1.0, |p| p.depth);
    let from = curve.points.iter().position(|p| p.depth >= FIT_FROM * deepest).unwrap_or(0);
    let window = &curve.points[from..];
    let points = |of: fn(&Increment) -> [f64; 2]| window.iter().map(of).collect::<Vec<[f64; 2]>>();
    let exponent = Line::fit(&points(|p| [p.depth.ln(), p.contact.force.max(0.0).ln()])).slope;
    let radius = Line::fit(&points(|p| [p.depth, disc_radius(p)])).slope;
    let root =
        beside_a_ripple(&points(|p| [p.depth, p.contact.force.max(0.0).sqrt()]), radius / curve.element);
    Fitted { root: root.slope, root_error: root.slope_error / root.slope, radius, exponent, curve }
}

/// The straight line through `points`, beside a ripple of `frequency` periods per unit of x: as the front
/// crosses element after element, √F of a cone ripples with the same amplitude. Without the ripple where
/// there are too few points for it.
fn beside_a_ripple(points: &[[f64; 2]], frequency: f64) -> Line {
    let ripple = |x: f64| {
        let (sin, cos) = (TAU * frequency * x).sin_cos();
        [1.0, cos, sin]
    };
    let rest = |y: fn(&[f64; 2]) -> f64| {
        let rows: Vec<_> = points.iter().map(|p| (ripple(p[0]), y(p), 1.0)).collect();
        let ripple = least_squares(&rows)?;
        Some(rows.iter().map(|(basis, y, _)| y - value(&ripple, basis)).collect::<Vec<f64>>())
    };
    // the slope is that of what is left of y over what is left of x
    match (rest(|p| p[0]), rest(|p| p[1])) {
        (Some(x), Some(y)) if points.len() >= POINTS => {
            let sxx: f64 = x.iter().map(|x| x * x).sum();
            let slope = x.iter().zip(&y).map(|(x, y)| x * y).sum::<f64>() / sxx;
            let scatter: f64 = x.iter().zip(&y).map(|(x, y)| (y - slope * x).powi(2)).sum();
            Line { slope, slope_error: (scatter / (points.len() as f64 - 4.0) / sxx).sqrt() }
        }
        _ => Line::fit(points),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K of run and companion 1.02 apart: of metal that hardens a third of that is taken off, of perfectly
    /// plastic metal nothing, and the bound holds the difference in each case.
    #[test]
    fn nothing_is_taken_off_where_flow_gathers_in_the_mesh() {
        let fitted = |root: f64| Fitted {
            root,
            root_error: 0.0,
            radius: 1.0,
            exponent: 2.0,
            curve: Curve { points: Vec::new(), element: 1.0, increments: 0, iterations: 0 },
        };
        let (run, companion) = (fitted(1.0), fitted(1.02_f64.sqrt()));
        let left =
            |exponent| Left { of_the_difference: 0.4, at_least: 0.0, taken_off: ORDER }.of_metal(exponent);
        let found = |exponent| run.extrapolated(&companion, &left(exponent));
        for (exponent, share) in
            [(None, 1.0), (Some(0.3), 1.0), (Some(0.1), 1.0), (Some(0.05), 0.5), (Some(0.0), 0.0)]
        {
            let [k, error] = found(exponent);
            assert!((k - 1.02_f64.powf(-share / 3.0)).abs() < 1e-14, "{exponent:?}");
            assert!((error - 0.4 * 1.02_f64.ln()).abs() < 1e-14, "{exponent:?}");
        }
    }

    #[test]
    fn a_ripple_does_not_tilt_the_line() {
        let point = |i: i32| {
            let x = 0.43 + 0.57 * f64::from(i) / 17.0;
            [x, 0.3 + 2.0 * x + 0.01 * (TAU * 7.7 * x + 0.4).sin()]
        };
        let points: Vec<[f64; 2]> = (0..=17).map(point).collect();
        let line = beside_a_ripple(&points, 7.7);
        assert!((line.slope - 2.0).abs() < 1e-9 && line.slope_error < 1e-9, "{line:?}");
        assert!((Line::fit(&points).slope - 2.0).abs() > 1e-3);
    }
}
