//! The line that names columns, and the columns that are wanted of it.

use super::declared_unit::DeclaredUnit;
use super::dialect::{Decimal, Dialect, Separator, is_row};
use super::heading::{Heading, Quantity, folded, is_unit, unbracketed};
use super::{TextError, shortened};
use crate::dimension::Dimension;
use crate::units::conversion;

/// Marks before the name of a column that turn the sign of its numbers.
pub(crate) const MINUS: [char; 2] = ['-', '−'];

/// Facts on a table beside its text.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a, const N: usize> {
    /// Name of each column, with or without its unit, or its number from 1; `None`: by the usual names.
    pub columns: [Option<&'a str>; N],
    /// A number that means that nothing was measured, in the unit of the file.
    pub missing: Option<f64>,
    /// Mark before decimals; `None`: as the file tells.
    pub decimal: Option<Decimal>,
    /// True where a row with a missing number is an error.
    pub needs_all: bool,
    /// True where a column may have no unit.
    pub may_lack_units: bool,
    /// The key that names columns, for messages.
    pub key: Option<&'a str>,
}

impl<const N: usize> Default for Asked<'_, N> {
    fn default() -> Self {
        Asked {
            columns: [None; N],
            missing: None,
            decimal: None,
            needs_all: false,
            may_lack_units: false,
            key: None,
        }
    }
}

/// One wanted column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pick {
    /// Its place, from 0.
    pub column: usize,
    /// SI value of one unit; `None` where the unit is not known and need not be.
    pub scale: Option<f64>,
}

/// The line that names columns, with that of their units.
#[derive(Clone, Debug)]
pub(crate) struct Header<'t> {
    /// Its place, from 1.
    pub line: usize,
    /// Its text; empty where columns have numbers only.
    pub text: &'t str,
    /// The text of the line of units, or of a row whose cells hold them.
    pub units: Option<&'t str>,
}

/// The wanted columns of a header.
#[derive(Clone, Debug)]
pub(crate) struct Columns<const N: usize> {
    /// Those of each test that stands beside the others.
    pub picks: Vec<[Pick; N]>,
    /// Columns that have a name.
    pub width: usize,
    /// The columns that number tests: those of a specimen and of its indents.
    pub tests: Vec<usize>,
    /// Names of the columns as a key takes them.
    pub names: [String; N],
    /// True of those of the first test whose unit is given.
    pub have_units: [bool; N],
    /// Interpretation of the header, in words.
    pub said: String,
}

/// Names of the column that numbers tests.
const TESTS: [&str; 26] = [
    "test",
    "specimen",
    "indent",
    "run",
    "sample",
    "probe",
    "versuch",
    "essai",
    "prufung",
    "messung",
    "measurement",
    "curve",
    "kurve",
    "mesure",
    "location",
    "material",
    "metal",
    "alloy",
    "werkstoff",
    "eindruck",
    "empreinte",
    "impronta",
    "replicate",
    "repeat",
    "trial",
    "site",
];
/// Words of a number: behind such a name, or alone.
const OF_A_NUMBER: [&str; 7] = ["no", "nr", "no.", "nr.", "number", "nummer", "id"];

/// Parts of names of what was asked for and not measured.
const NOT_MEASURED: [&str; 7] = ["nominal", "setpoint", "set point", "target", "demand", "command", "soll"];

/// True of the name of a column that numbers tests.
fn numbers_tests(name: &str) -> bool {
    let (first, rest) = name.split_once(' ').unwrap_or((name, ""));
    TESTS.contains(&first) && (rest.is_empty() || OF_A_NUMBER.contains(&rest)) || OF_A_NUMBER.contains(&name)
}

/// Cells of a header; where blanks part columns, `wanted` of them if there is a way to read so many.
pub(crate) fn header_cells(dialect: &Dialect, text: &str, wanted: Option<usize>) -> Vec<String> {
    let clean = |cell: &str| cell.trim().trim_matches('"').trim().to_string();
    if dialect.separator != Separator::Blanks {
        return dialect.cells(text).map(clean).collect();
    }
    if text.contains('\t') {
        // several of them line columns up
        return text.split('\t').map(clean).filter(|cell| !cell.is_empty()).collect();
    }
    let (mut words, mut groups): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    for word in text.split_whitespace() {
        // a unit in brackets belongs to the name before it
        match words.last_mut() {
            Some(last) if word.starts_with(['(', '[']) => *last = format!("{last} {word}"),
            _ => words.push(clean(word)),
        }
        match groups.last_mut() {
            Some(last) if !last.ends_with([')', ']']) => *last = format!("{last} {word}"),
            _ => groups.push(word.into()),
        }
    }
    let apart = text.trim().split("  ").map(clean).filter(|cell| !cell.is_empty()).collect();
    let choices = [words, apart, groups];
    let fits = choices.iter().position(|cells| Some(cells.len()) == wanted).unwrap_or(0);
    choices.into_iter().nth(fits).unwrap_or_default()
}

