//! Rows of numbers, as many in each: the heights of a map, or points line by line.

use super::dialect::{Decimal, Dialect, is_comment, is_row, looks_like_number};
use super::header::header_cells;
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
    /// True where columns, and rows, without a number stand at the edges: they may be of the map or not.
    pub empty_edges: [bool; 2],
    /// True where an empty first column was left out.
    pub has_empty_column: bool,
    /// Several tables of equal size that empty lines, rows or columns or notes part.
    pub parts: Option<Tables>,
}

/// Tables of equal size in one file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tables {
    /// Their number.
    pub count: usize,
    /// Rows of each, or columns.
    pub size: usize,
    /// True where they stand side by side.
    pub are_beside: bool,
}

/// Bytes of text that one task reads.
const PART: usize = 1 << 20;

/// Numbers of a part of the text and whether all of its rows end with an empty cell.
struct Part {
    values: Vec<f64>,
    all_end_empty: bool,
    /// The same of their beginning.
    all_start_empty: bool,
    /// Rows before each empty line or note.
    breaks: Vec<usize>,
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
    let outside = [&text[..start], &text[end..]];
    refuse_lost_rows(&dialect, outside, [0, text[..end].lines().count()], columns)?;
    let parts: Vec<Result<Part, TextError>> = parts_of(body)
        .into_par_iter()
        .map(|range| read_part(&dialect, &body[range], columns, missing))
        .collect();
    let mut line = text[..start].lines().count();
    let lines = [line + 1, line + body.lines().count()];
    let count = parts.iter().flatten().map(|part| part.values.len()).sum();
    let mut values = Vec::with_capacity(count);
    let (mut all_end_empty, mut all_start_empty, mut breaks) = (true, true, Vec::new());
    for (part, range) in parts.into_iter().zip(parts_of(body)) {
        let part = part.map_err(|e| TextError { line: e.line.map(|l| l + line), ..e })?;
        breaks.extend(part.breaks.iter().map(|rows| rows + values.len() / columns));
        values.extend_from_slice(&part.values);
        all_end_empty &= part.all_end_empty;
        all_start_empty &= part.all_start_empty;
        line += body[range].lines().count();
    }
    let corner = dialect.cells(first).next().unwrap_or("");
    let corner_is_empty = dialect.number(corner).is_none_or(f64::is_nan);
    let parts = equal_tables(&values, columns, breaks);
    let empty_edges = [all_start_empty, has_empty_rows(&dialect, outside, columns)];
    let mut grid = Grid {
        dialect,
        before,
        columns,
        values,
        lines,
        corner_is_empty,
        after,
        empty_edges,
        has_empty_column: false,
        parts,
    };
    if all_start_empty && !all_end_empty && columns > 2 {
        // one before the first cell neither; where more columns are empty they may be of the map
        let mut second = grid.values.iter().skip(1).step_by(columns);
        if second.any(|z| !z.is_nan()) {
            grid.values = grid.values.chunks_exact(columns).flat_map(|row| row[1..].to_vec()).collect();
            (grid.columns, grid.has_empty_column) = (columns - 1, true);
        }
    }
    if all_end_empty && columns > 1 {
        // a separator at the end of every line makes no further column
        grid.drop_last_column();
        let mut last = grid.values.iter().skip(grid.columns - 1).step_by(grid.columns);
        grid.empty_edges[0] |= last.all(|z| z.is_nan());
    }
    Ok(grid)
}

impl Grid<'_> {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    /// True of each column that holds a number in the first row.
    pub fn filled(&self) -> Vec<bool> {
        self.values.iter().take(self.columns).map(|value| !value.is_nan()).collect()
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
            "text with {}; rows of {} numbers{} in lines {} to {}{}",
            self.dialect.describe(),
            self.columns,
            if self.has_empty_column { " behind an empty first cell" } else { "" },
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
            let mut later = text[at + line.len()..].lines().filter(|line| !is_comment(line.trim()));
            let next = later.find(|line| is_all_numbers(line));
            if !is_below_names(dialect, &before, line, next) && !counts_points(dialect, line, next) {
                return Ok((before, at, line));
            }
            before.push((i + 1, bare));
            at += line.len();
            continue;
        }
        // a row with one bad cell is no title
        if !is_comment(bare) && is_row(bare) && dialect.cells(line).all(|c| !c.contains(' ')) {
            let bad = dialect.cells(line).find(|c| dialect.number(c).is_none()).unwrap_or("");
            return Err(TextError::new(i + 1, dialect.refuse(bad)));
        }
        before.push((i + 1, bare));
        at += line.len();
    }
    Err(no_rows(text, dialect))
}

