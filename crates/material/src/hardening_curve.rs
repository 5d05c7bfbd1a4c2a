//! Yield stress over accumulated plastic strain, whichever way a scene gives it.

use crate::flow_curve::OwnLaw;
use crate::hardening::{Hardening, HardeningPoint};
use crate::hardening_table::HardeningTable;
use crate::voce::Voce;
use asperity_numerics::lanes::Real;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Change of the yield surface with plastic strain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum HardeningMode {
    /// It grows: reverse yielding begins at the stress that was reached before.
    Isotropic,
    /// It moves and keeps its size: reverse yielding begins early (Bauschinger).
    Kinematic,
}

/// The stress that the hardening curve speaks of. A bar in tension hardly tells them apart; material under an indenter, whose volume
/// shrinks, does: K of a steep cone at E/σ_y = 30 differs by 2 to 3 %.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StressMeasure {
    /// True stress σ, force per current area: what a tensile test gives and other codes mean.
    #[default]
    Cauchy,
    /// τ = Jσ with J the volume ratio.
    Kirchhoff,
}

/// A curve of hardening: a law, or a table.
#[derive(Clone, Debug, PartialEq)]
pub enum HardeningCurve {
    /// A power law.
    Power(Hardening),
    /// Voce's law, which saturates.
    Voce(Voce),
    /// A table, shared between the copies of a material.
    Table(Arc<HardeningTable>),
    /// A law that another crate hands in.
    Own(OwnLaw),
}

impl From<Hardening> for HardeningCurve {
    fn from(law: Hardening) -> Self {
        HardeningCurve::Power(law)
    }
}

impl From<Voce> for HardeningCurve {
    fn from(law: Voce) -> Self {
        HardeningCurve::Voce(law)
    }
}

impl From<HardeningTable> for HardeningCurve {
    fn from(table: HardeningTable) -> Self {
        HardeningCurve::Table(Arc::new(table))
    }
}

impl From<OwnLaw> for HardeningCurve {
    fn from(law: OwnLaw) -> Self {
        HardeningCurve::Own(law)
    }
}

impl HardeningCurve {
    /// Stress at first yield.
    pub fn yield_stress(&self) -> f64 {
        match self {
            HardeningCurve::Power(law) => law.yield_stress,
            HardeningCurve::Voce(law) => law.yield_stress,
            HardeningCurve::Table(table) => table.yield_stress(),
            HardeningCurve::Own(law) => law.flow(0.0).yield_stress,
        }
    }

    /// Yield stress and slope at accumulated plastic strain `plastic_strain` ≥ 0.
    #[inline(always)]
    pub fn flow<T: Real>(&self, plastic_strain: T) -> HardeningPoint<T> {
        match self {
            HardeningCurve::Power(law) => law.flow(plastic_strain),
            HardeningCurve::Voce(law) => law.flow(plastic_strain),
            HardeningCurve::Table(table) => by_lane(|lane| table.flow(plastic_strain.lane(lane))),
            HardeningCurve::Own(law) => by_lane(|lane| law.flow(plastic_strain.lane(lane))),
        }
    }

    /// Radial return: the flow state at which `q_trial - 3G (ε_p - ε_p,old) = σ(ε_p)`; see
    /// [`Hardening::return_to_yield`].
    #[inline(always)]
    pub fn return_to_yield<T: Real>(
        &self,
        q_trial: T,
        three_g: T,
        old_plastic_strain: T,
        old_yield_stress: T,
    ) -> HardeningPoint<T> {
        match self {
            HardeningCurve::Power(law) => {
                law.return_to_yield(q_trial, three_g, old_plastic_strain, old_yield_stress)
            }
            HardeningCurve::Voce(law) => {
                law.return_to_yield(q_trial, three_g, old_plastic_strain, old_yield_stress)
            }
            HardeningCurve::Table(table) => by_lane(|lane| {
                table.return_to_yield(q_trial.lane(lane), three_g.lane(lane), old_plastic_strain.lane(lane))
            }),
            HardeningCurve::Own(law) => by_lane(|lane| {
                law.return_to_yield(q_trial.lane(lane), three_g.lane(lane), old_plastic_strain.lane(lane))
            }),
        }
    }

