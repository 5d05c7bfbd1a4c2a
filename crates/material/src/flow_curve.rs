//! The door for hardening laws of other crates: a curve that a program hands in.

use crate::hardening::HardeningPoint;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// A law of isotropic hardening from outside: the yield stress over accumulated plastic strain.
///
/// All stresses are Pa, whatever unit the solver computes in. The functions are pure: the same argument gives
/// the same bits, whichever thread asks. The yield stress is finite and positive and never falls; softening
/// would localise where the mesh lets it. The slope is finite everywhere: a law that is vertical at first
/// yield, as K ε_p^m with m < 1, gives at 0 the large slope that it has a little further on. No result
/// depends on that number, which the first return alone asks for.
///
/// ```
/// use asperity_material::FlowCurve;
///
/// /// σ = σ_y + K (ε_p + 1e-6)^m: Ludwik's law, its slope bounded at first yield.
/// #[derive(Debug)]
/// struct Shifted {
///     yield_stress: f64,
///     strength: f64,
///     exponent: f64,
/// }
///
/// impl FlowCurve for Shifted {
///     fn name(&self) -> &str {
///         "shifted-power"
///     }
///     fn parameters(&self) -> Vec<(&str, f64)> {
///         vec![("yield_stress_Pa", self.yield_stress), ("strength_Pa", self.strength), ("exponent", self.exponent)]
///     }
///     fn flow(&self, plastic_strain: f64) -> [f64; 2] {
///         let strain = plastic_strain + 1e-6;
///         let hardened = self.strength * strain.powf(self.exponent);
///         [self.yield_stress + hardened, self.exponent * hardened / strain]
///     }
/// }
///
/// let law = Shifted { yield_stress: 300e6, strength: 500e6, exponent: 0.5 };
/// // q - 3G Δε_p = σ(ε_p) from the virgin state on
/// let strain = law.return_to_yield(1e9, 240e9, 0.0);
/// assert!((1e9 - 240e9 * strain - law.flow(strain)[0]).abs() < 1.0);
/// ```
pub trait FlowCurve: fmt::Debug + Send + Sync {
    /// Name of the law in results, not one of a built-in law.
    fn name(&self) -> &str;

    /// Its numbers in SI by name, for results. Two curves of one name and the same numbers are taken to be
    /// the same curve.
    fn parameters(&self) -> Vec<(&str, f64)>;

    /// Yield stress and hardening modulus dσ/dε_p, Pa, at accumulated plastic strain `plastic_strain` ≥ 0;
    /// both finite, at 0 too.
    fn flow(&self, plastic_strain: f64) -> [f64; 2];

    /// Radial return: the plastic strain ε_p at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`.
    ///
    /// `q_trial` (Pa) is at or above the yield stress at `old_plastic_strain`; `three_g` is 3G, Pa. Unless
    /// given: Newton's steps in a bracket that is halved where they leave it.
    fn return_to_yield(&self, q_trial: f64, three_g: f64, old_plastic_strain: f64) -> f64 {
        bracketed_return(|strain| self.flow(strain), q_trial, three_g, old_plastic_strain)
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p, Pa. Unless given: by quadrature, to about 1e-9 of it for a
    /// smooth law.
    fn plastic_work(&self, plastic_strain: f64) -> f64 {
        integral(|strain| self.flow(strain)[0], plastic_strain)
    }
}

/// Steps of a return that does not converge sooner.
const MOST_STEPS: usize = 200;

/// The root of σ(ε_p) + 3G (ε_p - ε_p,old) - q, which grows with ε_p.
fn bracketed_return(flow: impl Fn(f64) -> [f64; 2], q_trial: f64, three_g: f64, old: f64) -> f64 {
    let mut stress = flow(old);
    // a flow without hardening is the longest
    let [mut low, mut high] = [0.0, ((q_trial - stress[0]) / three_g).max(0.0)];
    let mut gap = q_trial - stress[0];
    let mut step = 0.0;
    for _ in 0..MOST_STEPS {
        // a slope without a bound would end the search where it stands
        let newton = if stress[1].is_finite() { step + gap / (three_g + stress[1]) } else { f64::NAN };
        let inside = newton >= low && newton <= high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        let change = (next - step).abs();
        step = next;
        if change <= 2.0 * f64::EPSILON * (old + step) {
            break;
        }
        stress = flow(old + step);
        gap = q_trial - three_g * step - stress[0];
        if gap > 0.0 {
            low = step;
        } else {
            high = step;
        }
    }
    old + step
}

/// Nodes and weights of Gauss and Legendre on (-1, 1), five points.
const GAUSS: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_08],
    [-0.538_469_310_105_683, 0.478_628_670_499_366_47],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683, 0.478_628_670_499_366_47],
    [0.906_179_845_938_664, 0.236_926_885_056_189_08],
];

