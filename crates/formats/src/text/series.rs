//! Numbers under the names of their columns: below each other, side by side, or under the number of a test.

use super::declared_unit::{DeclaredUnit, OF_TIME, names_factor, speaks_of_units};
use super::dialect::{Dialect, Separator, is_comment, is_row, is_written_as_number, uncommented};
use super::header::{Asked, Columns, Header, Pick, column_number, header_cells};
use super::heading::{Quantity, folded, folded_name, is_unit, unbracketed};
use super::{TextError, shortened};
use std::collections::HashMap;

mod no_readings;
mod numbered;
mod repeats;
mod segments;
mod table;

use numbered::{is_next, label_of, one_label};
use repeats::leave_out_repeats;
use segments::{is_segment, named_segment};
pub use table::{Series, SeriesTable};

/// Most rows of numbers below the names of what sums up a table.
const ROWS_OF_A_SUMMARY: usize = 2;
/// First words of rows that sum up a table.
const SUMMARIES: [&str; 16] = [
    "sd",
    "stdev",
    "average",
    "mean",
    "std",
    "std dev",
    "standard deviation",
    "cov",
    "max",
    "min",
    "maximum",
    "minimum",
    "median",
    "mittelwert",
    "standardabweichung",
    "moyenne",
];

/// A header with the rows below it.
struct Block<'t, const N: usize> {
    header: Header<'t>,
    /// `None` before the first row.
    columns: Option<Columns<N>>,
    /// Series before this block.
    first: usize,
    /// True where its rows begin with numbers; then a line that does not is none of them.
    has_plain_rows: bool,
    /// True where the first cell of one of them is a number: its column is none of notes.
    has_first_numbers: bool,
    /// The last cell in each column that numbers tests.
    numbers: HashMap<usize, &'t str>,
    end: Option<End>,
}

/// The words that end a table.
#[derive(Clone, Copy)]
struct End {
    line: usize,
    /// Rows of numbers that may stand below them and be none of the test: few below names, any below names
    /// with units, which are those of another table.
    allowed: usize,
}

