//! Cells that a workbook shows as percent: they hold 0.05 where 5 % is seen.

use super::sheet::Archive;
use roxmltree::Document;
use std::collections::{HashMap, HashSet};
use std::io::Read;

/// Numbers of the formats `0%` and `0.00%` of every workbook.
const OF_PERCENT: [&str; 2] = ["9", "10"];

/// Names such as `B7` of the cells of each sheet that are shown as percent, by the name of the sheet.
pub(super) fn cells(archive: &mut Archive<'_>) -> HashMap<String, HashSet<String>> {
    let styles = styles(archive).unwrap_or_default();
    if styles.is_empty() {
        return HashMap::new();
    }
    let sheets = sheets(archive).unwrap_or_default();
    let found = |(name, path): (String, String)| {
        let sheet = member(archive, &path)?;
        Some((name, cells_of(&sheet, &styles)))
    };
    sheets.into_iter().filter_map(found).collect()
}

fn member(archive: &mut Archive<'_>, path: &str) -> Option<String> {
    let mut bytes = Vec::new();
    archive.by_name(path).ok()?.read_to_end(&mut bytes).ok()?;
    String::from_utf8(bytes).ok()
}

/// Places in the list of styles of those that show percent.
fn styles(archive: &mut Archive<'_>) -> Option<HashSet<String>> {
    let text = member(archive, "xl/styles.xml")?;
    let document = Document::parse(&text).ok()?;
    let formats = document.descendants().filter(|node| node.tag_name().name() == "numFmt");
    let shows = |code: &str| code.split('"').step_by(2).any(|part| part.contains('%'));
    let own = formats.filter(|format| format.attribute("formatCode").is_some_and(shows));
    let numbers: HashSet<&str> =
        own.filter_map(|format| format.attribute("numFmtId")).chain(OF_PERCENT).collect();
    let list = document.descendants().find(|node| node.tag_name().name() == "cellXfs")?;
    let styles = list.children().filter(|node| node.is_element()).enumerate();
    let is_percent =
        |style: roxmltree::Node<'_, '_>| style.attribute("numFmtId").is_some_and(|n| numbers.contains(n));
    Some(styles.filter(|(_, style)| is_percent(*style)).map(|(place, _)| place.to_string()).collect())
}

/// Name and path of each sheet.
fn sheets(archive: &mut Archive<'_>) -> Option<Vec<(String, String)>> {
    let (book, links) = (member(archive, "xl/workbook.xml")?, member(archive, "xl/_rels/workbook.xml.rels")?);
    let (book, links) = (Document::parse(&book).ok()?, Document::parse(&links).ok()?);
    let paths: HashMap<&str, &str> = links
        .root_element()
        .children()
        .filter_map(|link| Some((link.attribute("Id")?, link.attribute("Target")?)))
        .collect();
    let sheets = book.descendants().filter(|node| node.tag_name().name() == "sheet");
    let path = |sheet: roxmltree::Node<'_, '_>| {
        let id = sheet.attributes().find(|a| a.name() == "id")?.value();
        let target = paths.get(id)?;
        let path = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_string);
        Some((sheet.attribute("name")?.to_string(), path))
    };
    Some(sheets.filter_map(path).collect())
}

/// Names of the cells of a `sheet` with one of the `styles`. Its beginnings of cells are looked at alone, for
/// a sheet may have millions.
fn cells_of(sheet: &str, styles: &HashSet<String>) -> HashSet<String> {
    let mut found = HashSet::new();
    for rest in sheet.split("<c ").skip(1) {
        let head = rest.split('>').next().unwrap_or("");
        let attribute = |name: &str| {
            let value = format!(" {head}").split_once(&format!(" {name}=\""))?.1.to_string();
            Some(value.split('"').next()?.to_string())
        };
        if attribute("s").is_some_and(|style| styles.contains(&style)) {
            found.extend(attribute("r"));
        }
    }
    found
}

/// Name of the cell in a row and a column, from 0.
pub(super) fn name_of(row: u32, column: u32) -> String {
    let (mut letters, mut rest) = (Vec::new(), column + 1);
    while rest > 0 {
        letters.push(char::from(b'A' + ((rest - 1) % 26) as u8));
        rest = (rest - 1) / 26;
    }
    format!("{}{}", letters.iter().rev().collect::<String>(), row + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_named_as_a_sheet_names_them() {
        for (row, column, name) in
            [(0, 0, "A1"), (6, 25, "Z7"), (0, 26, "AA1"), (9, 701, "ZZ10"), (0, 702, "AAA1")]
        {
            assert_eq!(name_of(row, column), name);
        }
        let styles = HashSet::from(["1".to_string()]);
        let sheet =
            r#"<row r="2"><c r="A2" s="1" t="n"><v>0</v></c><c s="1" r="B2"/><c r="C2" s="11"/></row>"#;
        assert_eq!(cells_of(sheet, &styles), HashSet::from(["A2".to_string(), "B2".to_string()]));
    }
}
