//! Cells of a line and numbers in them, as the program that wrote the file parts and writes them.

use super::heading::is_unit;
use super::{TextError, shortened, thousands};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Separator of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// A character, with blanks about it or not, and tabs about one that is none.
    Mark(char),
    /// Any number of blanks.
    Blanks,
}

impl Separator {
    /// The text behind a separator from its first cell on: between other marks tabs are blanks.
    fn begin(self, text: &str) -> &str {
        match self {
            Separator::Mark('\t') => text.trim_start_matches(' '),
            _ => text.trim_start_matches([' ', '\t']),
        }
    }
}

/// Mark before decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Decimal {
    /// 1.5
    Point,
    /// 1,5
    Comma,
}

/// The way a file writes its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dialect {
    /// Between columns.
    pub separator: Separator,
    /// Before decimals.
    pub decimal: Decimal,
}

/// Rows of numbers from which the separator is told.
const ROWS_LOOKED_AT: usize = 50;
/// Heights and readings from here on mean that nothing was measured.
const MISSING_FROM: f64 = 1e37;

/// Words that mean that nothing was measured.
fn is_missing_word(word: &str) -> bool {
    const WORDS: [&str; 19] = [
        "", "bad", "-", "--", "---", "na", "n/a", "n.a.", "#n/a", "#nv", "no data", "nodata", "null", "none",
        "void", "missing", "invalid", "masked", "?",
    ];
    let word = word.to_ascii_lowercase();
    let number = word.trim_start_matches(['-', '+']);
    WORDS.contains(&word.as_str())
        || word.bytes().all(|b| b == b'*')
        // errors of a spreadsheet, in any language: #NUM!, #WERT!, #NOM?
        || word.len() > 2 && word.starts_with('#') && word.ends_with(['!', '?'])
        || ["nan", "inf", "infinity"].contains(&number)
        || number.starts_with("nan(")
        || ["1.#", "1,#"].iter().any(|start| number.starts_with(start))
}

/// True of a line that is a note.
pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%']) && !is_missing_word(first_word(line)) || line.starts_with("//")
}

/// The words of a line that may be a note.
pub(crate) fn uncommented(line: &str) -> &str {
    line.trim_start_matches(['#', '%', '/', ' '])
}

fn first_word(line: &str) -> &str {
    line.split(['\t', ';', ',', ' ']).next().unwrap_or("")
}

/// A number by its characters alone, whichever mark stands before its decimals.
pub(super) fn looks_like_number(word: &str) -> bool {
    let word = word.trim_matches('"');
    let word = word.strip_suffix('%').unwrap_or(word);
    word.contains(|c: char| c.is_ascii_digit())
        && word.chars().all(|c| c.is_ascii_digit() || "+-−.,eEdD'’ \u{a0}\u{202f}".contains(c))
        && !word.starts_with(['e', 'E', 'd', 'D'])
}

/// True of a cell that can be nothing but a number, however its decimals are written.
pub(super) fn is_written_as_number(cell: &str) -> bool {
    looks_like_number(cell) && !is_date(cell)
}

/// True of a number by its characters, with a unit behind it or not: no note with a comma in it.
fn is_number_or_measured(cell: &str) -> bool {
    looks_like_number(cell.trim_end_matches(|c: char| c.is_alphabetic() || "%‰ ".contains(c)))
}