/// Panels of the quadrature.
const PANELS: usize = 12;

/// ∫₀^end f. In u of x = end u³ the panels lie close where laws bend, at first yield.
fn integral(f: impl Fn(f64) -> f64, end: f64) -> f64 {
    let half = 0.5 / PANELS as f64;
    let at = |i: usize, [node, weight]: [f64; 2]| {
        let u = half * ((2 * i + 1) as f64 + node);
        weight * half * 3.0 * u * u * f(end * u * u * u)
    };
    end * (0..PANELS).map(|i| GAUSS.iter().map(|point| at(i, *point)).sum::<f64>()).sum::<f64>()
}

/// A law from outside in the unit of stress of a computation, shared between the copies of a material.
#[derive(Clone, Debug)]
pub struct OwnLaw {
    law: Arc<dyn FlowCurve>,
    /// Pa in one unit of stress.
    unit: f64,
}

impl OwnLaw {
    /// The law in Pa.
    pub fn new(law: Arc<dyn FlowCurve>) -> OwnLaw {
        OwnLaw { law, unit: 1.0 }
    }

    /// The law as it was handed in, which speaks Pa.
    pub fn law(&self) -> &dyn FlowCurve {
        self.law.as_ref()
    }

    /// The same law with stresses in another unit, of which one is `unit` > 0 here.
    #[must_use]
    pub fn in_units_of(&self, unit: f64) -> OwnLaw {
        OwnLaw { law: self.law.clone(), unit: self.unit * unit }
    }

    /// Yield stress and slope at accumulated plastic strain `plastic_strain` ≥ 0.
    pub fn flow(&self, plastic_strain: f64) -> HardeningPoint {
        let [yield_stress, slope] = self.law.flow(plastic_strain).map(|stress| stress / self.unit);
        HardeningPoint { plastic_strain, yield_stress, slope }
    }

    /// Radial return: the flow state at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`.
    pub fn return_to_yield(&self, q_trial: f64, three_g: f64, old_plastic_strain: f64) -> HardeningPoint {
        let (q_trial, three_g) = (q_trial * self.unit, three_g * self.unit);
        self.flow(self.law.return_to_yield(q_trial, three_g, old_plastic_strain))
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p.
    pub fn plastic_work(&self, plastic_strain: f64) -> f64 {
        self.law.plastic_work(plastic_strain) / self.unit
    }
}

impl PartialEq for OwnLaw {
    fn eq(&self, other: &OwnLaw) -> bool {
        let same = self.law.name() == other.law.name() && self.law.parameters() == other.law.parameters();
        same && self.unit == other.unit
    }
}

impl Serialize for OwnLaw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        write_custom(serializer, self.law.name(), self.law.parameters())
    }
}

impl<'de> Deserialize<'de> for OwnLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<OwnLaw, D::Error> {
        Err(refuse_custom(deserializer, "hardening law"))
    }
}

/// Writes what a program handed in as a table of `name` and `parameters`, as results hold it.
///
/// # Errors
/// Those of the serializer.
pub fn write_custom<S: Serializer>(
    serializer: S,
    name: &str,
    parameters: Vec<(&str, f64)>,
) -> Result<S::Ok, S::Error> {
    let mut table = serializer.serialize_struct("Custom", 2)?;
    table.serialize_field("name", name)?;
    table.serialize_field("parameters", &parameters.into_iter().collect::<BTreeMap<_, _>>())?;
    table.end()
}

