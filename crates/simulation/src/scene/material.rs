//! The metal of a scene: what it may hold, and which values make sense.

use super::messages::{Check, error};
use asperity_material::units::Stress;
use asperity_material::{
    Elastic, Hardening, HardeningCurve, HardeningLaw, HardeningMode, HardeningTable, OwnLaw, StressMeasure,
    Voce, range,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Isotropic metal: Hencky elasticity, von Mises plasticity, hardening by a law or a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    #[schemars(example = "210 GPa")]
    pub youngs_modulus: Stress,
    /// Poisson's ratio ν, in (-1, 0.5).
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poissons_ratio: f64,
    /// Initial yield stress σ_y; absent with `hollomon` or `swift`: the body stays elastic; `voce` needs it.
    #[schemars(example = "300 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<Stress>,
    /// Hardening exponent n in [0, 1), 0: perfect plasticity; required beside a yield stress of `hollomon`
    /// and `swift`.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_exponent: Option<f64>,
    /// Hardening law: `hollomon` (power law in total strain), `swift` (power law in plastic strain), `voce`
    /// (saturates) or `table`.
    #[serde(default = "hollomon")]
    pub hardening_law: HardeningChoice,
    /// For hardening_law = "voce": the stress that the yield stress goes to, above yield_stress.
    #[schemars(example = "600 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub saturation_stress: Option<Stress>,
    /// For hardening_law = "voce": plastic strain, above 0, over which what the yield stress lacks of
    /// saturation_stress falls to 1/e.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub saturation_strain: Option<f64>,
    /// For hardening_law = "table": a csv file, relative to the scene file, whose first line is
    /// plastic_strain,yield_stress_MPa, or total_strain in place of plastic_strain, of which stress over Young's
    /// modulus is subtracted; or an input file of Abaqus or CalculiX with *PLASTIC, whose unit of stress its
    /// *ELASTIC tells. Linear between its points, constant beyond the last. A resolved scene has
    /// `hardening_table` in its place.
    #[schemars(example = "curve.csv")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_file: Option<PathBuf>,
    /// Instead of `hardening_file`: accumulated plastic strain, from 0, and yield stress, point by point.
    #[schemars(extend("examples" = [[[0, "300 MPa"], [0.1, "450 MPa"]]]))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_table: Option<Vec<(f64, Stress)>>,
    /// The stress that the yield stress and the hardening curve mean: true stress, or Kirchhoff's, which is J times that.
    #[serde(default)]
    pub stress_measure: StressMeasure,
    /// Change of the yield surface with plastic flow: it grows or moves; the two differ in unloading and reloading.
    #[serde(default = "isotropic")]
    pub hardening_mode: HardeningMode,
    /// Share of the hardening that moves the yield surface in the kinematic mode, in (0, 1]; absent: all of it.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinematic_share: Option<f64>,
    /// For hardening_law = "custom": the law, handed in by a program; a file cannot hold it.
    #[schemars(skip)]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub custom: Option<OwnLaw>,
}

fn hollomon() -> HardeningChoice {
    HardeningChoice::Hollomon
}

fn isotropic() -> HardeningMode {
    HardeningMode::Isotropic
}

/// Form of the hardening curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum HardeningChoice {
    /// By eq. (1) in the total strain.
    Hollomon,
    /// By a power law in the plastic strain.
    Swift,
    /// By Voce's law, an exponential in the plastic strain.
    Voce,
    /// By a table of yield stress over plastic strain.
    Table,
    /// By a law that a program hands in.
    #[schemars(skip)]
    Custom,
}

impl HardeningChoice {
    /// Those that a file may name.
    pub(super) const OF_FILES: [HardeningChoice; 4] =
        [HardeningChoice::Hollomon, HardeningChoice::Swift, HardeningChoice::Voce, HardeningChoice::Table];

