//! Closures, the contact laws of single asperities: force and contact area of an island of slope tan β.

use super::calibrated::{Calibrated, ELASTIC_AREA};
use super::coefficient::Coefficient;
use super::material::Material;
use super::own_closure::OwnClosure;
use super::response::{Regime, Response};
use asperity_material::Hardening;
use serde::{Deserialize, Serialize};
use std::str::FromStr;
use thiserror::Error;

/// The published coefficient of eqs (9)-(13).
pub const PUBLISHED_COEFFICIENT: f64 = 0.13;
/// Eq. [18], on the island.
const JOHNSON_ELASTIC: f64 = 0.2;
/// Thresholds of the plasticity index printed below eq. (13).
const THRESHOLDS: [f64; 2] = [0.6, 1.0];

/// The law that gives the force of an island.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Closure {
    /// p = 0.13 E* tan β on the island, never capped (Jourani et al., eqs (10)-(12)).
    Published,
    /// p = c E* tan β with the c of the calibration.
    Fitted,
    /// Elastic, elastic-plastic, plastic after Johnson (eqs (18)-(20) with "tan" of eq. (19) mended to "ln").
    Johnson,
    /// Exact elastic cone (Love 1939, Sneddon 1965).
    Sneddon,
    /// K and contact ratio of the calibrated elastoplastic cone.
    Calibrated,
    /// No closure: the whole surface on an elastic half-space, interaction included.
    HalfSpace,
    /// The same with pressures up to the hardness, else to the plateau of the atlas of cones: elastic and
    /// perfectly plastic.
    HalfSpacePlastic,
    /// A law of one island that a program hands in.
    Custom,
}

impl Closure {
    /// All built-in closures, in the order of the tables.
    pub const ALL: [Closure; 7] = [
        Closure::Published,
        Closure::Fitted,
        Closure::Johnson,
        Closure::Sneddon,
        Closure::Calibrated,
        Closure::HalfSpace,
        Closure::HalfSpacePlastic,
    ];

    /// True where the whole surface is solved at once, without islands.
    pub fn is_half_space(self) -> bool {
        matches!(self, Closure::HalfSpace | Closure::HalfSpacePlastic)
    }

    /// True where it goes by the result of a calibration, for its law or for its unloading.
    pub fn takes_calibration(self) -> bool {
        matches!(self, Closure::Fitted | Closure::Johnson | Closure::Calibrated | Closure::Custom)
    }

    /// The name used in scenes and files.
    pub fn name(self) -> &'static str {
        match self {
            Closure::Published => "published",
            Closure::Fitted => "fitted",
            Closure::Johnson => "johnson",
            Closure::Sneddon => "sneddon",
            Closure::Calibrated => "calibrated",
            Closure::HalfSpace => "half-space",
            Closure::HalfSpacePlastic => "half-space-plastic",
            Closure::Custom => "custom",
        }
    }

    /// The origin of the closure, in one line.
    pub fn source(self) -> &'static str {
        match self {
            Closure::Published => {
                "p = 0.13 E* tan(beta) on the island, never capped (Jourani et al., eqs 10-12)"
            }
            Closure::Fitted => "p = c E* tan(beta) on the island, c from the calibration",
            Closure::Johnson => {
                "p = min(0.2 E* tan(beta) pi^2/4, max(2/3 Y, cavity law), H) on the contact, whose share of the island rises from 4/pi^2 at \
                 2/3 Y to 1 at H (Johnson 1985, ch. 6; eqs 18-20 mended)"
            }
            Closure::Sneddon => {
                "F = 2/pi^2 E* tan(beta) A_island, contact area 4/pi^2 of the island (Sneddon 1965)"
            }
            Closure::Calibrated => {
                "F = K(beta) h^2, area = contact_ratio^2 A_island, K from crushed cones: the calibration, beyond its range the atlas of cones"
            }
            Closure::HalfSpace => {
                "the whole surface on an elastic half-space, pressures from 0 up (Stanley and Kato 1997; Polonsky and Keer 1999)"
            }
            Closure::HalfSpacePlastic => {
                "the same with pressures from 0 to the hardness, else to the plateau of the atlas of cones (Almqvist et al. 2007)"
            }
            Closure::Custom => "handed in by a program",
        }
    }
}

impl FromStr for Closure {
    type Err = String;

    fn from_str(name: &str) -> Result<Closure, String> {
        let names = || Closure::ALL.map(Closure::name).join(", ");
        let found = Closure::ALL.into_iter().find(|closure| closure.name() == name);
        found.ok_or_else(|| format!("\"{name}\" is no closure: take one of {}", names()))
    }
}

