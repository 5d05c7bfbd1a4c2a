//! Sheets of workbooks of Excel and of LibreOffice as text: numbers with all their digits, a tab between
//! columns.

mod ods;
mod percent;
mod sheet;

use crate::text::TextError;
use calamine::{Data, DataRef, Reader, Xls, Xlsx};
use sheet::{Archive, CELL_BYTES, Sheet, most_cells, refused, too_many};
use std::fmt::Write;
use std::io::{Cursor, Read};
use std::panic;
use std::sync::{Mutex, PoisonError};

/// Beginning of a compound file, in which an `.xls` lies.
pub(crate) const COMPOUND: &[u8] = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";
/// Beginning of an archive, in which an `.xlsx` or an `.ods` lies.
pub(crate) const ARCHIVE: &[u8] = b"PK\x03\x04";

/// Parts of the names of sheets that hold something else than what was measured along the surface or in time.
const OTHERS: [&str; 15] = [
    "intensity",
    "intensität",
    "intensite",
    "reflect",
    "colour",
    "color",
    "image",
    "laser",
    "light",
    "result",
    "ergebnis",
    "summary",
    "statisti",
    "info",
    "quality",
];

/// Text of the sheet with a table, and its name among those of the file: of several with as many numbers, or
/// half of them, the first whose name is not that of something else.
pub(crate) fn text(bytes: &[u8]) -> Result<(String, String), TextError> {
    let sheets =
        if bytes.starts_with(ARCHIVE) { archived(bytes) } else { xls(bytes) }.map_err(TextError::whole)?;
    let most = sheets.iter().map(|sheet| sheet.numbers).max().unwrap_or(0);
    let full = || sheets.iter().filter(|sheet| most > 0 && 2 * sheet.numbers >= most);
    let is_other = |sheet: &Sheet| {
        let name = sheet.name.to_lowercase();
        // places of points beside their heights
        let is_place = ["x", "y"].contains(&name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or(""));
        is_place || OTHERS.iter().any(|other| name.contains(other))
    };
    let sheet = full().find(|sheet| !is_other(sheet)).or(full().next());
    let sheet = sheet.ok_or_else(|| TextError::whole("is a workbook without a number"))?;
    let columns = sheet.rows.values().flat_map(|row| row.keys());
    let width = columns.max().map_or(0, |last| *last as usize + 1);
    // cells that are empty take a tab each
    let ends = [sheet.rows.keys().next(), sheet.rows.keys().next_back()].map(|row| row.copied().unwrap_or(0));
    let height = (ends[1] - ends[0]) as usize + 1;
    if width.saturating_mul(height) / CELL_BYTES as usize > most_cells() {
        return Err(TextError::whole(too_many()));
    }
    let mut others = if sheets.len() > 1 { format!(", one of {}", sheets.len()) } else { String::new() };
    let alike: Vec<_> = full().filter(|other| !is_other(other) && other.name != sheet.name).collect();
    if let [other, ..] = alike[..] {
        let number = alike.len();
        let _ = write!(
            others,
            " ({number} with as many numbers, \"{}\" first, are not read: give a file each)",
            other.name
        );
    }
    Ok((sheet.text(), format!("sheet \"{}\"{others} of a workbook as", sheet.name)))
}

/// The sheets of an `.xlsx` or an `.ods`.
fn archived(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    if archive.index_for_name(ods::CONTENT).is_some() {
        return ods::sheets(&mut archive);
    }
    xlsx(bytes, &mut archive)
}

