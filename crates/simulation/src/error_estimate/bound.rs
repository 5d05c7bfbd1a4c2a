//! Difference of a quantity between a run and its companion over the depth: the part that is subtracted, and
//! the bound of the remainder.

use crate::fitted::FITTED;
use crate::scene::ElementChoice;
use crate::setup::discretisation::LEAST_COUNTED_DEPTH;
use asperity_numerics::least_squares::{powers, solve, value};
use asperity_solver::point::kinematics::Symmetry;

/// The errors of force or area, as far as they are known before a run.
#[derive(Clone, Copy)]
pub(super) struct Quantity {
    /// The smooth part through points, as coefficients of a parabola.
    smooth: fn(&[[f64; 2]]) -> Option<[f64; 3]>,
    /// Share of the smooth part that is subtracted: 1/(2ᵖ - 1) for an order p.
    share: f64,
    /// ln Q that the penetration is known to add beyond that.
    widened: f64,
    /// Relative errors at the peak that run and companion may hide.
    hidden: Hidden,
    /// Factor of the smooth part in the bound of what is left of it.
    kept: f64,
    /// Factor of a difference of which no order is known.
    safety: f64,
    /// Weight of the difference in the geometric mean of its rest and the ripple of the run itself.
    rest_of_difference: f64,
}

/// Relative errors at the peak that run and companion may hide.
#[derive(Clone, Copy)]
struct Hidden {
    /// Of mesh and penetration, of which the smaller depths have larger shares.
    balanced: f64,
    /// At all depths.
    even: f64,
}

impl Hidden {
    /// Both, in squares, at the logarithm `x` of the depth over that of the peak.
    fn in_squares(self, x: f64) -> f64 {
        (self.balanced * (-FITTED.errors.toward_touch * x).exp()).hypot(self.even)
    }
}

/// The numbers of a run that its bounds depend on, beside the two curves.
#[derive(Clone, Copy)]
pub(crate) struct Setting {
    /// Of the scene.
    pub symmetry: Symmetry,
    /// That of the run.
    pub element: ElementChoice,
    /// Penetration of the run over its depth.
    pub penetration: f64,
    /// Length of the last load step of the run in ln h.
    pub log_step: f64,
    /// The companion has the other element on the same mesh.
    pub same_mesh: bool,
}

/// The factor of safety of the grid convergence index where the order was seen on three meshes or more
/// (Roache, Verification and Validation in Computational Science and Engineering, 1998).
const GRID_CONVERGENCE_SAFETY: f64 = 1.25;

/// Span of ln h before the peak in which the front crosses an edge of the coarsest companion.
const SPAN_BEFORE_PEAK: f64 = 0.35;

impl Setting {
    /// The force of a run that has dissipated this share of its work at the peak: elastic paths do not depend
    /// on their steps, and yielding is what meshes err in most. At equal pressures a depth decides the force
    /// by its square in axisymmetry, by itself in plane strain.
    pub(super) fn force(self, dissipated: f64) -> Quantity {
        let fitted = FITTED.errors;
        let power = lengths(self.symmetry) / 2.0;
        let hidden = Hidden {
            balanced: fitted.hidden_force_of(self.element) * (1.0 + dissipated) * power * self.penetration,
            even: fitted.lost_by_steps * dissipated * power * self.log_step.powi(2),
        };
        let share = if self.same_mesh { 0.0 } else { fitted.force_share };
        Quantity {
            smooth: polynomial::<3>,
            share,
            widened: 0.0,
            hidden,
            kept: fitted.kept_of_force,
            safety: 1.0,
            rest_of_difference: fitted.rest_of_difference,
        }
    }

    pub(super) fn area(self) -> Quantity {
        let fitted = FITTED.errors;
        let longer = self.penetration * lengths(self.symmetry);
        let (share, widened, kept) = if self.same_mesh {
            (fitted.area_share_of_other_element, 0.0, fitted.kept_of_other_element)
        } else {
            (fitted.area_share, fitted.widened * longer, fitted.kept_of_area)
        };
        let hidden = Hidden {
            balanced: fitted.hidden_area * self.penetration.powi(2),
            even: fitted.end_of_contact[usize::from(self.same_mesh)] * longer,
        };
        Quantity {
            smooth: even_or_line,
            share,
            widened,
            hidden,
            kept,
            safety: GRID_CONVERGENCE_SAFETY,
            rest_of_difference: 0.0,
        }
    }
}

