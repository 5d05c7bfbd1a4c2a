//! Marks between thousands: those that are certain, and those that may stand before decimals.

use super::TextError;

/// Cells of each kind from which a column is doubtful.
const LEAST: usize = 3;

/// Cells of one column that a mark between thousands would explain.
#[derive(Default)]
struct Column<'t> {
    /// Whole numbers from 1 to 999.
    short: usize,
    /// Numbers from 1 with just three decimals.
    marked: usize,
    /// Others, which are written with decimals.
    other: usize,
    /// The last number with three decimals, with its line.
    example: (usize, &'t str),
}

impl<'t> Column<'t> {
    fn take(&mut self, line: usize, cell: &'t str) {
        let digits = cell.trim_start_matches(['-', '+', '−']);
        let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let is_short = |text: &str| is_whole(text) && text.len() <= 3 && !text.starts_with('0');
        match digits.split_once('.') {
            _ if digits == "0" || !digits.contains(|c: char| c.is_ascii_digit()) => {}
            None if is_short(digits) => self.short += 1,
            Some((whole, decimals)) if is_short(whole) && is_whole(decimals) && decimals.len() == 3 => {
                self.marked += 1;
                self.example = (line, cell);
            }
            _ => self.other += 1,
        }
    }
}

/// Refuses a column of whole numbers up to 999 and of others with just three decimals, all from 1: `525`
/// below `1.026` is what a spreadsheet shows of 1026 where points part thousands. `rows` are the cells of
/// lines, `has_key` is true where a message may name the key `decimal`.
///
/// # Errors
/// Such a column.
pub(super) fn refuse_doubtful<'t, Cells: Iterator<Item = &'t str>>(
    rows: impl Iterator<Item = (usize, Cells)>,
    has_key: bool,
) -> Result<(), TextError> {
    let mut columns: Vec<Column<'_>> = Vec::new();
    for (line, cells) in rows {
        for (i, cell) in cells.enumerate() {
            columns.resize_with(columns.len().max(i + 1), Column::default);
            columns[i].take(line, cell);
        }
    }
    let is_doubtful = |column: &&Column<'_>| column.other == 0 && column.short.min(column.marked) >= LEAST;
    let Some((line, cell)) = columns.iter().find(is_doubtful).map(|column| column.example) else {
        return Ok(());
    };
    let key = if has_key { format!(", or set decimal = \"point\" for {cell}") } else { String::new() };
    let message = format!(
        "\"{cell}\" is {cell} or {}, and whole numbers stand in its column: write numbers without marks between thousands{key}",
        cell.replace('.', "")
    );
    Err(TextError::new(line, message))
}

/// True of a number with groups of three digits that `other` parts, and decimals behind `mark`, or of
/// several groups. Where decimals stand behind a point, one group is enough: that they do is known then.
pub(super) fn parts_groups(cell: &str, mark: char, other: char) -> bool {
    let (whole, has_mark) = cell.split_once(mark).map_or((cell, false), |(whole, _)| (whole, true));
    let mut groups = whole.trim_start_matches(['-', '+', '−']).split(other);
    let first = groups.next().unwrap_or("");
    let later: Vec<&str> = groups.collect();
    let is_digits = |group: &str| !group.is_empty() && group.bytes().all(|b| b.is_ascii_digit());
    (has_mark || later.len() > 1 || mark == '.' && later.len() == 1 && !first.starts_with('0'))
        && (1..=3).contains(&first.len())
        && is_digits(first)
        && later.iter().all(|group| group.len() == 3 && is_digits(group))
        && cell.rsplit_once(mark).is_none_or(|(_, decimals)| !decimals.contains(other))
}
