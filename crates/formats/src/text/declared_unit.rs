//! Units that words before a table declare for its columns: `Depth unit: nm`, `Load: mN`, `Units: nm, mN`.

use super::heading::{Heading, Quantity, folded, is_unit};

/// A unit that a line gives to a column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DeclaredUnit {
    /// The line, from 1.
    pub line: usize,
    /// The column.
    pub column: DeclaredColumn,
    /// The unit.
    pub unit: String,
}

/// The column to which a line gives a unit.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DeclaredColumn {
    /// By its name, in small letters without accents, words apart by blanks.
    Named(String),
    /// By its place, from 0, in a table of so many columns.
    Placed(usize, usize),
}

/// Words that say that a unit is given.
const UNITS: [&str; 10] =
    ["unit", "units", "einheit", "einheiten", "unite", "unites", "unita", "unidad", "unidades", "unidade"];
/// Words between them and a name.
const BETWEEN: [&str; 11] = ["of", "for", "the", "in", "der", "des", "de", "du", "di", "da", "von"];
/// Units of columns that no table of this reader needs.
pub(super) const OF_TIME: [&str; 5] = ["s", "sec", "ms", "min", "µs"];

fn is_one_of(list: &[&str], word: &str) -> bool {
    list.contains(&folded(word).as_str())
}

fn words(text: &str) -> Vec<&str> {
    let is_mark = |c: char| c.is_whitespace() || ":=,;()[]{}\"_|".contains(c);
    text.split(is_mark).filter(|word| !word.is_empty()).collect()
}

/// True of a text with a word that says that a unit is given.
pub(crate) fn speaks_of_units(text: &str) -> bool {
    words(text).into_iter().any(|word| is_one_of(&UNITS, word))
}

impl DeclaredColumn {
    /// True of one by a name of `quantity`.
    pub(crate) fn is_called(&self, quantity: &Quantity) -> bool {
        matches!(self, DeclaredColumn::Named(name) if quantity.called.contains(&name.as_str()))
    }

    /// True for each of `heads` that it is: the one in this place, those of this name; where none is called
    /// so, those of the quantity that has it, or whose last words it is.
    pub(super) fn is_meant_of(&self, heads: &[Heading], wanted: &[Quantity]) -> Vec<bool> {
        let list = |test: &dyn Fn(&Heading) -> bool| heads.iter().map(test).collect();
        match self {
            DeclaredColumn::Placed(place, of) => {
                (0..heads.len()).map(|i| i == *place && heads.len() == *of).collect()
            }
            DeclaredColumn::Named(name) if heads.iter().any(|head| head.name == *name) => {
                list(&|head| head.name == *name)
            }
            DeclaredColumn::Named(name) => {
                match wanted.iter().find(|quantity| quantity.called.contains(&name.as_str())) {
                    Some(quantity) => list(&|head| head.rank(quantity).is_some()),
                    None => list(&|head| head.name.ends_with(&format!(" {name}"))),
                }
            }
        }
    }
}

impl DeclaredUnit {
    /// Those of a line: of all of its parts, or of it as a whole.
    pub fn list(line: usize, text: &str) -> Vec<DeclaredUnit> {
        let text = text.trim_start_matches(['#', '%', '/', '*', ' ']);
        let listed = DeclaredUnit::placed(line, text);
        if !listed.is_empty() {
            return listed;
        }
        let parts: Option<Vec<DeclaredUnit>> =
            text.split([';', ',', '\t']).map(|part| DeclaredUnit::new(line, part)).collect();
        parts.unwrap_or_else(|| DeclaredUnit::new(line, text).into_iter().collect())
    }

    fn new(line: usize, text: &str) -> Option<DeclaredUnit> {
        let (name, unit) = if speaks_of_units(text) {
            DeclaredUnit::about_the_word(text)
        } else {
            DeclaredUnit::behind_a_colon(text)
        }?;
        Some(DeclaredUnit { line, column: DeclaredColumn::Named(folded(&name)), unit })
    }

    /// The name is what stands about the word for units, the unit the longest end that is one.
    fn about_the_word(text: &str) -> Option<(String, String)> {
        let is_told = |word: &&str| !is_one_of(&UNITS, word) && !is_one_of(&BETWEEN, word);
        let rest: Vec<&str> = words(text).into_iter().filter(is_told).collect();
        let start = (1..rest.len()).find(|i| is_unit(&rest[*i..].join(" ")))?;
        Some((rest[..start].join(" "), rest[start..].join(" ")))
    }

    /// A unit alone behind a name and a colon.
    fn behind_a_colon(text: &str) -> Option<(String, String)> {
        let (name, unit) = text.split_once([':', '='])?;
        let unit = unit.trim().trim_matches(['"', '(', ')', '[', ']']);
        let is_told = !name.trim().is_empty() && (is_unit(unit) || OF_TIME.contains(&unit));
        is_told.then(|| (name.trim().into(), unit.into()))
    }

    /// The units of all columns in turn, behind the word for units alone.
    fn placed(line: usize, text: &str) -> Vec<DeclaredUnit> {
        let all = words(text);
        let Some((_, units)) = all.split_first().filter(|(first, _)| is_one_of(&UNITS, first)) else {
            return Vec::new();
        };
        let is_told = |unit: &&str| is_unit(unit) || OF_TIME.contains(unit) || **unit == *"-";
        if units.len() < 2 || !units.iter().all(is_told) {
            return Vec::new();
        }
        let of = |(place, unit): (usize, &&str)| DeclaredUnit {
            line,
            column: DeclaredColumn::Placed(place, units.len()),
            unit: (*unit).into(),
        };
        units.iter().enumerate().map(of).collect()
    }
}

/// Words of a factor of a column.
const FACTORS: [&str; 6] = ["factor", "faktor", "facteur", "fattore", "multiplier", "scaling"];

/// True of a line like `Load factor: 0.5`. Nothing tells whether the numbers below hold the factor already.
pub(super) fn names_factor(line: &str) -> bool {
    let Some((key, value)) = line.split_once([':', '=', '\t', ';']) else { return false };
    let number = value.split_whitespace().next().map(|word| word.replace(',', "."));
    let is_other_than_one = number.and_then(|word| word.parse::<f64>().ok()).is_some_and(|v| v != 1.0);
    // one word of German: Kraftfaktor
    let is_factor = |word: &str| FACTORS.iter().any(|factor| word.ends_with(factor));
    is_other_than_one && folded(key).split(' ').any(is_factor)
}
