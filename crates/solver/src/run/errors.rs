//! Errors of a run, measured by the run itself: its companion is the same scene with every number of the discretisation half as
//! good, and costs a tenth.
//!
//! With Q the force or the contact area at a depth, D = ln(Q_companion/Q) holds what mesh, load step, penalty and substrate do, each
//! of first order at least, and the ripple of both. A parabola through D over ln h is the smooth part.
//! * Were all errors of the order p, D/(2ᵖ - 1) of it would be left in Q. With p = 3/2 it is taken off (Richardson's extrapolation):
//!   observed orders lie between 1 and 2, for which a third of the smooth part at most is left.
//! * The bound of what is left is [`REMAINS`] times the largest smooth part and the largest rest, from a fifth of the depth on:
//!   measured on nine scenes of every kind at three resolutions, 0.2 to 1 of them.
//!
//! What is read at the peak or after it is not extrapolated. Its bound is the difference itself, and what the errors of force and
//! stiffness would do to it, since two runs may agree by chance.

use crate::point::kinematics::Symmetry;
use crate::run::curve::{COUNTS_FROM, Curve};
use crate::run::record::{CurveRow, Errors, Phase};
use crate::run::recorder::Outcome;
use crate::run::schedule::UNLOADING_EXPONENT;
use asperity_law::least_squares::{powers, solve, value};

/// 1/(2ᵖ - 1) for the order p = 3/2.
const ORDER: f64 = 0.547;

/// Largest logarithm that is taken off: a companion that differs by more is in no asymptotic range.
const MOST: f64 = 0.03;

/// Share of the smooth part and of the rest of the difference that bounds the error.
const REMAINS: f64 = 0.7;

/// Depths at which curves are compared, equally spaced in the logarithm.
const DEPTHS: usize = 81;

/// Half the span of ln h over which the rest of the difference counts for a row.
const NEAR: f64 = 0.15;

/// Difference of one quantity between companion and run.
struct Difference {
    /// ln(h/h_peak) and ln(Q_companion/Q).
    points: Vec<[f64; 2]>,
    smooth: [f64; 3],
}

impl Difference {
    fn new(points: Vec<[f64; 2]>) -> Option<Difference> {
        let rows: Vec<_> = points.iter().map(|[x, d]| (powers(*x), *d, 1.0)).collect();
        let smooth = solve(&rows).filter(|c| c.iter().all(|c| c.is_finite()))?;
        Some(Difference { points, smooth })
    }

    /// The smooth part at x = ln(h/h_peak); that of the first depth before it.
    fn smooth(&self, x: f64) -> f64 {
        value(&self.smooth, &powers(x.clamp(COUNTS_FROM.ln(), 0.0)))
    }

    /// What is taken off ln Q.
    fn correction(&self, x: f64) -> f64 {
        -(ORDER * self.smooth(x)).clamp(-MOST, MOST)
    }

    /// The bound of what is left near x.
    fn bound(&self, from: f64, to: f64) -> f64 {
        let within = self.points.iter().filter(|[x, _]| (from..=to).contains(x));
        let [smooth, rest] = within.fold([0.0_f64; 2], |[smooth, rest], [x, d]| {
            let even = self.smooth(*x);
            [smooth.max(even.abs()), rest.max((d - even).abs())]
        });
        // what was not taken off stays
        let beyond = (ORDER * smooth - MOST).max(0.0);
        REMAINS * (smooth + rest) + beyond
    }

    fn whole(&self) -> f64 {
        self.bound(f64::NEG_INFINITY, 0.0)
    }
}

/// Curve of a quantity over the first loading.
fn curve(rows: &[CurveRow], of: impl Fn(&CurveRow) -> f64) -> Curve {
    Curve::new(rows.iter().filter(|row| row.phase == Phase::Load).map(|row| [row.depth, of(row)]))
}