/// The number of a column that a key gives in place of a name, from 1.
pub(crate) fn column_number(name: &str) -> Option<usize> {
    name.split(['[', '(']).next()?.trim().parse().ok().filter(|n| *n > 0)
}

/// True of a head that a key calls `name`, with or without the unit.
fn is_named(head: &Heading, name: &str) -> bool {
    let bare = name.split(['[', '(']).next().unwrap_or("");
    let (text, asked) = (folded(&head.text), Heading::new(name).name);
    text == folded(name) || text == folded(bare) || !asked.is_empty() && head.name == asked
}

impl<'t> Header<'t> {
    /// The header `text` of a line, if it names all wanted columns.
    pub fn new<const N: usize>(
        dialect: &Dialect,
        line: usize,
        text: &'t str,
        wanted: &[Quantity; N],
        named: &Asked<'_, N>,
    ) -> Option<Header<'t>> {
        let heads: Vec<Heading> = header_cells(dialect, text, None).iter().map(|c| Heading::new(c)).collect();
        // mere numbers of columns fit every line
        let all_numbers =
            named.columns.iter().all(|name| name.is_some_and(|name| column_number(name).is_some()));
        let is_there = |i: usize| match named.columns[i] {
            Some(name) if heads.iter().any(|head| is_named(head, name)) => true,
            Some(name) => !all_numbers && column_number(name).is_some_and(|n| n <= heads.len()),
            None => heads.iter().any(|head| head.rank(&wanted[i]).is_some()),
        };
        (heads.len() >= N && (0..N).all(is_there)).then_some(Header { line, text, units: None })
    }

    /// The wanted columns, above rows whose cells hold numbers where `filled` says so, with the units that
    /// lines before `declared`.
    ///
    /// # Errors
    /// A column that is not there, or whose unit is missing, unknown or another one than was declared.
    pub fn columns<const N: usize>(
        &self,
        dialect: &Dialect,
        filled: &[bool],
        wanted: &[Quantity; N],
        named: &Asked<'_, N>,
        declared: &[DeclaredUnit],
    ) -> Result<Columns<N>, TextError> {
        let cells_of = |text: &str| header_cells(dialect, text, Some(filled.len()));
        let cells =
            if self.text.is_empty() { vec![String::new(); filled.len()] } else { cells_of(self.text) };
        // a row of numbers holds the units behind them
        let unit = |cell: String| match dialect.measured(&cell) {
            Some((_, unit)) => unit.unwrap_or("").to_string(),
            None => cell,
        };
        let units = self.units.map(|text| cells_of(text).into_iter().map(unit).collect::<Vec<_>>());
        self.refuse_nameless(&cells, filled, named)?;
        let units = units.unwrap_or_default();
        // cells with units of their own are in those
        if self.units.is_some_and(|line| !is_row(line.trim())) {
            self.refuse_other_units(&cells, &units, wanted)?;
        }
        let mut heads = Heading::list(&cells, &units, filled);
        self.declare(&mut heads, wanted, declared)?;
        let mut found: Vec<Vec<Pick>> = Vec::new();
        let mut said = Vec::new();
        for (i, quantity) in wanted.iter().enumerate() {
            let scale = |head: &Heading| match (&head.unit, quantity.dimension) {
                (Some(unit), dimension) => dimension.scale(unit).map(Some),
                (None, Dimension::Ratio) => Some(Some(1.0)),
                (None, _) => named.may_lack_units.then_some(None),
            };
            let picks = match named.columns[i] {
                Some(name) => vec![self.named_column(&heads, quantity, name, &scale)?],
                None => self.usual_columns(&heads, quantity, wanted, &scale)?,
            };
            let head = &heads[picks[0].column];
            let is_number = named.columns[i].is_some_and(|name| column_number(name).is_some());
            if let Some(doubt) = head.doubt(quantity).filter(|_| !is_number) {
                let message = format!("the {} \"{}\" {doubt}", quantity.name, shortened(&head.text));
                return Err(TextError::new(self.line, message));
            }
            let unit = head.unit.as_deref().filter(|unit| !head.text.contains(unit));
            said.push(format!(
                "{} from {}{}",
                quantity.name,
                if head.text.is_empty() {
                    format!("column {}", picks[0].column + 1)
                } else {
                    format!("\"{}\"", head.text)
                },
                unit.map_or(String::new(), |unit| format!(" in {unit}"))
            ));
            found.push(picks);
        }
        // tests that stand side by side have as many of each
        let count = found[0].len();
        if let Some(i) =
            (0..N).find(|i| found[*i].len() > 1 && found.iter().any(|f| f.len() != found[*i].len()))
        {
            return Err(self.several(&heads, &found, wanted, (i, named.key)));
        }
        Ok(Columns {
            picks: (0..count).map(|k| std::array::from_fn(|i| found[i][k])).collect(),
            width: heads.len(),
            names: std::array::from_fn(|i| match named.columns[i] {
                Some(name) => name.into(),
                None => heads[found[i][0].column].text.clone(),
            }),
            have_units: std::array::from_fn(|i| heads[found[i][0].column].unit.is_some()),
            tests: (0..heads.len())
                .filter(|i| {
                    let has_unit = heads[*i].unit.as_deref().is_some_and(is_unit);
                    numbers_tests(&heads[*i].name) && !has_unit
                })
                .collect(),
            said: said.join(", "),
        })
    }

    /// Refuses one more column of numbers than `cells` have names: programs that number their rows name all
    /// others, so that each name would stand above its left neighbour.
    fn refuse_nameless<const N: usize>(
        &self,
        cells: &[String],
        filled: &[bool],
        named: &Asked<'_, N>,
    ) -> Result<(), TextError> {
        let is_number = |name: &Option<&str>| name.is_some_and(|name| column_number(name).is_some());
        let names = cells.iter().filter(|cell| !cell.is_empty()).count();
        let is_one_more = filled.len() == names + 1 && cells.len() == names && filled[names];
        if !is_one_more || named.columns.iter().all(is_number) {
            return Ok(());
        }
        let key = named.key.map_or(String::new(), |key| {
            format!(", or say the columns by their numbers, as {key} = {{ … = \"2 [um]\" }}")
        });
        let message = format!(
            "has {names} names above {} columns of numbers, of which the first may be the number of the row: give every column a name{key}",
            filled.len()
        );
        Err(TextError::new(self.line, message))
    }

    /// Refuses `units` below names that have others.
    fn refuse_other_units(
        &self,
        cells: &[String],
        units: &[String],
        wanted: &[Quantity],
    ) -> Result<(), TextError> {
        for (cell, below) in cells.iter().zip(units) {
            let (Some(own), below) = (Heading::new(cell).unit, unbracketed(below)) else { continue };
            let scales = |quantity: &Quantity| {
                Some((quantity.dimension.scale(&own)?, quantity.dimension.scale(below)?))
            };
            let other =
                wanted.iter().find_map(scales).filter(|(own, below)| (own / below - 1.0).abs() > 1e-9);
            if other.is_some() {
                let name = shortened(cell);
                let message =
                    format!("\"{name}\" is in {own}, but the unit below it is {below}: correct one of them");
                return Err(TextError::new(self.line, message));
            }
        }
        Ok(())
    }

    /// Gives `heads` without a unit the one that was declared for them.
    ///
    /// # Errors
    /// Heads that have another unit.
    fn declare(
        &self,
        heads: &mut [Heading],
        wanted: &[Quantity],
        declared: &[DeclaredUnit],
    ) -> Result<(), TextError> {
        for DeclaredUnit { line, column, unit } in declared {
            let is_meant = column.is_meant_of(heads, wanted);
            let mut others: Vec<String> = Vec::new();
            let mut is_right = false;
            for (head, _) in heads.iter_mut().zip(is_meant).filter(|(_, is_meant)| *is_meant) {
                let own = head.unit.get_or_insert_with(|| unit.clone());
                let scale = |unit: &str| wanted.iter().find_map(|quantity| quantity.dimension.scale(unit));
                match (scale(own), scale(unit)) {
                    (Some(own), Some(given)) if (own / given - 1.0).abs() < 1e-9 => is_right = true,
                    (Some(_), Some(_)) => others.push(format!("\"{}\" is in {own}", shortened(&head.text))),
                    _ => {}
                }
            }
            if let Some(other) = others.first().filter(|_| !is_right) {
                let message = format!("{other}, but line {line} says {unit}: correct one of them");
                return Err(TextError::new(self.line, message));
            }
        }
        Ok(())
    }

    /// The columns whose names are nearest to those of `quantity`. One without a unit, like the error of a
    /// force, is left out beside one with.
    fn usual_columns(
        &self,
        heads: &[Heading],
        quantity: &Quantity,
        wanted: &[Quantity],
        scale: &dyn Fn(&Heading) -> Option<Option<f64>>,
    ) -> Result<Vec<Pick>, TextError> {
        let rank = |head: &Heading| {
            let rank = head.rank(quantity)?;
            // another quantity has a better claim to "Indentation load"
            let others =
                wanted.iter().filter(|other| *other != quantity).filter_map(|other| head.rank(other));
            others.min().is_none_or(|other| other >= rank).then_some(rank)
        };
        let ranked = || heads.iter().enumerate().filter_map(|(i, head)| Some((i, head, rank(head)?)));
        let known: Vec<(Pick, u8)> = ranked()
            .filter_map(|(column, head, rank)| Some((Pick { column, scale: scale(head)? }, rank)))
            .collect();
        match (known.iter().map(|(_, rank)| rank).min(), ranked().next()) {
            (Some(best), _) => {
                Ok(known.iter().filter(|(_, rank)| rank == best).map(|(pick, _)| *pick).collect())
            }
            (None, Some((_, head, _))) => Err(self.without_unit(head, quantity)),
            (None, None) => Err(TextError::new(self.line, format!("names no {}", quantity.name))),
        }
    }

    /// The column that a key calls `name`.
    fn named_column(
        &self,
        heads: &[Heading],
        quantity: &Quantity,
        name: &str,
        scale: &dyn Fn(&Heading) -> Option<Option<f64>>,
    ) -> Result<Pick, TextError> {
        // x and X may be two columns
        let bare = name.split(['[', '(']).next().unwrap_or("").trim();
        let letter_by_letter =
            heads.iter().position(|head| [name.trim(), bare].contains(&head.text.as_str()));
        let exact =
            letter_by_letter.or_else(|| heads.iter().position(|head| folded(&head.text) == folded(name)));
        let column = exact.or_else(|| heads.iter().position(|head| is_named(head, name)));
        let column = column.or_else(|| column_number(name).map(|n| n - 1).filter(|n| *n < heads.len()));
        let column = column.ok_or_else(|| {
            let message =
                format!("has {} columns, but none is \"{name}\", the {}", heads.len(), quantity.name);
            TextError::new(self.line, message)
        })?;
        let head = &heads[column];
        let asked = Heading { text: name.into(), ..Heading::new(name) };
        let given = match &asked.unit {
            Some(unit) => {
                Some(quantity.dimension.scale(unit).ok_or_else(|| self.without_unit(&asked, quantity))?)
            }
            None => None,
        };
        let own = head.unit.as_ref().and_then(|unit| quantity.dimension.scale(unit));
        match (own, given) {
            (Some(own), Some(given)) if (own / given - 1.0).abs() > 1e-9 => {
                let message =
                    format!("says \"{}\", but the key \"{name}\": leave the unit out of the key", head.text);
                Err(TextError::new(self.line, message))
            }
            (None, Some(given)) => Ok(Pick { column, scale: Some(given) }),
            _ => match scale(head) {
                Some(scale) => Ok(Pick { column, scale }),
                None => Err(self.without_unit(&Heading { text: name.into(), ..head.clone() }, quantity)),
            },
        }
    }

    /// Two columns that may both be the quantity `i`.
    fn several(
        &self,
        heads: &[Heading],
        found: &[Vec<Pick>],
        wanted: &[Quantity],
        (i, key): (usize, Option<&str>),
    ) -> TextError {
        let name = |pick: &Pick| format!("\"{}\"", shortened(&heads[pick.column].text));
        let names: Vec<String> = found[i].iter().take(3).map(name).collect();
        let has = |pick: &Pick, words: &[&str]| words.iter().any(|w| heads[pick.column].name.contains(w));
        let example = |found: &Vec<Pick>| {
            let measured = || found.iter().find(|pick| !has(pick, &NOT_MEASURED));
            let best = found.iter().find(|pick| has(pick, &["correct", "korrig", "corrig"]));
            name(best.or_else(measured).unwrap_or(&found[0]))
        };
        let keys: Vec<String> =
            wanted.iter().zip(found).map(|(q, f)| format!("{} = {}", q.name, example(f))).collect();
        let way = key.map_or_else(
            || "leave one out, or give the others another name".to_string(),
            |key| format!("say which, like {key} = {{ {} }}", keys.join(", ")),
        );
        let message = format!("{} may all be the {}: {way}", names.join(" and "), wanted[i].name);
        TextError::new(self.line, message)
    }

    fn without_unit(&self, head: &Heading, quantity: &Quantity) -> TextError {
        let found = match &head.unit {
            Some(unit) => {
                format!("has the unit \"{}\", which is not known{}", shortened(unit), conversion(unit))
            }
            None => "has no unit".into(),
        };
        TextError::new(
            self.line,
            format!(
                "the {} \"{}\" {found}: write it in the header, one of {}, like {}",
                quantity.name,
                shortened(&head.text),
                quantity.dimension.units(),
                quantity.example
            ),
        )
    }
}