/// The reason why a closure cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ClosureError {
    /// The material lacks a value.
    #[error("closure \"{closure}\" needs {needs} in [material]: add it, or choose another closure")]
    Material {
        /// The closure's name.
        closure: &'static str,
        /// The missing keys.
        needs: &'static str,
    },
    /// No calibration was given.
    #[error(
        "closure \"{closure}\" needs the result of a calibration: name the file in `coefficient = \"coefficient.toml\"` \
         (`asperity calibrate` writes it), or choose \"published\", \"johnson\" or \"sneddon\""
    )]
    Coefficient {
        /// The closure's name.
        closure: &'static str,
    },
    /// The closure is no law of one island.
    #[error("\"{closure}\" is no law of one island: it presses the whole surface (half_space::HalfSpace)")]
    Whole {
        /// The closure's name.
        closure: &'static str,
    },
    /// The closure has no law here.
    #[error("\"custom\" is a closure that a program hands in (ClosureLaw::own): take a built-in one")]
    Custom,
    /// The calibration was made with another law.
    #[error(
        "closure \"calibrated\": the calibration belongs to hardening_law = \"{calibrated}\", the material says \"{material}\": \
         set the same law, or name another coefficient file"
    )]
    Law {
        /// Law of the calibration.
        calibrated: &'static str,
        /// Law of the material.
        material: &'static str,
    },
}

/// A closure with the numbers of one material.
#[derive(Clone, Debug)]
pub struct ClosureLaw {
    /// The closure.
    pub closure: Closure,
    material: Material,
    /// E*, in Pa.
    pub reduced_modulus: f64,
    /// H, or 3 σ_y where only that is known (eq. (20)).
    pub hardness: Option<f64>,
    law: Law,
}

#[derive(Clone, Debug)]
enum Law {
    /// Island pressure = coefficient · E* tan β, contact area = ratio · island.
    Linear {
        coefficient: f64,
        area_ratio: f64,
    },
    Johnson {
        yield_stress: f64,
        hardness: f64,
    },
    Calibrated(Calibrated),
    Own(OwnClosure),
}

impl ClosureLaw {
    /// A closure of another crate for one material.
    pub fn own(closure: &OwnClosure, material: &Material) -> ClosureLaw {
        ClosureLaw::of_law(Closure::Custom, material, Law::Own(closure.clone()))
    }

    fn of_law(closure: Closure, material: &Material, law: Law) -> ClosureLaw {
        ClosureLaw {
            closure,
            material: *material,
            reduced_modulus: material.elastic().reduced_modulus(),
            hardness: material.limit(),
            law,
        }
    }

    /// Source of the closure, in one line.
    pub fn source(&self) -> &str {
        match &self.law {
            Law::Own(own) => own.closure().source(),
            _ => self.closure.source(),
        }
    }

    /// The closure for one material; `coefficient` is the calibration's result.
    ///
    /// # Errors
    /// A number of the material or of the calibration that is missing, or a closure without islands.
    pub fn new(
        closure: Closure,
        material: &Material,
        coefficient: Option<&Coefficient>,
    ) -> Result<ClosureLaw, ClosureError> {
        let name = closure.name();
        let hardness = material.limit();
        let calibration = || coefficient.ok_or(ClosureError::Coefficient { closure: name });
        let missing = |needs| ClosureError::Material { closure: name, needs };
        let regimes = || hardness.map(|_| ()).ok_or(missing("hardness (or yield_stress, H = 3 σ_y)"));
        let law = match closure {
            Closure::HalfSpace | Closure::HalfSpacePlastic => {
                return Err(ClosureError::Whole { closure: name });
            }
            Closure::Custom => return Err(ClosureError::Custom),
            Closure::Published => {
                regimes()?;
                Law::Linear { coefficient: PUBLISHED_COEFFICIENT, area_ratio: 1.0 }
            }
            Closure::Fitted => {
                let c = calibration()?.c;
                regimes()?;
                Law::Linear { coefficient: c, area_ratio: 1.0 }
            }
            Closure::Sneddon => Law::Linear { coefficient: 0.5 * ELASTIC_AREA, area_ratio: ELASTIC_AREA },
            Closure::Johnson => {
                let hardness = hardness.ok_or(missing("hardness or yield_stress"))?;
                Law::Johnson { yield_stress: material.yield_stress.map_or(hardness / 3.0, |y| y.0), hardness }
            }
            Closure::Calibrated => {
                let coefficient = calibration()?.clone();
                let yield_stress = material.yield_stress.ok_or(missing("yield_stress"))?.0;
                let exponent = material.hardening_exponent.ok_or(missing("hardening_exponent"))?;
                let law = material.hardening_law.unwrap_or(coefficient.law);
                if law != coefficient.law {
                    return Err(ClosureError::Law {
                        calibrated: coefficient.law.name(),
                        material: law.name(),
                    });
                }
                let youngs_modulus = material.youngs_modulus.0;
                let hardening = Hardening { law, yield_stress, exponent, youngs_modulus };
                Law::Calibrated(Calibrated::new(material.elastic(), hardening, coefficient))
            }
        };
        Ok(ClosureLaw::of_law(closure, material, law))
    }

