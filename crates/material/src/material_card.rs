//! The metal of an input file of Abaqus or CalculiX: yield stress over plastic strain below `*PLASTIC`.
//!
//! ```text
//! *MATERIAL, NAME=STEEL
//! *ELASTIC
//! 210000., 0.3
//! *PLASTIC
//! 300., 0.
//! 412.5, 0.01
//! ```
//! Such a file names no units. That of stress is the one in which its Young's modulus is that of the scene.
//! Source: the keyword pages `*PLASTIC` and `*ELASTIC` of the CalculiX 2.20 manual.

use asperity_formats::text::TextError;
use asperity_formats::units::Stress;

/// Rows of `*PLASTIC` as they stand in the file.
#[derive(Debug)]
pub(crate) struct MaterialCard {
    /// Plastic strain and yield stress in Pa.
    pub points: Vec<[f64; 2]>,
    /// Line of each point, from 1.
    pub lines: Vec<usize>,
    /// Pa of one unit of stress.
    pub unit: f64,
    /// Interpretation of the file, in one sentence.
    pub understood: String,
}

/// Units that people give stress in, where a file has none, each in Pa.
const STRESS_UNITS: [(&str, f64); 5] =
    [("Pa", 1.0), ("MPa", 1e6), ("GPa", 1e9), ("psi", PSI), ("ksi", 1e3 * PSI)];

/// Pa of a pound per square inch.
const PSI: f64 = 6_894.757_293_168_361;

/// Difference of two Young's moduli of one metal, as a share.
const MODULUS_TOLERANCE: f64 = 0.1;

/// Difference that is none, in percent.
const SAME_MODULUS: f64 = 0.05;

/// The way out that every such file has.
const WRITE_A_TABLE: &str =
    "write its rows below a first line yield_stress_MPa,plastic_strain (stress stands first in *PLASTIC)";

/// A keyword line with the rows of numbers below it.
struct Block<'t> {
    line: usize,
    /// In capitals: `PLASTIC`, and its parameters `HARDENING=KINEMATIC`.
    words: Vec<String>,
    rows: Vec<(usize, &'t str)>,
}

impl Block<'_> {
    fn is(&self, keyword: &str) -> bool {
        self.words[0] == keyword
    }

    /// The numbers of all its rows, each with its line.
    fn numbers(&self) -> Result<Vec<(usize, Vec<f64>)>, TextError> {
        let number = |line: usize, cell: &str| {
            // Fortran writes 2.1D5
            let plain = cell.to_ascii_uppercase().replace('D', "E");
            let wrong = || TextError::new(line, format!("\"{cell}\" is not a number"));
            plain.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong)
        };
        let row = |&(line, text): &(usize, &str)| {
            let cells = text.trim_end_matches([',', ' ', '\t']).split(',').map(str::trim);
            Ok((line, cells.map(|cell| number(line, cell)).collect::<Result<Vec<f64>, TextError>>()?))
        };
        self.rows.iter().map(row).collect()
    }
}

/// The keyword lines of `text`, without comments.
fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    for (i, line) in text.lines().enumerate().map(|(i, line)| (i, line.trim())) {
        if line.starts_with("**") || line.is_empty() {
            continue;
        }
        if let Some(keyword) = line.strip_prefix('*') {
            let word = |word: &str| word.to_uppercase().split_whitespace().collect::<Vec<_>>().join(" ");
            let words = keyword.split(',').map(word).filter(|word| !word.is_empty()).collect::<Vec<_>>();
            let words = if words.is_empty() { vec![String::new()] } else { words };
            blocks.push(Block { line: i + 1, words, rows: Vec::new() });
        } else if let Some(block) = blocks.last_mut() {
            block.rows.push((i + 1, line));
        }
    }
    blocks
}

