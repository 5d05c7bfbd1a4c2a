//! Sheets of OpenDocument spreadsheets (ODF 1.3, part 3): cells with the values that they show.

use super::sheet::{Archive, Sheet, most_cells, percent_text, refused, too_many};
use roxmltree::{Document, Node, ParsingOptions};
use std::io::Read;

const OFFICE: &str = "urn:oasis:names:tc:opendocument:xmlns:office:1.0";
const TABLE: &str = "urn:oasis:names:tc:opendocument:xmlns:table:1.0";
const TEXT: &str = "urn:oasis:names:tc:opendocument:xmlns:text:1.0";
/// Of what LibreOffice adds: cells whose formula failed.
const CALC: &str = "urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0";
/// The member of the archive that holds the sheets.
pub(super) const CONTENT: &str = "content.xml";
/// Bytes that a node of XML takes in memory with its attributes.
const NODE_BYTES: u64 = 512;

/// The sheets of an archive with a [`CONTENT`].
pub(super) fn sheets(archive: &mut Archive<'_>) -> Result<Vec<Sheet>, String> {
    let mut text = String::new();
    let member = archive.by_name(CONTENT).map_err(|e| refused(&e))?;
    let limit = crate::memory::default_limit();
    member.take(limit / 4 + 1).read_to_string(&mut text).map_err(|_| {
        refused(&"its content.xml is no text, as that of a sheet with a password or of a damaged one")
    })?;
    if text.len() as u64 > limit / 4 {
        return Err(too_many());
    }
    let nodes_limit = u32::try_from(limit / NODE_BYTES).unwrap_or(u32::MAX);
    let options = ParsingOptions { nodes_limit, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options).map_err(|e| match e {
        roxmltree::Error::NodesLimitReached => too_many(),
        other => refused(&other),
    })?;
    let body = document.descendants().find(|node| node.has_tag_name((OFFICE, "spreadsheet")));
    let body = body.ok_or("is an OpenDocument text or drawing, not a spreadsheet: save the table as CSV")?;
    let mut held = 0;
    body.children().filter(|node| node.has_tag_name((TABLE, "table"))).map(|t| sheet(t, &mut held)).collect()
}

fn sheet(table: Node<'_, '_>, held: &mut usize) -> Result<Sheet, String> {
    let mut sheet = Sheet::new(table.attribute((TABLE, "name")).unwrap_or("").into());
    let mut place = 0_u32;
    // rows may lie in groups; those of a table inside a cell are none of this one
    let is_own = |row: &Node<'_, '_>| {
        row.has_tag_name((TABLE, "table-row"))
            && row.ancestors().find(|node| node.has_tag_name((TABLE, "table"))) == Some(table)
    };
    for row in table.descendants().filter(is_own) {
        let repeated = repeats(row, "number-rows-repeated");
        let cells = cells_of(row);
        // the count of all before the first is put
        let count = cells.iter().map(|(_, count, ..)| *count as usize).sum::<usize>();
        *held = held.saturating_add(count.saturating_mul(repeated as usize));
        if *held > most_cells() {
            return Err(too_many());
        }
        for down in 0..if cells.is_empty() { 0 } else { repeated } {
            for (first, count, text, is_number) in &cells {
                for across in 0..*count {
                    let at = (place.saturating_add(down), first.saturating_add(across));
                    sheet.set(at, text.clone(), *is_number)?;
                }
            }
        }
        place = place.saturating_add(repeated);
    }
    Ok(sheet)
}

/// The cells of a row that hold something: first column, how many hold the same, text, and whether it is a
/// number.
fn cells_of(row: Node<'_, '_>) -> Vec<(u32, u32, String, bool)> {
    let mut cells = Vec::new();
    let mut column = 0_u32;
    let is_cell = |node: &Node<'_, '_>| {
        node.has_tag_name((TABLE, "table-cell")) || node.has_tag_name((TABLE, "covered-table-cell"))
    };
    for cell in row.children().filter(is_cell) {
        let count = repeats(cell, "number-columns-repeated");
        let (text, is_number) = content(cell);
        if !text.is_empty() {
            cells.push((column, count, text, is_number));
        }
        column = column.saturating_add(count);
    }
    cells
}

/// Number of times that a row or a cell stands there.
fn repeats(node: Node<'_, '_>, name: &str) -> u32 {
    node.attribute((TABLE, name)).and_then(|count| count.parse().ok()).unwrap_or(1)
}

