//! Power laws of hardening: the yield stress over plastic strain, the return to yield, the representative
//! stress.

use asperity_numerics::lanes::Real;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The strain that the power law hardens with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum HardeningLaw {
    /// σ = R εⁿ in the total strain ε = σ/E + ε_p (Jourani et al., eq. (1)), R = Eⁿ σ_y^(1-n).
    Hollomon,
    /// σ = σ_y (1 + E ε_p/σ_y)ⁿ in the plastic strain (Dao et al. 2001, Bucaille et al. 2003).
    Swift,
}

impl HardeningLaw {
    /// The name used in scenes and result files.
    pub fn name(self) -> &'static str {
        match self {
            HardeningLaw::Hollomon => "hollomon",
            HardeningLaw::Swift => "swift",
        }
    }
}

/// Isotropic power-law hardening; n = 0 is perfect plasticity.
///
/// Both laws are σ = R eⁿ in a strain measure e ≥ ε_y = σ_y/E and differ in the plastic strain that belongs
/// to e: `hollomon` ε_p = e - σ/E, `swift` ε_p = e - σ_y/E. The equations of this file are solved for e, in
/// which they are smooth and nearly linear for every n in [0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hardening {
    /// The strain that hardens.
    pub law: HardeningLaw,
    /// Initial yield stress σ_y, in the unit of E.
    pub yield_stress: f64,
    /// Hardening exponent n in [0, 1).
    pub exponent: f64,
    /// Young's modulus E: the law is continuous with the elastic line.
    pub youngs_modulus: f64,
}

/// A point on the hardening curve: plastic strain, yield stress and hardening modulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardeningPoint<T = f64> {
    /// Accumulated plastic strain ε_p.
    pub plastic_strain: T,
    /// Yield stress at that strain, in the unit of E.
    pub yield_stress: T,
    /// Hardening modulus dσ/dε_p, in the unit of E.
    pub slope: T,
}

/// Relative change of e in the last step: what the cube of it leaves of the root and of σ rounds to nothing.
const LAST_CHANGE: f64 = 3e-6;

impl Hardening {
    /// Strain at first yield, ε_y = σ_y/E.
    pub fn yield_strain(&self) -> f64 {
        self.yield_stress / self.youngs_modulus
    }

    /// σ(e) = R eⁿ, written with σ_y so that n = 0 is exact.
    #[inline(always)]
    fn stress<T: Real>(&self, e: T) -> T {
        if self.exponent == 0.0 {
            T::splat(self.yield_stress)
        } else {
            (e / self.yield_strain()).powf(self.exponent) * self.yield_stress
        }
    }

    /// The point of the curve at strain measure `e`, where the stress is `sigma`.
    #[inline(always)]
    fn flow_at<T: Real>(&self, [e, sigma]: [T; 2]) -> HardeningPoint<T> {
        let slope_e = sigma * self.exponent / e; // dσ/de
        let (strain, slope) = match self.law {
            HardeningLaw::Hollomon => {
                let modulus = self.youngs_modulus;
                (e - sigma / modulus, slope_e / (T::splat(1.0) - slope_e / modulus))
            }
            HardeningLaw::Swift => (e - self.yield_strain(), slope_e),
        };
        HardeningPoint { plastic_strain: strain.max(T::splat(0.0)), yield_stress: sigma, slope }
    }

    /// Yield stress and slope at accumulated plastic strain `plastic_strain` ≥ 0.
    #[inline(always)]
    pub fn flow<T: Real>(&self, plastic_strain: T) -> HardeningPoint<T> {
        let e = match self.law {
            HardeningLaw::Swift => {
                let e = plastic_strain + self.yield_strain();
                [e, self.stress(e)]
            }
            // e - σ(e)/E = ε_p: the left side is convex in e with slope ≥ 1 - n at first yield
            HardeningLaw::Hollomon => {
                let compliance = T::splat(-1.0 / self.youngs_modulus);
                let e = plastic_strain + self.yield_strain();
                self.solve(T::splat(1.0), compliance, plastic_strain, [e, self.stress(e)])
            }
        };
        HardeningPoint { plastic_strain, ..self.flow_at(e) }
    }

