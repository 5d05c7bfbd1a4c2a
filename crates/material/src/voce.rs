//! Voce's law: the yield stress saturates, σ = σ_s - (σ_s - σ_y) exp(-ε_p/ε_s).
//!
//! E. Voce, The relationship between stress and strain for homogeneous deformation, J. Inst. Metals 74 (1948)
//! 537.

use crate::hardening::HardeningPoint;
use asperity_numerics::lanes::Real;

/// Isotropic hardening that saturates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Voce {
    /// Initial yield stress σ_y, in the unit of E.
    pub yield_stress: f64,
    /// Stress σ_s ≥ σ_y that the yield stress goes to, in the unit of E.
    pub saturation_stress: f64,
    /// Plastic strain ε_s > 0 over which what is missing of it falls to 1/e.
    pub saturation_strain: f64,
}

/// Relative change of the plastic strain in Newton's last step: what its square leaves of the root rounds to
/// nothing.
const LAST_CHANGE: f64 = 3e-9;

/// Steps that no return takes: from the left, Newton's steps on a concave function need a few dozen at most.
const MOST_STEPS: usize = 100;

/// Largest ε_p/ε_s whose exponential is asked for: the rest is nothing beside 1.
const FARTHEST: f64 = 700.0;

impl Voce {
    /// exp(-x) - 1 for x ≥ 0.
    #[inline(always)]
    fn decayed<T: Real>(x: T) -> T {
        (-x).max(T::splat(-FARTHEST)).exp_m1()
    }

    /// Yield stress and slope at accumulated plastic strain `plastic_strain` ≥ 0.
    #[inline(always)]
    pub fn flow<T: Real>(&self, plastic_strain: T) -> HardeningPoint<T> {
        let growth = self.saturation_stress - self.yield_stress;
        let decayed = Voce::decayed(plastic_strain / self.saturation_strain);
        HardeningPoint {
            plastic_strain,
            yield_stress: T::splat(self.yield_stress) - decayed * growth,
            slope: (decayed + 1.0) * (growth / self.saturation_strain),
        }
    }

