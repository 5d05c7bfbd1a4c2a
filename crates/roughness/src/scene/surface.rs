//! The table of a surface: where it comes from, and what is done to it.

use super::SceneError;
use super::error::error;
use super::generate::GenerateScene;
use crate::surface::filter;
use crate::surface::generate;
use crate::surface::height_map::HeightMap;
use crate::surface::level::{self, Levelling};
use crate::surface::outliers;
use crate::surface::prepared_surface::Surface;
use asperity_formats::surface::{self, Measured, Request, Spacing};
use asperity_formats::text::Decimal;
use asperity_material::units::{Length, Memory, rounded};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, IntoDeserializer, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt::{self, Formatter};
use std::path::{Path, PathBuf};

/// Treatment of missing points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Missing {
    /// Cells with a missing corner are left out.
    #[default]
    Exclude,
    /// Holes are closed smoothly from their rims.
    Fill,
}

/// A unit of length by name, in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct HeightUnit {
    name: String,
    metres: f64,
}

/// Forms of [`SurfaceScene::pixel_size`].
#[derive(JsonSchema)]
#[schemars(untagged, inline)]
#[allow(dead_code, reason = "the schema alone is wanted")]
enum PixelSize {
    Each([Length; 2]),
    Both(Length),
}

/// Pixels that a surface may have, m: from below the distance of atoms to that of fields.
const POSSIBLE_PIXELS: [f64; 2] = [1e-10, 1.0];
/// Height over which a map may go, m.
const MOST_HEIGHT: f64 = 1.0;

/// The reason why the pixel of a file is not known, with the line that leaves it open.
fn without_pixel(measured: &Measured) -> String {
    let (problem, size) = match measured.spacing {
        Spacing::Numbers(steps) => {
            let [x, y] = steps.map(|step| rounded(step, 6));
            let size = if x == y { format!("\"{x} um\"") } else { format!("[\"{x} um\", \"{y} um\"]") };
            (format!("says that its points are {x} x {y} apart, but not in which unit"), size)
        }
        _ => ("does not say how far its points are apart".into(), "\"1 um\"".to_string()),
    };
    let mut notes = measured.notes.iter().flat_map(|note| note.split("; "));
    let line = notes.find(|note| note.starts_with("line "));
    let line = line.map_or_else(String::new, |line| format!(" ({line})"));
    format!(
        "the file {problem}{line}: add pixel_size = {size} to [surface] (or nm, mm, m, whichever it is), or --set \
         'surface.pixel_size={size}'"
    )
}

/// Heights that no surface has.
fn refuse_absurd(surface: &Surface) -> Result<(), SceneError> {
    let height = surface.parameters.sz;
    if height <= MOST_HEIGHT {
        return Ok(());
    }
    let message = format!(
        "the heights go over {height:.3} m, which no surface has: look whether height_unit is right, or set override = true"
    );
    error("surface", message)
}

/// Two lengths, or one that is meant twice.
fn pixel_size<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[Length; 2]>, D::Error> {
    struct Lengths;
    impl<'de> Visitor<'de> for Lengths {
        type Value = [Length; 2];
        fn expecting(&self, to: &mut Formatter<'_>) -> fmt::Result {
            to.write_str("a length, \"1 um\", or two, [\"1 um\", \"2 um\"]")
        }
        fn visit_str<E: de::Error>(self, length: &str) -> Result<[Length; 2], E> {
            Length::deserialize(length.into_deserializer()).map(|length| [length; 2])
        }
        fn visit_seq<A: SeqAccess<'de>>(self, lengths: A) -> Result<[Length; 2], A::Error> {
            <[Length; 2]>::deserialize(SeqAccessDeserializer::new(lengths))
        }
    }
    from.deserialize_any(Lengths).map(Some)
}

/// Units of heights: those of length, and that of old stylus instruments.
fn units() -> impl Iterator<Item = (&'static str, f64)> {
    Length::UNITS.iter().copied().chain([("Å", 1e-10)])
}

