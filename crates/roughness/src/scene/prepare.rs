use super::{Missing, SceneError, SurfaceScene, error};
use crate::contact::Surface;
use crate::filter;
use crate::format::{self, Measured, Spacing};
use crate::generate;
use crate::height_map::{Extent, HeightMap};
use crate::level::{self, Level};
use crate::numbers::Roughness;
use std::path::{Path, PathBuf};

/// A surface ready for contact.
pub struct Prepared {
    /// Levelled and filtered.
    pub map: HeightMap,
    /// Points missing before any were filled.
    pub missing: usize,
    /// Extent of the map.
    pub extent: Extent,
    /// Roughness numbers of the map.
    pub roughness: Roughness,
}

impl Prepared {
    /// The surface to press.
    pub fn surface(&self) -> Surface<'_> {
        Surface { map: &self.map, extent: self.extent, roughness: self.roughness }
    }
}

impl SurfaceScene {
    /// Reads or makes the surface and prepares it: holes, S-filter, levelling, L-filter, in this order.
    ///
    /// `resolve` turns a path of the scene into one that can be opened.
    pub fn prepare(&self, resolve: impl Fn(&Path) -> PathBuf) -> Result<Prepared, SceneError> {
        let at = |path: &'static str| move |e: String| SceneError { path: path.into(), message: e };
        let (map, source) = match (&self.file, &self.generate) {
            (Some(file), _) => {
                let path = resolve(file);
                let measured = format::read(&path)
                    .map_err(|e| at("surface.file")(format!("{}: {e}", path.display())))?;
                (self.in_metres(measured)?, "surface.file")
            }
            (None, Some(made)) => {
                let (kind, grid, target) = made.request()?;
                let map = generate::generate(kind, &grid, target)
                    .map_err(|e| at("surface.generate")(e.to_string()))?;
                (map, "surface.generate")
            }
            (None, None) => return error("surface", "name a file, or add a [surface.generate] table"),
        };
        let mut map = map.with_periodic(self.periodic);
        let missing = map.missing();
        map.extent().map_err(|e| at(source)(e.to_string())).or_else(|e| match self.missing {
            Missing::Fill if missing < map.heights().len() => Ok(Extent { low: 0.0, high: 0.0, cells: 0 }),
            _ => Err(e),
        })?;
        if self.missing == Missing::Fill {
            map = filter::fill(&map).map_err(|e| at("surface.missing")(e.to_string()))?;
        }
        if let Some(cutoff) = self.s_filter {
            map = filter::s_filter(&map, cutoff.0).map_err(|e| at("surface.s_filter")(e.to_string()))?;
        }
        let default = if self.file.is_some() { Level::Plane } else { Level::None };
        map = level::level(map, self.level.unwrap_or(default));
        if let Some(cutoff) = self.l_filter {
            map = filter::l_filter(&map, cutoff.0).map_err(|e| at("surface.l_filter")(e.to_string()))?;
        }
        let extent = map.extent().map_err(|e| at(source)(e.to_string()))?;
        let roughness = Roughness::of(&map, &extent);
        if ![roughness.sa, roughness.sdq, roughness.mean].iter().all(|v| v.is_finite()) {
            return error(source, "the heights are too large to compute with: check height_unit");
        }
        Ok(Prepared { map, missing, extent, roughness })
    }

    /// The file's heights in metres, its units checked against those of the scene.
    fn in_metres(&self, measured: Measured) -> Result<HeightMap, SceneError> {
        let same = |a: f64, b: f64| (a / b - 1.0).abs() <= 1e-4;
        let unit = match (measured.height_unit, &self.height_unit) {
            (Some(file), Some(scene)) if !same(file, scene.metres) && !self.override_file => {
                return error(
                    "surface.height_unit",
                    format!(
                        "the file has its heights in units of {file} m, not {}: remove height_unit, or set override = true",
                        scene.name
                    ),
                );
            }
            (_, Some(scene)) => scene.metres,
            (Some(file), None) => file,
            (None, None) => {
                return error(
                    "surface",
                    "the file does not name the unit of its heights: add height_unit = \"um\"",
                );
            }
        };
        let said = match measured.spacing {
            Spacing::Unknown => None,
            Spacing::Metres(p) => Some(p),
            Spacing::HeightUnits(p) => Some(p.map(|v| v * unit)),
        };
        let pixel = match (said, self.pixel_size.map(|p| p.map(|l| l.0))) {
            (Some(file), Some(scene))
                if !(self.override_file || same(file[0], scene[0]) && same(file[1], scene[1])) =>
            {
                return error(
                    "surface.pixel_size",
                    format!(
                        "the file has pixels of {:?} x {:?} m, the scene says {:?} x {:?} m: remove pixel_size, or set override = true",
                        file[0], file[1], scene[0], scene[1]
                    ),
                );
            }
            (_, Some(scene)) => scene,
            (Some(file), None) => file,
            (None, None) => {
                return error(
                    "surface",
                    "the file does not say how far its points are apart: add pixel_size = [\"1 um\", \"1 um\"]",
                );
            }
        };
        let mut heights = measured.heights;
        if unit != 1.0 {
            heights.iter_mut().for_each(|z| *z *= unit);
        }
        HeightMap::new(measured.columns, measured.rows, pixel, heights)
            .map_err(|e| SceneError { path: "surface.file".into(), message: e.to_string() })
    }
}