/// The reason why `text` of another program is not read; `None` where it is none of these.
pub(crate) fn of_another_program(text: &str) -> Option<TextError> {
    let starts =
        |line: &str, word: &str| line.get(..word.len()).is_some_and(|w| w.eq_ignore_ascii_case(word));
    text.lines().enumerate().find_map(|(i, line)| {
        let line = line.trim();
        let message = if starts(line, "TB,") {
            "is a material of ANSYS: write its rows TBPT below a first line with the names of their columns, of TB,PLAS with MISO \
             plastic_strain,yield_stress_MPa and of the older TB,MISO total_strain,yield_stress_MPa"
        } else if starts(line, "*DEFINE_CURVE") || starts(line, "*MAT_") {
            "is a material of LS-DYNA: write the rows of its curve below a first line plastic_strain,yield_stress_MPa"
        } else {
            return None;
        };
        Some(TextError::new(i + 1, message))
    })
}

impl MaterialCard {
    /// Reads `text` where it has a keyword `*PLASTIC`, of a metal of this Young's modulus in Pa; `None` of
    /// any other file.
    ///
    /// # Errors
    /// Several metals, temperatures or rates, hardening by no table, no Young's modulus or one that is that
    /// of the scene in no unit, cells that are no numbers; each with its line.
    pub fn read(text: &str, youngs_modulus: f64) -> Option<Result<MaterialCard, TextError>> {
        let blocks = blocks(text);
        let places: Vec<usize> = (0..blocks.len()).filter(|i| blocks[*i].is("PLASTIC")).collect();
        let read = |place: usize| {
            let (plastic, modulus) = (&blocks[place], modulus_beside(&blocks, place)?);
            check_parameters(plastic)?;
            let unit = unit_of(modulus, youngs_modulus)?;
            let away = 100.0 * (modulus.1 * unit.1 / youngs_modulus - 1.0);
            Self::of_rows(plastic, unit, away)
        };
        match places[..] {
            [] => None,
            [place] => Some(read(place)),
            [_, second, ..] => {
                Some(Err(TextError::new(blocks[second].line, "begins a second *PLASTIC: keep one in a file")))
            }
        }
    }

    /// The rows with their stress in a unit, in which Young's modulus of the file is `away` percent off that
    /// of the scene.
    fn of_rows(
        plastic: &Block<'_>,
        (unit, scale): (&str, f64),
        away: f64,
    ) -> Result<MaterialCard, TextError> {
        let rows = plastic.numbers()?;
        let (mut points, mut lines) = (Vec::new(), Vec::new());
        let temperature = rows.first().and_then(|(_, row)| row.get(2).copied());
        for (line, row) in rows {
            let [stress, strain, rest @ ..] = &row[..] else {
                return Err(TextError::new(
                    line,
                    "has one number: a row of *PLASTIC is a stress and a plastic strain",
                ));
            };
            if rest.first().copied() != temperature || rest.len() > 1 {
                let message = format!(
                    "belongs to another temperature or field: keep the rows of one, or {WRITE_A_TABLE}"
                );
                return Err(TextError::new(line, message));
            }
            points.push([*strain, stress * scale]);
            lines.push(line);
        }
        let [Some(first), Some(last)] = [lines.first(), lines.last()] else {
            return Err(TextError::new(plastic.line, "has no rows below it"));
        };
        let modulus = match away.abs() < SAME_MODULUS {
            true => "*ELASTIC gives Young's modulus of the scene".into(),
            false => {
                format!("*ELASTIC gives a Young's modulus {away:+.1} % off that of the scene, which is taken")
            }
        };
        let understood = format!(
            "{} rows of *PLASTIC, lines {first} to {last}: stress in {unit}, in which {modulus}; plastic strain as a share",
            points.len()
        );
        Ok(MaterialCard { points, lines, unit: scale, understood })
    }
}