fn xlsx(bytes: &[u8], archive: &mut Archive<'_>) -> Result<Vec<Sheet>, String> {
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
    let percent = percent::cells(archive);
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|e| refused(&e))?;
    let mut sheets = Vec::new();
    let mut held = 0;
    for name in book.sheet_names() {
        let mut sheet = Sheet::new(name.clone());
        let shown = percent.get(&name).filter(|cells| !cells.is_empty());
        // a sheet that is a chart has no cells
        let Ok(mut cells) = book.worksheet_cells_reader(&name) else { continue };
        while let Some(cell) = cells.next_cell().map_err(|e| refused(&e))? {
            if !matches!(cell.get_value(), DataRef::Empty) {
                let (row, column) = cell.get_position();
                let is_percent = shown.is_some_and(|cells| cells.contains(&percent::name_of(row, column)));
                sheet.put((row, column), cell.get_value(), is_percent)?;
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
                sheet.put((row + down as u32, column + across as u32), cell, false)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    /// A workbook of Office Open XML (ECMA-376) with these sheets; style 1 shows percent, style 2 a date.
    fn book(sheets: &[(&str, &str)]) -> Vec<u8> {
        let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
        let mut member = |name: &str, text: &str| {
            archive.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            archive.write_all(text.as_bytes()).unwrap();
        };
        let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
        let office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
        let (mut list, mut links) = (String::new(), String::new());
        for (i, (name, cells)) in sheets.iter().enumerate() {
            list += &format!(r#"<sheet name="{name}" sheetId="{}" r:id="r{i}"/>"#, i + 1);
            links += &format!(
                r#"<Relationship Id="r{i}" Type="{office}/worksheet" Target="worksheets/s{i}.xml"/>"#
            );
            let sheet = format!(r#"<worksheet xmlns="{main}"><sheetData>{cells}</sheetData></worksheet>"#);
            member(&format!("xl/worksheets/s{i}.xml"), &sheet);
        }
        let book =
            format!(r#"<workbook xmlns="{main}" xmlns:r="{office}"><sheets>{list}</sheets></workbook>"#);
        member("xl/workbook.xml", &book);
        let package = "http://schemas.openxmlformats.org/package/2006/relationships";
        let links = format!(r#"<Relationships xmlns="{package}">{links}</Relationships>"#);
        member("xl/_rels/workbook.xml.rels", &links);
        let root =
            format!(r#"<Relationship Id="r" Type="{office}/officeDocument" Target="xl/workbook.xml"/>"#);
        member("_rels/.rels", &format!(r#"<Relationships xmlns="{package}">{root}</Relationships>"#));
        let styles = r#"<xf numFmtId="0"/><xf numFmtId="164"/><xf numFmtId="14"/>"#;
        let format = r#"<numFmts><numFmt numFmtId="164" formatCode="0.0%"/></numFmts>"#;
        let styles =
            format!(r#"<styleSheet xmlns="{main}">{format}<cellXfs>{styles}</cellXfs></styleSheet>"#);
        member("xl/styles.xml", &styles);
        archive.finish().unwrap().into_inner()
    }

    /// Rows of cells by their places, such as `B3`; words stand as they are, numbers too.
    fn placed(cells: &[(&str, &str)]) -> String {
        let row = |place: &str| place.trim_start_matches(|c: char| c.is_alphabetic()).to_string();
        let cell = |(place, value): &(&str, &str)| {
            let kind = if value.parse::<f64>().is_ok() { "n" } else { "str" };
            format!(r#"<row r="{}"><c r="{place}" t="{kind}"><v>{value}</v></c></row>"#, row(place))
        };
        cells.iter().map(cell).collect()
    }

    /// Titles stand in the corner of a sheet, the table where there was room.
    #[test]
    fn rows_and_columns_before_a_table_are_none_of_it() {
        let table = [("C4", "1"), ("D4", "2"), ("D5", "4"), ("C6", "5"), ("D6", "6")];
        let map = "\n1.0\t2.0\n\t4.0\n5.0\t6.0\n";
        for (before, want) in [
            (&[][..], "\n\n"),
            (&[("A1", "Map 7"), ("A2", "pixel size"), ("B2", "1 um")], "Map 7\npixel size\t1 um\n"),
            (&[("B1", "pixel size (um)"), ("B2", "3")], "pixel size (um)\n3.0\n"),
            (&[("A1", "Map 7"), ("D1", "by hand")], "Map 7\t\t\tby hand\n\n"),
            (&[("C2", "a"), ("D2", "b")], "\na\tb\n"),
        ] {
            let (text, _) = text(&book(&[("a", &placed(&[before, &table[..]].concat()))])).unwrap();
            assert_eq!(text, format!("{want}{map}"), "{before:?}");
        }
        // names of columns stay above their numbers, beside a label too
        let (text, _) = text(&book(&[(
            "a",
            &placed(&[("A3", "x"), ("C3", "a"), ("D3", "b"), ("C4", "1"), ("D4", "2")]),
        )]))
        .unwrap();
        assert_eq!(text, "\n\nx\t\ta\tb\n\t\t1.0\t2.0\n");
    }

    #[test]
    fn what_a_cell_shows_counts_and_the_sheet_of_what_was_measured() {
        let row = |cells: &str| format!(r#"<row r="1">{cells}</row>"#);
        let number =
            |place: &str, style: u8, value: &str| format!(r#"<c r="{place}" s="{style}"><v>{value}</v></c>"#);
        let percent = row(&(number("A1", 1, "0.05") + &number("B1", 0, "300")));
        // 2023-03-15 is day 45000 of Excel
        let date = row(&(number("A1", 2, "45000") + &number("B1", 0, "300")));
        let words = row(r#"<c r="A1" t="str"><v>0,25</v></c><c r="B1" t="str"><v>1.5</v></c>"#);
        for (sheets, want) in [
            (&[("a", percent.as_str())][..], "5.0%\t300.0\n"),
            (&[("a", date.as_str())], "2023-03-15\t300.0\n"),
            (&[("a", words.as_str())], "0,25\t1.5\n"),
            (&[("Intensity", date.as_str()), ("Height", percent.as_str())], "5.0%\t300.0\n"),
            (&[("Results", percent.as_str())], "5.0%\t300.0\n"),
            (&[("X", words.as_str()), ("Y (mm)", words.as_str()), ("Z", percent.as_str())], "5.0%\t300.0\n"),
        ] {
            assert_eq!(text(&book(sheets)).unwrap().0, want, "{sheets:?}");
        }
    }
}
