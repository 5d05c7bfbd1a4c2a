//! Rows of numbers, as many in each: the heights of a map, or points line by line.

use super::dialect::{Decimal, Dialect, is_comment, is_row};
use super::{TextError, shortened};
use rayon::prelude::*;
use std::ops::Range;

/// Rows of numbers and what stands before them.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<'t> {
    /// The way they are written.
    pub dialect: Dialect,
    /// Lines before the numbers, comments too, with their place from 1.
    pub before: Vec<(usize, &'t str)>,
    /// Numbers in a row.
    pub columns: usize,
    /// The numbers row by row, NaN where missing.
    pub values: Vec<f64>,
    /// First and last line of numbers, from 1.
    pub lines: [usize; 2],
    /// True where the first cell of the first row is empty.
    pub corner_is_empty: bool,
    /// Lines behind the numbers that hold none.
    pub after: usize,
}

/// Bytes of text that one task reads.
const PART: usize = 1 << 20;

/// Numbers of a part of the text and whether all of its rows end with an empty cell.
struct Part {
    values: Vec<f64>,
    all_end_empty: bool,
}

/// Reads the rows of numbers of `text`. Numbers that are `missing` in the file count as none; `decimal` is
/// the mark before decimals where the file does not tell.
///
/// # Errors
/// No numbers, rows of different lengths, cells that are no numbers, words between rows.
pub fn read_grid(text: &str, missing: Option<f64>, decimal: Option<Decimal>) -> Result<Grid<'_>, TextError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = Dialect::detect(text, decimal, true)?;
    let (before, start, first) = beginning(text, &dialect)?;
    let (end, after) = ending(text, start);
    let body = &text[start..end];
    let columns = dialect.cells(first).count();
    let parts: Vec<Result<Part, TextError>> = parts_of(body)
        .into_par_iter()
        .map(|range| read_part(&dialect, &body[range], columns, missing))
        .collect();
    let mut line = text[..start].lines().count();
    let lines = [line + 1, line + body.lines().count()];
    let count = parts.iter().flatten().map(|part| part.values.len()).sum();
    let mut values = Vec::with_capacity(count);
    let mut all_end_empty = true;
    for (part, range) in parts.into_iter().zip(parts_of(body)) {
        let part = part.map_err(|e| TextError { line: e.line.map(|l| l + line), ..e })?;
        values.extend_from_slice(&part.values);
        all_end_empty &= part.all_end_empty;
        line += body[range].lines().count();
    }
    let corner = dialect.cells(first).next().unwrap_or("");
    let corner_is_empty = dialect.number(corner).is_none_or(f64::is_nan);
    let mut grid = Grid { dialect, before, columns, values, lines, corner_is_empty, after };
    if all_end_empty && columns > 1 {
        // a separator at the end of every line makes no further column
        grid.drop_last_column();
    }
    Ok(grid)
}

impl Grid<'_> {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    fn drop_last_column(&mut self) {
        let wide = self.columns;
        self.columns -= 1;
        for row in 0..self.values.len() / wide {
            self.values.copy_within(row * wide..row * wide + self.columns, row * self.columns);
        }
        self.values.truncate(self.values.len() / wide * self.columns);
    }

    /// One sentence on what was read.
    pub fn describe(&self) -> String {
        let skipped = self.before.iter().filter(|(_, line)| !line.is_empty()).count() + self.after;
        format!(
            "text with {}; rows of {} numbers in lines {} to {}{}",
            self.dialect.describe(),
            self.columns,
            self.lines[0],
            self.lines[1],
            if skipped > 0 { format!(", {skipped} lines of words beside them") } else { String::new() }
        )
    }
}

/// Lines before the numbers with their place from 1.
type Before<'t> = Vec<(usize, &'t str)>;

/// Lines before the numbers, the byte where these begin, and the first row.
fn beginning<'t>(text: &'t str, dialect: &Dialect) -> Result<(Before<'t>, usize, &'t str), TextError> {
    let mut before = Vec::new();
    let mut at = 0;
    let is_all_numbers =
        |line: &str| is_row(line.trim()) && dialect.cells(line).skip(1).all(|c| dialect.number(c).is_some());
    for (i, line) in text.split_inclusive('\n').enumerate() {
        let bare = line.trim();
        if !bare.is_empty() && !is_comment(bare) && is_all_numbers(line) {
            return Ok((before, at, line));
        }
        // a row with one bad cell is no title
        if !is_comment(bare) && is_row(bare) && dialect.cells(line).all(|c| !c.contains(' ')) {
            let bad = dialect.cells(line).find(|c| dialect.number(c).is_none()).unwrap_or("");
            return Err(TextError::new(i + 1, dialect.refuse(bad)));
        }
        before.push((i + 1, bare));
        at += line.len();
    }
    Err(TextError::whole("holds no rows of numbers"))
}

/// The byte where the rows end that begin at `start`, and the number of lines of words behind them.
fn ending(text: &str, start: usize) -> (usize, usize) {
    let (mut end, mut after) = (text.len(), 0);
    while end > start {
        let newline = text.as_bytes()[start..end - 1].iter().rposition(|b| *b == b'\n');
        let begin = newline.map_or(start, |i| start + i + 1);
        let line = text[begin..end].trim();
        let is_words = line.starts_with(|c: char| c.is_alphabetic() || c == '"' || c == '[') && !is_row(line);
        let is_bare = line.chars().all(|c| ",;\t ".contains(c));
        if begin == start || !(is_bare || is_comment(line) || is_words) {
            break;
        }
        after += usize::from(!is_bare);
        end = begin;
    }
    (end, after)
}

/// Parts of a text that end with a line.
fn parts_of(text: &str) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let near = (start + PART).min(text.len());
        let end =
            text.as_bytes()[near..].iter().position(|b| *b == b'\n').map_or(text.len(), |i| near + i + 1);
        parts.push(start..end);
        start = end;
    }
    parts
}

fn read_part(dialect: &Dialect, text: &str, columns: usize, missing: Option<f64>) -> Result<Part, TextError> {
    let mut part = Part { values: Vec::with_capacity(text.len() / 8), all_end_empty: true };
    for (i, line) in text.lines().enumerate() {
        let bare = line.trim_start();
        if bare.is_empty() || is_comment(bare) {
            continue;
        }
        let start = part.values.len();
        let mut last = "";
        for cell in dialect.cells(line) {
            last = cell;
            match dialect.number(cell) {
                Some(value) => part.values.push(if Some(value) == missing { f64::NAN } else { value }),
                None if !is_row(bare) && bare.starts_with(char::is_alphabetic) => {
                    let line = shortened(bare.trim_end());
                    let message =
                        format!("\"{line}\" stands between rows of numbers: keep one table in a file");
                    return Err(TextError::new(i + 1, message));
                }
                None => return Err(TextError::new(i + 1, dialect.refuse(cell))),
            }
        }
        if part.values.len() - start == columns + 1 && last.is_empty() {
            part.values.pop();
        }
        let found = part.values.len() - start;
        if found != columns {
            let message = format!(
                "{found} numbers, but the lines before have {columns}: rows must be of equal length; begin lines that are no rows with #"
            );
            return Err(TextError::new(i + 1, message));
        }
        part.all_end_empty &= last.is_empty();
    }
    Ok(part)
}