/// Refuses a `*PLASTIC` whose rows are no table of yield stress alone.
fn check_parameters(plastic: &Block<'_>) -> Result<(), TextError> {
    for parameter in &plastic.words[1..] {
        let (name, value) = parameter.split_once('=').unwrap_or((parameter, ""));
        let known = match (name.trim(), value.trim()) {
            ("HARDENING", value) => ["ISOTROPIC", "KINEMATIC"].contains(&value),
            ("DATA TYPE", value) => value == "HALF CYCLE",
            (name, _) => name != "RATE" && name != "SCALESTRESS" && name != "DEPENDENCIES",
        };
        if !known {
            let message = format!(
                "has \"{parameter}\", of which no table of yield stress over plastic strain is read: {WRITE_A_TABLE}"
            );
            return Err(TextError::new(plastic.line, message));
        }
    }
    Ok(())
}

/// Young's modulus of the metal to which the block at `place` belongs, with its line.
fn modulus_beside(blocks: &[Block<'_>], place: usize) -> Result<(usize, f64), TextError> {
    let begins = |block: &Block<'_>| block.is("MATERIAL");
    let start = blocks[..place].iter().rposition(begins).unwrap_or(0);
    let end = blocks[place..].iter().position(begins).map_or(blocks.len(), |i| place + i);
    let Some(elastic) = blocks[start..end].iter().find(|block| block.is("ELASTIC")) else {
        let message = format!("names no unit of stress, and no *ELASTIC beside it tells it: {WRITE_A_TABLE}");
        return Err(TextError::new(blocks[place].line, message));
    };
    let isotropic =
        |word: &String| !word.starts_with("TYPE") || word.replace(' ', "").starts_with("TYPE=ISO");
    let numbers = elastic.numbers()?;
    let first = numbers.first().filter(|_| elastic.words.iter().all(isotropic));
    let modulus = first.and_then(|(line, row)| Some((*line, *row.first()?)));
    modulus.ok_or_else(|| {
        TextError::new(
            elastic.line,
            format!("gives no Young's modulus, which would tell the unit of stress: {WRITE_A_TABLE}"),
        )
    })
}

/// The unit in which the `modulus` of the file, in its line, is that of the scene, in Pa.
fn unit_of((line, modulus): (usize, f64), youngs_modulus: f64) -> Result<(&'static str, f64), TextError> {
    let differs = |unit: &(&str, f64)| (modulus * unit.1 / youngs_modulus - 1.0).abs();
    let closest = STRESS_UNITS.into_iter().min_by(|a, b| differs(a).total_cmp(&differs(b)));
    closest.filter(|unit| differs(unit) <= MODULUS_TOLERANCE).ok_or_else(|| {
        let message = format!(
            "gives a Young's modulus of {modulus}, which is that of the scene, {} GPa, in none of {}: correct one of them, or {WRITE_A_TABLE}",
            Stress(youngs_modulus).in_unit("GPa"),
            STRESS_UNITS.map(|(name, _)| name).join(", ")
        );
        TextError::new(line, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODULUS: f64 = 210e9;

    fn card(elastic: &str, plastic: &str) -> String {
        format!("*Heading\n1, 2\n** steel\n*Material, name=STEEL\n*Elastic\n{elastic}\n*Plastic\n{plastic}")
    }

    fn read(text: &str) -> Result<MaterialCard, TextError> {
        MaterialCard::read(text, MODULUS).unwrap()
    }

    #[test]
    fn stress_stands_first_and_its_unit_is_told_by_youngs_modulus() {
        for (elastic, unit) in [
            ("2.1E5, 0.3", 1e6),
            ("210., 0.3", 1e9),
            ("2.1D11, 0.3,", 1.0),
            ("30.5E6, .3", PSI),
            ("30500., .3", 1e3 * PSI),
        ] {
            let [first, second] = [300e6 / unit, 412.5e6 / unit];
            let rows = format!("{first:e}, 0.\n** a note\n{second:e}, 0.01,\n*Step\n1, 2, 3\n");
            let found = read(&card(elastic, &rows)).unwrap_or_else(|e| panic!("{elastic}: {e}"));
            assert_eq!(found.lines, [8, 10]);
            for ([strain, stress], [e, s]) in found.points.iter().zip([[0.0, 300e6], [0.01, 412.5e6]]) {
                assert!(*strain == e && (stress / s - 1.0).abs() < 1e-9, "{elastic}: {:?}", found.points);
            }
        }
    }

    #[test]
    fn another_modulus_of_the_file_is_told_and_a_slip_in_the_scenes_is_refused() {
        let away = read(&card("200000., 0.3", "300., 0.\n")).unwrap();
        assert!(away.understood.contains("-4.8 % off"), "{}", away.understood);
        assert!(!read(&card("210000., 0.3", "300., 0.\n")).unwrap().understood.contains("off"));
        // 210 MPa for 210 GPa is no file in kPa
        let slip = MaterialCard::read(&card("210000., 0.3", "300., 0.\n"), 210e6).unwrap();
        assert!(slip.unwrap_err().message.contains("in none of Pa, MPa"));
    }

    #[test]
    fn rows_of_one_temperature_are_read() {
        let found = read(&card("210000., 0.3", "300., 0., 20.\n350., 0.1, 20.\n")).unwrap();
        assert_eq!(found.points, [[0.0, 300e6], [0.1, 350e6]]);
    }

    #[test]
    fn cards_that_are_no_one_table_are_refused_with_their_line() {
        let steel = "210000., 0.3";
        for (text, line, words) in [
            ("*PLASTIC\n300., 0.\n".to_string(), 1, "no *ELASTIC beside it"),
            (card("70000., 0.3", "300., 0.\n"), 6, "210 GPa"),
            (card(steel, "300., 0., 20.\n350., 0.1, 20.\n250., 0., 100.\n"), 10, "another temperature"),
            (card(steel, "300.\n"), 8, "one number"),
            (card(steel, "300., x\n"), 8, "\"x\" is not a number"),
            (card(steel, ""), 7, "no rows"),
            (card(steel, "300., 0.\n*Plastic\n300., 0.\n"), 9, "second *PLASTIC"),
            (
                card(steel, "300., 0.\n").replace("*Plastic", "*Plastic, hardening=Johnson Cook"),
                7,
                "JOHNSON COOK",
            ),
            (card(steel, "300., 0.\n").replace("*Plastic", "*Plastic, hardening=COMBINED"), 7, "COMBINED"),
            (card(steel, "300., 0.\n").replace("*Plastic", "*Plastic, rate=10."), 7, "RATE"),
            (card(steel, "300., 0.\n").replace("*Elastic", "*Elastic, type=ORTHO"), 5, "no Young's modulus"),
        ] {
            let error = read(&text).unwrap_err();
            assert_eq!(error.line, Some(line), "{text}: {error}");
            assert!(error.message.contains(words), "{text}: {error}");
        }
        // the modulus of another metal tells nothing
        let other = "*MATERIAL\n*ELASTIC\n210000., 0.3\n*MATERIAL\n*PLASTIC\n300., 0.\n";
        assert!(read(other).unwrap_err().message.contains("no *ELASTIC"));
    }

    #[test]
    fn materials_of_ansys_and_ls_dyna_are_told_their_columns() {
        for (text, words) in [
            ("MP,EX,1,210000\nTB,MISO,1,1,5\nTBPT,DEFI,0,300\n", "total_strain"),
            ("*KEYWORD\n*DEFINE_CURVE\n1, 0\n0.0, 300.\n", "plastic_strain,yield_stress_MPa"),
        ] {
            assert!(MaterialCard::read(text, MODULUS).is_none());
            assert!(of_another_program(text).unwrap().message.contains(words), "{text}");
        }
        assert_eq!(of_another_program("plastic_strain,yield_stress_MPa\n0,300\n"), None);
    }
}
