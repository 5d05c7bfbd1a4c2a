//! The content of a fit file: the metal with what is known and sought of it, and the measurements.

use crate::known_or_unknown::{KnownOrUnknown, Percent};
use asperity_formats::text::Decimal;
use asperity_material::units::{Compliance, Length, Stiffness, Stress};
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_simulation::scene::{Asperity, Friction, HardeningChoice};
use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt::{self, Formatter};
use std::path::PathBuf;

/// Everything that defines an identification: what `asperity identify` reads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "A fit of `asperity identify`")]
pub struct FitFile {
    /// The metal: a number is known, a range of two is sought.
    pub material: FitMaterial,
    /// The measurements.
    #[serde(default)]
    pub curve: Vec<FitCurve>,
    /// Level of the finite elements that give the answer: draft or standard.
    #[serde(default)]
    pub accuracy: FitAccuracy,
    /// Samples of the posterior in posterior.csv; 0: no file.
    #[schemars(range(max = 100_000))]
    #[serde(default = "samples")]
    pub samples: usize,
    /// Seed of these samples.
    #[serde(default)]
    pub seed: u64,
}

fn samples() -> usize {
    1000
}

/// Level of the finite elements of a fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FitAccuracy {
    /// About 1 % of the force of a cone.
    Draft,
    /// About 0.5 %.
    #[default]
    Standard,
}

/// The metal of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitMaterial {
    /// Young's modulus E.
    #[schemars(example = "210 GPa")]
    pub youngs_modulus: KnownOrUnknown<Stress>,
    /// Poisson's ratio ν, in (-1, 0.5).
    pub poissons_ratio: KnownOrUnknown<f64>,
    /// Initial yield stress σ_y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<KnownOrUnknown<Stress>>,
    /// Hardening exponent n in [0, 1).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_exponent: Option<KnownOrUnknown<f64>>,
    /// Hardening law: `hollomon` (power law in total strain), `swift` (power law in plastic strain) or `table`, whose points follow
    /// any other law.
    #[serde(default)]
    pub hardening_law: FitLaw,
    /// For hardening_law = "table": plastic strain, from 0, and yield stress (known or sought), point by point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_table: Option<Vec<(f64, KnownOrUnknown<Stress>)>>,
    /// The stress that the yield stress means: true stress, or Kirchhoff's.
    #[serde(default)]
    pub stress_measure: StressMeasure,
}

/// Form of the hardening curve that is sought.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FitLaw {
    /// By eq. (1) in the total strain.
    #[default]
    Hollomon,
    /// By a power law in the plastic strain.
    Swift,
    /// By a table of yield stress over plastic strain.
    Table,
}

impl FitLaw {
    /// The power law; `None` of a table.
    pub fn power_law(self) -> Option<HardeningLaw> {
        match self {
            FitLaw::Hollomon => Some(HardeningLaw::Hollomon),
            FitLaw::Swift => Some(HardeningLaw::Swift),
            FitLaw::Table => None,
        }
    }
}

impl From<FitLaw> for HardeningChoice {
    fn from(law: FitLaw) -> Self {
        law.power_law().map_or(HardeningChoice::Table, Into::into)
    }
}

/// A measurement: a force-depth curve in a file, or features of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitCurve {
    /// Text table of depth and force, relative to the fit file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Columns of depth and force, where their names are unusual.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<CurveColumns>,
    /// Number that stands for a reading that is missing, in the unit of the file.
    #[schemars(example = -9999.0)]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missing_value: Option<f64>,
    /// Mark before decimals, `point` or `comma`, where the file does not tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decimal: Option<Decimal>,
    /// Number of the test in a file of several, from 1; absent: every test is a curve of its own.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<usize>,
    /// Numbers of a curve in its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub features: Option<Features>,
    /// The tool.
    pub tool: FitTool,
    /// The asperity that a plane crushes; absent: a flat body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asperity: Option<Asperity>,
    /// Standard deviation of the force (of each feature); absent: from the scatter about the fit, 1 % of features.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<Percent>,
    /// Standard deviation of what the model leaves out, common to the whole curve; absent: 0. That of the correction of a
    /// pyramid counts in addition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_error: Option<Percent>,
    /// Further unknowns of this measurement.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unknown: Vec<Nuisance>,
    /// The imprint that was left, of a cone or a ball: a profile with columns such as r_um,z_um (r from the axis, z up, 0 on
    /// the far field), or a map; or a table with its noise and what the file does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub imprint: Option<FitImprint>,
}