/// True of a row of numbers: at least half of its words are numbers, and it begins with one or with a word
/// that means that there is none. A row of several such words alone is one too: the edge of a masked map.
pub(super) fn is_row(line: &str) -> bool {
    let is_blank = |c: char| " \t;,|".contains(c);
    let mut words = line.split(is_blank).map(|word| word.trim_matches('"')).filter(|word| !word.is_empty());
    let first = words.clone().next().unwrap_or("");
    // "Invalid value: -9999" is a remark
    let is_word = is_missing_word(first) && first.starts_with(char::is_alphabetic);
    // "NODATA -9999" and "Invalid,Bad" name a mark
    let is_pair = is_word && !first.to_ascii_lowercase().starts_with("nan") && words.clone().count() == 2;
    let starts = !is_pair && (looks_like_number(first) || !first.is_empty() && is_missing_word(first));
    if !starts && (is_pair || !line.to_ascii_lowercase().starts_with("no data")) {
        return false;
    }
    // "1 _ 1" is a title
    if words.clone().take(64).any(|word| word == "_") {
        return false;
    }
    let (mut numbers, mut missing, mut others) = (0, 0, 0);
    // a row of thousands is known by its beginning
    for word in words.by_ref().take(64) {
        if looks_like_number(word) {
            numbers += 1;
        } else if !is_missing_word(word) {
            others += 1;
        } else if !word.bytes().all(|b| b == b'-') {
            // dashes may also be a line below titles, or the unit of a ratio
            missing += 1;
        }
    }
    numbers > 0 && numbers >= others + usize::from(is_word && others > 0) || missing > 1 && others == 0
}

impl Dialect {
    /// The way `text` writes its rows of numbers; commas and points where it has none. `asked` says what
    /// stands before decimals, and `has_key` whether a message may name the key `decimal` that does.
    ///
    /// # Errors
    /// A number like `1,234`, where nothing in the file says whether its comma stands before decimals; commas
    /// that stand both between columns and before decimals.
    pub fn detect(text: &str, asked: Option<Decimal>, has_key: bool) -> Result<Dialect, TextError> {
        let lines = || text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
        let has_rows = lines().any(|(_, line)| !is_comment(line) && is_row(line));
        // where every row begins with a word or a time of day, the rest of a line tells
        let is_rest =
            |line: &str| !has_rows && line.split_once(['\t', ';']).is_some_and(|(_, rest)| is_row(rest));
        let rows = || lines().filter(|(_, line)| !is_comment(line) && (is_row(line) || is_rest(line)));
        let looked_at: Vec<(usize, &str)> = rows().take(ROWS_LOOKED_AT).collect();
        let separator = match looked_at[..] {
            [] => ['\t', ';', '|', ',']
                .into_iter()
                .find(|mark| text.contains(*mark))
                .map_or(Separator::Blanks, Separator::Mark),
            _ => Dialect::separator_of(text, &looked_at),
        };
        let point = Dialect { separator, decimal: Decimal::Point };
        point.refuse_cut(&looked_at)?;
        let mut doubtful = None;
        if let Some(decimal) = asked {
            if separator == Separator::Mark(',') && decimal == Decimal::Comma {
                let message = "decimal = \"comma\" does not go with a file whose commas part the columns: remove the key, or part \
                               the columns by semicolons or tabs";
                return Err(TextError::whole(message));
            }
            return Ok(Dialect { decimal, ..point });
        }
        let cells = looked_at.iter().map(|&(line, row)| (line, point.cells(row)));
        thousands::refuse_doubtful(cells, has_key)?;
        if !text.contains(',') || separator == Separator::Mark(',') && !text.contains('"') {
            return Ok(point);
        }
        for (line, row) in rows().filter(|(_, row)| row.contains(',')) {
            for cell in point.cells(row).filter(|cell| cell.contains(',') && is_number_or_measured(cell)) {
                match is_decimal_comma(cell) {
                    Some(true) => return Ok(Dialect { decimal: Decimal::Comma, ..point }),
                    Some(false) => return Ok(point),
                    None => doubtful = doubtful.or(Some((line, cell))),
                }
            }
        }
        match doubtful {
            None => Ok(point),
            Some((line, cell)) => {
                let cell = shortened(cell);
                let (small, large) = (cell.replace(',', "."), cell.replace(',', ""));
                let key = if has_key {
                    format!("set decimal = \"comma\" for {small}, decimal = \"point\" for {large}, or ")
                } else {
                    String::new()
                };
                let message = format!(
                    "\"{cell}\" is {small} or {large}, and nothing in the file tells which: {key}write another number of decimals"
                );
                Err(TextError::new(line, message))
            }
        }
    }

