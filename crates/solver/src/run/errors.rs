//! Errors of a run, measured by the run itself: its companion is the same scene with every number of the discretisation half as
//! good, and costs a fifth.
//!
//! With Q the force or the contact area at a depth, D = ln(Q_companion/Q) holds what mesh, load step, penalty and substrate do, each
//! of first order nearly or better, and the ripple of both. A parabola through D over ln h is the smooth part; of the area, whose
//! companion ripples more than it differs, the mean.
//! * Were all errors of the order p, ln Q would be off by D/(2ᵖ - 1), which is taken off (Richardson's extrapolation): with p = 3/2 of
//!   the force, whose observed orders lie between 1 and 2. The area is narrowed by a coarse mesh, of the same orders, and widened by
//!   the penetration, whose rim is thinner than an element, of an order near 1: p = 1 where the companion has more of it. For orders
//!   between 0.8 and 3/2 there, 0.35 to -0.45 of the smooth part is left, for 1 to 2 elsewhere 0.45 to -0.21: half of what the bound
//!   allows.
//! * The bound of what is left is `REMAINS` times the largest smooth part and the largest rest, from a fifth of the depth on. The
//!   rest is that of D, or that of the run from a smooth curve of its own where it is less: the companion ripples more.
//! * Penetration and mesh pull the area in opposite directions, and two runs may agree by chance: what they may hide (`Quantity::hidden`) is added in squares.
//!
//! The two constants were chosen on nine scenes (crushed, indented, ridges, rings; n of 0 to 0.3, elastic), not those of the coverage.
//!
//! The mean pressure is force over area: its bound is the sum of theirs. Values read at the peak or after it are not extrapolated.
//! Their bound is the difference itself, and what the stated errors of force and stiffness (in squares) would do to it, since two runs
//! may agree by chance. That of the elastic fraction also has the work that the energies of the run do not account for.

use crate::point::kinematics::Symmetry;
use crate::run::curve::{COUNTS_FROM, Curve};
use crate::run::record::{CurveRow, Errors, Phase, largest_work};
use crate::run::recorder::Outcome;
use crate::run::schedule::UNLOADING_EXPONENT;
use asperity_law::least_squares::{powers, solve, value};

/// Of force or area, what is known of its errors before a run.
#[derive(Clone, Copy)]
struct Quantity {
    /// The smooth part through points, as coefficients of a parabola.
    smooth: fn(&[[f64; 2]]) -> Option<[f64; 3]>,
    /// Share of the smooth part that is taken off where the companion has more, and where it has less: 1/(2ᵖ - 1) for an order p.
    taken_off: [f64; 2],
    /// Relative error per penetration over depth that mesh and penetration may hide from each other.
    hidden: f64,
}

/// 1/(2ᵖ - 1) for the orders p = 1 and p = 3/2.
const FIRST: f64 = 1.0;
const THREE_HALVES: f64 = 0.547;

const FORCE: Quantity =
    Quantity { smooth: polynomial::<3>, taken_off: [THREE_HALVES, THREE_HALVES], hidden: 0.4 };

/// The penetration widens a contact, by 1 to 8 times its share of the depth, mostly 6 times, and the mesh narrows it. Where the two cancel
/// in D, as much as a third of either is left, for orders between 0.8 and 1.
const AREA: Quantity =
    Quantity { smooth: polynomial::<1>, taken_off: [FIRST, THREE_HALVES], hidden: 6.0 / 3.0 };

/// Largest smooth part of which a share is taken off: a companion that differs by more is in no asymptotic range.
const MOST: f64 = 0.055;

/// Share of the smooth part and of the rest of the difference that bounds the error.
const REMAINS: f64 = 0.9;

/// Depths at which curves are compared, equally spaced in the logarithm.
const DEPTHS: usize = 81;

/// Half the span of ln h over which the rest of the difference counts for a row.
const NEAR: f64 = 0.15;

/// Share of the depth that the companion must reach.
const COMPARED: f64 = 0.9;

/// Least squares of `TERMS` coefficients, of which the others are 0.
fn polynomial<const TERMS: usize>(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let rows: Vec<_> = points.iter().map(|[x, d]| (powers::<TERMS>(*x), *d, 1.0)).collect();
    let found = solve(&rows).filter(|c| c.iter().all(|c| c.is_finite()))?;
    Some(std::array::from_fn(|i| found.get(i).copied().unwrap_or(0.0)))
}