    /// Radial return: the flow state at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`; see
    /// [`crate::Hardening::return_to_yield`].
    ///
    /// The function of the flow d = ε_p - ε_p,old is concave and grows: Newton's steps from 0 on come from
    /// the left and stay below the end of the bracket, what flows without hardening. In d a tiny flow keeps
    /// its digits.
    #[inline(always)]
    pub fn return_to_yield<T: Real>(
        &self,
        q_trial: T,
        three_g: T,
        old_plastic_strain: T,
        old_yield_stress: T,
    ) -> HardeningPoint<T> {
        let zero = T::splat(0.0);
        let missing = (T::splat(self.saturation_stress) - old_yield_stress).max(zero);
        let excess = (q_trial - old_yield_stress).max(zero);
        let (steepest, most) = (missing / self.saturation_strain, excess / three_g);
        let mut flow = excess / (three_g + steepest);
        for _ in 0..MOST_STEPS {
            let decayed = Voce::decayed(flow / self.saturation_strain);
            let gap = excess - three_g * flow + decayed * missing;
            let step = (gap / (three_g + (decayed + 1.0) * steepest)).max(zero);
            let next = flow + step;
            flow = T::select(next.is_above(most), most, next);
            if !T::any(step.is_above(flow * LAST_CHANGE)) {
                break;
            }
        }
        let decayed = Voce::decayed(flow / self.saturation_strain);
        HardeningPoint {
            plastic_strain: old_plastic_strain + flow,
            yield_stress: old_yield_stress - decayed * missing,
            slope: (decayed + 1.0) * steepest,
        }
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p, in the unit of the stresses.
    pub fn plastic_work(&self, plastic_strain: f64) -> f64 {
        let growth = self.saturation_stress - self.yield_stress;
        let decayed = Voce::decayed(plastic_strain / self.saturation_strain);
        self.saturation_stress * plastic_strain + growth * self.saturation_strain * decayed
    }

    /// The same law with stresses in another unit, of which one is `unit` > 0 here.
    #[must_use]
    pub fn in_units_of(&self, unit: f64) -> Voce {
        Voce {
            yield_stress: self.yield_stress / unit,
            saturation_stress: self.saturation_stress / unit,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_numerics::lanes::Lanes;

    const METALS: [Voce; 4] = [
        Voce { yield_stress: 1.0 / 700.0, saturation_stress: 2.0 / 700.0, saturation_strain: 0.1 },
        Voce { yield_stress: 0.01, saturation_stress: 0.5, saturation_strain: 1e-3 },
        Voce { yield_stress: 1e-5, saturation_stress: 1.00001e-5, saturation_strain: 3.0 },
        Voce { yield_stress: 0.01, saturation_stress: 0.01, saturation_strain: 0.2 },
    ];

    #[test]
    fn the_curve_goes_from_first_yield_to_saturation() {
        let steel = Voce { yield_stress: 300.0, saturation_stress: 600.0, saturation_strain: 0.1 };
        // 600 - 300 e^(-p/0.1)
        for (p, stress, slope) in [(0.0, 300.0, 3000.0), (0.1, 489.636_17, 1_103.638_3), (9e9, 600.0, 0.0)] {
            let flow = steel.flow(p);
            assert!((flow.yield_stress - stress).abs() < 1e-5 && (flow.slope - slope).abs() < 1e-4, "{p}");
        }
    }

    #[test]
    fn slope_and_work_are_the_derivative_and_the_integral_of_the_yield_stress() {
        for metal in METALS {
            for p in [1e-4, 0.02, 0.5] {
                let d = 1e-5 * p;
                let (low, mid, high) = (metal.flow(p - d), metal.flow(p), metal.flow(p + d));
                let slope = (high.yield_stress - low.yield_stress) / (2.0 * d);
                let rounding = 1e-15 * mid.yield_stress / d;
                assert!((slope - mid.slope).abs() <= 1e-6 * mid.slope + rounding, "{metal:?} {p}");
                let work = metal.plastic_work(p + d) - metal.plastic_work(p - d);
                assert!((work / (2.0 * d * mid.yield_stress) - 1.0).abs() < 1e-6, "{metal:?} {p}");
            }
            assert_eq!(metal.plastic_work(0.0), 0.0);
        }
    }

    #[test]
    fn the_return_lands_on_the_curve_for_every_metal_and_overshoot() {
        for metal in METALS {
            for old in [0.0, 1e-6, 0.1, 4.0] {
                for three_g in [1.01, 1.15, 15.0] {
                    let start = metal.flow(old);
                    for overshoot in [0.0, 1e-9, 0.1, 1.0, 1e3, 1e5] {
                        let q = start.yield_stress * (1.0 + overshoot);
                        let end = metal.return_to_yield(q, three_g, old, start.yield_stress);
                        let gap = q - three_g * (end.plastic_strain - old) - end.yield_stress;
                        assert!(
                            gap.abs() <= 1e-14 * (q + three_g * old),
                            "{metal:?} {old} {overshoot} {gap}"
                        );
                        let again = metal.flow(end.plastic_strain);
                        assert!((again.yield_stress / end.yield_stress - 1.0).abs() < 1e-13);
                        let slopes = (again.slope - end.slope).abs();
                        assert!(slopes <= 1e-9 * metal.flow(0.0).slope, "{metal:?} {slopes}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_tiny_flow_keeps_its_digits() {
        let metal = METALS[0];
        let old = metal.flow(0.0);
        let excess = 1e-13;
        let end = metal.return_to_yield(old.yield_stress + excess, 1.15, 0.0, old.yield_stress);
        assert!((end.plastic_strain * (1.15 + old.slope) / excess - 1.0).abs() < 1e-2);
    }

    #[test]
    fn each_lane_returns_as_it_would_alone() {
        let metal = METALS[0];
        let (old, q) = ([0.0, 0.01, 0.1, 2.0], [0.01, 0.002, 0.7, 0.003]);
        let stress = old.map(|p| metal.flow(p).yield_stress);
        let four = metal.return_to_yield(Lanes(q), Lanes([1.15; 4]), Lanes(old), Lanes(stress));
        for lane in 0..4 {
            let alone = metal.return_to_yield(q[lane], 1.15, old[lane], stress[lane]);
            let gap = four.plastic_strain.0[lane] - alone.plastic_strain;
            assert!(gap.abs() <= 1e-14 * alone.plastic_strain);
        }
    }
}
