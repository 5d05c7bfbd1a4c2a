//! Sheets of Excel workbooks as text: numbers with all their digits, a tab between columns.

use crate::text::TextError;
use calamine::{Data, DataRef, DataType, Reader, Xls, Xlsx};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::panic;
use std::sync::{Mutex, PoisonError};

/// Beginning of a compound file, in which an `.xls` lies.
pub(crate) const COMPOUND: &[u8] = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";
/// Beginning of an archive, in which an `.xlsx` lies.
pub(crate) const ARCHIVE: &[u8] = b"PK\x03\x04";
/// Bytes that a cell takes in memory, with its text.
const CELL_BYTES: u64 = 128;

/// Rows and columns of the largest sheet.
const MOST_ROWS: u32 = 1 << 20;
const MOST_COLUMNS: u32 = 1 << 14;

/// A sheet: its rows, each with its cells by their columns.
struct Sheet {
    name: String,
    rows: BTreeMap<u32, BTreeMap<u32, String>>,
    numbers: usize,
}

/// Text of the sheet with a table, and its name among those of the file: of several with as many numbers, or
/// half of them, the first.
pub(crate) fn text(bytes: &[u8]) -> Result<(String, String), TextError> {
    let sheets =
        if bytes.starts_with(ARCHIVE) { xlsx(bytes) } else { xls(bytes) }.map_err(TextError::whole)?;
    let most = sheets.iter().map(|sheet| sheet.numbers).max().unwrap_or(0);
    let found = sheets.iter().find(|sheet| most > 0 && 2 * sheet.numbers >= most);
    let sheet = found.ok_or_else(|| TextError::whole("is an Excel workbook without a number"))?;
    let columns = sheet.rows.values().flat_map(|row| row.keys());
    let width = columns.max().map_or(0, |last| *last as usize + 1);
    // cells that are empty take a tab each
    if width.saturating_mul(sheet.rows.len()) / CELL_BYTES as usize > most_cells() {
        return Err(TextError::whole(too_many()));
    }
    let others = if sheets.len() > 1 { format!(", one of {}", sheets.len()) } else { String::new() };
    Ok((sheet.text(), format!("sheet \"{}\"{others} of an Excel workbook as", sheet.name)))
}

impl Sheet {
    fn new(name: String) -> Sheet {
        Sheet { name, rows: BTreeMap::new(), numbers: 0 }
    }

    fn put(&mut self, place: (u32, u32), cell: &impl DataType) -> Result<(), String> {
        if place.0 >= MOST_ROWS || place.1 >= MOST_COLUMNS {
            return Err(refused(&format_args!("a cell in row {} and column {}", place.0, place.1)));
        }
        // dates and times are numbers too, of days
        let number = cell.get_float().or_else(|| cell.get_int().map(|i| i as f64));
        let number = number.or_else(|| cell.get_datetime().map(|date| date.as_f64()));
        let text = match number {
            Some(number) => format!("{number:?}"),
            None if cell.is_error() => "#N/A".into(),
            None => cell.as_string().unwrap_or_default().replace(['\t', '\n', '\r'], " "),
        };
        if !text.is_empty() {
            self.numbers += usize::from(number.is_some());
            self.rows.entry(place.0).or_default().insert(place.1, text);
        }
        Ok(())
    }

    /// Rows up to the last column with a number, so that empty cells of a map stay.
    fn text(&self) -> String {
        let is_number = |cell: &str| cell.parse::<f64>().is_ok();
        let columns = || self.rows.values().flat_map(|row| row.iter());
        let first = columns().map(|(column, _)| *column).min().unwrap_or(0);
        let last =
            columns().filter(|(_, cell)| is_number(cell)).map(|(column, _)| *column).max().unwrap_or(0);
        let mut out = String::new();
        let mut line = self.rows.keys().next().copied().unwrap_or(0);
        for (place, row) in &self.rows {
            // lines of the text are those of the sheet where it is filled
            if *place > line {
                out.push('\n');
            }
            line = *place;
            let end = last.max(row.keys().next_back().copied().unwrap_or(0));
            let has_number = row.values().any(|cell| is_number(cell));
            let end = if has_number { end } else { row.keys().next_back().copied().unwrap_or(0) };
            for column in first..=end {
                if column > first {
                    out.push('\t');
                }
                out.push_str(row.get(&column).map_or("", String::as_str));
            }
        }
        out.push('\n');
        out
    }
}

fn refused(error: &dyn std::fmt::Display) -> String {
    format!("is an Excel workbook that cannot be read ({error}): save the sheet as CSV")
}

/// Cells that may be held.
fn most_cells() -> usize {
    (crate::memory::default_limit() / CELL_BYTES) as usize
}