/// The reader as it goes down a table.
struct Reader<'q, 't, const N: usize> {
    dialect: Dialect,
    wanted: &'q [Quantity; N],
    named: &'q Asked<'q, N>,
    block: Option<Block<'t, N>>,
    series: Vec<Series<N>>,
    /// Places of series by the first one of their block and their label.
    places: HashMap<(usize, String), usize>,
    skipped: usize,
    /// True below a line that names a later segment of the test, until its first reading.
    goes_on: bool,
    /// The last line of words before a header.
    words: Option<(usize, &'t str)>,
    /// Units that lines above the rows declare.
    declared: Vec<DeclaredUnit>,
    /// Columns that were understood first.
    said: String,
    scales: [f64; N],
    names: [String; N],
    have_units: [bool; N],
    /// The first line above the rows that names a factor.
    factor: Option<(usize, &'t str)>,
}

/// True of a unit, or of what stands in its place where a column has none.
fn is_unit_or_none(cell: &str) -> bool {
    is_unit(cell) || ["", "-", "–", "—", "1", "#"].contains(&cell)
}

/// The same with units of time.
fn is_unit_of_any(cell: &str) -> bool {
    is_unit_or_none(cell) || OF_TIME.contains(&cell)
}

/// Reads the columns `wanted` of `text`.
///
/// # Errors
/// No header that names them, units that are missing or unknown, cells that are no numbers.
pub fn read_series<const N: usize>(
    text: &str,
    wanted: &[Quantity; N],
    named: &Asked<'_, N>,
) -> Result<SeriesTable<N>, TextError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = Dialect::detect(text, named.decimal, named.key.is_some())?;
    let (series, said) = (Vec::new(), String::new());
    let mut reader = Reader {
        dialect,
        wanted,
        named,
        block: None,
        series,
        places: HashMap::new(),
        skipped: 0,
        goes_on: false,
        words: None,
        declared: Vec::new(),
        said,
        scales: [1.0; N],
        names: std::array::from_fn(|_| String::new()),
        have_units: [false; N],
        factor: None,
    };
    for (i, line) in text.lines().enumerate() {
        reader.take(i + 1, line)?;
    }
    reader.finish(text)
}

/// The line, from 1, of the first header of `text` that names all columns `wanted`.
pub fn header_line<const N: usize>(text: &str, wanted: &[Quantity; N]) -> Option<usize> {
    let dialect = Dialect::detect(text, None, false).ok()?;
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let names = |(i, line): (usize, &str)| {
        let line = uncommented(line);
        let is_header =
            !is_row(line) && Header::new(&dialect, i + 1, line, wanted, &Asked::default()).is_some();
        is_header.then_some(i + 1)
    };
    lines.map(names).find_map(|line| line)
}

impl<'t, const N: usize> Reader<'_, 't, N> {
    /// Takes one line.
    fn take(&mut self, line: usize, text: &'t str) -> Result<(), TextError> {
        let bare = text.trim();
        if bare.is_empty() {
            return Ok(());
        }
        if self.series.is_empty() && self.factor.is_none() && names_factor(bare) {
            self.factor = Some((line, bare));
        }
        if self.declares(line, bare) {
            return Ok(());
        }
        if self.are_units(bare) {
            if let Some(block) = self.block.as_mut() {
                block.header.units = Some(text);
            }
            return Ok(());
        }
        if is_comment(bare) {
            let content = uncommented(bare);
            // a header behind the sign of a comment, as NumPy writes it; said again it begins another test
            let repeats = self.block.as_ref().is_some_and(|block| block.header.text.trim() == content);
            if (self.series.is_empty() || repeats)
                && let Some(header) = Header::new(&self.dialect, line, content, self.wanted, self.named)
            {
                self.begin(header);
            }
            return Ok(());
        }
        if !is_row(bare) {
            if let Some(header) = Header::new(&self.dialect, line, text, self.wanted, self.named) {
                // each segment may have the names above it
                let is_same = self.block.as_ref().is_some_and(|block| block.header.text.trim() == bare);
                if !(self.goes_on && is_same) {
                    self.begin(header);
                }
                return Ok(());
            }
            let waiting = self.block.as_mut().filter(|block| block.columns.is_none());
            if let Some(block) = waiting
                && header_cells(&self.dialect, text, None).iter().any(|cell| is_unit(unbracketed(cell)))
            {
                let units = *block.header.units.get_or_insert(text);
                if units.trim() != bare {
                    return Err(TextError::new(line, "is a second line of units below the names: keep one"));
                }
                return Ok(());
            }
        }
        if self.block.is_none() {
            if !is_row(bare)
                || !self.named.columns.iter().all(|c| c.is_some_and(|c| column_number(c).is_some()))
            {
                self.skipped += 1;
                self.words = Some((line, text));
                return Ok(());
            }
            let cells = Some(self.dialect.cells(text).count());
            let title = self
                .words
                .filter(|(_, words)| Some(header_cells(&self.dialect, words, cells).len()) == cells);
            let (line, text) = title.unwrap_or((line, ""));
            self.begin(Header { line, text, units: None });
        }
        if self.is_behind(line, text)? {
            self.skipped += 1;
            return Ok(());
        }
        self.row(line, text)
    }

    /// Keeps the units that a line above the rows declares; true where it names no columns.
    fn declares(&mut self, line: usize, bare: &str) -> bool {
        let is_above = !is_row(bare) && self.block.as_ref().is_none_or(|block| block.columns.is_none());
        let declared = if is_above { DeclaredUnit::list(line, bare) } else { Vec::new() };
        let is_one = !declared.is_empty();
        self.declared.extend(declared);
        let names = || Header::new(&self.dialect, line, bare, self.wanted, self.named);
        // a line of names may hold their units as well
        let is_no_header = || {
            speaks_of_units(bare) && bare.contains([':', '=']) || self.block.is_some() || names().is_none()
        };
        is_one && is_no_header()
    }

