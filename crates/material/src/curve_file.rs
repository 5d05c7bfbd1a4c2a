//! A curve of hardening as a text file: columns for plastic strain and yield stress under a header with
//! units.
//!
//! ```text
//! # quenched steel, tension test of 12 May
//! plastic_strain,yield_stress_MPa
//! 0,300
//! 0.01,412.5
//! ```
//! Columns may change places, stand among others and be written as the reader of tables knows; the heads may
//! be those of other languages.

use crate::hardening_table::HardeningTable;
use asperity_formats::dimension::Dimension;
use asperity_formats::text::{Asked, Quantity, Series, TextError, read_series};

/// A curve that was read, with the line of each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFile {
    /// Plastic strain and yield stress in Pa.
    pub points: Vec<[f64; 2]>,
    /// Line of each point, from 1.
    pub lines: Vec<usize>,
    /// Interpretation of the file, in one sentence.
    pub understood: String,
}

/// Plastic strains above it are doubted where the file names no unit: hardly a test reaches them, but
/// percent do.
const LARGEST_STRAIN: f64 = 5.0;

/// Accumulated plastic strain.
const STRAIN: Quantity = Quantity {
    name: "plastic strain",
    dimension: Dimension::Ratio,
    called: &[
        "plastic strain",
        "true plastic strain",
        "equivalent plastic strain",
        "peeq",
        "eps p",
        "eps pl",
        "epsilon p",
        "plastische dehnung",
        "plastische vergleichsdehnung",
        "umformgrad",
        "deformation plastique",
        "ε p",
        "εp",
        "deformazione plastica",
        "deformacion plastica",
    ],
    example: "plastic_strain",
};

/// Yield stress at it.
const STRESS: Quantity = Quantity {
    name: "yield stress",
    dimension: Dimension::Stress,
    called: &[
        "yield stress",
        "flow stress",
        "true stress",
        "stress",
        "yield strength",
        "sigma",
        "sigma y",
        "σ",
        "σ y",
        "kf",
        "fliessspannung",
        "wahre spannung",
        "spannung",
        "contrainte",
        "contrainte vraie",
        "tensione",
        "tension",
    ],
    example: "yield_stress_MPa",
};

