//! The message on a table in which no readings were found.

use super::super::dialect::is_row;
use super::super::header::header_cells;
use super::super::heading::{Quantity, unbracketed};
use super::super::{TextError, shortened};
use super::{Reader, is_unit_of_any};

impl<const N: usize> Reader<'_, '_, N> {
    /// The number of largest size in each column of the rows, as it is written.
    fn most_of_columns(&self, text: &str) -> Vec<String> {
        let mut most: Vec<(f64, &str)> = Vec::new();
        for line in text.lines().filter(|line| is_row(line.trim())) {
            for (i, cell) in self.dialect.cells(line).enumerate() {
                let size = self.dialect.number(cell).map_or(0.0, f64::abs);
                match most.get_mut(i) {
                    Some(known) if size > known.0 => *known = (size, cell),
                    Some(_) => {}
                    None => most.push((size, cell)),
                }
            }
        }
        most.into_iter().filter(|(_, cell)| !cell.is_empty()).map(|(_, cell)| cell.to_string()).collect()
    }

    /// The reason why there are no readings.
    pub(super) fn nothing(&self, text: &str) -> TextError {
        if let Some(block) = &self.block {
            let message = "is a header without readings below it: give a row of numbers for each reading";
            return TextError::new(block.header.line, message);
        }
        let list = |part: fn(&Quantity) -> &str, between| {
            self.wanted.iter().map(part).collect::<Vec<_>>().join(between)
        };
        let asked: Vec<String> =
            self.named.columns.iter().flatten().map(|name| format!("\"{name}\"")).collect();
        let mut message = if text.trim().is_empty() {
            format!("is empty: begin it with a line like {}", list(|q| q.example, ","))
        } else if asked.is_empty() {
            format!(
                "has no header that names a {} with their units: write a first line like {}",
                list(|q| q.name, " and a "),
                list(|q| q.example, ",")
            )
        } else {
            format!("has no header with the columns {}", asked.join(" and "))
        };
        let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        // a line of units is none of names
        let is_title = |(_, line): &(usize, &str)| {
            let cells = header_cells(&self.dialect, line, None);
            let are_units = cells.len() > 1 && cells.iter().all(|cell| is_unit_of_any(unbracketed(cell)));
            !are_units
        };
        let title = lines().take_while(|(_, line)| !is_row(line.trim())).filter(is_title).last();
        if let (Some(key), Some((_, title))) = (self.named.key, title) {
            let cells = header_cells(&self.dialect, title, None);
            let cells: Vec<String> = cells.iter().take(12).map(|c| format!("\"{}\"", shortened(c))).collect();
            let keys = list(|q| q.name, " = \"…\", ");
            message +=
                &format!(", or say which of {} they are: {key} = {{ {keys} = \"…\" }}", cells.join(", "));
        }
        if let (Some(key), None) = (self.named.key, title) {
            let most = self.most_of_columns(text);
            // which of more columns than are wanted is which cannot be guessed
            let is_open = most.len() > N;
            let one = |(i, q): (usize, &Quantity)| {
                let unit = q.example.rsplit('_').next().unwrap_or("");
                let number = if is_open { "NUMBER".to_string() } else { format!("{}", i + 1) };
                format!("{} = \"{number} [{unit}]\"", q.name)
            };
            let keys: Vec<String> = self.wanted.iter().enumerate().map(one).collect();
            let reach = if is_open { format!(" (they reach {})", most.join(", ")) } else { String::new() };
            message += &format!(
                ", or say which columns they are, by number and unit: {key} = {{ {} }}{reach}",
                keys.join(", ")
            );
        }
        TextError { line: title.or_else(|| lines().next()).map(|(i, _)| i + 1), message }
    }
}