impl Quantity {
    /// The same of a contact with so many `elements` across it, whose front stays within an edge: nothing is
    /// known of the order of its errors, and the place of the front to an edge alone.
    pub fn within_an_edge(self, elements: usize, symmetry: Symmetry) -> Quantity {
        let edge = lengths(symmetry) / elements as f64;
        let hidden = Hidden { even: self.hidden.even.hypot(edge), ..self.hidden };
        Quantity { share: 0.0, widened: 0.0, hidden, ..self }
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
pub(super) fn longer(symmetry: Symmetry, wider: f64) -> f64 {
    wider.powf(1.0 / lengths(symmetry))
}

/// Least squares of `TERMS` coefficients, of which the others are 0.
fn polynomial<const TERMS: usize>(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let rows: Vec<_> = points.iter().map(|[x, d]| (powers::<TERMS>(*x), *d, 1.0)).collect();
    let found = solve(&rows).filter(|c| c.iter().all(|c| c.is_finite()))?;
    Some(std::array::from_fn(|i| found.get(i).copied().unwrap_or(0.0)))
}

/// The mean, or a line where it explains nearly all.
fn even_or_line(points: &[[f64; 2]]) -> Option<[f64; 3]> {
    let [mean, line] = [polynomial::<1>(points)?, polynomial::<2>(points)?];
    let left = |c: &[f64; 3]| points.iter().map(|[x, d]| (d - value(c, &powers(*x))).powi(2)).sum::<f64>();
    Some(if left(&line) < FITTED.errors.line * left(&mean) { line } else { mean })
}

/// Difference of one quantity between companion and run.
pub(super) struct Difference {
    /// ln(h/h_peak) and ln(Q_companion/Q).
    points: Vec<[f64; 2]>,
    /// ln Q less a smooth curve of its own, at the same places.
    ripple: Vec<f64>,
    /// The stretches on which it is smooth, in their order.
    stretches: Vec<Stretch>,
    of: Quantity,
}

/// Places of a difference between two onsets, on which it has a smooth part.
struct Stretch {
    ends: [f64; 2],
    smooth: [f64; 3],
    /// Share of the smooth part that is subtracted.
    share: f64,
}

/// Fewest places of a stretch: a parabola through fewer is no smooth part.
const FEWEST_PLACES: usize = 9;

impl Difference {
    /// Of these `points` and `ripple`. In the `onsets`, stretches of x in which a contact begins, nothing is
    /// smooth; where they leave too little, they count as any other places.
    pub fn new(
        points: Vec<[f64; 2]>,
        ripple: Vec<f64>,
        onsets: &[[f64; 2]],
        of: Quantity,
    ) -> Option<Difference> {
        let mut stretches = Vec::new();
        let mut from = f64::NEG_INFINITY;
        for &[begin, end] in onsets.iter().chain(&[[f64::INFINITY; 2]]) {
            stretches.extend(Stretch::new(&points, [from, begin], of));
            from = end;
        }
        if stretches.last().is_none_or(|last| last.ends[1] < f64::INFINITY) {
            stretches = vec![Stretch::new(&points, [f64::NEG_INFINITY, f64::INFINITY], of)?];
        }
        Some(Difference { points, ripple, stretches, of })
    }

    /// The smooth part at x = ln(h/h_peak), and the share of it that is subtracted; that of the first depth
    /// before it, `None` in an onset.
    fn smooth(&self, x: f64) -> Option<[f64; 2]> {
        let x = x.clamp(LEAST_COUNTED_DEPTH.ln(), 0.0);
        let stretch = self.stretches.iter().find(|s| s.ends[0] <= x && x <= s.ends[1])?;
        Some([value(&stretch.smooth, &powers(x)), stretch.share])
    }

    /// The correction that is added to ln Q.
    pub fn correction(&self, x: f64) -> f64 {
        let [smooth, share] = self.smooth(x).unwrap_or([0.0; 2]);
        -share * smooth - self.of.widened
    }

    /// The bound of the residual near x.
    pub fn bound(&self, from: f64, to: f64) -> f64 {
        let within = self.points.iter().zip(&self.ripple).filter(|([x, _], _)| (from..=to).contains(x));
        let largest = |[smooth, rest, own]: [f64; 3], ([x, d], ripple): (&[f64; 2], &f64)| {
            // all of it where nothing is smooth
            let [even, share] = self.smooth(*x).unwrap_or([*d, 0.0]);
            [smooth.max(self.kept(share) * even.abs()), rest.max((d - even).abs()), own.max(ripple.abs())]
        };
        let [smooth, rest, own] = within.fold([0.0; 3], largest);
        // the companion ripples more; the run itself has kinks that are no ripple
        let weight = self.of.rest_of_difference;
        let rest = FITTED.errors.rest_in_bound * rest.min(own).powf(1.0 - weight) * rest.powf(weight);
        smooth.hypot(rest).hypot(self.of.hidden.in_squares(from.max(LEAST_COUNTED_DEPTH.ln())))
    }

    /// Factor of the smooth part in a bound after this share of it is subtracted: where none is, nothing is
    /// known of its order.
    fn kept(&self, share: f64) -> f64 {
        if share > 0.0 { self.of.kept } else { self.of.safety }
    }

    pub fn whole(&self) -> f64 {
        self.bound(f64::NEG_INFINITY, 0.0)
    }

    /// The bound near the peak.
    pub fn near_peak(&self) -> f64 {
        self.bound(-SPAN_BEFORE_PEAK, 0.0)
    }
}

impl Stretch {
    /// The places of `points` between `ends`; `None` if there are too few.
    fn new(points: &[[f64; 2]], ends: [f64; 2], of: Quantity) -> Option<Stretch> {
        let within: Vec<[f64; 2]> =
            points.iter().copied().filter(|[x, _]| ends[0] <= *x && *x <= ends[1]).collect();
        if within.len() < FEWEST_PLACES {
            return None;
        }
        let smooth = (of.smooth)(&within)?;
        let largest = within.iter().map(|[x, _]| value(&smooth, &powers(*x)).abs()).fold(0.0, f64::max);
        let share = if largest > FITTED.errors.asymptotic { 0.0 } else { of.share };
        Some(Stretch { ends, smooth, share })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTHS: usize = 81;

    const SETTING: Setting = Setting {
        symmetry: Symmetry::Axisymmetric,
        element: ElementChoice::Q8r,
        penetration: 0.0,
        log_step: 1e-3,
        same_mesh: false,
    };

    /// A companion that differs by `d(x)` from a run without ripple.
    fn difference(of: Quantity, d: impl Fn(f64) -> f64) -> Difference {
        let depths = (0..DEPTHS).map(|i| LEAST_COUNTED_DEPTH.ln() * (1.0 - i as f64 / (DEPTHS - 1) as f64));
        let points: Vec<[f64; 2]> = depths.map(|x| [x, d(x)]).collect();
        Difference::new(points, vec![0.0; DEPTHS], &[], of).unwrap()
    }

    /// Errors of the orders that are assumed vanish: ln Q is off by e and that of the companion by 2ᵖ e.
    #[test]
    fn errors_of_the_assumed_order_are_taken_off_whole() {
        for (of, order) in [(SETTING.force(1.0), 1.5), (SETTING.area(), 1.0)] {
            for sign in [1.0, -1.0] {
                let error = |x: f64| sign * (0.008 + 0.002 * x);
                let companion = difference(of, |x| (2_f64.powf(order) - 1.0) * error(x));
                for x in [LEAST_COUNTED_DEPTH.ln(), -0.8, -0.2, 0.0] {
                    let left = error(x) + companion.correction(x);
                    assert!(left.abs() < 2e-5, "order {order}, sign {sign}: {left:e} at {x}");
                }
            }
        }
    }

    /// A radius that a penetration of 0.004 widens by three times that, of the order 0.85, and a mesh narrows
    /// at the first order.
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

    /// A depth decides the force of an axisymmetric contact by its square: run and companion that agree may
    /// hide twice as much as in plane strain.
    #[test]
    fn what_is_hidden_of_a_force_goes_by_the_lengths_of_the_contact() {
        let [round, flat] = [Symmetry::Axisymmetric, Symmetry::PlaneStrain].map(|symmetry| {
            let setting = Setting { penetration: 0.004, symmetry, ..SETTING };
            difference(setting.force(1.0), |_| 0.0).near_peak()
        });
        assert!(flat > 0.0 && (round / flat - 2.0).abs() < 1e-9, "{round} {flat}");
    }

    /// Onset of another contact between 0.4 and 0.5 of the depth, where run and companion differ by 85 %.
    #[test]
    fn an_onset_stays_out_of_the_bound_at_the_peak() {
        let [begin, end] = [0.4_f64.ln(), 0.5_f64.ln()];
        let d = |x: f64| {
            if x < begin {
                0.02
            } else if x < end {
                -0.6
            } else {
                0.004 + 0.004 * x
            }
        };
        let depths = (0..DEPTHS).map(|i| LEAST_COUNTED_DEPTH.ln() * (1.0 - i as f64 / (DEPTHS - 1) as f64));
        let points: Vec<[f64; 2]> = depths.map(|x| [x, d(x)]).collect();
        for of in [SETTING.force(1.0), SETTING.area()] {
            let found = Difference::new(points.clone(), vec![0.0; DEPTHS], &[[begin, end]], of).unwrap();
            assert!(
                found.near_peak() < 0.01 && found.whole() >= 0.6,
                "{} {}",
                found.near_peak(),
                found.whole()
            );
            assert!((found.correction(0.0) + 0.004 * of.share).abs() < 1e-3);
            assert!(
                (found.correction(-1.2) + 0.02 * of.share).abs() < 1e-3
                    && found.correction(-0.8).abs() < 1e-12
            );
        }
    }

    /// The error that penetration and mesh hide is a larger share of a smaller depth, by a power of it.
    #[test]
    fn what_is_hidden_grows_towards_the_touch() {
        let hidden = Hidden { balanced: 0.003, even: 0.004 };
        assert!((hidden.in_squares(0.0) - 0.005).abs() < 1e-15);
        let grown = (0.003 * 0.5_f64.powf(-FITTED.errors.toward_touch)).hypot(0.004);
        assert!((hidden.in_squares(0.5_f64.ln()) / grown - 1.0).abs() < 1e-12);
    }

    /// Run and companion that agree say nothing of the end of the contact, which nine tenths of the
    /// penetration leave open: twice in an area of axisymmetry, once in a width.
    #[test]
    fn agreement_does_not_say_where_the_contact_ends() {
        for (symmetry, lengths) in [(Symmetry::Axisymmetric, 2.0), (Symmetry::PlaneStrain, 1.0)] {
            let agreed = difference(Setting { symmetry, penetration: 0.004, ..SETTING }.area(), |_| 0.0);
            let end = 0.9 * lengths * 0.004;
            assert!(agreed.near_peak() >= end && agreed.near_peak() < 1.5 * end, "{}", agreed.near_peak());
        }
    }

    /// A kink of a tabulated metal, which a smooth curve of the run has swallowed: a fifth of a percent of
    /// the force, of which the run itself shows a twentieth.
    #[test]
    fn a_kink_in_the_difference_counts_though_the_run_is_smooth() {
        let kink = |x: f64| if x.abs() < 0.05 { 0.002 } else { 0.0 };
        let seen = difference(SETTING.force(1.0), kink);
        let with_ripple =
            Difference::new(seen.points.clone(), vec![1e-4; DEPTHS], &[], SETTING.force(1.0)).unwrap();
        assert!(with_ripple.near_peak() > 1e-3, "{}", with_ripple.near_peak());
    }

    /// Of other orders the rest is bounded, within the asymptotic range.
    #[test]
    fn what_is_left_is_bounded() {
        for (of, orders) in [(SETTING.force(1.0), [1.0, 2.0]), (SETTING.area(), [0.8, 1.5])] {
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