    /// Radial return: the flow state at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`.
    ///
    /// `q_trial` is the trial von Mises stress, at or above `old_yield_stress`, which belongs to
    /// `old_plastic_strain`; `three_g` is 3G. Bracketed steps in e, good for n from 0 to 0.99 and any
    /// overshoot.
    #[inline(always)]
    pub fn return_to_yield<T: Real>(
        &self,
        q_trial: T,
        three_g: T,
        old_plastic_strain: T,
        old_yield_stress: T,
    ) -> HardeningPoint<T> {
        // 3G (e - elastic - ε_p,old) + σ = q with the elastic part of e
        let (elastic, c, rhs) = match self.law {
            HardeningLaw::Hollomon => {
                let modulus = self.youngs_modulus;
                let c = T::splat(1.0) - three_g / modulus;
                (old_yield_stress / modulus, c, q_trial + three_g * old_plastic_strain)
            }
            HardeningLaw::Swift => {
                let rhs = q_trial + three_g * (old_plastic_strain + self.yield_strain());
                (T::splat(self.yield_strain()), T::splat(1.0), rhs)
            }
        };
        let start = [old_plastic_strain + elastic, old_yield_stress];
        self.flow_at(self.solve(three_g, c, rhs, start))
    }

    /// Root e ≥ ε_y of f(e) = `a e + c σ(e) - rhs`, a monotone function (convex for c < 0, concave for c >
    /// 0), and σ there, from a `start` [e, σ(e)] on: Halley's steps, which are of third order, halved
    /// brackets where they leave those. Lanes that have their root wait for the others.
    #[inline(always)]
    fn solve<T: Real>(&self, a: T, c: T, rhs: T, start: [T; 2]) -> [T; 2] {
        let (zero, one, infinity) = (T::splat(0.0), T::splat(1.0), T::splat(f64::INFINITY));
        let n = self.exponent;
        let (mut low, mut high) = (T::splat(self.yield_strain()), infinity);
        let [mut e, mut sigma] = start;
        let (mut found, mut root) = (T::mask(|_| false), start);
        for _ in 0..200 {
            let f = a * e + c * sigma - rhs;
            let beyond = f.is_above(zero);
            (low, high) = (T::select(beyond, low, e), T::select(beyond, e, high));
            // over e: f' = a + cσ', f'' = -(1 - n) cσ'/e with σ' = nσ/e
            let hardens = c * sigma * n / e;
            let slope = a + hardens;
            let newton = f / (slope * e);
            let bend = newton * hardens * (0.5 * (1.0 - n)) / slope;
            // far from the root no more than twice Newton's step
            let halley = e - e * newton / (bend.max(T::splat(-0.5)) + one);
            let inside = halley.is_above(low) & high.is_above(halley);
            let middle = T::select(infinity.is_above(high), (low + high) * 0.5, low);
            let next = T::select(inside, halley, middle);
            let change = (next - e) / e;
            // σ ∝ eⁿ to second order, which is exact to rounding: no power for the last step
            let last = [next, sigma * (change * (change * (0.5 * (n - 1.0)) + one) * n + one)];
            let least = T::select(inside, T::splat(LAST_CHANGE), T::splat(4.0 * f64::EPSILON));
            let open = change.abs().is_above(least);
            root = [T::select(found, root[0], last[0]), T::select(found, root[1], last[1])];
            found = T::mask(|lane| T::holds(found, lane) | !T::holds(open, lane));
            if T::all(found) {
                break;
            }
            (e, sigma) = (next, self.stress(next));
        }
        root
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p, at a state of the curve, in the unit of E.
    pub fn plastic_work(&self, flow: &HardeningPoint) -> f64 {
        let (n, e_y) = (self.exponent, self.yield_strain());
        let power = |e: f64, sigma: f64| (sigma * e - self.yield_stress * e_y) / (n + 1.0); // ∫ R eⁿ de from ε_y
        match self.law {
            HardeningLaw::Hollomon => {
                let (s, s_y) = (flow.yield_stress, self.yield_stress);
                power(flow.plastic_strain + s / self.youngs_modulus, s)
                    - (s - s_y) * (s + s_y) / (2.0 * self.youngs_modulus)
            }
            HardeningLaw::Swift => power(flow.plastic_strain + e_y, flow.yield_stress),
        }
    }

    /// Representative stress σ_r = σ_y (1 + E ε_r/σ_y)ⁿ (Jourani et al., eq. (8)), in the unit of E.
    ///
    /// For `hollomon` ε_r is the strain beyond σ_y/E, for `swift` the plastic strain.
    pub fn representative_stress(&self, representative_strain: f64) -> f64 {
        self.stress(self.yield_strain() + representative_strain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metal(law: HardeningLaw, n: f64, e_over_sy: f64) -> Hardening {
        Hardening { law, yield_stress: 1.0 / e_over_sy, exponent: n, youngs_modulus: 1.0 }
    }

    /// Total-strain law at the points of a uniaxial bar (E = 210 GPa, σ_y = 300 MPa, n = 0.3), stress in MPa.
    #[test]
    fn hollomon_is_equation_1_in_total_strain() {
        let steel = Hardening {
            law: HardeningLaw::Hollomon,
            yield_stress: 300.0,
            exponent: 0.3,
            youngs_modulus: 210e3,
        };
        for (total, stress) in
            [(0.002, 331.86), (0.01, 537.84), (0.05, 871.65), (0.1, 1073.13), (1.0, 2141.17)]
        {
            let plastic = total - stress / 210e3;
            // the stresses are printed to 0.005 MPa, and ε_p inherits that
            assert!((steel.flow(plastic).yield_stress - stress).abs() < 0.01);
        }
    }

    #[test]
    fn return_lands_on_the_curve_for_every_metal_and_overshoot() {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            for n in [0.0, 0.01, 0.1, 0.3, 0.6, 0.99] {
                for e_over_sy in [10.0, 300.0, 1e5] {
                    for nu in [-0.9, 0.0, 0.3, 0.4999999] {
                        for old in [0.0, 1e-6, 0.1] {
                            let m = metal(law, n, e_over_sy);
                            let three_g = 1.5 / (1.0 + nu);
                            let start = m.flow(old);
                            for overshoot in [1e-9, 0.1, 1.0, 1e3, 1e5] {
                                let q = start.yield_stress * (1.0 + overshoot);
                                let end = m.return_to_yield(q, three_g, old, start.yield_stress);
                                let gap = q - three_g * (end.plastic_strain - old) - end.yield_stress;
                                assert!(
                                    gap.abs() <= 1e-12 * (q + three_g * old),
                                    "{law:?} {n} {e_over_sy} {gap}"
                                );
                                let again = m.flow(end.plastic_strain);
                                assert!((again.yield_stress / end.yield_stress - 1.0).abs() < 1e-9);
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn slope_and_work_are_the_derivative_and_the_integral_of_the_yield_stress() {
        for law in [HardeningLaw::Hollomon, HardeningLaw::Swift] {
            for n in [0.0, 0.1, 0.3, 0.6] {
                let m = metal(law, n, 300.0);
                for p in [1e-3, 0.02, 0.5] {
                    let d = 1e-5 * p;
                    let (low, mid, high) = (m.flow(p - d), m.flow(p), m.flow(p + d));
                    let slope = (high.yield_stress - low.yield_stress) / (2.0 * d);
                    assert!((slope - mid.slope).abs() <= 1e-6 * mid.slope.max(1e-3));
                    let density = (m.plastic_work(&high) - m.plastic_work(&low)) / (2.0 * d);
                    assert!((density / mid.yield_stress - 1.0).abs() < 1e-6);
                }
            }
        }
    }
}