    /// Force per E* and unit of ∫|∇h|dA, and contact area per island area, of a closure linear in tan β.
    pub fn linear(&self) -> Option<(f64, f64)> {
        match &self.law {
            Law::Linear { coefficient, area_ratio } => Some((*coefficient, *area_ratio)),
            Law::Own(own) => {
                own.closure().linear().map(|[modulus, ratio]| (modulus / self.reduced_modulus, ratio))
            }
            _ => None,
        }
    }

    /// True where unloading returns all the work: closures without a limit of pressure.
    pub fn returns_everything(&self) -> bool {
        self.linear().is_some()
    }

    /// Pressure, area and regime of an island of mean gradient `tan_beta`.
    pub fn respond(&self, tan_beta: f64) -> Response {
        match &self.law {
            Law::Linear { coefficient, area_ratio } => {
                self.response(coefficient * self.reduced_modulus * tan_beta, *area_ratio, true)
            }
            Law::Johnson { yield_stress, hardness } => self.johnson(tan_beta, *yield_stress, *hardness),
            Law::Calibrated(cones) => {
                let cone = cones.respond(tan_beta);
                self.response(cone.island_pressure, cone.area_ratio, cone.inside)
            }
            Law::Own(own) => own.closure().respond(tan_beta),
        }
    }

    /// The regime goes by p/H with the printed thresholds; elastic where no hardness is known.
    fn response(&self, island_pressure: f64, area_ratio: f64, inside: bool) -> Response {
        let index = self.hardness.map_or(0.0, |h| island_pressure / area_ratio / h);
        let regime = match index {
            index if index < THRESHOLDS[0] => Regime::Elastic,
            index if index <= THRESHOLDS[1] => Regime::Elastoplastic,
            _ => Regime::Plastic,
        };
        Response { island_pressure, area_ratio, regime, inside }
    }

    /// Eqs (18)-(20). Eq. (18) is the pressure of an elastic cone on its island; the cavity law and the
    /// hardness are pressures on the contact. So all are taken on the contact, and the contact's share of the
    /// island goes from the elastic cone's to the whole of it, in proportion to the pressure beyond first
    /// yield.
    fn johnson(&self, tan_beta: f64, yield_stress: f64, hardness: f64) -> Response {
        let nu = self.material.poissons_ratio;
        let x = self.material.youngs_modulus.0 * tan_beta / yield_stress;
        let elastic = JOHNSON_ELASTIC / ELASTIC_AREA * self.reduced_modulus * tan_beta;
        let argument = (x + 4.0 * (1.0 - 2.0 * nu)) / (6.0 * (1.0 - nu));
        let log = if argument > 0.0 { argument.ln() } else { f64::NEG_INFINITY };
        let first = 2.0 / 3.0 * yield_stress;
        let cavity = first.max(first * (1.0 + log));
        let pressure = elastic.min(cavity).min(hardness);
        // a hardness below first yield is no metal's: there the contact grows from half of it on
        let start = first.min(0.5 * hardness);
        let flowed = ((pressure - start) / (hardness - start)).max(0.0);
        let area_ratio = ELASTIC_AREA + (1.0 - ELASTIC_AREA) * flowed;
        let regime = if elastic <= cavity.min(hardness) {
            Regime::Elastic
        } else if cavity < hardness {
            Regime::Elastoplastic
        } else {
            Regime::Plastic
        };
        Response { island_pressure: area_ratio * pressure, area_ratio, regime, inside: true }
    }

    /// Elastic pressure of the closure on its contact area at slope `tan_beta`, for the plasticity index (eq.
    /// (13)).
    pub fn elastic_pressure(&self, tan_beta: f64) -> f64 {
        let coefficient = match &self.law {
            Law::Linear { coefficient, area_ratio } => coefficient / area_ratio,
            Law::Johnson { .. } => JOHNSON_ELASTIC / ELASTIC_AREA,
            Law::Calibrated(_) => 0.5, // Sneddon's, on the contact area
            Law::Own(own) => return own.closure().elastic_pressure(tan_beta),
        };
        coefficient * self.reduced_modulus * tan_beta
    }
}