    /// Name in a scene.
    pub(super) fn name(self) -> &'static str {
        match self {
            HardeningChoice::Hollomon => HardeningLaw::Hollomon.name(),
            HardeningChoice::Swift => HardeningLaw::Swift.name(),
            HardeningChoice::Voce => "voce",
            HardeningChoice::Table => "table",
            HardeningChoice::Custom => "custom",
        }
    }
}

impl From<HardeningLaw> for HardeningChoice {
    fn from(law: HardeningLaw) -> Self {
        match law {
            HardeningLaw::Hollomon => HardeningChoice::Hollomon,
            HardeningLaw::Swift => HardeningChoice::Swift,
        }
    }
}

impl Material {
    /// Elastic constants, in Pa.
    pub fn elastic(&self) -> Elastic {
        Elastic { youngs_modulus: self.youngs_modulus.0, poissons_ratio: self.poissons_ratio }
    }

    /// True where the metal yields at any stress.
    pub fn yields(&self) -> bool {
        self.yield_stress.is_some()
            || matches!(self.hardening_law, HardeningChoice::Table | HardeningChoice::Custom)
    }

    /// The curve of hardening, in Pa; `None` for an elastic body.
    pub fn hardening(&self) -> Option<HardeningCurve> {
        let law = match self.hardening_law {
            HardeningChoice::Hollomon => HardeningLaw::Hollomon,
            HardeningChoice::Swift => HardeningLaw::Swift,
            HardeningChoice::Voce => return self.voce().map(Into::into),
            HardeningChoice::Custom => return self.custom.clone().map(Into::into),
            HardeningChoice::Table => return HardeningTable::new(&self.points()?).ok().map(Into::into),
        };
        let (yield_stress, exponent) = (self.yield_stress?.0, self.hardening_exponent?);
        Some(Hardening { law, yield_stress, exponent, youngs_modulus: self.youngs_modulus.0 }.into())
    }

    /// Share of the hardening that moves the yield surface: 0 for isotropic hardening.
    pub fn moving_share(&self) -> f64 {
        match self.hardening_mode {
            HardeningMode::Isotropic => 0.0,
            HardeningMode::Kinematic => self.kinematic_share.unwrap_or(1.0),
        }
    }

    /// Voce's law, in Pa; `None` where a number is missing.
    fn voce(&self) -> Option<Voce> {
        Some(Voce {
            yield_stress: self.yield_stress?.0,
            saturation_stress: self.saturation_stress?.0,
            saturation_strain: self.saturation_strain?,
        })
    }

    /// The points of the table, in Pa.
    fn points(&self) -> Option<Vec<[f64; 2]>> {
        let table = self.hardening_table.as_ref()?;
        Some(table.iter().map(|(strain, stress)| [*strain, stress.0]).collect())
    }
}

impl Material {
    /// Ranges; paths relative to the material table.
    pub(super) fn check(&self) -> Check {
        range::youngs_modulus(self.youngs_modulus)
            .map_err(|m| error("youngs_modulus", m + ": steel has 210 GPa"))?;
        range::poissons_ratio(self.poissons_ratio).map_err(|m| {
            let known = ": metals have 0.25 to 0.35; for a nearly incompressible body take 0.4999";
            error("poissons_ratio", m + known)
        })?;
        if self.hardening_mode == HardeningMode::Kinematic && !self.yields() {
            return Err(error(
                "hardening_mode",
                "needs a metal that yields: give the keys of its hardening_law, or leave it out",
            ));
        }
        match self.kinematic_share {
            Some(_) if self.hardening_mode == HardeningMode::Isotropic => {
                return Err(error(
                    "kinematic_share",
                    "needs hardening_mode = \"kinematic\" beside it: add that, or remove it",
                ));
            }
            Some(share) if !(share > 0.0 && share <= 1.0) => {
                return Err(error(
                    "kinematic_share",
                    format!(
                        "must be above 0 and at most 1, not {share}: for isotropic hardening leave hardening_mode out"
                    ),
                ));
            }
            _ => {}
        }
        self.check_keys_of_laws()?;
        match self.hardening_law {
            HardeningChoice::Hollomon | HardeningChoice::Swift => self.check_power_law(),
            HardeningChoice::Voce => self.check_voce(),
            HardeningChoice::Table => self.check_table(),
            HardeningChoice::Custom => self.check_custom(),
        }
    }

