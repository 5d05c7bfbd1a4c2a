//! Errors of a run, measured by the run itself: its companion is the same scene with every number of the discretisation half as
//! good, and costs a fifth.
//!
//! With Q the force or the contact area at a depth, D = ln(Q_companion/Q) holds what mesh, load step, penalty and substrate do, each
//! of first order nearly or better, and the ripple of both. The smooth part of D over ln h is a parabola for the force; for the area,
//! whose companion ripples more than it differs, the mean, or a line where D is one.
//! * Were all errors of the order p, ln Q would be off by D/(2ᵖ - 1), which is taken off (Richardson's extrapolation): with p = 3/2 of
//!   the force, whose observed orders lie between 1 and 2, and with p = 1 of the area.
//! * A penetration d over the depth widens radius or half width by about 3 d, of an order near 0.85: after Richardson's extrapolation
//!   of the first order 3 d (2 - 2^0.85) = 0.6 d is left (`WIDENED`), and taken off too.
//! * The bound of what is left is, added in squares, the largest smooth part from a fifth of the depth on and `RIPPLE` times
//!   the largest rest, of the area both with Roache's factor of safety (`SAFETY`), and what errors of mesh and penetration, which have
//!   opposite signs, may hide from each other by chance (`Quantity::hidden`; of the force also what coarse steps lose). The rest is
//!   that of D, or that of the run from a smooth curve of its own where it is less: the companion ripples more.
//! * A companion that differs by more than `MOST` is in no asymptotic range: no share of D is taken off.
//! * The mesh that is given cannot be made coarser. Its companion has the other element, of which no order is known: nothing is taken
//!   off the force, half of D off the area.
//!
//! The orders and `WIDENED` were found on every second round of the scenes of the coverage and hold on the others; shares of the bound
//! were chosen on both.
//!
//! The stiffness of the first unloading is that of a punch, 2 E* a: half of what is taken off the area of an axisymmetric contact is
//! taken off it.
//!
//! The mean pressure is force over area: its bound is the sum of theirs. Other values read at the peak or after it are not
//! extrapolated. Their bound is the difference itself, and what the stated errors of force and stiffness near the peak (in squares)
//! would do to it, since two runs may agree by chance; to that of the stiffness, half the bound of the area there is added. The
//! elastic fraction has them in squares, and with them the work over the depths that the energies of the body do not account for.

use crate::record::curve::Curve;
use crate::record::recorder::Outcome;
use crate::record::rows::{CurveRow, Errors, Phase, largest_work, work_along};
use crate::scene::ElementChoice;
use crate::setup::discretisation::COUNTS_FROM;
use crate::setup::schedule::UNLOADING_EXPONENT;
use asperity_numerics::least_squares::{powers, solve, value};
use asperity_solver::point::kinematics::Symmetry;

/// The errors of force or area, as far as they are known before a run.
#[derive(Clone, Copy)]
struct Quantity {
    /// The smooth part through points, as coefficients of a parabola.
    smooth: fn(&[[f64; 2]]) -> Option<[f64; 3]>,
    /// Share of the smooth part that is taken off: 1/(2ᵖ - 1) for an order p.
    share: f64,
    /// ln Q that the penetration is known to add beyond that.
    widened: f64,
    /// Relative error that run and companion may hide.
    hidden: f64,
    /// Factor of what is seen of the difference in the bound of what is left of it.
    safety: f64,
}

/// The numbers of a run that its bounds depend on, beside the two curves.
#[derive(Clone, Copy)]
pub(super) struct Setting {
    /// Of the scene.
    pub symmetry: Symmetry,
    /// That of the run.
    pub element: ElementChoice,
    /// Penetration of the run over its depth.
    pub penetration: f64,
    /// Load steps of the run.
    pub steps: usize,
    /// The companion has the other element on the same mesh.
    pub same_mesh: bool,
}

/// 1/(2ᵖ - 1) for the orders p = 1 and p = 3/2.
const FIRST: f64 = 1.0;
const THREE_HALVES: f64 = 0.547;