    /// True of a line below a header that holds units alone: "%;MPa" is no comment, "-;MPa" no row.
    fn are_units(&self, line: &str) -> bool {
        let waits = self.block.as_ref().is_some_and(|b| b.columns.is_none() && b.header.units.is_none());
        let cells = header_cells(&self.dialect, line, None);
        waits
            && cells.len() > 1
            && cells.iter().any(|cell| is_unit(unbracketed(cell)))
            && cells.iter().all(|cell| is_unit_or_none(unbracketed(cell)))
    }

    /// True of a line behind the table: words end it, and numbers below those are no readings.
    fn is_behind(&mut self, line: usize, text: &str) -> Result<bool, TextError> {
        let Some(block) = self.block.as_mut() else { return Ok(false) };
        let Some(columns) = &block.columns else { return Ok(false) };
        if let (None, Some(goes_on)) = (&block.end, named_segment(text)) {
            self.goes_on = goes_on;
            return Ok(true);
        }
        let cells = header_cells(&self.dialect, text, Some(columns.width));
        let is_word = |cell: &str| !cell.is_empty() && self.dialect.measured(cell).is_none();
        let is_words = !is_row(text.trim()) && self.dialect.cells(text).next().is_some_and(is_word);
        let is_summary =
            cells.first().is_some_and(|cell| SUMMARIES.contains(&folded(cell).replace('.', "").as_str()));
        // a segment begins in the row of its first reading
        let is_number = |pick: &Pick| {
            cells.get(pick.column).is_some_and(|cell| self.dialect.number(cell).is_some_and(|v| !v.is_nan()))
        };
        let begins_segment =
            || cells.first().is_some_and(|cell| is_segment(cell)) && columns.picks[0].iter().all(is_number);
        // nor does a note end the table, in a column that has a name and no numbers
        let goes_on = || {
            let number =
                |pick: &Pick| Some(self.dialect.number(cells.get(pick.column)?)? * pick.scale.unwrap_or(1.0));
            let found = columns.picks[0].each_ref().map(|pick| number(pick).unwrap_or(f64::NAN));
            self.series.last().is_none_or(|test| is_next(&test.rows, &found))
        };
        let has_note = || {
            let named = header_cells(&self.dialect, block.header.text, Some(columns.width));
            block.end.is_none()
                && !block.has_first_numbers
                && named.first().is_some_and(|name| !name.is_empty())
                && columns.picks[0].iter().all(|pick| pick.column > 0 && is_number(pick))
                && goes_on()
        };
        if is_words && (is_summary || block.has_plain_rows && !begins_segment() && !has_note()) {
            let names = cells.iter().filter(|cell| is_word(cell)).count();
            let least = if self.dialect.separator == Separator::Blanks { columns.width } else { 2 };
            let allowed = match names >= least.max(2) {
                true if cells.iter().any(|cell| folded_name(cell).1.is_some_and(|unit| is_unit(&unit))) => {
                    usize::MAX
                }
                names_columns if names_columns || is_summary => ROWS_OF_A_SUMMARY,
                _ => 0,
            };
            block.end = Some(End { line: block.end.map_or(line, |end| end.line), allowed });
            return Ok(true);
        }
        let Some(end) = block.end.as_mut() else { return Ok(false) };
        let numbers =
            cells.iter().filter(|cell| self.dialect.number(cell).is_some_and(|v| !v.is_nan())).count();
        if end.allowed > 0 || numbers < N {
            end.allowed = end.allowed.saturating_sub(usize::from(numbers >= N));
            return Ok(true);
        }
        let message = format!(
            "numbers stand behind words (line {}), and nothing tells whether they belong to the test: begin the words with # if they \
             do, delete the lines if they do not",
            end.line
        );
        Err(TextError::new(line, message))
    }

    fn begin(&mut self, header: Header<'t>) {
        let first = self.series.len();
        let (has_plain_rows, has_first_numbers, numbers) = (false, false, HashMap::new());
        let block =
            Block { header, columns: None, first, has_plain_rows, has_first_numbers, numbers, end: None };
        self.block = Some(block);
    }