/// Takes the errors that the `companion` reveals off force and area of `run`, and states what is left.
pub(super) fn settle(run: &mut Outcome, companion: &Outcome, symmetry: Symmetry) {
    let of = [|row: &CurveRow| row.force, |row: &CurveRow| row.contact_area];
    let curves = of.map(|of| [curve(&run.rows, of), curve(&companion.rows, of)]);
    let (end, other) = (curves[0][0].end(), curves[0][1].end());
    // a companion that stopped early says nothing of what comes after
    if other < COMPARED * end {
        return;
    }
    let peak = end.min(other);
    let depths = (0..DEPTHS).map(|i| COUNTS_FROM.ln() * i as f64 / (DEPTHS - 1) as f64).rev();
    let depths: Vec<f64> = depths.collect();
    let difference = |[own, other]: &[Curve; 2]| {
        let at = |x: &f64| [*x, 0.0 + (other.at(peak * x.exp()) / own.at(peak * x.exp())).ln()];
        Difference::new(depths.iter().map(at).collect())
    };
    let (Some(force), Some(area)) = (difference(&curves[0]), difference(&curves[1])) else { return };
    let pressure = force.points.iter().zip(&area.points).map(|([x, f], [_, a])| [*x, f - a]);
    let Some(pressure) = Difference::new(pressure.collect()) else { return };

    let summary = &run.summary;
    let relative = |own: Option<f64>, other: Option<f64>| Some((other? / own? - 1.0).abs());
    let unloading_stiffness = relative(summary.unloading_stiffness, companion.summary.unloading_stiffness);
    let indirect = force.whole() + unloading_stiffness.unwrap_or(0.0);
    let difference = |own: Option<f64>, other: Option<f64>| Some((other? - own?).abs());
    let share = |x: f64| x * (1.0 - x) * indirect;
    let residual = summary.residual_depth.map(|depth| (depth / summary.peak_depth).clamp(0.0, 1.0));
    let elastic = summary.elastic_fraction.map(|fraction| fraction.clamp(0.0, 1.0));
    let errors = Errors {
        force: force.whole(),
        contact_area: area.whole(),
        mean_pressure: pressure.whole(),
        residual_depth: difference(summary.residual_depth, companion.summary.residual_depth)
            .zip(residual)
            .map(|(d, r)| d / summary.peak_depth + share(r)),
        elastic_fraction: difference(summary.elastic_fraction, companion.summary.elastic_fraction)
            .zip(elastic)
            .map(|(d, e)| d + share(e)),
        unloading_stiffness: unloading_stiffness.map(|s| s + 0.5 * area.whole()),
    };
    let residual_depth = summary.residual_depth.unwrap_or(0.0);
    let moved = errors.residual_depth.unwrap_or(0.0) * summary.peak_depth;

    let last = run.rows.len() - 1;
    let at = |row: &CurveRow| match row.phase {
        Phase::Load if row.depth > 0.0 => (row.depth / end).ln(),
        _ => 0.0,
    };
    for share in &mut run.asperities {
        if let Some(row) = run.rows.get(share.increment) {
            share.force *= force.correction(at(row)).exp();
            share.contact_area *= area.correction(at(row)).exp();
        }
    }
    for (index, row) in run.rows.iter_mut().enumerate() {
        let x = at(row);
        let widened = area.correction(x).exp();
        row.force *= force.correction(x).exp();
        row.contact_area *= widened;
        row.contact_radius *= if symmetry == Symmetry::Axisymmetric { widened.sqrt() } else { widened };
        row.mean_pressure *= (force.correction(x) - area.correction(x)).exp();
        row.force_error = match row.phase {
            _ if row.depth <= 0.0 || row.force <= 0.0 => f64::NAN,
            Phase::Load if x < COUNTS_FROM.ln() => {
                let own = (curves[0][1].at(row.depth) / curves[0][0].at(row.depth)).ln().abs();
                let first = force.bound(f64::NEG_INFINITY, COUNTS_FROM.ln() + NEAR);
                if own.is_finite() { first.max(own) } else { first.max(1.0) }
            }
            Phase::Load => force.bound(x - NEAR, x + NEAR),
            // a curve that is moved by the error of the residual depth: dF/F = m dh/(h - h_residual)
            _ if index == last => f64::NAN,
            _ => {
                let left = (row.depth - residual_depth)
                    / (run.summary.peak_depth - residual_depth).max(f64::MIN_POSITIVE);
                let lever = UNLOADING_EXPONENT * (1.0 - left).max(0.0) * moved;
                (force.bound(-NEAR, 0.0) + lever / (row.depth - residual_depth).max(f64::MIN_POSITIVE))
                    .min(1.0)
            }
        };
    }
    let top = run.rows.iter().rposition(|row| row.phase == Phase::Load).map(|i| run.rows[i]);
    if let Some(top) = top {
        run.summary.peak_force = top.force;
        run.summary.contact_area = top.contact_area;
        run.summary.contact_radius = top.contact_radius;
    }
    run.summary.errors = errors;
    run.summary.estimated_error = errors.force;
}

/// Share of the depth that the companion must reach.
const COMPARED: f64 = 0.9;