/// ln of radius or half width, per penetration over depth, that Richardson's extrapolation of the first order leaves. Observed are 0.5
/// to 0.65 at each level, and in every kind of scene.
const WIDENED: f64 = 0.6;

/// ln of the area, per square of penetration over depth, that mesh and penetration hide from the difference of run and companion.
const SECOND: f64 = 300.0;

/// Force that steps lose at the peak, times the square of their number: 12 to 24 steps lose 3 to 8 %, and their companion no more.
const COARSE_STEPS: f64 = 12.0;

/// The rest of the difference that the bound allows for, over the largest that is seen.
const RIPPLE: f64 = 2.0;

/// The factor of safety of the grid convergence index where the order was seen on three meshes or more (Roache, Verification and
/// Validation in Computational Science and Engineering, 1998).
const SAFETY: f64 = 1.25;

impl Setting {
    fn force(self) -> Quantity {
        // errors of linear elements in bending and in volume have opposite signs
        let balanced = if self.element == ElementChoice::Q4 { 1.5 } else { 0.6 };
        let hidden = (balanced * self.penetration).hypot(COARSE_STEPS / (self.steps as f64).powi(2));
        let share = if self.same_mesh { 0.0 } else { THREE_HALVES };
        Quantity { smooth: polynomial::<3>, share, widened: 0.0, hidden, safety: 1.0 }
    }

    fn area(self) -> Quantity {
        let (share, widened) = if self.same_mesh {
            (0.5, 0.0)
        } else {
            (FIRST, WIDENED * self.penetration * lengths(self.symmetry))
        };
        let hidden = SECOND * self.penetration.powi(2);
        Quantity { smooth: even_or_line, share, widened, hidden, safety: SAFETY }
    }
}

/// Lengths that an area is a product of.
fn lengths(symmetry: Symmetry) -> f64 {
    match symmetry {
        Symmetry::Axisymmetric => 2.0,
        Symmetry::PlaneStrain => 1.0,
    }
}

/// Factor of a radius, or of half a width, whose area grows by the factor `wider`.
fn longer(symmetry: Symmetry, wider: f64) -> f64 {
    wider.powf(1.0 / lengths(symmetry))
}

/// Factor of the unloading stiffness where the area grows by the factor `wider`: 2 E* a of a punch. That of a strip depends on its
/// width by a logarithm.
fn stiffer(symmetry: Symmetry, wider: f64) -> f64 {
    match symmetry {
        Symmetry::Axisymmetric => wider.sqrt(),
        Symmetry::PlaneStrain => 1.0,
    }
}

/// Largest smooth part of which a share is taken off: a companion that differs by more is in no asymptotic range, and the whole
/// difference stays in the bound.
const MOST: f64 = 0.055;

/// Depths at which curves are compared, equally spaced in the logarithm.
const DEPTHS: usize = 81;

/// Half the span of ln h over which the rest of the difference counts for a row.
const NEAR: f64 = 0.15;

/// Span of ln h before the peak in which the front crosses an edge of the coarsest companion.
const LAST: f64 = 0.35;

/// Error of a residual depth over the depth, and of an elastic fraction, below which none is stated.
const DIGITS: f64 = 1e-5;

/// Share of the depth that the companion must reach.
const COMPARED: f64 = 0.9;

/// Least squares of `TERMS` coefficients, of which the others are 0.
fn polynomial<const TERMS: usize>(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let rows: Vec<_> = points.iter().map(|[x, d]| (powers::<TERMS>(*x), *d, 1.0)).collect();
    let found = solve(&rows).filter(|c| c.iter().all(|c| c.is_finite()))?;
    Some(std::array::from_fn(|i| found.get(i).copied().unwrap_or(0.0)))
}

/// Share of the variance about the mean below which what a line leaves makes it the smooth part.
const LINE: f64 = 0.15;

