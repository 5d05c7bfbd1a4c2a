//! The one reader of text tables: maps, points, profiles, curves and hardening go through it.
//!
//! In order: characters ([`decode`]), cells and numbers ([`Dialect`]), names and units of columns
//! ([`Quantity`]), numbers under names ([`read_series`]), rows of numbers ([`read_grid`]).

mod declared_unit;
mod dialect;
mod encoding;
mod grid;
mod header;
mod heading;
mod series;
mod thousands;

pub use dialect::{Decimal, Dialect, Separator};
pub use encoding::decode;
pub use grid::{Grid, Tables, read_grid};
pub use header::Asked;
pub use heading::Quantity;
pub use series::{Series, SeriesTable, header_line, read_series};

pub(crate) use declared_unit::{DeclaredColumn, DeclaredUnit};
pub(crate) use dialect::uncommented;
pub(crate) use grid::names_above;
pub(crate) use header::{Columns, Header, MINUS, header_cells};
pub(crate) use heading::{folded, folded_name};

/// The reason why a table cannot be read: the line (from 1) where it has one, and a sentence with a way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", line.map_or_else(String::new, |line| format!("line {line}: ")))]
pub struct TextError {
    /// Line, from 1.
    pub line: Option<usize>,
    /// The sentence.
    pub message: String,
}

impl TextError {
    /// An error about the file as a whole.
    pub fn whole(message: impl Into<String>) -> TextError {
        TextError { line: None, message: message.into() }
    }

    /// An error in a line, from 1.
    pub fn new(line: usize, message: impl Into<String>) -> TextError {
        TextError { line: Some(line), message: message.into() }
    }
}

/// The beginning of a long word.
pub(crate) fn shortened(word: &str) -> String {
    const SHOWN_CHARACTERS: usize = 40;
    let start: String = word.chars().take(SHOWN_CHARACTERS).collect();
    if start.len() < word.len() { format!("{start}…") } else { start }
}

#[cfg(test)]
mod tests;