fn too_many() -> String {
    refused(&"it unpacks to more than the memory that is free")
}

fn xlsx(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    // a bomb is known by unpacking it once, without keeping anything
    let limit = crate::memory::default_limit() / 4;
    let mut unpacked = 0;
    for i in 0..archive.len() {
        let member = archive.by_index(i).map_err(|e| refused(&e))?;
        let mut rest = member.take(limit - unpacked + 1);
        unpacked += std::io::copy(&mut rest, &mut std::io::sink()).map_err(|e| refused(&e))?;
        if unpacked > limit {
            return Err(too_many());
        }
    }
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    let mut sheets = Vec::new();
    let mut held = 0;
    for name in book.sheet_names() {
        let mut sheet = Sheet::new(name.clone());
        // a sheet that is a chart has no cells
        let Ok(mut cells) = book.worksheet_cells_reader(&name) else { continue };
        while let Some(cell) = cells.next_cell().map_err(|e| refused(&e))? {
            if !matches!(cell.get_value(), DataRef::Empty) {
                sheet.put(cell.get_position(), cell.get_value())?;
                held += 1;
            }
            if held > most_cells() {
                return Err(too_many());
            }
        }
        sheets.push(sheet);
    }
    Ok(sheets)
}

/// The reader of `.xls` files does not ask whether a damaged file goes as far as its indices: its panic is an
/// error of the file. Messages of panics are kept back meanwhile, those of other threads too.
fn xls(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    check_places(bytes)?;
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| ()));
    let sheets = panic::catch_unwind(|| xls_sheets(bytes));
    panic::set_hook(hook);
    sheets.unwrap_or_else(|_| Err(refused(&"it is damaged")))
}

fn xls_sheets(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    let mut book = Xls::new(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    let mut sheets = Vec::new();
    for (name, range) in book.worksheets() {
        let mut sheet = Sheet::new(name);
        let (row, column) = range.start().unwrap_or((0, 0));
        for (down, across, cell) in range.used_cells() {
            if *cell != Data::Empty {
                sheet.put((row + down as u32, column + across as u32), cell)?;
            }
        }
        sheets.push(sheet);
    }
    Ok(sheets)
}

/// Refuses cells in places that no sheet has, for a reader allocates all cells between the outermost ones.
fn check_places(bytes: &[u8]) -> Result<(), String> {
    const COLUMNS: u64 = 256;
    let mut file = cfb::CompoundFile::open(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    let name = ["/Workbook", "/Book"].into_iter().find(|name| file.exists(name));
    let name = name.ok_or(
        "is a file of old Microsoft Office or of an instrument that stores so (.doc, .oir), no workbook: save the table as CSV",
    )?;
    let mut stream = Vec::new();
    file.open_stream(name).and_then(|mut s| s.read_to_end(&mut stream)).map_err(|e| refused(&e))?;
    let mut rest = &stream[..];
    let mut rows = 0;
    let mut held = 0;
    while let [a, b, c, d, after @ ..] = rest {
        let (kind, length) = (u16::from_le_bytes([*a, *b]), usize::from(u16::from_le_bytes([*c, *d])));
        let record = after.get(..length).unwrap_or(after);
        rest = after.get(length..).unwrap_or(&[]);
        let word = |place: usize| {
            record.get(place..place + 2).map_or(0, |w| u64::from(w[0]) + 256 * u64::from(w[1]))
        };
        let (row, column) = (word(0), word(2));
        match kind {
            // numbers, texts, truths, formulas
            0x203 | 0x204 | 0x205 | 0x27e | 0xfd | 0x0d6 | 0x006 | 0x0bd if column >= COLUMNS => {
                return Err(refused(&format_args!("a cell in column {column}")));
            }
            0x203 | 0x204 | 0x205 | 0x27e | 0xfd | 0x0d6 | 0x006 | 0x0bd => rows = rows.max(row + 1),
            // first and last row and column
            0x200 => {
                let sizes = match length {
                    10 => [word(0), word(2), word(4), word(6)],
                    _ => [row + (column << 16), word(4) + (word(6) << 16), word(8), word(10)],
                };
                let [top, bottom, left, right] = sizes;
                if bottom < top || right < left || bottom > 1 << 16 || right > COLUMNS {
                    return Err(refused(&"its dimensions make no sense"));
                }
                rows = rows.max(bottom);
            }
            // a sheet ends
            0x00a => {
                held += rows * COLUMNS;
                rows = 0;
            }
            _ => {}
        }
    }
    if held + rows * COLUMNS > most_cells() as u64 { Err(too_many()) } else { Ok(()) }
}