impl CurveFile {
    /// Reads `text`.
    ///
    /// # Errors
    /// No header, a column that is not there or has no unit, a line that is not numbers, or points that are
    /// no curve of hardening (see [`HardeningTable::new`]); each with its line.
    pub fn parse(text: &str) -> Result<CurveFile, TextError> {
        let named = Asked { needs_all: true, ..Asked::default() };
        let mut table = read_series(text, &[STRAIN, STRESS], &named)?;
        let Series { rows: points, lines, .. } = table.series.swap_remove(0);
        if let Some(second) = table.series.first() {
            return Err(TextError::new(second.lines[0], "begins a second curve: keep one in a file"));
        }
        let largest = points.iter().zip(&lines).find(|(p, _)| p[0] > LARGEST_STRAIN && !table.have_units[0]);
        if let Some((p, line)) = largest {
            let message = format!(
                "is a plastic strain of {}, {} %, if \"{}\" has no unit: write plastic_strain_% above percent, and plastic_strain [1] \
                 above true strains as large as that",
                p[0],
                100.0 * p[0],
                table.names[0]
            );
            return Err(TextError::new(*line, message));
        }
        // in the unit of the file, so that the sentence says what the reader sees
        let shown: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1] / table.scales[1]]).collect();
        HardeningTable::new(&shown)
            .map_err(|e| TextError { line: e.point.map(|point| lines[point]), message: e.message })?;
        Ok(CurveFile { points, lines, understood: table.understood })
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
            "plastic_strain;yield_stress (MPa)\n0;300\n0,01;412,5\n;\n",
            "\"Plastische Dehnung [%]\",\"Fließspannung [N/mm²]\"\n\"0\",\"300\"\n\"1\",\"412.5\"\n",
            "test 7 of 12 May\n# eps_p sigma_MPa\n0 300\n0.01 412.5\n",
        ] {
            let file = CurveFile::parse(text).unwrap();
            for (got, want) in file.points.iter().zip(&points) {
                assert!((got[0] - want[0]).abs() < 1e-18 && (got[1] / want[1] - 1.0).abs() < 1e-15, "{text}");
            }
            assert_eq!(file.points.len(), 2);
        }
        assert_eq!(CurveFile::parse("plastic_strain,yield_stress_Pa\n#\n0,3e8").unwrap().lines, [3]);
    }

    /// Heads as people and testing machines write them, each with the factor of its unit.
    #[test]
    fn a_strain_is_read_in_its_unit_wherever_that_stands() {
        for (head, factor) in [
            ("plastic strain %,stress MPa", 1e2),
            ("plastic strain%,stress (Mpa)", 1e2),
            ("plastic_strain_percent,yield_stress_MPa", 1e2),
            ("Plastic strain, percent\tTrue stress, MPa", 1e2),
            ("plastic_strain_pct,yield_stress_MPa", 1e2),
            ("plastic_strain_%,STRESS (MPA)", 1e2),
            ("Plastische Dehnung in %,Spannung in MPa", 1e2),
            ("plastic strain [percent],true von Mises stress [MPa]", 1e2),
            ("plastic strain,true stress\n%,MPa", 1e2),
            ("plastic strain ‰,stress MPa", 1e3),
            ("plastic strain microstrain,stress MPa", 1e6),
            ("log. plastic strain (µm/m),stress MPa", 1e6),
            ("accumulated plastic strain (in/in),stress (MPa)", 1.0),
            ("plastic strain (),engineering stress (MPa),true stress (MPa)", 1.0),
        ] {
            let mark = if head.contains('\t') { '\t' } else { ',' };
            let engineers = if head.contains("engineering") { ",270" } else { "" };
            let row = |strain: f64, stress: f64| format!("{}{engineers}{mark}{stress}\n", strain * factor);
            let text = format!("{head}\n{}{}", row(0.0, 300.0), row(0.01, 412.5));
            let points = CurveFile::parse(&text).unwrap_or_else(|e| panic!("{text}: {e}")).points;
            assert!((points[1][0] - 0.01).abs() < 1e-15, "{text}: {points:?}");
            assert!((points[1][1] / 412.5e6 - 1.0).abs() < 1e-15, "{text}: {points:?}");
        }
        let percent = CurveFile::parse("plastic strain [%],stress (MPa)\n0%,300\n5%,400\n").unwrap();
        assert!((percent.points[1][0] - 0.05).abs() < 1e-15, "{percent:?}");
        assert_eq!(
            CurveFile::parse("plastic strain [1],stress (MPa)\n0,300\n6,400").unwrap().points[1][0],
            6.0
        );
        for (text, words) in [
            ("plastic strain furlong,stress MPa\n0,300\n1,360", "\"furlong\""),
            ("stress MPa,% plastic strain\n300,0\n360,1", "\"%\""),
            ("plastic strain,stress MPa\n0,300\n20,360", "plastic_strain_%"),
            ("plastic strain,engineering stress (MPa)\n0,300\n1,360", "σ (1 + ε)"),
            ("plastic strain,nominal stress [MPa]\n0,300\n1,360", "σ (1 + ε)"),
            ("engineering plastic strain,true stress [MPa]\n0,300\n1,360", "ln(1 + ε)"),
            ("plastic strain,shear stress (MPa)\n0,300\n1,360", "\"shear\""),
            ("plastic strain,stress x 10 (MPa)\n0,300\n1,360", "\"x 10\""),
        ] {
            let error = CurveFile::parse(text).unwrap_err();
            assert!(error.message.contains(words), "{text}: {error}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_refused_with_its_line() {
        for (text, line, words) in [
            ("", None, "is empty"),
            ("0,300\n", Some(1), "no header"),
            ("plastic_strain,yield_stress\n0,300", Some(1), "has no unit"),
            ("plastic_strain,yield_stress (tsf)\n0,300", Some(1), "\"tsf\""),
            ("plastic_strain\n0", Some(1), "yield_stress_MPa"),
            ("strain,yield_stress_MPa\n0,300", Some(1), "plastic strain"),
            ("plastic_strain,yield_stress_MPa\n", Some(1), "without readings"),
            ("plastic_strain,yield_stress_MPa\n0,300\n0,01,310", Some(3), "decimal comma"),
            ("plastic_strain,yield_stress_MPa\n0,300 MPa", Some(2), "\"300 MPa\" is not a number"),
            ("plastic_strain,yield_stress_MPa\n0,300\n0.1,nan", Some(3), "\"nan\" is not a finite number"),
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