    /// The columns of `header` above its first row of numbers, the line `text`; `None` where `row` has none.
    fn columns_above(
        &self,
        header: &Header<'_>,
        (line, text): (usize, &str),
        row: &[&str],
    ) -> Result<Option<Columns<N>>, TextError> {
        let measured: Vec<_> = row.iter().map(|cell| self.dialect.measured(cell)).collect();
        let filled: Vec<bool> = measured.iter().map(|cell| cell.is_some_and(|(v, _)| !v.is_nan())).collect();
        if !filled.contains(&true) {
            let written_otherwise = row.iter().find(|cell| is_written_as_number(cell));
            return written_otherwise
                .map_or(Ok(None), |cell| Err(TextError::new(line, self.dialect.refuse(cell))));
        }
        let has_units = measured.iter().flatten().any(|(_, unit)| unit.is_some());
        let units = header.units.or(Some(text).filter(|_| has_units));
        let header = Header { units, ..header.clone() };
        header.columns(&self.dialect, &filled, self.wanted, self.named, &self.declared).map(Some)
    }

    /// Takes a row below the header.
    fn row(&mut self, line: usize, text: &'t str) -> Result<(), TextError> {
        let Some(mut block) = self.block.take() else { return Ok(()) };
        self.goes_on = false;
        let row: Vec<&'t str> = self.dialect.cells(text).collect();
        let columns = match block.columns.take() {
            None => self.columns_above(&block.header, (line, text), &row)?,
            known => known,
        };
        let Some(columns) = columns else {
            self.skipped += 1;
            self.block = Some(block);
            return Ok(());
        };
        let more = row.get(columns.width..).and_then(|more| more.iter().find(|cell| !cell.is_empty()));
        if let Some(cell) = more.filter(|_| self.dialect.separator == Separator::Mark(',')) {
            let message = if is_written_as_number(cell) {
                format!(
                    "has {} cells below {} of the header: a decimal comma needs columns that semicolons or tabs part; else give every column a name",
                    row.len(),
                    columns.width
                )
            } else {
                let cell = shortened(cell);
                format!("has \"{cell}\" beyond the columns of the header: give them a name, or delete it")
            };
            return Err(TextError::new(line, message));
        }
        for (k, picks) in columns.picks.iter().enumerate() {
            let Some(reading) = self.reading(line, &row, picks)? else { continue };
            // of tests side by side each has its columns
            let numbers = columns.tests.iter().filter(|_| columns.picks.len() == 1);
            let label = label_of(numbers.copied().map(|t| {
                let cell = row.get(t).copied().unwrap_or("");
                // a merged cell stands in its first row
                if !cell.is_empty() {
                    block.numbers.insert(t, cell);
                }
                block.numbers.get(&t).copied().unwrap_or("")
            }))
            .unwrap_or_else(|| (block.first + k + 1).to_string());
            let end = self.series.len();
            let place = *self.places.entry((block.first, label.clone())).or_insert(end);
            if place == end {
                self.series.push(Series { label, rows: Vec::new(), lines: Vec::new() });
            }
            self.series[place].rows.push(reading);
            self.series[place].lines.push(line);
        }
        if self.said.is_empty() {
            self.said.clone_from(&columns.said);
            self.names.clone_from(&columns.names);
            self.have_units = columns.have_units;
            self.scales = columns.picks[0].map(|pick| pick.scale.unwrap_or(1.0));
        }
        block.has_plain_rows |= is_row(text.trim());
        block.has_first_numbers |=
            row.first().is_some_and(|cell| self.dialect.measured(cell).is_some_and(|(v, _)| !v.is_nan()));
        block.columns = Some(columns);
        self.block = Some(block);
        Ok(())
    }