    /// No key belongs to another law.
    fn check_keys_of_laws(&self) -> Check {
        // a key that several laws have names all of them
        let rows: [(&str, bool, &[HardeningChoice]); 5] = [
            ("hardening_file", self.hardening_file.is_some(), &[HardeningChoice::Table]),
            ("hardening_table", self.hardening_table.is_some(), &[HardeningChoice::Table]),
            ("saturation_stress", self.saturation_stress.is_some(), &[HardeningChoice::Voce]),
            ("saturation_strain", self.saturation_strain.is_some(), &[HardeningChoice::Voce]),
            ("custom", self.custom.is_some(), &[HardeningChoice::Custom]),
        ];
        for (path, given, laws) in rows {
            if given && !laws.contains(&self.hardening_law) {
                let names: Vec<String> = laws.iter().map(|law| format!("\"{}\"", law.name())).collect();
                let message =
                    format!("needs hardening_law = {} beside it: add that, or remove it", names.join(" or "));
                return Err(error(path, message));
            }
        }
        Ok(())
    }

    fn check_power_law(&self) -> Check {
        if let Some(yield_stress) = self.yield_stress {
            self.check_yield_stress("yield_stress", yield_stress, "for an elastic body leave it out")?;
        }
        match self.hardening_exponent {
            Some(n) => range::hardening_exponent(n).map_err(|m| {
                let known = ": 0 is perfect plasticity; for an elastic body leave yield_stress out";
                error("hardening_exponent", m + known)
            }),
            None if self.yield_stress.is_some() => Err(error(
                "",
                "`hardening_exponent` is missing beside yield_stress: give one from 0 (perfect plasticity) to below 1",
            )),
            None => Ok(()),
        }
    }

    /// Voce's law has its three numbers and no other, and does not soften.
    fn check_voce(&self) -> Check {
        if self.hardening_exponent.is_some() {
            return Err(error(
                "hardening_exponent",
                "does not go with hardening_law = \"voce\", which saturates: remove it, or take \"hollomon\" or \"swift\"",
            ));
        }
        for (key, given, example) in [
            ("yield_stress", self.yield_stress.is_some(), "\"300 MPa\""),
            ("saturation_stress", self.saturation_stress.is_some(), "\"600 MPa\""),
            ("saturation_strain", self.saturation_strain.is_some(), "0.1"),
        ] {
            if !given {
                let message =
                    format!("`{key}` is missing beside hardening_law = \"voce\": give {key} = {example}");
                return Err(error("", message));
            }
        }
        let (Some(first), Some(last), Some(strain)) =
            (self.yield_stress, self.saturation_stress, self.saturation_strain)
        else {
            return Ok(());
        };
        self.check_yield_stress("yield_stress", first, "correct it, or its unit")?;
        if !(last.0 > first.0 && last.0 <= self.youngs_modulus.0) {
            let [low, high, given] = [first, self.youngs_modulus, last].map(|s| s.in_unit("MPa"));
            return Err(error(
                "saturation_stress",
                format!(
                    "must be above yield_stress, {low} MPa, and at most Young's modulus, {high} MPa, not {given} MPa: without hardening take hardening_law = \"swift\" with hardening_exponent = 0"
                ),
            ));
        }
        if !(strain > 0.0 && strain.is_finite()) {
            return Err(error(
                "saturation_strain",
                format!("must be finite and above 0, not {strain}: metals have 0.02 to 0.5"),
            ));
        }
        Ok(())
    }