/// The refusal of a file that holds a custom `what`: its code is not in the file.
pub fn refuse_custom<'de, D: Deserializer<'de>>(deserializer: D, what: &str) -> D::Error {
    #[derive(Deserialize)]
    struct Named {
        name: String,
    }
    match Named::deserialize(deserializer) {
        Ok(Named { name }) => de::Error::custom(format!(
            "\"{name}\" is a custom {what} of the program that wrote this, not of a file: hand it in from that program again, or take a built-in one"
        )),
        Err(error) => error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Hardening, HardeningCurve, HardeningLaw};

    const SWIFT: Hardening =
        Hardening { law: HardeningLaw::Swift, yield_stress: 300e6, exponent: 0.3, youngs_modulus: 210e9 };

    /// Swift's law once more, by the door.
    #[derive(Debug)]
    struct Copy;

    impl FlowCurve for Copy {
        fn name(&self) -> &str {
            "copy"
        }
        fn parameters(&self) -> Vec<(&str, f64)> {
            vec![("yield_stress_Pa", 300e6)]
        }
        fn flow(&self, plastic_strain: f64) -> [f64; 2] {
            let flow = SWIFT.flow(plastic_strain);
            [flow.yield_stress, flow.slope]
        }
    }

    #[test]
    fn the_provided_return_meets_the_yield_condition() {
        for old in [0.0, 1e-6, 0.1, 2.0] {
            for overshoot in [0.0, 1e-9, 0.1, 1.0, 1e3, 1e5] {
                let q = Copy.flow(old)[0] * (1.0 + overshoot);
                let strain = Copy.return_to_yield(q, 240e9, old);
                let gap = q - 240e9 * (strain - old) - Copy.flow(strain)[0];
                assert!(gap.abs() <= 1e-14 * (q + 240e9 * old), "{old} {overshoot} {gap}");
                assert!(strain >= old);
            }
        }
    }

    /// The slope at 0 may be anything: the flow is that of the curve.
    #[test]
    fn the_provided_return_leaves_a_vertical_first_yield() {
        for slope_at_0 in [f64::INFINITY, 1e150, 1e12] {
            let root = |strain: f64| {
                let slope = if strain > 0.0 { 250e6 / strain.sqrt() } else { slope_at_0 };
                [300e6 + 500e6 * strain.sqrt(), slope]
            };
            let strain = bracketed_return(root, 1e9, 240e9, 0.0);
            let gap = 1e9 - 240e9 * strain - root(strain)[0];
            assert!(strain > 0.0 && gap.abs() < 1e-5, "{slope_at_0} {strain} {gap}");
        }
    }

    #[test]
    fn the_provided_work_is_the_integral_of_the_yield_stress() {
        for strain in [0.0, 1e-5, 1e-3, 0.1, 3.0] {
            let exact = SWIFT.plastic_work(&SWIFT.flow(strain));
            assert!((Copy.plastic_work(strain) - exact).abs() <= 2e-9 * exact, "{strain}");
        }
    }

    #[test]
    fn a_law_from_outside_is_scaled_to_the_unit_of_the_computation() {
        let (own, power) = (HardeningCurve::from(OwnLaw::new(Arc::new(Copy))), HardeningCurve::from(SWIFT));
        let [own, power] = [own, power].map(|curve| curve.in_units_of(210e9));
        assert!((own.yield_stress() / power.yield_stress() - 1.0).abs() < 1e-15);
        let [a, b] = [&own, &power].map(|curve| curve.return_to_yield(0.02, 1.15, 0.1, 0.0046));
        assert!((a.plastic_strain / b.plastic_strain - 1.0).abs() < 1e-12);
        assert!((own.plastic_work(&a) / power.plastic_work(&b) - 1.0).abs() < 2e-9);
        assert!((own.exponent(1.0) - 0.3).abs() < 1e-12);
    }
}