/// The message on a text without a row of numbers.
fn no_rows(text: &str, dialect: &Dialect) -> TextError {
    // words of a header have few numbers behind them
    const LEAST_BEHIND_A_LABEL: usize = 3;
    let is_number = |cell: &str| dialect.number(cell).is_some_and(|value| !value.is_nan());
    let label = |(i, line): (usize, &str)| {
        let mut cells = dialect.cells(line);
        let first = cells.next().map(str::to_string)?;
        let rest: Vec<&str> = cells.collect();
        let is_labelled = rest.len() >= LEAST_BEHIND_A_LABEL && rest.iter().all(|cell| is_number(cell));
        (is_labelled && !is_number(&first)).then_some((i + 1, first))
    };
    match text.lines().enumerate().find_map(label) {
        Some((line, label)) => {
            let label = shortened(&label);
            let message = format!("begins with \"{label}\", which is no number: delete the column of labels");
            TextError::new(line, message)
        }
        None if text.contains(['[', '{']) && text.contains(|c: char| c.is_ascii_digit()) => TextError::whole(
            "holds no rows of numbers: write them without brackets, a row of the map in each line, as numpy.savetxt does",
        ),
        None => TextError::whole("holds no rows of numbers"),
    }
}

/// True of a row that holds the values of the names above it, `nx ny step` above `200 160 1.25`: rows of the
/// table, of which the `next` is one, are longer.
fn is_below_names(dialect: &Dialect, before: &Before<'_>, row: &str, next: Option<&str>) -> bool {
    let Some((_, names)) = before.iter().rev().find(|(_, line)| !line.is_empty()) else { return false };
    let count = filled_cells(dialect, row);
    names_above(dialect, names, row).is_some()
        && next.is_some_and(|next| filled_cells(dialect, next) >= 2 * count)
}

/// True of a line with one number before rows of three and more: how many points follow.
fn counts_points(dialect: &Dialect, row: &str, next: Option<&str>) -> bool {
    let is_one = row.trim().bytes().all(|b| b.is_ascii_digit());
    is_one && next.is_some_and(|next| filled_cells(dialect, next) >= 3)
}

/// Cells of a line up to the last that is not empty.
fn filled_cells(dialect: &Dialect, line: &str) -> usize {
    dialect.cells(line).collect::<Vec<_>>().iter().rposition(|cell| !cell.is_empty()).map_or(0, |i| i + 1)
}