/// The mean, or a line where it explains nearly all.
fn even_or_line(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let [mean, line] = [polynomial::<1>(points)?, polynomial::<2>(points)?];
    let left = |c: &[f64; 3]| points.iter().map(|[x, d]| (d - value(c, &powers(*x))).powi(2)).sum::<f64>();
    Some(if left(&line) < LINE * left(&mean) { line } else { mean })
}

/// Difference of one quantity between companion and run.
struct Difference {
    /// ln(h/h_peak) and ln(Q_companion/Q).
    points: Vec<[f64; 2]>,
    /// ln Q less a smooth curve of its own, at the same places.
    ripple: Vec<f64>,
    smooth: [f64; 3],
    of: Quantity,
}

impl Difference {
    fn new(points: Vec<[f64; 2]>, ripple: Vec<f64>, of: Quantity) -> Option<Difference> {
        let smooth = (of.smooth)(&points)?;
        let largest = points.iter().map(|[x, _]| value(&smooth, &powers(*x)).abs()).fold(0.0, f64::max);
        let of = if largest > MOST { Quantity { share: 0.0, ..of } } else { of };
        Some(Difference { points, ripple, smooth, of })
    }

    /// The smooth part at x = ln(h/h_peak); that of the first depth before it.
    fn smooth(&self, x: f64) -> f64 {
        value(&self.smooth, &powers(x.clamp(COUNTS_FROM.ln(), 0.0)))
    }

    /// The correction that is added to ln Q.
    fn correction(&self, x: f64) -> f64 {
        -self.of.share * self.smooth(x) - self.of.widened
    }

    /// The bound of what is left near x.
    fn bound(&self, from: f64, to: f64) -> f64 {
        let within = self.points.iter().zip(&self.ripple).filter(|([x, _], _)| (from..=to).contains(x));
        let largest = |[smooth, rest, own]: [f64; 3], ([x, d], ripple): (&[f64; 2], &f64)| {
            let even = self.smooth(*x);
            [smooth.max(even.abs()), rest.max((d - even).abs()), own.max(ripple.abs())]
        };
        let [smooth, rest, own] = within.fold([0.0; 3], largest);
        // the companion ripples more; the run itself has kinks that are no ripple
        let seen = smooth.hypot(RIPPLE * rest.min(own));
        (self.of.safety * seen).hypot(self.of.hidden)
    }

    fn whole(&self) -> f64 {
        self.bound(f64::NEG_INFINITY, 0.0)
    }

    /// The bound near the peak.
    fn at_peak(&self) -> f64 {
        self.bound(-LAST, 0.0)
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

/// Takes the errors that the `companion` reveals off force, area and stiffness of `run`, and states what is left.
pub(super) fn extrapolate_and_bound(run: &mut Outcome, companion: &Outcome, setting: Setting) {
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
        Difference::new(points, ripple, of)
    };
    let (Some(force), Some(area)) =
        (difference(&curves[0], setting.force()), difference(&curves[1], setting.area()))
    else {
        return;
    };
    let summary = &run.summary;
    let relative = |own: Option<f64>, other: Option<f64>| Some((other? / own? - 1.0).abs());
    let unloading_stiffness = relative(summary.unloading_stiffness, companion.summary.unloading_stiffness);
    let unloading_stiffness = unloading_stiffness.map(|s| s + 0.5 * area.at_peak());
    let indirect = force.at_peak().hypot(unloading_stiffness.unwrap_or(0.0));
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
            .map(|(d, r)| (d / summary.peak_depth + share(r)).max(DIGITS)),
        elastic_fraction: difference(summary.elastic_fraction, companion.summary.elastic_fraction)
            .zip(elastic)
            .map(|(d, e)| d.hypot(share(e)).hypot(unaccounted(&run.rows)).max(DIGITS)),
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
        row.contact_radius *= longer(setting.symmetry, widened);
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
                Some((force.at_peak() + moved).min(1.0))
            }
        };
    }
    let stiffer = stiffer(setting.symmetry, area.correction(0.0).exp());
    run.summary.unloading_stiffness = run.summary.unloading_stiffness.map(|s| s * stiffer);
    note_peak(run);
    run.summary.errors = errors;
    run.summary.estimated_error = errors.force;
}