    /// Refuses a decimal comma among commas between columns: `07552`, which one cut off, or `0,5,` before a
    /// blank.
    fn refuse_cut(&self, rows: &[(usize, &str)]) -> Result<(), TextError> {
        let is_cut = |cell: &&str| {
            let digits = cell.trim_start_matches(['-', '+']);
            if self.separator == Separator::Mark(',') {
                digits.len() > 1 && digits.starts_with('0') && digits.bytes().all(|b| b.is_ascii_digit())
            } else {
                digits.strip_suffix(',').is_some_and(|digits| digits.contains(','))
            }
        };
        match rows.iter().find_map(|&(line, row)| Some((line, self.cells(row).find(is_cut)?))) {
            None => Ok(()),
            Some((line, cell)) => {
                let message = format!(
                    "a decimal comma stands among commas between columns, as \"{cell}\" shows: part the columns by semicolons or tabs"
                );
                Err(TextError::new(line, message))
            }
        }
    }

    fn separator_of(text: &str, rows: &[(usize, &str)]) -> Separator {
        let any = |test: &dyn Fn(&str) -> bool| rows.iter().any(|(_, row)| test(row));
        let all = |test: &dyn Fn(&str) -> bool| rows.iter().all(|(_, row)| test(row));
        // tabs behind other marks, or before them, only line columns up
        let fits = |mark: char, row: &str| row.trim().split(mark).all(|cell| !cell.trim().contains('\t'));
        let parts = |mark: char| any(&|row| row.contains(mark)) && all(&|row| fits(mark, row));
        let is_padded =
            |row: &str| row.split(',').skip(1).all(|rest| rest.is_empty() || rest.starts_with([' ', '\t']));
        let is_behind = |row: &str| row.split('\t').skip(1).all(|rest| rest.starts_with(','));
        if any(&|row| row.contains('\t')) && !parts(';') {
            // ",2" behind a tab is 0,2 unless a comma stands before its name, too
            let names = text.lines().take(rows[0].0 - 1).filter(|line| line.contains('\t')).last();
            let is_comma = match names {
                Some(names) => fits(',', names) && (all(&is_padded) || all(&is_behind)),
                None => all(&is_padded),
            };
            return match parts(',') && is_comma {
                true => Separator::Mark(','),
                false if are_aligned(names, rows) => Separator::Blanks,
                false => Separator::Mark('\t'),
            };
        }
        if let Some(mark) = [';', '|'].into_iter().find(|mark| any(&|row| row.contains(*mark))) {
            return Separator::Mark(mark);
        }
        if !any(&|row| row.contains(',')) {
            return Separator::Blanks;
        }
        // quotes hold commas that part nothing
        let unquoted = |row: &str| row.split('"').step_by(2).collect::<String>();
        if any(&|row| row.contains('"')) && !any(&|row| unquoted(row).contains(',')) {
            return Separator::Blanks;
        }
        let has_words_apart = |row: &str| {
            row.split_whitespace().filter(|word| looks_like_number(word.trim_matches(','))).count() > 1
        };
        // 0,5 0,3 against 0.5, 0.3
        if any(&|row| has_words_apart(row) && !is_padded(row) && !row.contains('.')) {
            Separator::Blanks
        } else {
            Separator::Mark(',')
        }
    }

