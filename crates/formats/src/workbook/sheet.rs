//! One sheet of a workbook as a table of text.

use calamine::DataType;
use std::collections::BTreeMap;
use std::io::Cursor;

/// An archive in memory.
pub(super) type Archive<'b> = zip::ZipArchive<Cursor<&'b [u8]>>;
/// Bytes that a cell takes in memory, with its text.
pub(super) const CELL_BYTES: u64 = 128;

/// Rows and columns of the largest sheet.
const MOST_ROWS: u32 = 1 << 20;
const MOST_COLUMNS: u32 = 1 << 14;

/// A sheet: its rows, each with its cells by their columns.
pub(super) struct Sheet {
    pub(super) name: String,
    pub(super) rows: BTreeMap<u32, BTreeMap<u32, String>>,
    pub(super) numbers: usize,
}

impl Sheet {
    /// One without a cell.
    pub(super) fn new(name: String) -> Sheet {
        Sheet { name, rows: BTreeMap::new(), numbers: 0 }
    }

    /// Gives a cell its value.
    pub(super) fn put(
        &mut self,
        place: (u32, u32),
        cell: &impl DataType,
        is_percent: bool,
    ) -> Result<(), String> {
        let number = cell.get_float().or_else(|| cell.get_int().map(|i| i as f64));
        let date = cell.get_datetime().map(|date| date_of(date.as_f64()));
        let text = match number {
            // a date is no number, and stands as well before the numbers of a row
            _ if date.is_some() => date.unwrap_or_default(),
            Some(number) if is_percent => percent_text(number),
            Some(number) => format!("{number:?}"),
            None if cell.is_error() => "#N/A".into(),
            None => cell.as_string().unwrap_or_default(),
        };
        self.set(place, text, number.is_some())
    }

    /// Gives a cell its text.
    pub(super) fn set(&mut self, place: (u32, u32), text: String, has_number: bool) -> Result<(), String> {
        if place.0 >= MOST_ROWS || place.1 >= MOST_COLUMNS {
            return Err(refused(&format_args!("a cell in row {} and column {}", place.0, place.1)));
        }
        let text = text.replace(['\t', '\n', '\r'], " ");
        if !text.is_empty() {
            self.numbers += usize::from(has_number || is_number(&text));
            self.rows.entry(place.0).or_default().insert(place.1, text);
        }
        Ok(())
    }

    /// The first column of the rows with numbers, not counting words and numbers above them that stand
    /// further left; where one of these lines goes on above the numbers as a heading does, the first of all.
    fn first_column(&self) -> u32 {
        let mut numbers: BTreeMap<u32, usize> = BTreeMap::new();
        for (column, _) in self.rows.values().flatten().filter(|(_, cell)| is_number(cell)) {
            *numbers.entry(*column).or_default() += 1;
        }
        let most = numbers.values().max().copied().unwrap_or(0);
        let full = numbers.iter().find(|(_, count)| 2 * **count >= most).map_or(0, |(column, _)| *column);
        let is_row = |row: &&BTreeMap<u32, String>| row.range(full..).any(|(_, cell)| is_number(cell));
        let begin = |row: &BTreeMap<u32, String>| row.keys().next().copied();
        let first = self.rows.values().filter(is_row).filter_map(begin).min().unwrap_or(0);
        let is_heading = |row: &BTreeMap<u32, String>| {
            begin(row).is_some_and(|column| column < first) && row.range(first..).nth(1).is_some()
        };
        if self.rows.values().any(is_heading) {
            return self.rows.values().filter_map(begin).min().unwrap_or(0);
        }
        first
    }

    /// Rows up to the last column with a number, so that empty cells of a map stay.
    pub(super) fn text(&self) -> String {
        let columns = || self.rows.values().flat_map(|row| row.iter());
        let first = self.first_column();
        let last =
            columns().filter(|(_, cell)| is_number(cell)).map(|(column, _)| *column).max().unwrap_or(0);
        let mut out = String::new();
        let mut line = 0;
        let mut had_number = false;
        for (place, row) in &self.rows {
            let has_number = row.range(first..).any(|(_, cell)| is_number(cell));
            // lines of the text are those of the sheet; rows without a cell between numbers are missing ones
            for before in line..*place {
                out.push('\n');
                if had_number && has_number && before + 1 < *place {
                    out.extend((first..last).map(|_| '\t'));
                }
            }
            (line, had_number) = (*place, has_number);
            let end = last.max(row.keys().next_back().copied().unwrap_or(0));
            let end = if has_number { end } else { row.keys().next_back().copied().unwrap_or(0) };
            let begin = row.keys().next().map_or(first, |own| first.min(*own));
            for column in begin..=end {
                if column > begin {
                    out.push('\t');
                }
                out.push_str(row.get(&column).map_or("", String::as_str));
            }
        }
        out.push('\n');
        out
    }
}

/// True of a number, of one too that a program stored as text with a point or a comma before decimals.
fn is_number(cell: &str) -> bool {
    cell.parse::<f64>().is_ok() || cell.contains(',') && cell.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// A share as a cell shows it that is set to percent.
pub(super) fn percent_text(share: f64) -> String {
    format!("{:?}%", 100.0 * share)
}

/// The day so many days after Excel's day 0, as ISO 8601 writes it. By Howard Hinnant's count of days in eras
/// of 400 years that begin in March.
pub(super) fn date_of(days: f64) -> String {
    // 1899-12-30 is that many days after 0000-03-01
    const DAY_0: i64 = 693_899;
    let day = days.floor().clamp(-6e5, 1e7) as i64 + DAY_0;
    let (era, of_era) = (day.div_euclid(146_097), day.rem_euclid(146_097));
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let (year, month) = (year + 400 * era + i64::from(month >= 10), (month + 2) % 12 + 1);
    format!("{year:04}-{month:02}-{day:02}")
}

pub(super) fn refused(error: &dyn std::fmt::Display) -> String {
    format!("is a workbook that cannot be read ({error}): save the sheet as CSV")
}

/// Cells that may be held.
pub(super) fn most_cells() -> usize {
    (crate::memory::default_limit() / CELL_BYTES) as usize
}

pub(super) fn too_many() -> String {
    refused(&"it unpacks to more than the memory that is free")
}

#[cfg(test)]
mod tests {
    use super::date_of;

    /// Day 60 is 29 February 1900 to Excel, which never was.
    #[test]
    fn days_of_excel_are_those_of_the_calendar() {
        assert_eq!([0.5, 60.0, 61.0].map(date_of), ["1899-12-30", "1900-02-28", "1900-03-01"]);
    }
}