fn unit_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({"enum": units().map(|(unit, _)| unit).collect::<Vec<_>>()})
}

impl TryFrom<String> for HeightUnit {
    type Error = String;

    fn try_from(name: String) -> Result<HeightUnit, String> {
        let (_, metres) = units().find(|(unit, _)| *unit == name).ok_or_else(|| {
            let known: Vec<&str> = units().map(|(unit, _)| unit).collect();
            format!("\"{name}\" is not a unit of length: use one of {}", known.join(", "))
        })?;
        Ok(HeightUnit { metres, name })
    }
}

impl From<HeightUnit> for String {
    fn from(unit: HeightUnit) -> String {
        unit.name
    }
}

/// The columns of a list of points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointColumns {
    /// Name of the column of x, with or without a unit in brackets, or its number from 1.
    #[schemars(example = "X [mm]")]
    pub x: String,
    /// That of y.
    pub y: String,
    /// That of the heights.
    pub z: String,
}

/// Source of the surface and its treatment before the contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceScene {
    /// A file, relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Instead of a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub generate: Option<GenerateScene>,
    /// Heights in memory instead of a file, for surfaces that a program holds.
    #[serde(skip)]
    pub heights: Option<Measured>,
    /// Distance of the points along x and y, or one for both, where the file does not say.
    #[schemars(with = "Option<PixelSize>")]
    #[serde(default, deserialize_with = "pixel_size", skip_serializing_if = "Option::is_none")]
    pub pixel_size: Option<[Length; 2]>,
    /// Unit of the heights, where the file does not say.
    #[schemars(schema_with = "unit_schema")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_unit: Option<HeightUnit>,
    /// True where `pixel_size` and `height_unit` win over what the file says, and a file is read whose sums do not hold.
    #[serde(default, rename = "override")]
    pub override_file: bool,
    /// Number that stands for a point that was not measured, in the unit of the file (text).
    #[schemars(example = -9999.0)]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missing_value: Option<f64>,
    /// Mark before decimals in text, `point` or `comma`, where the file does not tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decimal: Option<Decimal>,
    /// Most memory that reading the file may take; half of what is free unless told.
    #[schemars(example = "4 GB")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory_limit: Option<Memory>,
    /// Columns of a list of points (text), by their names or numbers, with units where the file has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<PointColumns>,
    /// Levelling: by default the plane from a file, nothing from a generated surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<Levelling>,
    /// Missing points.
    #[serde(default)]
    pub missing: Missing,
    /// Points further from the median of their eight neighbours than so many standard deviations count as missing; at least 3.
    #[schemars(extend("minimum" = 3))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outliers: Option<f64>,
    /// Cut-off of the Gaussian S-filter (removes what is shorter).
    #[schemars(example = "5 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub s_filter: Option<Length>,
    /// Cut-off of the Gaussian L-filter (removes what is longer).
    #[schemars(example = "0.8 mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub l_filter: Option<Length>,
    /// True where the map is one period of an endless surface.
    #[serde(default)]
    pub periodic: bool,
}

