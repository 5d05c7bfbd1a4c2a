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
//! be those of other languages. A column of `total_strain` in place of the plastic one is made that with
//! Young's modulus. The metal of an input file of Abaqus or CalculiX is read too.

use crate::hardening_table::HardeningTable;
use crate::material_card::{MaterialCard, of_another_program};
use crate::total_strain::{NoYield, is_elastic, plastic_points};
use asperity_formats::dimension::Dimension;
use asperity_formats::text::{Asked, Quantity, Series, SeriesTable, TextError, header_line, read_series};
use asperity_formats::units::Stress;

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

/// Strains above it are doubted where the file names no unit: tests seldom reach them, but percent do.
const LARGEST_STRAIN: f64 = 1.0;

/// The same under a name by which a share is meant: that of our own files, those of finite elements, those of
/// forming.
const LARGEST_SHARE: f64 = 5.0;
const SHARES: [&str; 5] =
    [STRAIN.example, "peeq", "equivalent plastic strain", "plastische vergleichsdehnung", "umformgrad"];

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
        "vergleichsumformgrad",
        "deformation plastique",
        "ε p",
        "εp",
        "deformazione plastica",
        "deformacion plastica",
    ],
    example: "plastic_strain",
};

/// Total strain by a name that says so.
const TOTAL: Quantity = Quantity {
    name: "total strain",
    called: &[
        "total strain",
        "true total strain",
        "total true strain",
        "gesamtdehnung",
        "totaldehnung",
        "wahre gesamtdehnung",
        "deformation totale",
        "deformazione totale",
        "deformacion total",
        "eps total",
        "eps tot",
        "epsilon total",
        "ε total",
        "ε tot",
    ],
    example: "total_strain",
    ..STRAIN
};