    /// Plastic work per volume, ∫₀^{ε_p} σ dε_p, at a state of the curve, in the unit of the stresses.
    pub fn plastic_work(&self, flow: &HardeningPoint) -> f64 {
        match self {
            HardeningCurve::Power(law) => law.plastic_work(flow),
            HardeningCurve::Voce(law) => law.plastic_work(flow.plastic_strain),
            HardeningCurve::Table(table) => table.plastic_work(flow.plastic_strain),
            HardeningCurve::Own(law) => law.plastic_work(flow.plastic_strain),
        }
    }

    /// Stress at a representative strain ε_r: eq. (8) of Jourani et al. for a power law (see
    /// [`Hardening::representative_stress`]); of another curve the yield stress at the plastic strain ε_r.
    pub fn representative_stress(&self, representative_strain: f64) -> f64 {
        match self {
            HardeningCurve::Power(law) => law.representative_stress(representative_strain),
            curve => curve.flow(representative_strain).yield_stress,
        }
    }

    /// The hardening exponent that estimates ask for. Of what is no power law: that of the `swift` law
    /// through first yield and the stress at a plastic strain of 0.1, which the material under a contact
    /// reaches; E is `youngs_modulus`.
    pub fn exponent(&self, youngs_modulus: f64) -> f64 {
        match self {
            HardeningCurve::Power(law) => law.exponent,
            curve => {
                let first = curve.yield_stress();
                let (growth, strain) =
                    (curve.flow(0.1).yield_stress / first, 1.0 + 0.1 * youngs_modulus / first);
                (growth.ln() / strain.ln()).clamp(0.0, 1.0)
            }
        }
    }

    /// The same material with all stresses, E among them, in another unit, of which one is `unit` > 0 here.
    #[must_use]
    pub fn in_units_of(&self, unit: f64) -> HardeningCurve {
        match self {
            HardeningCurve::Power(law) => HardeningCurve::Power(Hardening {
                yield_stress: law.yield_stress / unit,
                youngs_modulus: law.youngs_modulus / unit,
                ..*law
            }),
            HardeningCurve::Voce(law) => law.in_units_of(unit).into(),
            HardeningCurve::Table(table) => table.in_units_of(unit).into(),
            HardeningCurve::Own(law) => law.in_units_of(unit).into(),
        }
    }
}

/// The flow that is `of(lane)` in each lane.
fn by_lane<T: Real>(of: impl Fn(usize) -> HardeningPoint) -> HardeningPoint<T> {
    let mut flows = [HardeningPoint { plastic_strain: 0.0, yield_stress: 0.0, slope: 0.0 }; 4];
    (0..T::LANES).for_each(|lane| flows[lane] = of(lane));
    HardeningPoint {
        plastic_strain: T::each(|lane| flows[lane].plastic_strain),
        yield_stress: T::each(|lane| flows[lane].yield_stress),
        slope: T::each(|lane| flows[lane].slope),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HardeningLaw;

    /// A table of a `swift` law has its exponent.
    #[test]
    fn the_exponent_of_a_table_is_that_of_its_law() {
        let law = Hardening {
            law: HardeningLaw::Swift,
            yield_stress: 300.0,
            exponent: 0.23,
            youngs_modulus: 210e3,
        };
        let points: Vec<[f64; 2]> = [0.0, 0.05, 0.1, 0.2].map(|p| [p, law.flow(p).yield_stress]).into();
        let curve = HardeningCurve::from(HardeningTable::new(&points).unwrap());
        assert!((curve.exponent(210e3) - 0.23).abs() < 1e-12);
        assert!((curve.in_units_of(210e3).exponent(1.0) - 0.23).abs() < 1e-12);
        assert!((curve.representative_stress(0.1) / law.representative_stress(0.1) - 1.0).abs() < 1e-12);
    }
}
