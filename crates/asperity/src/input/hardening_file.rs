//! The table of hardening that a scene names, read into the scene.

use crate::error::InputError;
use crate::input::table_file::TableFile;
use crate::input::toml_file::TomlFile;
use asperity_material::units::Stress;
use asperity_material::{CurveFile, LARGEST_TABLE};
use asperity_simulation::scene::{HardeningChoice, Material, Scene, SceneError};

/// No line of a table is longer, on average.
const LONGEST_LINE: u64 = 100;

/// A table that was read, with what is needed to point at its lines later.
pub struct ReadCurve {
    table: TableFile,
    curve: CurveFile,
}

/// The table that the scene names; `None` where it names none, or names one that it cannot use, which
/// validation says.
///
/// # Errors
/// A file that cannot be read or holds no curve of hardening, pointing at its line.
pub fn read(scene: &TomlFile<Scene>) -> Result<Option<ReadCurve>, InputError> {
    let material = &scene.value.material;
    let table = material.hardening_law == HardeningChoice::Table && material.hardening_table.is_none();
    // total strain is made plastic with Young's modulus, whose range validation checks
    let has_modulus = material.youngs_modulus.0 > 0.0;
    let Some(named) = material.hardening_file.as_ref().filter(|_| table && has_modulus) else {
        return Ok(None);
    };
    let limit = LONGEST_LINE * LARGEST_TABLE as u64;
    let table = TableFile::read(scene, "material.hardening_file", named, limit)?;
    match CurveFile::parse(&table.text, material.youngs_modulus.0) {
        Ok(curve) => Ok(Some(ReadCurve { table, curve })),
        Err(error) => Err(table.error(scene, &error)),
    }
}

impl ReadCurve {
    /// Puts the table in the place of its file.
    pub fn put_into(&self, material: &mut Material) {
        material.hardening_file = None;
        material.hardening_table =
            Some(self.curve.points.iter().map(|&[strain, stress]| (strain, Stress(stress))).collect());
    }

    /// One line on what was understood of the table.
    pub fn understood(&self) -> String {
        self.table.understood(&self.curve.understood)
    }

    /// An error of the scene that is about a point of this table, at its line.
    pub fn point_at(&self, scene: &TomlFile<Scene>, error: &SceneError) -> Option<InputError> {
        self.table.point_at(scene, "material.hardening_table", &self.curve.lines, error)
    }
}
