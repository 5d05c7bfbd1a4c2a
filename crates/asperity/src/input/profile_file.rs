//! The measured outlines that a scene names, read into the scene.
//!
//! ```text
//! # stylus, 2 um tip, 12 May
//! r_um,z_um
//! 0,20.0
//! 0.5,19.98
//! ```
//! Places under `r` or `x` and heights under `z`, or under the names of instruments, each with its unit;
//! other columns are left out. Points may stand from the outside inward too.

use crate::error::InputError;
use crate::input::table_file::TableFile;
use crate::input::toml_file::TomlFile;
use asperity_formats::profile;
use asperity_formats::text::{Asked, Series, TextError};
use asperity_simulation::scene::{Points, Scene, SceneError};
use std::path::PathBuf;

/// No file of an outline is larger.
const MAX_BYTES: u64 = 16 << 20;

/// An outline that was read, with what is needed to point at its lines later.
pub struct ReadProfile {
    file: TableFile,
    /// Table of the scene that names it.
    table: String,
    /// Line of each point.
    lines: Vec<usize>,
    /// Its columns as they were understood.
    columns: String,
}

/// The table of a scene that names a file, and the key.
struct Named {
    table: String,
    key: &'static str,
    file: PathBuf,
}

/// Files that the tables of a scene name and that are to be read.
fn named(scene: &Scene) -> Vec<Named> {
    let of = |table: String, key: &'static str, file: &Option<PathBuf>, points: &Option<Points>| {
        let file = file.clone().filter(|_| points.is_none())?;
        Some(Named { table, key, file })
    };
    let asperities = scene.asperity.iter().enumerate();
    let asperities =
        asperities.filter_map(|(i, a)| of(format!("asperity[{i}]"), "profile", &a.profile, &a.points));
    let lines = scene.profile.iter().enumerate();
    let lines = lines.filter_map(|(i, l)| of(format!("profile[{i}]"), "file", &l.file, &l.points));
    let tool = of("tool".into(), "file", &scene.tool.file, &scene.tool.points);
    asperities.chain(lines).chain(tool).collect()
}

/// Reads the outlines that `scene` names and puts their points in the place of the files.
///
/// # Errors
/// A file that cannot be read or holds no outline, pointing at its line.
pub fn read(scene: &mut TomlFile<Scene>) -> Result<Vec<ReadProfile>, InputError> {
    let mut read = Vec::new();
    for Named { table, key, file } in named(&scene.value) {
        let file = TableFile::read(scene, &format!("{table}.{key}"), &file, MAX_BYTES)?;
        let Outline { points, lines, columns } =
            parse(&file.text).map_err(|error| file.error(scene, &error))?;
        put(&mut scene.value, &table, Points::new(points));
        read.push(ReadProfile { file, table, lines, columns });
    }
    Ok(read)
}

/// Puts points into the table that named their file.
fn put(scene: &mut Scene, table: &str, points: Points) {
    let slot = |places: &str| places.strip_suffix(']').and_then(|i| i.parse::<usize>().ok());
    let (file, values) = if let Some(i) = table.strip_prefix("asperity[").and_then(slot) {
        let asperity = &mut scene.asperity[i];
        (&mut asperity.profile, &mut asperity.points)
    } else if let Some(i) = table.strip_prefix("profile[").and_then(slot) {
        let line = &mut scene.profile[i];
        (&mut line.file, &mut line.points)
    } else {
        (&mut scene.tool.file, &mut scene.tool.points)
    };
    (*file, *values) = (None, Some(points));
}

/// Points in metres with their lines, and what was understood of the columns.
#[derive(Debug)]
struct Outline {
    points: Vec<[f64; 2]>,
    lines: Vec<usize>,
    columns: String,
}

/// Reads a text.
fn parse(text: &str) -> Result<Outline, TextError> {
    let named = Asked { needs_all: true, ..Asked::default() };
    let mut table = profile::read_outline(text, &named)?;
    let Series { rows: mut points, mut lines, .. } = table.series.swap_remove(0);
    if let Some(second) = table.series.first() {
        let message = "begins a second outline: keep one in a file";
        return Err(TextError::new(second.lines[0], message));
    }
    if points.windows(2).all(|p| p[1][0] < p[0][0]) {
        points.reverse();
        lines.reverse();
    }
    Ok(Outline { points, lines, columns: table.understood })
}

impl ReadProfile {
    /// One line on what was understood of the outline.
    pub fn understood(&self) -> String {
        self.file.understood(&self.columns)
    }

    /// An error of the scene that is about this outline, at its line or at the key that names its file.
    pub fn point_at(&self, scene: &TomlFile<Scene>, error: &SceneError) -> Option<InputError> {
        self.file.point_at(scene, &format!("{}.points", self.table), &self.lines, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_in_any_order_unit_and_direction() {
        let expected = [[0.0, 20e-6], [5e-6, 19e-6]];
        for text in [
            "r_um,z_um\n0,20\n5,19\n",
            "# a stylus\nz_nm;quality;x_mm\n20000;1;0\n19000;0.5;0.005",
            "\u{feff}z_m\tr_m\r\n19e-6\t5e-6\r\n20e-6\t0\r\n",
            "Taster 2 µm\nx [µm];z [µm]\n0,0;20,00\n5,0;19,00\n;\n",
            "\"r\",\"z\"\n\"(um)\",\"(um)\"\n\"0\",\"20\"\n\"5\",\"19\"\n",
        ] {
            let Outline { points, lines, .. } = parse(text).unwrap();
            assert_eq!(lines.len(), 2);
            for (p, e) in points.iter().zip(expected) {
                assert!((p[0] - e[0]).abs() < 1e-18 && (p[1] - e[1]).abs() < 1e-18, "{text}: {points:?}");
            }
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_its_line() {
        for (text, line, words) in [
            ("", None, "is empty"),
            ("0,20\n5,19\n", Some(1), "r_um,z_um"),
            ("r,z\n0,20\n", Some(1), "\"r\" has no unit"),
            ("r_um,z (furlong)\n0,20\n", Some(1), "\"furlong\""),
            ("r_um,z_um\n0,20\n1,\n2,19\n", Some(3), "was not measured"),
            ("r_um,z_um\n0,20\n1,nan\n2,19\n", Some(3), "\"nan\""),
            ("r_um,z_um\n0,20\n1,19,5\n", Some(3), "decimal comma"),
        ] {
            let TextError { line: found, message } = parse(text).unwrap_err();
            assert_eq!(found, line, "{text}: {message}");
            assert!(message.contains(words), "{text}: {message}");
        }
    }
}
