//! The calibrated cone of one metal over all slopes: the table of the calibration, and beyond it the atlas of
//! cones.

use super::coefficient::{Coefficient, Nearest};
use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
use asperity_material::{Elastic, Hardening};
use asperity_numerics::bisection::bisect;
use std::f64::consts::PI;

/// Contact area of an elastic cone over that of its island (Sneddon 1965).
pub(super) const ELASTIC_AREA: f64 = 4.0 / (PI * PI);
/// Least and largest tan β of the nodes between which the atlas is read.
const SLOPES: [f64; 2] = [1e-5, 10.0];
/// Nodes, 3.5 % of tan β apart: lines between them are off by 1e-4.
const NODES: usize = 401;

/// Force and contact of a crushed cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Mean pressure over the island, K tan²β/π, in Pa.
    pub island_pressure: f64,
    /// Contact area over the island, (a tan β/h)².
    pub area_ratio: f64,
    /// True where slope and metal lie in the range of the calibration or of the atlas.
    pub inside: bool,
}

/// A calibration and the atlas with the numbers of one metal.
#[derive(Clone, Debug)]
pub struct Calibrated {
    elastic: Elastic,
    hardening: Hardening,
    coefficient: Coefficient,
    /// ln of K and of the contact ratio over those of the table's nearest place, at nodes of ln tan β.
    beyond: Vec<[f64; 2]>,
}

impl Calibrated {
    /// Of a metal; stresses in Pa.
    pub fn new(elastic: Elastic, hardening: Hardening, coefficient: Coefficient) -> Calibrated {
        let mut cone = Calibrated { elastic, hardening, coefficient, beyond: Vec::new() };
        if let Some(atlas) = Atlas::committed() {
            let [low, high] = SLOPES.map(f64::ln);
            let node = |i: usize| (low + (high - low) * i as f64 / (NODES - 1) as f64).exp();
            cone.beyond = (0..NODES).map(|i| cone.by_the_atlas(atlas, node(i))).collect();
        }
        cone
    }

    fn stress(&self, tan: f64) -> f64 {
        self.hardening.representative_stress(self.coefficient.c * tan)
    }

    fn nearest(&self, tan: f64) -> Nearest {
        self.coefficient.nearest(tan, self.elastic.reduced_modulus() * tan / self.stress(tan))
    }

    fn sharp(&self, tan: f64, elastic: &Elastic, hardening: Hardening) -> SharpCone {
        SharpCone::new(tan.atan().to_degrees(), elastic, hardening, Contact::Crushed)
    }

    /// ln of K tan²β/σ_r and of the contact ratio at `tan` over those of the table's nearest place: as the
    /// atlas has them, less what the atlas and the table differ by at that place. Toward elastic cones, which
    /// both know exactly, that difference is let go.
    fn by_the_atlas(&self, atlas: &Atlas, tan: f64) -> [f64; 2] {
        let near = self.nearest(tan);
        let table = Elastic { poissons_ratio: self.coefficient.poissons_ratio, ..self.elastic };
        let stress = table.reduced_modulus() * near.tan / near.x;
        let edge = Hardening {
            yield_stress: yield_stress(&self.hardening, self.coefficient.c * near.tan, stress),
            ..self.hardening
        };
        let logarithms = |cone: &SharpCone, tan: f64, stress: f64| {
            let answer = atlas.nearest(cone);
            let y = answer.k_over_e.value * tan * tan * self.elastic.youngs_modulus / stress;
            [y.ln(), answer.contact_ratio.value.ln()]
        };
        let here = logarithms(&self.sharp(tan, &self.elastic, self.hardening), tan, self.stress(tan));
        let there = logarithms(&self.sharp(near.tan, &table, edge), near.tan, stress);
        let developed = |x: f64| (0.05 * x).ln_1p();
        let x = self.elastic.reduced_modulus() * tan / self.stress(tan);
        let kept = (developed(x) / developed(near.x)).min(1.0);
        std::array::from_fn(|i| here[i] - there[i] + (kept - 1.0) * (near.logarithms[i] - there[i]))
    }

    /// The cone of the slope `tan`.
    pub fn respond(&self, tan: f64) -> Cone {
        if tan <= 0.0 {
            return Cone { island_pressure: 0.0, area_ratio: ELASTIC_AREA, inside: false };
        }
        let near = self.nearest(tan);
        let beyond = self.shift_beyond(tan);
        let y = (near.logarithms[0] + beyond[0]).exp();
        let ratio = (near.logarithms[1] + beyond[1]).exp();
        Cone {
            island_pressure: y * self.stress(tan) / PI,
            area_ratio: ratio * ratio,
            inside: near.inside || self.sharp(tan, &self.elastic, self.hardening).is_inside(),
        }
    }