/// The words of the line `names` with the numbers of the line `row` that stand below them; `None` where they
/// are not as many.
pub(crate) fn names_above(dialect: &Dialect, names: &str, row: &str) -> Option<Vec<(String, String)>> {
    let count = filled_cells(dialect, row);
    let mut names = header_cells(dialect, names, Some(count));
    names.truncate(names.iter().rposition(|name| !name.is_empty()).map_or(0, |i| i + 1));
    let is_name = |name: &String| name.contains(char::is_alphabetic) && !looks_like_number(name);
    let is_number = |cell: &&str| dialect.number(cell).is_some_and(|value| !value.is_nan());
    let numbers: Vec<&str> = dialect.cells(row).take(count).collect();
    let is_pair =
        count > 0 && names.len() == count && names.iter().all(is_name) && numbers.iter().all(is_number);
    is_pair.then(|| names.into_iter().zip(numbers.into_iter().map(String::from)).collect())
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

/// True of a line that parts as many cells as a row and holds no number.
fn is_empty_row(dialect: &Dialect, line: &str, columns: usize) -> bool {
    let cells = || dialect.cells(line);
    columns > 1
        && (columns..=columns + 1).contains(&cells().count())
        && cells().all(|cell| dialect.number(cell).is_some_and(f64::is_nan))
}

/// True where rows without a number stand beside those with, which a spreadsheet did not fill up.
fn has_empty_rows(dialect: &Dialect, [before, after]: [&str; 2], columns: usize) -> bool {
    let is_empty = |line: &str| is_empty_row(dialect, line, columns);
    let is_filled_up = before.lines().any(|line| dialect.cells(line).count() >= columns && !is_empty(line));
    let beside = [before.lines().next_back(), after.lines().next()];
    !is_filled_up && beside.into_iter().flatten().any(is_empty)
}

/// Refuses lines beside the rows that are rows but for a word or the way that numbers are written: before
/// them those that begin with a number, behind them all.
fn refuse_lost_rows(
    dialect: &Dialect,
    outside: [&str; 2],
    first: [usize; 2],
    columns: usize,
) -> Result<(), TextError> {
    let bad = |line: &str, is_behind: bool| {
        let cells: Vec<&str> = dialect.cells(line).collect();
        let is_wide = columns > 2 && (columns..=columns + 1).contains(&cells.len());
        let is_like_row = is_behind || cells.first().is_some_and(|cell| looks_like_number(cell));
        let count = cells.iter().filter(|cell| looks_like_number(cell)).count();
        let bad = cells.iter().find(|cell| dialect.number(cell).is_none()).map(|cell| (*cell).to_string());
        bad.filter(|_| is_wide && is_like_row && 2 * count >= columns && !is_comment(line.trim()))
    };
    for (k, text) in outside.into_iter().enumerate() {
        let line =
            if k == 0 { text.lines().next_back() } else { text.lines().find(|l| !l.trim().is_empty()) };
        if let Some(cell) = line.and_then(|line| bad(line, k == 1)) {
            let count = text.lines().count();
            let empty = text.lines().take_while(|l| l.trim().is_empty()).count();
            let place = if k == 0 { count } else { first[1] + 1 + empty };
            return Err(TextError::new(place, dialect.refuse(&cell)));
        }
    }
    Ok(())
}

/// The tables into which `breaks` before rows, rows or columns without a number cut a grid: several of equal
/// size, above one row or column.
fn equal_tables(values: &[f64], columns: usize, breaks: Vec<usize>) -> Option<Tables> {
    let rows = values.len() / columns;
    let empty_rows: Vec<usize> =
        (0..rows).filter(|row| values[row * columns..][..columns].iter().all(|z| z.is_nan())).collect();
    let below = equal_parts(breaks, &empty_rows, rows);
    let empty_columns: Vec<usize> = (0..columns)
        .filter(|column| values.iter().skip(*column).step_by(columns).all(|z| z.is_nan()))
        .collect();
    let beside = equal_parts(Vec::new(), &empty_columns, columns);
    let tables = |are_beside| move |[count, size]: [usize; 2]| Tables { count, size, are_beside };
    below.map(tables(false)).or_else(|| beside.map(tables(true)))
}

/// Number and lines of the equal parts into which `breaks` and `empty` lines cut so many lines.
fn equal_parts(breaks: Vec<usize>, empty: &[usize], lines: usize) -> Option<[usize; 2]> {
    let full = lines - empty.len();
    let before = |line: usize| line - empty.partition_point(|other| *other < line);
    let mut breaks: Vec<usize> = breaks.iter().chain(empty).map(|line| before(*line)).collect();
    breaks.sort_unstable();
    breaks.retain(|at| (1..full).contains(at));
    breaks.dedup();
    let each = *breaks.first()?;
    let all = breaks.iter().chain([&full]).enumerate().all(|(i, at)| *at == (i + 1) * each);
    (each > 1 && all).then_some([full / each, each])
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
    let mut part = Part {
        values: Vec::with_capacity(text.len() / 8),
        all_end_empty: true,
        all_start_empty: true,
        breaks: Vec::new(),
    };
    for (i, line) in text.lines().enumerate() {
        let bare = line.trim_start();
        let is_bare = bare.is_empty() && !is_empty_row(dialect, line, columns);
        if is_bare || is_comment(bare) {
            part.breaks.push(part.values.len() / columns);
            continue;
        }
        let start = part.values.len();
        let mut last = "";
        for cell in dialect.cells(line) {
            part.all_start_empty &= part.values.len() > start || cell.is_empty();
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