/// Work over the depths of an unloaded run that the energies of its body do not account for, over the external work at the peak.
fn unaccounted(rows: &[CurveRow]) -> f64 {
    let kept = |row: &CurveRow| row.elastic_energy + row.plastic_work - row.transfer_energy;
    rows.last().map_or(0.0, |last| (work_along(rows) - kept(last)).abs() / largest_work(rows))
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

    const SETTING: Setting = Setting {
        symmetry: Symmetry::Axisymmetric,
        element: ElementChoice::Q8r,
        penetration: 0.0,
        steps: 1000,
        same_mesh: false,
    };

    /// A companion that differs by `d(x)` from a run without ripple.
    fn difference(of: Quantity, d: impl Fn(f64) -> f64) -> Difference {
        let depths = (0..DEPTHS).map(|i| COUNTS_FROM.ln() * (1.0 - i as f64 / (DEPTHS - 1) as f64));
        let points: Vec<[f64; 2]> = depths.map(|x| [x, d(x)]).collect();
        Difference::new(points, vec![0.0; DEPTHS], of).unwrap()
    }

    /// Errors of the orders that are assumed vanish: ln Q is off by e and that of the companion by 2ᵖ e.
    #[test]
    fn errors_of_the_assumed_order_are_taken_off_whole() {
        for (of, order) in [(SETTING.force(), 1.5), (SETTING.area(), 1.0)] {
            for sign in [1.0, -1.0] {
                let error = |x: f64| sign * (0.008 + 0.002 * x);
                let companion = difference(of, |x| (2_f64.powf(order) - 1.0) * error(x));
                for x in [COUNTS_FROM.ln(), -0.8, -0.2, 0.0] {
                    let left = error(x) + companion.correction(x);
                    assert!(left.abs() < 2e-5, "order {order}, sign {sign}: {left:e} at {x}");
                }
            }
        }
    }

    /// A radius that a penetration of 0.004 widens by three times that, of the order 0.85, and a mesh narrows at the first order.
    #[test]
    fn what_penetration_and_mesh_do_to_the_area_is_taken_off() {
        for narrowed in [0.0, 0.01, 0.03] {
            let widened = 2.0 * 3.0 * 0.004;
            let d = (2_f64.powf(0.85) - 1.0) * widened - narrowed;
            let companion = difference(Setting { penetration: 0.004, ..SETTING }.area(), |_| d);
            let left = widened - narrowed + companion.correction(0.0);
            assert!(left.abs() < 2e-4, "{left:e} of {widened} - {narrowed}");
        }
    }

    /// The companion of a ripple that swings about a constant, and of a line.
    #[test]
    fn a_line_is_followed_and_a_ripple_is_not() {
        let ripple = |x: f64| 0.01 + 0.02 * (9.0 * x).sin() + 0.002 * x;
        let [mean, line] = [&ripple as &dyn Fn(f64) -> f64, &|x| 0.01 + 0.02 * x + 1e-3 * (9.0 * x).sin()]
            .map(|d| difference(SETTING.area(), d));
        assert_eq!(mean.correction(-1.0).to_bits(), mean.correction(0.0).to_bits());
        assert!((line.correction(0.0) + 0.01).abs() < 1e-3 && (line.correction(-1.0) - 0.01).abs() < 1e-3);
    }

    /// Of other orders the rest is bounded, within the asymptotic range.
    #[test]
    fn what_is_left_is_bounded() {
        for (of, orders) in [(SETTING.force(), [1.0, 2.0]), (SETTING.area(), [0.8, 1.5])] {
            for (order, size) in orders.into_iter().flat_map(|p| [(p, 0.01), (p, 0.04)]) {
                for error in [size, -size] {
                    let companion = difference(of, |_| (2_f64.powf(order) - 1.0) * error);
                    let left = (error + companion.correction(-0.5)).abs();
                    assert!(left > 1e-4 && left <= companion.whole(), "order {order}: {left} of {error}");
                }
            }
        }
    }
}
