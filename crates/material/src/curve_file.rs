//! A curve of hardening as a text file: columns for plastic strain and yield stress under a header with
//! units.
//!
//! ```text
//! # quenched steel, tension test of 12 May
//! plastic_strain,yield_stress_MPa
//! 0,300
//! 0.01,412.5
//! ```
//! Columns may change places and be parted by commas, semicolons or tabs; empty lines and lines that begin
//! with # are comments.

use crate::hardening_table::HardeningTable;
use crate::units::Stress;
use asperity_formats::text_table::TextTable;

/// A curve that was read, with the line of each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFile {
    /// Plastic strain and yield stress in Pa.
    pub points: Vec<[f64; 2]>,
    /// Line of each point, from 1.
    pub lines: Vec<usize>,
}

/// An error in a file, with its line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", line.map_or_else(String::new, |line| format!("line {line}: ")))]
pub struct CurveFileError {
    /// The line, from 1; `None`: the file as a whole.
    pub line: Option<usize>,
    /// Names the value, what is allowed and a way out.
    pub message: String,
}

/// A header that can be read.
const HEADER: &str = "plastic_strain,yield_stress_MPa";

/// Where the two columns stand, and what 1 in them is worth.
struct Columns {
    /// Those of strain and stress.
    places: [usize; 2],
    /// 1 of the stress column in Pa.
    unit: f64,
}

impl CurveFile {
    /// Reads `text`.
    ///
    /// # Errors
    /// No header, a column that is not known or has no unit, a line that is not numbers, or points that are
    /// no curve of hardening (see [`HardeningTable::new`]); each with its line.
    pub fn parse(text: &str) -> Result<CurveFile, CurveFileError> {
        let table = TextTable::new(text).ok_or_else(|| CurveFileError {
            line: None,
            message: format!("is empty: begin it with the line {HEADER}"),
        })?;
        let at = |(line, message)| CurveFileError { line: Some(line), message };
        let columns =
            Columns::from_names(&table.header).map_err(|message| at((table.header_line, message)))?;
        let (lines, points) = table.pairs(columns.places).map_err(at)?.into_iter().unzip();
        let mut file = CurveFile { points, lines };
        // in the unit of the file, so that the sentence says what the reader sees
        HardeningTable::new(&file.points).map_err(|e| CurveFileError {
            line: e.point.map(|point| file.lines[point]),
            message: e.message,
        })?;
        for point in &mut file.points {
            point[1] *= columns.unit;
        }
        Ok(file)
    }
}

impl Columns {
    fn from_names(names: &[&str]) -> Result<Columns, String> {
        let units = Stress::UNITS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        let (mut strain, mut stress) = (None, None);
        for (place, name) in names.iter().enumerate() {
            match name.strip_prefix("yield_stress") {
                _ if *name == "plastic_strain" && strain.is_none() => strain = Some(place),
                Some(unit) if stress.is_none() => {
                    let unit = unit.trim_start_matches('_');
                    let scale = Stress::UNITS.iter().find(|(known, _)| *known == unit).ok_or_else(|| {
                        format!("the column `{name}` has no unit of stress: write yield_stress_MPa, or another of {units}")
                    })?;
                    stress = Some((place, scale.1));
                }
                _ => {
                    return Err(format!(
                        "`{name}` is no column of a curve of hardening: the first line must name plastic_strain and yield_stress_MPa (or another of {units}), once each, for example {HEADER}"
                    ));
                }
            }
        }
        match (strain, stress) {
            (Some(strain), Some((stress, unit))) => Ok(Columns { places: [strain, stress], unit }),
            (None, _) => Err(format!("a column plastic_strain is missing: write {HEADER}")),
            (_, None) => Err(format!("a column yield_stress_MPa is missing: write {HEADER}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_in_any_order_and_unit() {
        let points = vec![[0.0, 300e6], [0.01, 412.5e6]];
        for text in [
            "plastic_strain,yield_stress_MPa\n0,300\n0.01,412.5\n",
            "# steel\n\nyield_stress_GPa;plastic_strain\n0.3;0\n0.4125;1e-2",
            "\u{feff}plastic_strain\tyield_stress_MPa\r\n0\t300\r\n# a note\r\n0.01\t412.5\r\n",
        ] {
            let file = CurveFile::parse(text).unwrap();
            for (got, want) in file.points.iter().zip(&points) {
                assert!((got[0] - want[0]).abs() < 1e-18 && (got[1] / want[1] - 1.0).abs() < 1e-15, "{text}");
            }
            assert_eq!(file.points.len(), 2);
        }
        assert_eq!(CurveFile::parse("plastic_strain,yield_stress_Pa\n#\n0,3e8").unwrap().lines, [3]);
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_its_line() {
        for (text, line, words) in [
            ("", None, "is empty"),
            ("0,300\n", Some(1), "`0` is no column"),
            ("plastic_strain,yield_stress\n0,300", Some(1), "has no unit"),
            ("plastic_strain,yield_stress_psi\n0,300", Some(1), "MPa, GPa"),
            ("plastic_strain\n0", Some(1), "yield_stress_MPa is missing"),
            ("yield_stress_MPa\n0", Some(1), "plastic_strain is missing"),
            ("plastic_strain,plastic_strain,yield_stress_MPa\n", Some(1), "once each"),
            ("plastic_strain,yield_stress_MPa\n", None, "not 0"),
            ("plastic_strain,yield_stress_MPa\n0,300\n0,01,310", Some(3), "decimal comma"),
            ("plastic_strain,yield_stress_MPa\n0,300 MPa", Some(2), "`300 MPa` is not a finite number"),
            ("plastic_strain,yield_stress_MPa\n0,nan", Some(2), "`nan` is not a finite number"),
            ("plastic_strain,yield_stress_MPa\n\n0.002,300", Some(3), "must start at 0, not at 0.002"),
            (
                "plastic_strain,yield_stress_MPa\n0,300\n0.1,200",
                Some(3),
                "must not fall, but 200 follows 300",
            ),
        ] {
            let error = CurveFile::parse(text).unwrap_err();
            assert_eq!(error.line, line, "{text}: {error}");
            assert!(error.message.contains(words), "{text}: {error}");
        }
    }
}
