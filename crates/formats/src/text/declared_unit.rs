//! Units that words before a table declare for its columns: `Depth unit: nm`, `Load [unit] = mN`.

use super::heading::{folded, is_unit};

/// A unit that a line gives to a name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DeclaredUnit {
    /// The line, from 1.
    pub line: usize,
    /// The name, in small letters without accents, words apart by blanks.
    pub name: String,
    /// The unit.
    pub unit: String,
}

/// Words that say that a unit is given.
const UNITS: [&str; 10] =
    ["unit", "units", "einheit", "einheiten", "unite", "unites", "unita", "unidad", "unidades", "unidade"];
/// Words between them and a name.
const BETWEEN: [&str; 11] = ["of", "for", "the", "in", "der", "des", "de", "du", "di", "da", "von"];

impl DeclaredUnit {
    /// Those of a line: of all of its parts, or of it as a whole.
    pub fn list(line: usize, text: &str) -> Vec<DeclaredUnit> {
        let parts: Option<Vec<DeclaredUnit>> =
            text.split([';', ',', '\t']).map(|part| DeclaredUnit::new(line, part)).collect();
        parts.unwrap_or_else(|| DeclaredUnit::new(line, text).into_iter().collect())
    }

    /// The name is what stands about the word for units, the unit the longest end that is one.
    fn new(line: usize, text: &str) -> Option<DeclaredUnit> {
        let is_mark = |c: char| c.is_whitespace() || ":=,;()[]{}\"_".contains(c);
        let text = text.trim_start_matches(['#', '%', '/', '*', ' ']);
        let words: Vec<&str> = text.split(is_mark).filter(|word| !word.is_empty()).collect();
        let is_one_of = |list: &[&str], word: &str| list.contains(&folded(word).as_str());
        words.iter().find(|word| is_one_of(&UNITS, word))?;
        let rest: Vec<&str> =
            words.into_iter().filter(|word| !is_one_of(&UNITS, word) && !is_one_of(&BETWEEN, word)).collect();
        let start = (1..rest.len()).find(|i| is_unit(&rest[*i..].join(" ")))?;
        Some(DeclaredUnit { line, name: folded(&rest[..start].join(" ")), unit: rest[start..].join(" ") })
    }
}