/// Strain by a name that leaves open which.
const SOME: Quantity = Quantity {
    name: "strain",
    called: &[
        "strain",
        "true strain",
        "logarithmic strain",
        "dehnung",
        "wahre dehnung",
        "logarithmische dehnung",
        "deformation",
        "deformation vraie",
        "deformazione",
        "deformazione reale",
        "deformacion",
        "deformacion verdadera",
        "eps",
        "epsilon",
        "ε",
        "phi",
        "φ",
    ],
    example: "plastic_strain",
    ..STRAIN
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
        "sig",
        "sigma y",
        "σ",
        "σ y",
        "kf",
        "mises",
        "s mises",
        "vergleichsspannung",
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

/// The columns of a file as they stand there.
struct Columns {
    file: CurveFile,
    /// Name of the column of strain.
    name: String,
    /// Pa of one unit of stress.
    unit: f64,
}

impl Columns {
    /// Reads the columns of this `strain` and of stress.
    fn new(text: &str, strain: Quantity) -> Result<Columns, TextError> {
        let named = Asked { needs_all: true, ..Asked::default() };
        let table = read_series(text, &[strain, STRESS], &named)?;
        let SeriesTable { mut series, scales, names: [name, _], have_units, understood } = table;
        let Series { rows: points, lines, .. } = series.swap_remove(0);
        if let Some(second) = series.first() {
            return Err(TextError::new(second.lines[0], "begins a second curve: keep one in a file"));
        }
        let written = name.to_lowercase();
        let is_share = SHARES.iter().any(|share| written.starts_with(share));
        let bound = if is_share { LARGEST_SHARE } else { LARGEST_STRAIN };
        let largest = points.iter().zip(&lines).find(|(p, _)| p[0] > bound && !have_units[0]);
        if let Some((p, line)) = largest {
            let (kind, key) = (strain.name, strain.example);
            let message = format!(
                "is a {kind} of {}, {} %, if \"{name}\" has no unit: write {key}_% above percent, and {key} [1] above true strains as \
                 large as that",
                p[0],
                100.0 * p[0]
            );
            return Err(TextError::new(*line, message));
        }
        Ok(Columns { file: CurveFile { points, lines, understood }, name, unit: scales[1] })
    }

    /// The curve, if its points are one of hardening.
    fn checked(self) -> Result<CurveFile, TextError> {
        // in the unit of the file, so that the sentence says what the reader sees
        let shown: Vec<[f64; 2]> = self.file.points.iter().map(|p| [p[0], p[1] / self.unit]).collect();
        HardeningTable::new(&shown).map_err(|e| TextError {
            line: e.point.map(|point| self.file.lines[point]),
            message: e.message,
        })?;
        Ok(self.file)
    }

    /// The columns with plastic strain in the place of the total one, from first yield on.
    fn made_plastic(mut self, youngs_modulus: f64) -> Result<Columns, TextError> {
        let modulus = Stress(youngs_modulus).in_unit("GPa");
        let CurveFile { points, lines, understood } = &mut self.file;
        let (first, plastic) = plastic_points(points, youngs_modulus).map_err(|no_yield| {
            let (point, message) = match no_yield {
                NoYield::OffTheLine(point) => {
                    let [strain, stress] = points[point];
                    let message = format!(
                        "has a total strain of {strain}, but Young's modulus, {modulus} GPa, gives {:.4e} for its stress: total strain begins \
                         on the elastic line, without the slack of grips and machine; correct it, or youngs_modulus, or call it \
                         plastic_strain if it is that",
                        stress / youngs_modulus
                    );
                    (point, message)
                }
                NoYield::NeverLeaves(point) => {
                    (point, "still lies on the elastic line, and no row follows: nothing tells the first yield".into())
                }
            };
            TextError::new(lines[point], message)
        })?;
        lines.drain(..first);
        *points = plastic;
        let left_out = if first > 0 { format!(", {first} before it left out") } else { String::new() };
        *understood += &format!(
            "; plastic strain is the total one less stress over Young's modulus, {modulus} GPa: first yield in line {} at {} MPa{left_out}",
            lines[0],
            Stress(points[0][1]).in_unit("MPa")
        );
        Ok(self)
    }

    /// The reason why a strain by a name that leaves open which is not taken.
    fn doubt(&self, youngs_modulus: f64) -> String {
        let loaded = self.file.points.iter().find(|point| point[1] > 0.0);
        let why = if self.file.points[0] == [0.0, 0.0] {
            ", and 0 under no stress is no first yield"
        } else if loaded.is_some_and(|point| is_elastic(*point, youngs_modulus)) {
            ", and the first row lies on the elastic line"
        } else {
            ""
        };
        format!(
            "\"{}\" may be plastic strain or total strain{why}: call it plastic_strain and give that, from 0 at first yield, or call \
             it total_strain, of which stress over Young's modulus is subtracted",
            self.name
        )
    }
}

impl CurveFile {
    /// Reads `text` of a metal of this Young's modulus in Pa.
    ///
    /// # Errors
    /// No header, a column that is not there or has no unit, a strain of which nothing tells whether it is
    /// plastic or total, a line that is not numbers, total strains that do not begin on the elastic line, or
    /// points that are no curve of hardening (see [`HardeningTable::new`]); each with its line.
    pub fn parse(text: &str, youngs_modulus: f64) -> Result<CurveFile, TextError> {
        if let Some(card) = MaterialCard::read(text, youngs_modulus) {
            let MaterialCard { points, lines, unit, understood } = card?;
            return Columns { file: CurveFile { points, lines, understood }, name: STRAIN.name.into(), unit }
                .checked();
        }
        if let Some(error) = of_another_program(text) {
            return Err(error);
        }
        let names = |strain: Quantity| header_line(text, &[strain, STRESS]);
        if names(STRAIN).is_none() && names(TOTAL).is_some() {
            return Columns::new(text, TOTAL)?.made_plastic(youngs_modulus)?.checked();
        }
        if let (None, Some(line)) = (names(STRAIN), names(SOME)) {
            let message = Columns::new(text, SOME)?.doubt(youngs_modulus);
            return Err(TextError::new(line, message));
        }
        Columns::new(text, STRAIN)?.checked()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODULUS: f64 = 200e9;

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
            let file = CurveFile::parse(text, MODULUS).unwrap();
            for (got, want) in file.points.iter().zip(&points) {
                assert!((got[0] - want[0]).abs() < 1e-18 && (got[1] / want[1] - 1.0).abs() < 1e-15, "{text}");
            }
            assert_eq!(file.points.len(), 2);
        }
        assert_eq!(CurveFile::parse("plastic_strain,yield_stress_Pa\n#\n0,3e8", MODULUS).unwrap().lines, [3]);
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
            ("plastic strain;true stress\n-;MPa", 1.0),
            ("plastic strain;true stress\n1;MPa", 1.0),
            ("plastic strain;true stress\n[-];[MPa]", 1.0),
            ("PEEQ,\"S, Mises (MPa)\"", 1.0),
            ("Umformgrad φ,kf (MPa)", 1.0),
        ] {
            let mark = *['\t', ';'].iter().find(|mark| head.contains(**mark)).unwrap_or(&',');
            let engineers = if head.contains("engineering") { ",270" } else { "" };
            let row = |strain: f64, stress: f64| format!("{}{engineers}{mark}{stress}\n", strain * factor);
            let text = format!("{head}\n{}{}", row(0.0, 300.0), row(0.01, 412.5));
            let points = CurveFile::parse(&text, MODULUS).unwrap_or_else(|e| panic!("{text}: {e}")).points;
            assert!((points[1][0] - 0.01).abs() < 1e-15, "{text}: {points:?}");
            assert!((points[1][1] / 412.5e6 - 1.0).abs() < 1e-15, "{text}: {points:?}");
        }
        let percent = CurveFile::parse("plastic strain [%],stress (MPa)\n0%,300\n5%,400\n", MODULUS).unwrap();
        assert!((percent.points[1][0] - 0.05).abs() < 1e-15, "{percent:?}");
        assert_eq!(
            CurveFile::parse("plastic strain [1],stress (MPa)\n0,300\n6,400", MODULUS).unwrap().points[1][0],
            6.0
        );
        let equivalent =
            CurveFile::parse("Equivalent plastic strain,Stress (MPa)\n0,300\n1.5,400", MODULUS).unwrap();
        assert_eq!(equivalent.points[1][0], 1.5);
        for (text, words) in [
            ("plastic strain furlong,stress MPa\n0,300\n1,360", "\"furlong\""),
            ("stress MPa,% plastic strain\n300,0\n360,1", "\"%\""),
            ("plastic strain,stress MPa\n0,300\n20,360", "plastic_strain_%"),
            ("plastic strain,engineering stress (MPa)\n0,300\n1,360", "σ (1 + ε)"),
            ("plastic strain,nominal stress [MPa]\n0,300\n1,360", "σ (1 + ε)"),
            ("engineering plastic strain,true stress [MPa]\n0,300\n1,360", "ln(1 + ε)"),
            ("plastic strain,plastic strain corrected,stress (MPa)\n0,0,300\n1,0.9,360", "may all be"),
            (
                "plastic strain,true stress (MPa),corrected true stress (MPa)\n0,300,300\n1,360,350",
                "may all be",
            ),
            ("plastic strain,shear stress (MPa)\n0,300\n1,360", "\"shear\""),
            ("plastic strain,stress x 10 (MPa)\n0,300\n1,360", "\"x 10\""),
        ] {
            let error = CurveFile::parse(text, MODULUS).unwrap_err();
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
            ("plastic_strain,yield_stress_MPa\n0,300 mm", Some(2), "\"300 mm\" is not a number"),
            ("plastic_strain,yield_stress_MPa\n0,300\n0.1,nan", Some(3), "\"nan\" is not a finite number"),
            ("plastic_strain,yield_stress_MPa\n\n0.002,300", Some(3), "must start at 0, not at 0.002"),
            (
                "plastic_strain,yield_stress_MPa\n0,300\n0.1,200",
                Some(3),
                "must not fall, but 200 follows 300",
            ),
        ] {
            let error = CurveFile::parse(text, MODULUS).unwrap_err();
            assert_eq!(error.line, line, "{text}: {error}");
            assert!(error.message.contains(words), "{text}: {error}");
        }
    }

    /// Percent up to 3 were read as shares of 300 %.
    #[test]
    fn a_strain_above_one_needs_a_unit_or_a_name_that_means_a_share() {
        let read =
            |name: &str| CurveFile::parse(&format!("{name},stress (MPa)\n0,300\n0.2,350\n3,500\n"), MODULUS);
        for name in ["plastic strain", "Plastische Dehnung", "eps_pl"] {
            let error = read(name).unwrap_err();
            assert_eq!(error.line, Some(4), "{error}");
            for words in ["300 %", "plastic_strain_%", "plastic_strain [1]"] {
                assert!(error.message.contains(words), "{error}");
            }
        }
        for (name, scale) in [
            ("plastic_strain", 1.0),
            ("PEEQ", 1.0),
            ("Umformgrad", 1.0),
            ("plastic strain [1]", 1.0),
            ("plastic strain [%]", 0.01),
        ] {
            assert_eq!(read(name).unwrap().points[2], [3.0 * scale, 5e8], "{name}");
        }
    }

    const ELASTIC_LINE: &str = "0,0\n0.001,200\n0.0015,300\n0.01175,350\n0.022,400\n";

    /// Read as shares before, a hundred times too large, wherever stress had a unit of its own.
    #[test]
    fn percent_in_the_words_before_a_table_is_that_of_its_strain() {
        let text = "Strain unit: %\nplastic strain,stress (MPa)\n0,300\n1,412\n";
        assert_eq!(CurveFile::parse(text, 210e9).unwrap().points, [[0.0, 300e6], [0.01, 412e6]]);
    }

    #[test]
    fn total_strain_is_taken_less_its_elastic_part() {
        for name in
            ["total strain", "total_strain", "True total strain (-)", "Total True Strain", "Gesamtdehnung"]
        {
            let text = format!("{name},stress (MPa)\n{ELASTIC_LINE}");
            let file = CurveFile::parse(&text, MODULUS).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!((file.points.len(), &file.lines[..]), (3, &[4, 5, 6][..]), "{file:?}");
            for (got, want) in file.points.iter().zip([[0.0, 3e8], [0.01, 3.5e8], [0.02, 4e8]]) {
                assert!((got[0] - want[0]).abs() < 1e-15 && got[1] == want[1], "{file:?}");
            }
            let said = "less stress over Young's modulus, 200 GPa: first yield in line 4 at 300 MPa, 2 before it left out";
            assert!(file.understood.contains(said), "{}", file.understood);
        }
        // the plastic column goes before the total one
        let both = "total strain,plastic strain,stress (MPa)\n0.0015,0,300\n0.01175,0.01,350\n";
        assert_eq!(CurveFile::parse(both, MODULUS).unwrap().points[1], [0.01, 3.5e8]);
    }

    #[test]
    fn strain_that_may_be_total_or_plastic_is_refused_with_both_names() {
        for (name, rows, why) in [
            ("strain", ELASTIC_LINE, "0 under no stress"),
            ("True strain", &ELASTIC_LINE[4..], "on the elastic line"),
            ("Dehnung", "0,300\n0.01,350\n", "total strain: call it"),
        ] {
            let error = CurveFile::parse(&format!("{name},stress (MPa)\n{rows}"), MODULUS).unwrap_err();
            assert_eq!(error.line, Some(1), "{error}");
            for words in [name, why, "plastic_strain", "total_strain"] {
                assert!(error.message.contains(words), "{error}");
            }
        }
    }

    #[test]
    fn total_strain_off_the_elastic_line_and_that_of_engineers_are_refused() {
        for (text, line, words) in [
            (
                "total strain,stress (MPa)\n0,0\n0.002,200\n0.02,300\n",
                Some(3),
                "Young's modulus, 200 GPa, gives 1.0000e-3",
            ),
            ("total strain,stress (MPa)\n0,300\n0.02,350\n", Some(2), "call it plastic_strain"),
            ("total strain,stress (MPa)\n0,0\n0.001,200\n", Some(3), "no row follows"),
            ("total strain,stress (MPa)\n0.0015,300\n0.02,280\n", Some(3), "must not fall"),
            ("total strain,stress (MPa)\n0,0\n15,300\n", Some(3), "total_strain_%"),
            ("engineering strain,engineering stress (MPa)\n0,0\n0.001,200\n", Some(1), "ln(1 + ε)"),
            ("total strain,nominal stress (MPa)\n0,0\n0.001,200\n", Some(1), "σ (1 + ε)"),
            ("Nenndehnung,Nennspannung (MPa)\n0,0\n0.001,200\n", Some(1), "ln(1 + ε)"),
            ("plastic strain,Nennspannung (MPa)\n0,300\n0.001,320\n", Some(1), "σ (1 + ε)"),
        ] {
            let error = CurveFile::parse(text, MODULUS).unwrap_err();
            assert_eq!(error.line, line, "{text}: {error}");
            assert!(error.message.contains(words), "{text}: {error}");
        }
    }
}