impl SurfaceScene {
    pub(super) fn validate(&self) -> Result<(), SceneError> {
        let sources = [self.file.is_some(), self.heights.is_some(), self.generate.is_some()];
        match sources.iter().filter(|given| **given).count() {
            0 => return error("surface", "name a file, or add a [surface.generate] table"),
            1 => {}
            _ => return error("surface.file", "give either a file or [surface.generate], not both"),
        }
        if let Some(made) = &self.generate {
            if self.pixel_size.is_some() {
                let message = "a generated surface has size / pixels: remove pixel_size";
                return error("surface.pixel_size", message);
            }
            if self.height_unit.is_some() {
                let message = "a generated surface has its heights from ra: remove height_unit";
                return error("surface.height_unit", message);
            }
            made.request()?;
        }
        if let Some(limit) = self.outliers.filter(|limit| limit.is_nan() || *limit < 3.0) {
            let message =
                format!("{limit} must be at least 3: closer points belong to the surface; for example 8");
            return error("surface.outliers", message);
        }
        for (path, length) in [("surface.s_filter", self.s_filter), ("surface.l_filter", self.l_filter)] {
            if length.is_some_and(|l| l.0 <= 0.0) {
                return error(path, "a cut-off must be above 0: leave the key out for no filter");
            }
        }
        if let Some([x, y]) = self.pixel_size.filter(|p| p.iter().any(|l| l.0 <= 0.0)) {
            let message = format!("{x} x {y} is not possible: both must be above 0");
            return error("surface.pixel_size", message);
        }
        match (self.s_filter, self.l_filter) {
            (Some(s), Some(l)) if s.0 >= l.0 => {
                let message = format!("{s} must be below l_filter = {l}: else nothing is left");
                error("surface.s_filter", message)
            }
            _ => Ok(()),
        }
    }

    /// Reads or makes the surface and prepares it: outliers, holes, S-filter, levelling, L-filter, in this
    /// order.
    ///
    /// `resolve` turns a path of the scene into one that can be opened.
    ///
    /// # Errors
    /// A file that is no surface, units that are missing or contradict it, a filter that does not fit it.
    pub fn prepare(&self, resolve: impl Fn(&Path) -> PathBuf) -> Result<Surface, SceneError> {
        fn error_at<E: ToString>(path: &'static str) -> impl Fn(E) -> SceneError {
            move |e| SceneError::new(path, e)
        }
        let source = if self.generate.is_some() { "surface.generate" } else { "surface.file" };
        let mut notes = Vec::new();
        let map = match (&self.file, &self.heights, &self.generate) {
            (Some(file), ..) => {
                let path = resolve(file);
                let measured = surface::read(&path, &self.request())
                    .map_err(|e| SceneError::new(source, format!("{}: {e}", path.display())))?;
                notes.clone_from(&measured.notes);
                self.in_metres(measured)?
            }
            (None, Some(measured), _) => self.in_metres(measured.clone())?,
            (None, None, Some(made)) => {
                let (kind, grid, target) = made.request()?;
                generate::generate(kind, &grid, target).map_err(error_at(source))?
            }
            (None, None, None) => return error("surface", "name a file, or add a [surface.generate] table"),
        };
        let mut map = map.with_periodic(self.periodic);
        let missing = map.missing();
        let mut outliers = 0;
        if let Some(limit) = self.outliers {
            (map, outliers) = outliers::without(map, limit);
        }
        let fill = self.missing == Missing::Fill;
        if let Err(e) = map.extent()
            && !(fill && map.missing() < map.heights().len())
        {
            return error(source, e);
        }
        if fill {
            map = filter::fill(&map).map_err(error_at("surface.missing"))?;
        }
        if let Some(cutoff) = self.s_filter {
            map = filter::s_filter(&map, cutoff.0).map_err(error_at("surface.s_filter"))?;
        }
        let default = if self.generate.is_some() { Levelling::None } else { Levelling::Plane };
        map = level::level(map, self.level.unwrap_or(default));
        if let Some(cutoff) = self.l_filter {
            map = filter::l_filter(&map, cutoff.0).map_err(error_at("surface.l_filter"))?;
        }
        let surface =
            Surface { missing, outliers, notes, ..Surface::from_map(map).map_err(error_at(source))? };
        let parameters = &surface.parameters;
        if ![parameters.sa, parameters.sdq, parameters.mean].iter().all(|v| v.is_finite()) {
            return error(source, "the heights are too large to compute with: check height_unit");
        }
        if self.file.is_some() && !self.override_file {
            refuse_absurd(&surface)?;
        }
        Ok(surface)
    }