    /// The cells of a line, without blanks and quotes about them.
    pub fn cells<'l>(&self, line: &'l str) -> Cells<'l> {
        let rest = match self.separator {
            // a tab at the end is an empty cell
            Separator::Mark('\t') => line.trim_matches([' ', '\r', '\n']),
            Separator::Mark('|') => framed(line.trim()),
            _ => line.trim(),
        };
        Cells { rest: Some(rest), separator: self.separator }
    }

    /// The number in a cell, NaN where it says that there is none; `None` where it holds something else.
    pub fn number(&self, cell: &str) -> Option<f64> {
        if self.decimal == Decimal::Point
            && let Ok(value) = cell.parse::<f64>()
        {
            return Some(if value.abs() < MISSING_FROM { value } else { f64::NAN });
        }
        self.number_written_otherwise(cell)
    }

    /// The number in a cell with the unit behind it, if there is one: `6.25 nm`.
    pub fn measured<'c>(&self, cell: &'c str) -> Option<(f64, Option<&'c str>)> {
        if let Some(value) = self.number(cell) {
            return Some((value, None));
        }
        // the 3 of 1e3 N is no unit
        let mut ends = cell.char_indices().filter(|(_, c)| c.is_alphabetic() || "%‰µ".contains(*c));
        let one = |(end, _): (usize, char)| {
            let (number, unit) = (cell[..end].trim_end(), &cell[end..]);
            // 66.2m is 0.0662 of something where prefixes stand behind numbers
            let is_prefix = unit == "m" && cell.len() == number.len() + unit.len();
            let value = self.number(number).filter(|value| !value.is_nan() && is_unit(unit) && !is_prefix)?;
            Some((value, Some(unit)))
        };
        ends.find_map(one)
    }

    /// Numbers with decimal commas, blanks or commas between thousands, signs of typesetters, the exponents
    /// of Fortran, and words for missing ones.
    fn number_written_otherwise(&self, cell: &str) -> Option<f64> {
        if is_missing_word(cell) {
            return Some(f64::NAN);
        }
        let (mark, other) = match self.decimal {
            Decimal::Point => ('.', ','),
            Decimal::Comma => (',', '.'),
        };
        if cell.contains(other) && !thousands::parts_groups(cell, mark, other) {
            return None;
        }
        // a blank parts nothing else in a cell: decimals need not tell
        let has_groups = cell.contains(' ')
            && (thousands::parts_groups(cell, mark, ' ')
                || thousands::parts_groups(&format!("{cell}{mark}0"), mark, ' '));
        let mut plain = String::with_capacity(cell.len());
        for c in cell.chars() {
            match c {
                _ if c == mark => plain.push('.'),
                _ if c == other => {}
                ' ' if has_groups => {}
                '−' => plain.push('-'),
                '\u{a0}' | '\u{202f}' | '\'' | '’' => {}
                'd' | 'D' => plain.push('e'),
                _ => plain.push(c),
            }
        }
        let value = plain.parse::<f64>().ok()?;
        Some(if value.abs() < MISSING_FROM { value } else { f64::NAN })
    }

    /// The reason why `cell` is no number, with a way out.
    pub fn refuse(&self, cell: &str) -> String {
        let cell = shortened(cell);
        match self.decimal {
            _ if is_date(&cell) => format!(
                "\"{cell}\" is a date, not a number: programs of tables make dates of numbers like 3.15; import the numbers anew as text or in columns of numbers"
            ),
            Decimal::Point if cell.contains(',') => {
                format!("\"{cell}\" is not a number: in this file decimals stand behind a point, not a comma")
            }
            Decimal::Comma if cell.contains('.') => {
                format!("\"{cell}\" is not a number: in this file decimals stand behind a comma, not a point")
            }
            _ => format!(
                "\"{cell}\" is not a number: write nan where nothing was measured, and begin lines of words with #"
            ),
        }
    }

    /// The dialect in words.
    pub fn describe(&self) -> String {
        let separator = match self.separator {
            Separator::Mark('\t') => "tabs",
            Separator::Mark(';') => "semicolons",
            Separator::Mark('|') => "bars",
            Separator::Mark(_) => "commas",
            Separator::Blanks => "blanks",
        };
        let decimal = if self.decimal == Decimal::Comma { " and decimal commas" } else { "" };
        format!("{separator} between columns{decimal}")
    }
}