    fn shift_beyond(&self, tan: f64) -> [f64; 2] {
        let [low, high] = SLOPES.map(f64::ln);
        let at = ((tan.ln() - low) / (high - low)).clamp(0.0, 1.0) * (NODES - 1) as f64;
        let i = (at as usize).min(NODES - 2);
        match self.beyond.get(i..i + 2) {
            Some([a, b]) => std::array::from_fn(|k| a[k] + (at - i as f64) * (b[k] - a[k])),
            _ => [0.0; 2],
        }
    }
}

/// The yield stress with which a metal like `hardening` has the representative stress `stress` at the strain
/// `strain`: the root of σ_y (1 + E ε/σ_y)ⁿ = `stress`, whose left side grows with σ_y.
fn yield_stress(hardening: &Hardening, strain: f64, stress: f64) -> f64 {
    let of = |yield_stress: f64| Hardening { yield_stress, ..*hardening }.representative_stress(strain);
    bisect([0.0, stress], 200, |yield_stress| of(yield_stress) <= stress)[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::HardeningLaw;

    fn metal(yield_mpa: f64, exponent: f64) -> Calibrated {
        metal_of(yield_mpa, exponent, 0.3)
    }

    fn metal_of(yield_mpa: f64, exponent: f64, poissons_ratio: f64) -> Calibrated {
        let law = HardeningLaw::Hollomon;
        let hardening = Hardening { law, yield_stress: yield_mpa, exponent, youngs_modulus: 210e3 };
        let elastic = Elastic { youngs_modulus: 210e3, poissons_ratio };
        Calibrated::new(elastic, hardening, Coefficient::committed().unwrap())
    }

    /// Perfectly plastic metal has a plateau of 3.0 to 3.07 σ_y on the contact in the table; carried on along
    /// lines in ln Y it had 3.5, 4.4 and 5.1 σ_y at E/σ_y 1400, 3500 and 7000.
    #[test]
    fn the_pressure_of_soft_metal_stays_at_its_plateau() {
        for yield_mpa in [427.0, 150.0, 60.0, 30.0, 3.0, 0.03] {
            let cone = metal(yield_mpa, 0.0).respond(10f64.to_radians().tan());
            let over = cone.island_pressure / cone.area_ratio / yield_mpa;
            assert!((2.8..3.1).contains(&over), "{yield_mpa}: {over}");
            assert_eq!(cone.inside, yield_mpa > 21.0);
        }
    }

    /// The force of a cone and its pressure rise with its slope without a jump, from nearly elastic to steep
    /// and soft.
    #[test]
    fn no_edge_of_table_or_atlas_shows() {
        for (yield_mpa, exponent) in [(1500.0, 0.1), (300.0, 0.0), (300.0, 0.3), (60.0, 0.5), (10.0, 0.2)] {
            let cone = metal(yield_mpa, exponent);
            let mut last = cone.respond(1e-5);
            for i in 1..4000 {
                let next = cone.respond(1e-5 * 1.003f64.powi(i));
                let [force, area] =
                    [next.island_pressure / last.island_pressure, next.area_ratio / last.area_ratio]
                        .map(f64::ln);
                // in proportion to the slope at most, that is 0.3 %; the plateau and a ripple of the
                // formula's error take from it
                let tan = 1e-5 * 1.003f64.powi(i);
                let falls = if tan > 0.84 { -0.005 } else { -0.002 };
                assert!(force > falls && force < 0.0045, "{yield_mpa} {exponent} {tan}: {force}");
                assert!(area.abs() < 0.006, "{yield_mpa} {exponent} {tan}: {area}");
                last = next;
            }
        }
    }

    /// Inside its range the table is met, whatever the atlas says; another ν has the share that the atlas
    /// knows.
    #[test]
    fn the_calibration_feeds_the_closure_inside_its_range() {
        let tan = 5f64.to_radians().tan();
        let cone = metal(300.0, 0.3);
        let near = cone.nearest(tan);
        assert!(near.inside);
        let found = cone.respond(tan);
        assert!(
            (found.island_pressure / (near.logarithms[0].exp() * cone.stress(tan) / PI) - 1.0).abs() < 1e-12
        );
        let other = metal_of(300.0, 0.3, 0.45).respond(tan).island_pressure / found.island_pressure;
        // E* is 1.14 of it, and this cone is between elastic and plastic
        assert!((1.0..1.1).contains(&other), "{other}");
    }
}