    /// Interpretation of a row; `None` where its cells are empty or the row is a note.
    fn reading(
        &mut self,
        line: usize,
        row: &[&str],
        picks: &[Pick; N],
    ) -> Result<Option<[f64; N]>, TextError> {
        let cells = picks.map(|pick| row.get(pick.column).copied().unwrap_or(""));
        let measured = |v: f64| if Some(v) == self.named.missing { f64::NAN } else { v };
        let number = |i: usize| {
            let (value, unit) = self.dialect.measured(cells[i])?;
            // a cell with a unit is in that, whatever stands above it
            let own = unit.map(|unit| self.wanted[i].dimension.scale(unit));
            own.map_or(Some(value), |own| Some(value * own? / picks[i].scale.unwrap_or(1.0)))
        };
        let values: [Option<f64>; N] = std::array::from_fn(|i| number(i).map(measured));
        let count = values.iter().flatten().filter(|v| !v.is_nan()).count();
        if count == N {
            let si = |i: usize| values[i].unwrap_or(f64::NAN) * picks[i].scale.unwrap_or(1.0);
            return Ok(Some(std::array::from_fn(si)));
        }
        let find = |test: fn(&Option<f64>) -> bool| (0..N).find(|i| test(&values[*i])).map(|i| cells[i]);
        self.refuse_lost(line, row, picks, &values)?;
        match (find(Option::is_none), find(|v| v.is_none_or(f64::is_nan))) {
            (Some(word), _) if count > 0 => Err(TextError::new(line, self.dialect.refuse(word))),
            (None, Some(cell)) if count > 0 && self.named.needs_all => {
                let cell = shortened(cell);
                let message = format!(
                    "\"{cell}\" is not a finite number: leave out the line of a point that was not measured"
                );
                Err(TextError::new(line, message))
            }
            _ => {
                self.skipped += 1;
                Ok(None)
            }
        }
    }

    /// Refuses a row of numbers that would be left out without a word: its cells are written otherwise than
    /// those of the rest, or there are fewer of them than columns.
    ///
    /// # Errors
    /// Such a row.
    fn refuse_lost(
        &self,
        line: usize,
        row: &[&str],
        picks: &[Pick; N],
        values: &[Option<f64>; N],
    ) -> Result<(), TextError> {
        let cell = |i: usize| row.get(picks[i].column).copied();
        let is_lost = |i: &usize| values[*i].is_none() && cell(*i).is_some_and(is_written_as_number);
        if let Some(cell) = (0..N).find(is_lost).and_then(cell) {
            return Err(TextError::new(line, self.dialect.refuse(cell)));
        }
        let has_number = (0..N).any(|i| cell(i).is_some() && values[i].is_some_and(|v| !v.is_nan()));
        if let Some(end) = picks.iter().map(|pick| pick.column + 1).find(|end| has_number && *end > row.len())
        {
            let message = format!(
                "has {} of at least {end} columns: correct it, or write nan where nothing was measured",
                row.len()
            );
            return Err(TextError::new(line, message));
        }
        Ok(())
    }

    fn finish(mut self, text: &str) -> Result<SeriesTable<N>, TextError> {
        one_label(&mut self.series);
        let repeats = match leave_out_repeats(&mut self.series, |test| (&test.lines, &test.rows)) {
            0 => "",
            _ => ", a test that repeats another left out",
        };
        let lines = || self.series.iter().flat_map(|series| &series.lines);
        let (Some(first), Some(last)) = (lines().min(), lines().max()) else {
            return Err(self.nothing(text));
        };
        let count: usize = self.series.iter().map(|s| s.rows.len()).sum();
        let plural = |n: usize, what: &str| if n > 1 { format!("{what} {n}") } else { String::new() };
        let understood = format!(
            "{}; {}; {count} rows{}, lines {first} to {last}{}{}",
            self.said,
            self.dialect.describe(),
            plural(self.series.len(), ", tests") + repeats,
            if self.skipped > 0 {
                format!(", other lines left out: {}", self.skipped)
            } else {
                String::new()
            },
            self.factor.map_or(String::new(), |(line, text)| format!(
                "; line {line} (\"{}\") changes nothing: if the numbers do not hold it yet, multiply the column by it",
                shortened(text)
            ))
        );
        let (scales, names, have_units) = (self.scales, self.names, self.have_units);
        Ok(SeriesTable { series: self.series, scales, names, have_units, understood })
    }
}