/// Unloading exponent of the paper's single asperity (tip 10 µm, 10°) unloaded from 5 µm.
pub const SINGLE_ASPERITY_EXPONENT: f64 = 1.22;

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::HardeningLaw;
    use asperity_material::units::Stress;
    use std::f64::consts::PI;

    fn steel() -> Material {
        Material {
            youngs_modulus: Stress(210e3),
            poissons_ratio: 0.3,
            hardness: Some(Stress(1280.0)),
            hardness_error: None,
            yield_stress: None,
            hardening_exponent: None,
            hardening_law: None,
        }
    }

    /// The paper's Table 1 slopes: arithmetic of eqs (11), [13], and of [18]-[20] mended, for E 210 GPa, ν
    /// 0.3, H 1280 MPa.
    #[test]
    fn pressures_at_the_slopes_of_table_1() {
        let model = |c| ClosureLaw::new(c, &steel(), None).unwrap();
        for (tan, published, index, johnson) in [
            (0.02741, 822.0, 0.642, 648.2),
            (0.07133, 2140.0, 1.672, 901.1),
            (0.20127, 6038.0, 4.717, 1188.0),
        ] {
            let p = model(Closure::Published).respond(tan).island_pressure;
            assert!((p / published - 1.0).abs() < 1e-3);
            assert!((model(Closure::Published).elastic_pressure(tan) / 1280.0 / index - 1.0).abs() < 1e-3);
            let found = model(Closure::Johnson).respond(tan);
            let p = found.island_pressure / found.area_ratio;
            assert!((p / johnson - 1.0).abs() < 1e-3, "{p} {johnson}");
        }
    }

    #[test]
    fn johnson_is_continuous_monotone_and_capped() {
        let model = ClosureLaw::new(Closure::Johnson, &steel(), None).unwrap();
        let (mut last, mut share) = (0.0, 0.0);
        for i in 0..4000 {
            let tan = 1e-5 * 1.003f64.powi(i);
            let found = model.respond(tan);
            let p = found.island_pressure;
            // elastic it rises with the slope; beyond, the share of the island adds its own rise
            assert!(p >= last && p <= 1280.0 && (i < 1 || p - last < 0.0062 * p.max(1e-3)));
            assert!(found.area_ratio >= share && found.area_ratio <= 1.0);
            (last, share) = (p, found.area_ratio);
        }
        assert_eq!((last, share), (1280.0, 1.0));
        // an elastic cone: 0.2 is 2/π² to 1.3 %, as eq. [18] has it
        let elastic = model.respond(1e-3);
        assert_eq!(elastic.area_ratio, 4.0 / PI / PI);
        assert!((elastic.island_pressure / (0.2 * 210e3 / 0.91 * 1e-3) - 1.0).abs() < 1e-12);
        assert_eq!(model.respond(1.0).regime, Regime::Plastic);
        assert_eq!(model.respond(1e-3).regime, Regime::Elastic);
    }

    #[test]
    fn a_closure_without_its_material_says_what_it_needs() {
        let bare = Material { hardness: None, ..steel() };
        for closure in Closure::ALL {
            let answer = ClosureLaw::new(closure, &bare, None);
            assert_eq!(answer.is_ok(), closure == Closure::Sneddon, "{closure:?}");
        }
        let table = crate::contact::coefficient::tests::master_curve();
        let material =
            Material { yield_stress: Some(Stress(300.0)), hardening_exponent: Some(0.3), ..steel() };
        let model = ClosureLaw::new(Closure::Calibrated, &material, Some(&table)).unwrap();
        // elastic limit: Sneddon's cone, of which the atlas leaves less than a thousandth at this slope
        let soft = model.respond(1e-5);
        assert!(
            (soft.island_pressure / (2.0 / PI / PI * 210e3 / 0.91 * 1e-5) - 1.0).abs() < 1e-3,
            "{soft:?}"
        );
        assert!((soft.area_ratio - 4.0 / PI / PI).abs() < 1e-2);
        let swift = Material { hardening_law: Some(HardeningLaw::Swift), ..material };
        assert!(matches!(
            ClosureLaw::new(Closure::Calibrated, &swift, Some(&table)),
            Err(ClosureError::Law { .. })
        ));
    }
}