/// True where several tabs stand between two columns: between all of a table without names, or so that rows
/// have as many words as their names and other tabs.
fn are_aligned(names: Option<&str>, rows: &[(usize, &str)]) -> bool {
    let cells =
        |line: &str| line.trim().split('\t').map(|cell| !cell.trim().is_empty()).collect::<Vec<bool>>();
    let words = |cells: &[bool]| cells.iter().filter(|is_word| **is_word).count();
    let names = names.map(cells);
    let is_aligned = |row: Vec<bool>| match &names {
        Some(names) => names.len() != row.len() && words(names) == words(&row),
        None => row.len() > 2 && row.iter().enumerate().all(|(i, is_word)| *is_word == (i % 2 == 0)),
    };
    rows.iter().all(|(_, row)| is_aligned(cells(row)))
}

/// The text between the bars at both ends of a line, if it has them.
fn framed(line: &str) -> &str {
    line.strip_prefix('|').map_or(line, |inside| inside.strip_suffix('|').unwrap_or(inside))
}

/// True of a day as ISO 8601 writes it.
fn is_date(cell: &str) -> bool {
    let parts: Vec<&str> = cell.split('-').collect();
    let lengths: Vec<usize> = parts.iter().map(|part| part.len()).collect();
    lengths == [4, 2, 2] && parts.iter().all(|part| part.bytes().all(|b| b.is_ascii_digit()))
}

/// True where the commas of a number stand before decimals; `None` where they may be those of a thousand too.
fn is_decimal_comma(cell: &str) -> Option<bool> {
    let (whole, decimals) = cell.rsplit_once(',')?;
    let whole = whole.trim_start_matches(['-', '+', '−']);
    if let Some(point) = cell.rfind('.') {
        return Some(point < cell.len() - decimals.len());
    }
    if whole.contains(',') {
        return Some(false);
    }
    let is_group = decimals.len() == 3 && decimals.bytes().all(|b| b.is_ascii_digit());
    let may_be_thousand = is_group && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
    if may_be_thousand { None } else { Some(true) }
}

/// The cells of one line.
#[derive(Clone, Debug)]
pub struct Cells<'l> {
    rest: Option<&'l str>,
    separator: Separator,
}

impl<'l> Iterator for Cells<'l> {
    type Item = &'l str;

    fn next(&mut self) -> Option<&'l str> {
        let rest = self.rest?;
        if let Some(inside) = rest.strip_prefix('"')
            && let Some(end) = inside.find('"')
        {
            let after = inside[end + 1..].trim_start_matches(' ');
            self.rest = match self.separator {
                Separator::Mark(mark) => after.find(mark).map(|i| self.separator.begin(&after[i + 1..])),
                Separator::Blanks => Some(after.trim_start()).filter(|after| !after.is_empty()),
            };
            return Some(inside[..end].trim());
        }
        let (cell, after) = match self.separator {
            Separator::Mark(mark) => {
                let end = rest.as_bytes().iter().position(|b| *b == mark as u8);
                (&rest[..end.unwrap_or(rest.len())], end.map(|end| &rest[end + 1..]))
            }
            Separator::Blanks => {
                let end = word_end(rest);
                (&rest[..end], Some(rest[end..].trim_start()).filter(|after| !after.is_empty()))
            }
        };
        self.rest = after.map(|after| self.separator.begin(after));
        Some(cell.trim())
    }
}

/// End of the first word; "No Data" is one.
fn word_end(text: &str) -> usize {
    let end = |text: &str| text.find([' ', '\t']).unwrap_or(text.len());
    let first = end(text);
    if text[..first].eq_ignore_ascii_case("no") {
        let second = text[first..].trim_start();
        let word = &second[..end(second)];
        if word.eq_ignore_ascii_case("data") {
            return text.len() - second.len() + word.len();
        }
    }
    first
}