/// The imprint of a measurement: its file, or the file with what is to be said of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FitImprint {
    /// Its file.
    File(PathBuf),
    /// Its file, its noise, its units.
    Table(ImprintTable),
}

/// The file of an imprint, its noise and what it does not say itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImprintTable {
    /// Profile or map, relative to the fit file.
    pub file: PathBuf,
    /// Standard deviation of a height, of a map of one of its heights; absent: from the far field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<Length>,
    /// Distance over which heights are off alike, that of roughness or of the stylus; absent: from the far field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation_length: Option<Length>,
    /// Distance of the points of a map along x and y, or one for both, where the file does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixel_size: Option<ImprintPixel>,
    /// Unit of the heights of a map, where the file does not say.
    #[schemars(example = &"nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_unit: Option<String>,
    /// True where the heights of the file count down, so that the imprint has positive ones.
    #[serde(default)]
    pub z_down: bool,
}

/// Distance of the points of a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ImprintPixel {
    /// Along both sides.
    Both(Length),
    /// Along x and along y.
    Each([Length; 2]),
}

/// By the form of the value, so that a message names the key that is wrong.
impl<'de> Deserialize<'de> for FitImprint {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = FitImprint;
            fn expecting(&self, to: &mut Formatter<'_>) -> fmt::Result {
                to.write_str(
                    "a file, \"imprint.csv\", or a table, { file = \"imprint.csv\", noise = \"5 nm\" }",
                )
            }
            fn visit_str<E: de::Error>(self, file: &str) -> Result<FitImprint, E> {
                Ok(FitImprint::File(file.into()))
            }
            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<FitImprint, A::Error> {
                ImprintTable::deserialize(MapAccessDeserializer::new(table)).map(FitImprint::Table)
            }
        }
        from.deserialize_any(Reader)
    }
}

/// Likewise.
impl<'de> Deserialize<'de> for ImprintPixel {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = ImprintPixel;
            fn expecting(&self, to: &mut Formatter<'_>) -> fmt::Result {
                to.write_str("a length, \"1 um\", or two, [\"1 um\", \"2 um\"]")
            }
            fn visit_str<E: de::Error>(self, size: &str) -> Result<ImprintPixel, E> {
                Length::deserialize(size.into_deserializer()).map(ImprintPixel::Both)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, sizes: A) -> Result<ImprintPixel, A::Error> {
                <[Length; 2]>::deserialize(SeqAccessDeserializer::new(sizes)).map(ImprintPixel::Each)
            }
        }
        from.deserialize_any(Reader)
    }
}

impl ImprintPixel {
    /// Along x and y, m.
    pub fn metres(self) -> [f64; 2] {
        match self {
            ImprintPixel::Both(size) => [size.0; 2],
            ImprintPixel::Each(sizes) => sizes.map(|size| size.0),
        }
    }
}

impl FitImprint {
    /// The file with what is said of it.
    pub fn table(&self) -> ImprintTable {
        match self {
            FitImprint::File(file) => ImprintTable { file: file.clone(), ..ImprintTable::default() },
            FitImprint::Table(table) => table.clone(),
        }
    }
}

/// The columns of a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurveColumns {
    /// Name of the column of depth, with or without a unit in brackets, or its number from 1; a minus before it
    /// turns the sign of its numbers.
    #[schemars(example = "Pd [nm]")]
    pub depth: String,
    /// That of force.
    #[schemars(example = "Fn [mN]")]
    pub force: String,
}

impl FitCurve {
    /// Columns of depth and force, where a key names them.
    pub fn column_names(&self) -> [Option<&str>; 2] {
        let names = self.columns.as_ref().map(|c| [Some(c.depth.as_str()), Some(c.force.as_str())]);
        names.unwrap_or_default()
    }

    /// The name in pictures of a measurement that messages call `name`: that of its file, with the test where
    /// it has several.
    pub fn label(&self, name: &str) -> String {
        let Some(file) = self.file.as_ref().and_then(|path| path.file_name()) else { return name.into() };
        let file = file.to_string_lossy();
        match (name.split_once(": "), self.test) {
            (Some((_, test)), _) => format!("{file}, {test}"),
            (None, Some(test)) => format!("{file}, test {test}"),
            (None, None) => file.into_owned(),
        }
    }
}