/// Difference of one quantity between companion and run.
struct Difference {
    /// ln(h/h_peak) and ln(Q_companion/Q).
    points: Vec<[f64; 2]>,
    smooth: [f64; 3],
    /// ln Q less a smooth curve of its own, at the same places.
    ripple: Vec<f64>,
    taken_off: [f64; 2],
    /// The error that mesh and penetration may hide.
    hidden: f64,
}

impl Difference {
    /// Of a run whose penetration is this share of the depth.
    fn new(points: Vec<[f64; 2]>, ripple: Vec<f64>, of: Quantity, penetration: f64) -> Option<Difference> {
        let Quantity { smooth, taken_off, hidden } = of;
        let smooth = smooth(&points)?;
        Some(Difference { points, smooth, ripple, taken_off, hidden: hidden * penetration })
    }

    /// The smooth part at x = ln(h/h_peak); that of the first depth before it.
    fn smooth(&self, x: f64) -> f64 {
        value(&self.smooth, &powers(x.clamp(COUNTS_FROM.ln(), 0.0)))
    }

    /// The correction that is added to ln Q.
    fn correction(&self, x: f64) -> f64 {
        let smooth = self.smooth(x);
        -self.share(smooth) * smooth.clamp(-MOST, MOST)
    }

    /// The share of the smooth part that is taken off where it is this.
    fn share(&self, smooth: f64) -> f64 {
        let [more, less] = self.taken_off;
        if smooth > 0.0 { more } else { less }
    }

    /// The bound of what is left near x.
    fn bound(&self, from: f64, to: f64) -> f64 {
        let within = self.points.iter().zip(&self.ripple).filter(|([x, _], _)| (from..=to).contains(x));
        let largest = |[smooth, rest, own, beyond]: [f64; 4], ([x, d], ripple): (&[f64; 2], &f64)| {
            let even = self.smooth(*x);
            // what was not taken off stays
            let left = self.share(even) * (even.abs() - MOST);
            [smooth.max(even.abs()), rest.max((d - even).abs()), own.max(ripple.abs()), beyond.max(left)]
        };
        let [smooth, rest, own, beyond] = within.fold([0.0; 4], largest);
        // the companion ripples more; the run itself has kinks that are no ripple
        let rest = rest.min(own);
        (REMAINS * (smooth + rest)).hypot(self.hidden) + beyond
    }

    fn whole(&self) -> f64 {
        self.bound(f64::NEG_INFINITY, 0.0)
    }
}

/// Curve of a quantity over the first loading, both over their values in the row `top`.
fn curve(rows: &[CurveRow], top: &CurveRow, of: impl Fn(&CurveRow) -> f64) -> Curve {
    let loading = rows.iter().filter(|row| row.phase == Phase::Load);
    Curve::new(loading.map(|row| [row.depth / top.depth, of(row) / of(top)]))
}

/// The last row of the first loading.
fn top(rows: &[CurveRow]) -> Option<&CurveRow> {
    rows.iter().take_while(|row| row.phase == Phase::Load).last()
}

