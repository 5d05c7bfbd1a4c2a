//! Pieces of Markdown.

/// A table of Markdown.
pub(super) fn table(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        format!("| {} |\n", cells.map(|cell| in_cell(&cell)).collect::<Vec<_>>().join(" | "))
    };
    let mut text = line(&mut head.iter().map(ToString::to_string));
    text += &format!("|{}\n", "-|".repeat(head.len()));
    rows.into_iter().for_each(|row| text += &line(&mut row.into_iter()));
    text + "\n"
}

/// Text that stays within its cell.
fn in_cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ").trim().into()
}

/// Words for the text of a page: what would be read as a tag is written out.
pub(super) fn words(text: &str) -> String {
    text.replace('<', "&lt;").replace('*', "\\*").replace(" _", " \\_")
}

/// Letters, digits and units as code.
pub(super) fn code(text: &str) -> String {
    format!("`{text}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_holds_bars_and_lines() {
        let text = table(&["a", "b"], [vec!["x|y".into(), "1\n2".into()]]);
        assert_eq!(text, "| a | b |\n|-|-|\n| x\\|y | 1 2 |\n\n");
    }
}