/// Numbers of a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Features {
    /// F/h² of the loading.
    #[schemars(example = "27.4 GPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loading_curvature: Option<Stress>,
    /// dF/dh where unloading begins, at `max_depth`.
    #[schemars(example = "5.15e6 N/m")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unloading_slope: Option<Stiffness>,
    /// Share of the work of loading that unloading does not return.
    #[schemars(range(min = 0, max = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plastic_work_ratio: Option<f64>,
    /// The largest depth.
    #[schemars(example = "10.4 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_depth: Option<Length>,
    /// Height of the imprint's highest point above the far field, at `max_depth`; of cones and balls.
    #[schemars(example = "0.19 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pile_up_height: Option<Length>,
    /// Depth of the imprint's lowest point below the far field, likewise.
    #[schemars(example = "1.86 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual_depth: Option<Length>,
    /// Radius of the imprint's rim, its highest point, likewise.
    #[schemars(example = "5.9 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim_radius: Option<Length>,
}

impl Features {
    /// The table that such numbers belong to.
    pub const FEATURES_PLACE: &str = "numbers such as loading curvature, unloading slope and work ratio go into features = { loading_curvature = \"27 GPa\", … } in place of file";

    /// True where a table that is no curve has a header of such numbers.
    pub fn are_named_in(table: &str) -> bool {
        let header = table.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().to_lowercase();
        ["curvature", "slope", "dp/dh", "dpdh", "dp_dh", "wp/wt", "wp_wt", "work"]
            .iter()
            .any(|word| header.contains(word))
    }
}

/// Unknowns of a measurement beside the metal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Nuisance {
    /// The depth reading at which the tool touches.
    ContactDepth,
    /// The compliance of the machine.
    MachineCompliance,
    /// The radius of the rounded tip.
    TipRadius,
    /// The coefficient of friction, from 0 to 0.5; a list of two as `friction` of the tool gives other bounds.
    Friction,
}

/// Outline of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FitShape {
    /// A plane that flattens an asperity.
    Plane,
    /// A cone.
    Cone,
    /// A cone with a rounded tip.
    Conospherical,
    /// A ball.
    Sphere,
    /// Berkovich's pyramid, taken as the cone of 70.3° half apex angle, which has the same section at every depth, with a
    /// correction.
    Berkovich,
    /// Vickers' pyramid, likewise, with half the correction.
    Vickers,
}

/// The tool of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitTool {
    /// Its outline.
    pub shape: FitShape,
    /// Cone: angle between flank and horizontal, degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_deg: Option<f64>,
    /// Cone: angle between flank and axis, degrees, instead of `slope_deg`.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_apex_deg: Option<f64>,
    /// Radius of the tip; absent or 0: sharp.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_radius: Option<KnownOrUnknown<Length>>,
    /// Radius of the ball.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<Length>,
    /// Young's modulus of the tool; absent: rigid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Stress>,
    /// Poisson's ratio of the tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
    /// Friction of the tool: a coefficient from 0 to 2, "sticking", or a list of two coefficients where it is sought; absent: smooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<KnownOrUnknown<Friction>>,
    /// Depth per force that the machine adds; absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine_compliance: Option<KnownOrUnknown<Compliance>>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::value::{MapDeserializer, StrDeserializer};

    #[test]
    fn a_table_of_features_is_told_from_a_curve() {
        assert!(Features::are_named_in("\nC_GPa,dP/dh_N_per_m,Wp/Wt\n27.4,5.1e6,0.9\n"));
        assert!(!Features::are_named_in("time_s,voltage\n1,2\n"));
    }

    #[test]
    fn a_key_that_an_imprint_lacks_is_named() {
        let of = |entries: &[(&'static str, &'static str)]| {
            let table = MapDeserializer::<_, de::value::Error>::new(entries.iter().copied());
            FitImprint::deserialize(table).map_err(|e| e.to_string())
        };
        let problem = of(&[("file", "a.csv"), ("nois", "5 nm")]).unwrap_err();
        assert!(problem.contains("`nois`") && problem.contains("`correlation_length`"), "{problem}");
        assert_eq!(of(&[("file", "a.csv")]).unwrap().table(), FitImprint::File("a.csv".into()).table());
        let size: StrDeserializer<'_, de::value::Error> = "1 parsec".into_deserializer();
        let problem = ImprintPixel::deserialize(size).unwrap_err().to_string();
        assert!(problem.contains("parsec"), "{problem}");
        let file: StrDeserializer<'_, de::value::Error> = "a.csv".into_deserializer();
        assert_eq!(FitImprint::deserialize(file), Ok(FitImprint::File("a.csv".into())));
    }
}