/// Takes the errors that the `companion` reveals off force and area of `run`, and states what is left. `penetration` is that of the
/// run over the depth.
pub(super) fn extrapolate_and_bound(
    run: &mut Outcome,
    companion: &Outcome,
    symmetry: Symmetry,
    penetration: f64,
) {
    let of = [|row: &CurveRow| row.force, |row: &CurveRow| row.contact_area];
    let Some(&last_loaded) = top(&run.rows).filter(|row| row.force > 0.0 && row.contact_area > 0.0) else {
        return;
    };
    let curves = of.map(|of| [&run.rows, &companion.rows].map(|rows| curve(rows, &last_loaded, of)));
    let (end, other) = (curves[0][0].end(), curves[0][1].end());
    // a companion that stopped early says nothing of what comes after
    if other < COMPARED * end {
        return;
    }
    let peak = end.min(other);
    let depths = (0..DEPTHS).map(|i| COUNTS_FROM.ln() * i as f64 / (DEPTHS - 1) as f64).rev();
    let depths: Vec<f64> = depths.collect();
    let difference = |[own, other]: &[Curve; 2], of: Quantity| {
        let smooth = own.smooth(peak);
        let at = |x: &f64| {
            let depth = peak * x.exp();
            let value = own.logarithm_at(depth);
            ([*x, other.logarithm_at(depth) - value], value - smooth.at(depth).ln())
        };
        let (points, ripple) = depths.iter().map(at).unzip();
        Difference::new(points, ripple, of, penetration)
    };
    let (Some(force), Some(area)) = (difference(&curves[0], FORCE), difference(&curves[1], AREA)) else {
        return;
    };
    let summary = &run.summary;
    let relative = |own: Option<f64>, other: Option<f64>| Some((other? / own? - 1.0).abs());
    let unloading_stiffness = relative(summary.unloading_stiffness, companion.summary.unloading_stiffness);
    let unloading_stiffness = unloading_stiffness.map(|s| s + 0.5 * area.whole());
    let indirect = force.whole().hypot(unloading_stiffness.unwrap_or(0.0));
    let difference = |own: Option<f64>, other: Option<f64>| Some((other? - own?).abs());
    let share = |x: f64| x * (1.0 - x) * indirect;
    let residual = summary.residual_depth.map(|depth| (depth / summary.peak_depth).clamp(0.0, 1.0));
    let elastic = summary.elastic_fraction.map(|fraction| fraction.clamp(0.0, 1.0));
    let errors = Errors {
        force: force.whole(),
        contact_area: area.whole(),
        // force and area may err in opposite directions
        mean_pressure: force.whole() + area.whole(),
        residual_depth: difference(summary.residual_depth, companion.summary.residual_depth)
            .zip(residual)
            .map(|(d, r)| d / summary.peak_depth + share(r)),
        elastic_fraction: difference(summary.elastic_fraction, companion.summary.elastic_fraction)
            .zip(elastic)
            .map(|(d, e)| d + share(e) + unaccounted(&run.rows)),
        unloading_stiffness,
    };
    let residual_depth = summary.residual_depth.unwrap_or(0.0);
    let moved = errors.residual_depth.unwrap_or(0.0) * summary.peak_depth;

    let last = run.rows.len() - 1;
    let at = |row: &CurveRow| match row.phase {
        Phase::Load if row.depth > 0.0 => (row.depth / last_loaded.depth).ln(),
        _ => 0.0,
    };
    for share in &mut run.asperities {
        if let Some(row) = run.rows.get(share.increment) {
            share.force *= force.correction(at(row)).exp();
            share.contact_area *= area.correction(at(row)).exp();
        }
    }
    for cycle in &mut run.cycles {
        cycle.peak_force *= force.correction(0.0).exp();
    }
    for (index, row) in run.rows.iter_mut().enumerate() {
        let x = at(row);
        let widened = area.correction(x).exp();
        row.force *= force.correction(x).exp();
        row.contact_area *= widened;
        row.contact_radius *= longer(symmetry, widened);
        row.mean_pressure *= (force.correction(x) - area.correction(x)).exp();
        row.force_error = match row.phase {
            _ if row.depth <= 0.0 || row.force <= 0.0 => None,
            Phase::Load if x < COUNTS_FROM.ln() => {
                let depth = row.depth / last_loaded.depth;
                let own = (curves[0][1].logarithm_at(depth) - curves[0][0].logarithm_at(depth)).abs();
                let first = force.bound(f64::NEG_INFINITY, COUNTS_FROM.ln() + NEAR);
                Some(if own.is_finite() { first.max(own) } else { first.max(1.0) })
            }
            Phase::Load => Some(force.bound(x - NEAR, x + NEAR)),
            // a curve that is moved by the error of the residual depth: dF/F = m dh/(h - h_residual)
            _ if index == last => None,
            _ => {
                let left = (row.depth - residual_depth)
                    / (run.summary.peak_depth - residual_depth).max(f64::MIN_POSITIVE);
                let lever = UNLOADING_EXPONENT * (1.0 - left).max(0.0) * moved;
                let moved = lever / (row.depth - residual_depth).max(f64::MIN_POSITIVE);
                Some((force.bound(-NEAR, 0.0) + moved).min(1.0))
            }
        };
    }
    note_peak(run);
    run.summary.errors = errors;
    run.summary.estimated_error = errors.force;
}

/// Work at the end of a run that its energies do not account for, over that at the peak.
fn unaccounted(rows: &[CurveRow]) -> f64 {
    rows.last().map_or(0.0, |row| row.unaccounted_work().abs() / largest_work(rows))
}