    /// A custom law stands alone, begins where a yield stress may lie, and never softens.
    fn check_custom(&self) -> Check {
        for (path, given) in [
            ("yield_stress", self.yield_stress.is_some()),
            ("hardening_exponent", self.hardening_exponent.is_some()),
        ] {
            if given {
                return Err(error(path, "does not go with the law that a program hands in: remove it"));
            }
        }
        let Some(law) = &self.custom else {
            let names = HardeningChoice::OF_FILES.map(|law| format!("\"{}\"", law.name())).join(", ");
            let message = format!("\"custom\" is a law that a program hands in: a file takes one of {names}");
            return Err(error("hardening_law", message));
        };
        let virgin = law.flow(0.0);
        let first = Stress(virgin.yield_stress);
        self.check_yield_stress("custom", first, "correct the law, which speaks Pa")?;
        if !(virgin.slope.is_finite() && virgin.slope >= 0.0) {
            return Err(error(
                "custom",
                format!(
                    "the slope of \"{}\" at the plastic strain 0 must be finite and at least 0, not {} Pa: where the law is vertical there, give the slope a little further on",
                    law.law().name(),
                    virgin.slope
                ),
            ));
        }
        let mut last = first.0;
        for strain in [1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0] {
            let flow = law.flow(strain);
            if !(flow.yield_stress >= last && flow.yield_stress <= self.youngs_modulus.0 && flow.slope >= 0.0)
            {
                let [before, given] = [last, flow.yield_stress].map(|s| Stress(s).in_unit("MPa"));
                return Err(error(
                    "custom",
                    format!(
                        "the yield stress of \"{}\" must not fall and be at most Young's modulus, but it is {given} MPa with slope {} Pa at the plastic strain {strain}, after {before} MPa",
                        law.law().name(),
                        flow.slope
                    ),
                ));
            }
            last = flow.yield_stress;
        }
        Ok(())
    }

    /// A table stands alone, hardens, and begins where a yield stress may lie.
    fn check_table(&self) -> Check {
        let law = [
            ("yield_stress", self.yield_stress.is_some()),
            ("hardening_exponent", self.hardening_exponent.is_some()),
        ];
        for (path, given) in law {
            if given {
                return Err(error(
                    path,
                    "does not go with hardening_law = \"table\", whose first point is the yield stress: remove it, or take \"hollomon\" or \"swift\"",
                ));
            }
        }
        let (Some(table), Some(points)) = (&self.hardening_table, self.points()) else {
            return Err(match self.hardening_file {
                None => error(
                    "hardening_law",
                    "\"table\" needs the table: give hardening_file = \"curve.csv\", or hardening_table = [[0, \"300 MPa\"], [0.1, \"450 MPa\"]]",
                ),
                Some(_) => error("hardening_file", "has not been read: put its points into hardening_table"),
            });
        };
        if self.hardening_file.is_some() {
            return Err(error("hardening_file", "does not go with `hardening_table`: remove one of the two"));
        }
        HardeningTable::new(&points).map_err(|e| {
            let path = e.point.map_or("hardening_table".into(), |point| format!("hardening_table[{point}]"));
            error(path, e.message)
        })?;
        self.check_yield_stress("hardening_table[0]", table[0].1, "correct it, or its unit")?;
        match table.iter().position(|(_, stress)| stress.0 > self.youngs_modulus.0) {
            None => Ok(()),
            Some(point) => Err(error(
                format!("hardening_table[{point}]"),
                format!(
                    "the yield stress must be at most Young's modulus, {} MPa, not {} MPa: correct it, or its unit",
                    self.youngs_modulus.in_unit("MPa"),
                    table[point].1.in_unit("MPa")
                ),
            )),
        }
    }

    fn check_yield_stress(&self, path: &str, yield_stress: Stress, way_out: &str) -> Check {
        range::yield_stress(yield_stress, self.youngs_modulus)
            .map_err(|m| error(path, format!("{m}: {way_out}")))
    }
}