/// Text of a cell as the other readers of workbooks write it, and whether it is a number.
fn content(cell: Node<'_, '_>) -> (String, bool) {
    let of_office = |name: &str| cell.attribute((OFFICE, name));
    let number = || of_office("value").and_then(|value| value.trim().parse::<f64>().ok());
    if cell.attribute((CALC, "value-type")) == Some("error") {
        return ("#N/A".into(), false);
    }
    match (of_office("value-type"), number()) {
        (Some("percentage"), Some(number)) => (percent_text(number), true),
        (Some("float" | "currency"), Some(number)) => (format!("{number:?}"), true),
        // without the time of day
        (Some("date"), _) => {
            let date = of_office("date-value").unwrap_or("");
            (date.split('T').next().unwrap_or("").into(), false)
        }
        _ => (of_office("string-value").map_or_else(|| shown(cell), Into::into), false),
    }
}

/// The paragraphs of a cell; those of a remark on it are none of it.
fn shown(cell: Node<'_, '_>) -> String {
    let paragraphs = cell.children().filter(|node| node.has_tag_name((TEXT, "p")));
    let of = |paragraph: Node<'_, '_>| -> String {
        let word = |node: Node<'_, '_>| match node.text().filter(|_| node.is_text()) {
            Some(text) => text.to_string(),
            // blanks that follow each other, and tabs, are elements
            None if node.has_tag_name((TEXT, "s")) || node.has_tag_name((TEXT, "tab")) => " ".into(),
            None => String::new(),
        };
        paragraph.descendants().map(word).collect()
    };
    paragraphs.map(of).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workbook::text;
    use std::io::{Cursor, Write};

    /// A file of OpenDocument 1.3 with this body.
    fn file(body: &str) -> Vec<u8> {
        let of = "urn:oasis:names:tc:opendocument:xmlns";
        let spaces = [("office", "office"), ("table", "table"), ("text", "text")]
            .map(|(prefix, space)| format!(r#" xmlns:{prefix}="{of}:{space}:1.0""#))
            .concat();
        let calc = r#" xmlns:calcext="urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0""#;
        let content = format!(
            "<office:document-content{spaces}{calc}><office:body>{body}</office:body></office:document-content>"
        );
        let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
        archive.start_file(CONTENT, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(content.as_bytes()).unwrap();
        archive.finish().unwrap().into_inner()
    }

    /// One with a sheet of these rows.
    fn open_document(rows: &str) -> Vec<u8> {
        let table = format!(r#"<table:table table:name="a">{rows}</table:table>"#);
        file(&format!("<office:spreadsheet>{table}</office:spreadsheet>"))
    }

    #[test]
    fn a_sheet_of_libreoffice_gives_what_its_cells_show() {
        let row = |cells: &str| format!("<table:table-row>{cells}</table:table-row>");
        let cell = |inside: &str| format!("<table:table-cell {inside}/>");
        let number = cell(r#"office:value-type="float" office:value="300""#);
        let words = r#"<table:table-cell office:value-type="string"><office:annotation><text:p>7</text:p></office:annotation><text:p>by<text:s/>hand</text:p></table:table-cell>"#;
        for (cells, want) in [
            (cell(r#"office:value-type="percentage" office:value="0.05""#), "5.0%\t300.0\n"),
            (
                cell(r#"office:value-type="date" office:date-value="2023-03-15T10:00:00""#),
                "2023-03-15\t300.0\n",
            ),
            (cell(r#"office:value-type="string" calcext:value-type="error""#), "#N/A\t300.0\n"),
            (words.into(), "by hand\t300.0\n"),
            (cell(r#"table:number-columns-repeated="2""#) + &number, "300.0\t300.0\n"),
        ] {
            assert_eq!(text(&open_document(&row(&(cells + &number)))).unwrap().0, want);
        }
        // rows lie in groups; one that repeats is there so often, an empty one takes no memory
        let twice = format!(r#"<table:table-row table:number-rows-repeated="2">{number}</table:table-row>"#);
        let empty = r#"<table:table-row table:number-rows-repeated="1048000"><table:table-cell table:number-columns-repeated="16384"/></table:table-row>"#;
        let grouped = format!("<table:table-row-group>{twice}</table:table-row-group>{empty}");
        assert_eq!(text(&open_document(&grouped)).unwrap().0, "300.0\n300.0\n");
    }

    /// Places beyond those of any sheet, and a file of a few bytes that asks for millions of cells.
    #[test]
    fn a_sheet_of_libreoffice_that_repeats_without_end_is_refused() {
        let of = |rows: u64, columns: u64| {
            format!(
                r#"<table:table-row table:number-rows-repeated="{rows}"><table:table-cell office:value-type="float" office:value="1" table:number-columns-repeated="{columns}"/></table:table-row>"#
            )
        };
        for (rows, columns) in [(1 << 20, 1 << 14), (1, 1 << 20), (u64::from(u32::MAX), 1)] {
            let refused = text(&open_document(&of(rows, columns))).unwrap_err();
            assert!(refused.message.contains("save the sheet as CSV"), "{refused}");
        }
        let refused = text(&file("<office:text/>")).unwrap_err();
        assert!(refused.message.contains("not a spreadsheet"), "{refused}");
    }
}