    /// Requests of the scene on its file.
    fn request(&self) -> Request<'_> {
        let columns = self.columns.as_ref().map(|c| [&c.x, &c.y, &c.z].map(|name| Some(name.as_str())));
        Request {
            columns: columns.unwrap_or_default(),
            missing_value: self.missing_value,
            decimal: self.decimal,
            override_file: self.override_file,
            memory_limit: self.memory_limit.map(|limit| limit.0.max(0.0) as u64),
        }
    }

    /// Heights in metres, the units that came with them checked against those of the scene.
    fn in_metres(&self, measured: Measured) -> Result<HeightMap, SceneError> {
        let same_to = |share: f64| move |a: f64, b: f64| (a / b - 1.0).abs() <= share;
        let (same, same_step) = (same_to(1e-4), same_to(measured.spacing_error.max(1e-4)));
        let unit = match (measured.height_unit, &self.height_unit) {
            (Some(file), Some(scene)) if !same(file, scene.metres) && !self.override_file => {
                let message = format!(
                    "the file has its heights in units of {}, not of 1 {}: remove height_unit, or set override = true",
                    Length(file),
                    scene.name
                );
                return error("surface.height_unit", message);
            }
            (_, Some(scene)) => scene.metres,
            (Some(file), None) => file,
            (None, None) => {
                let message = "the file does not name the unit of its heights: add height_unit to [surface], which is \"nm\", \
                               \"um\", \"mm\" or \"m\", or --set surface.height_unit=UNIT";
                let unsaid = matches!(measured.spacing, Spacing::Unknown | Spacing::Numbers(_));
                let pixel = without_pixel(&measured).replacen("the file", "it also", 1);
                let both = unsaid && self.pixel_size.is_none();
                return error("surface", if both { format!("{message}; {pixel}") } else { message.into() });
            }
        };
        let said = match measured.spacing {
            Spacing::Unknown | Spacing::Numbers(_) => None,
            Spacing::Metres(p) => Some(p),
            Spacing::HeightUnits(p) => Some(p.map(|v| v * unit)),
        };
        let asked = self.pixel_size.map(|p| p.map(|l| l.0));
        // without a unit they tell how long a pixel is for its width
        if let (Spacing::Numbers([x, y]), Some([a, b])) = (&measured.spacing, asked)
            && !(self.override_file || same_step(x / y, a / b))
        {
            let message = format!(
                "the file has pixels of {x} x {y} in a unit that it does not name, and the scene other sides: give both, \
                 pixel_size = [\"{x} um\", \"{y} um\"] (or nm, mm, m, whichever it is), or set override = true"
            );
            return error("surface.pixel_size", message);
        }
        let pixel = match (said, asked) {
            (Some([x, y]), Some([a, b])) if !(self.override_file || same_step(x, a) && same_step(y, b)) => {
                let [x, y, a, b] = [x, y, a, b].map(|side| rounded(side * 1e6, 7));
                let message = format!(
                    "the file has pixels of {x} x {y} um, the scene says {a} x {b} um: remove pixel_size, or set \
                     override = true to take it; a list of points whose x and y are in another unit than z names both, \
                     columns = {{ x = \"1 [mm]\", y = \"2 [mm]\", z = \"3 [um]\" }}"
                );
                return error("surface.pixel_size", message);
            }
            (_, Some(scene)) => scene,
            (Some(file), None) => file,
            (None, None) => return error("surface", without_pixel(&measured)),
        };
        let mut heights = measured.heights;
        let [least, most] = POSSIBLE_PIXELS;
        if let Some(side) = pixel.iter().find(|side| !(least..=most).contains(*side))
            && !self.override_file
        {
            let message = format!(
                "the pixels are {side:e} m: between {least:e} and {most} m is possible; look whether height_unit and pixel_size are right, \
                 or set override = true"
            );
            return error("surface", message);
        }
        if unit != 1.0 {
            heights.iter_mut().for_each(|z| *z *= unit);
        }
        HeightMap::new(measured.columns, measured.rows, pixel, heights)
            .map_err(|e| SceneError::new("surface.file", e))
    }
}