/// Factor of a radius, or of half a width, whose area grows by the factor `wider`.
fn longer(symmetry: Symmetry, wider: f64) -> f64 {
    match symmetry {
        Symmetry::Axisymmetric => wider.sqrt(),
        Symmetry::PlaneStrain => wider,
    }
}

/// Takes the peak of the curve into the summary.
fn note_peak(run: &mut Outcome) {
    if let Some(&top) = top(&run.rows) {
        run.summary.peak_force = top.force;
        run.summary.peak_depth = top.depth;
        run.summary.contact_area = top.contact_area;
        run.summary.contact_radius = top.contact_radius;
    }
}

/// Moves the curve of a run that ended where the sum of its nodal forces was `asked` along itself to where its force is: a
/// power of the depth near the peak.
pub(super) fn rescale_to_force(run: &mut Outcome, asked: f64, symmetry: Symmetry) {
    let Some(&last) = top(&run.rows).filter(|row| row.force > 0.0 && row.contact_area > 0.0) else { return };
    let exponent =
        |of: fn(&CurveRow) -> f64| -curve(&run.rows, &last, of).logarithm_at(0.9) / (1.0_f64 / 0.9).ln();
    let (force, area) = (exponent(|row| row.force), exponent(|row| row.contact_area));
    if !(force > 0.0 && area > 0.0) {
        return;
    }
    let stronger = asked / last.force;
    let deeper = stronger.powf(1.0 / force);
    let wider = deeper.powf(area);
    for row in &mut run.rows {
        row.force *= stronger;
        row.depth *= deeper;
        row.contact_area *= wider;
        row.contact_radius *= longer(symmetry, wider);
        row.mean_pressure *= stronger / wider;
    }
    for share in &mut run.asperities {
        share.force *= stronger;
        share.depth *= deeper;
        share.contact_area *= wider;
    }
    for gap in &mut run.gaps {
        gap.depth *= deeper;
    }
    for cycle in &mut run.cycles {
        cycle.peak_force *= stronger;
        cycle.peak_depth *= deeper;
        cycle.residual_depth *= deeper;
    }
    run.summary.residual_depth = run.summary.residual_depth.map(|depth| depth * deeper);
    note_peak(run);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A companion that differs by `d(x)` from a run without ripple.
    fn difference(of: Quantity, d: impl Fn(f64) -> f64) -> Difference {
        let depths = (0..DEPTHS).map(|i| COUNTS_FROM.ln() * (1.0 - i as f64 / (DEPTHS - 1) as f64));
        let points: Vec<[f64; 2]> = depths.map(|x| [x, d(x)]).collect();
        Difference::new(points, vec![0.0; DEPTHS], of, 0.0).unwrap()
    }

    /// Errors of the orders that are assumed vanish: ln Q is off by e and that of the companion by 2ᵖ e.
    #[test]
    fn errors_of_the_assumed_order_are_taken_off_whole() {
        for (of, order, sign) in [(FORCE, 1.5, 1.0), (FORCE, 1.5, -1.0), (AREA, 1.0, 1.0), (AREA, 1.5, -1.0)]
        {
            // that of the area is taken as even over the depth
            let slope = if order == 1.5 && of.hidden == FORCE.hidden { 0.002 } else { 0.0 };
            let error = |x: f64| sign * (0.008 + slope * x);
            let companion = difference(of, |x| (2_f64.powf(order) - 1.0) * error(x));
            for x in [COUNTS_FROM.ln(), -0.8, -0.2, 0.0] {
                let left = error(x) + companion.correction(x);
                assert!(left.abs() < 2e-5, "order {order}, sign {sign}: {left:e} at {x}");
            }
        }
    }

    /// Of other orders between 0.8 or 1 and 2, and of a companion that is beyond the asymptotic range, the rest is bounded.
    #[test]
    fn what_is_left_is_bounded() {
        for (of, orders, sign) in
            [(FORCE, [1.0, 2.0], 1.0), (AREA, [0.8, 2.0], 1.0), (AREA, [1.0, 2.0], -1.0)]
        {
            for (order, error) in orders.into_iter().flat_map(|p| [(p, 0.01), (p, 0.1)]) {
                let error = sign * error;
                let companion = difference(of, |_| (2_f64.powf(order) - 1.0) * error);
                let left = (error + companion.correction(-0.5)).abs();
                assert!(left > 1e-4 && left <= companion.whole(), "order {order}: {left} of {error}");
            }
        }
    }
}
