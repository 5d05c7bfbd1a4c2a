//! Columns beside those of heights, by their names: means of rows, places, marks of what was measured.

use super::measured::{ReadError, Request};
use crate::text::{Grid, TextError, folded, header_cells, shortened, uncommented};

/// Fewest columns of alike names among which another one is none of heights.
const LEAST_ALIKE: usize = 4;
/// Most columns of other names beside these.
const MOST_OTHERS: usize = 3;
/// Names of a column that holds 1 where a point was measured.
const VALID: [&str; 6] = ["valid", "is valid", "validity", "valid point", "gultig", "valide"];
/// Names of one that holds 1 where none was.
const INVALID: [&str; 6] = ["invalid", "masked", "is masked", "missing", "is missing", "ungultig"];

/// The cells of the line above the rows, and its number; `None` where they are not as many as the columns.
fn title(grid: &Grid<'_>) -> Option<(usize, Vec<String>)> {
    let &(line, text) = grid.before.iter().rev().find(|(_, text)| !text.is_empty())?;
    let cells = header_cells(&grid.dialect, uncommented(text), Some(grid.columns));
    (cells.len() == grid.columns).then_some((line, cells))
}

/// The name of a column without its number.
fn stem(name: &str) -> String {
    folded(name).chars().filter(|c| !c.is_ascii_digit() && !" .,-+_".contains(*c)).collect()
}

/// Columns of a map whose names are not like those of all others: `Mean` behind `C1` to `C512`.
#[derive(Debug, Default)]
pub(super) struct Others {
    /// Line of the names.
    line: usize,
    /// Number of columns under them.
    count: usize,
    /// Those of other names, with their place.
    names: Vec<(usize, String)>,
}

impl Others {
    /// Finds those of a table of rows.
    pub fn new(grid: &Grid<'_>) -> Others {
        let is_full = |names: &[String]| names.iter().skip(1).all(|name| !name.trim().is_empty());
        let Some((line, names)) = title(grid).filter(|(_, names)| is_full(names)) else {
            return Others::default();
        };
        let stems: Vec<String> = names.iter().map(|name| stem(name)).collect();
        let alike = |stem: &String| stems.iter().filter(|other| *other == stem).count();
        let most = stems.iter().max_by_key(|stem| alike(stem)).map_or(0, alike);
        let count = stems.len() - most;
        let is_map = most >= LEAST_ALIKE && (1..=MOST_OTHERS).contains(&count) && count < most;
        let others = || {
            let named = names.iter().zip(&stems).enumerate();
            named.filter(|(_, (name, stem))| alike(stem) < most && !name.trim().is_empty())
        };
        if !is_map {
            return Others::default();
        }
        let others = others().map(|(k, (name, _))| (k, name.clone())).collect();
        Others { line, count: names.len(), names: others }
    }

    /// Refuses such columns among `columns` of heights that are left; a first one less was taken as places.
    ///
    /// # Errors
    /// Their names.
    pub fn refuse(&self, columns: usize, request: &Request<'_>) -> Result<(), ReadError> {
        let taken = self.count.saturating_sub(columns);
        let left: Vec<String> = self
            .names
            .iter()
            .filter(|(k, _)| *k >= taken)
            .map(|(_, name)| format!("\"{}\"", shortened(name)))
            .collect();
        if left.is_empty() || request.override_file {
            return Ok(());
        }
        let problem = format!(
            "names {} beside columns of heights: delete what holds no heights, or set override = true if all of them are heights",
            left.join(", ")
        );
        Err(TextError::new(self.line, problem).into())
    }
}

/// Makes the points missing that a column like `Valid` says were not measured; `picks` are the columns of x,
/// y and z. Gives how many.
pub(super) fn take_invalid(grid: &mut Grid<'_>, picks: [usize; 3]) -> Option<String> {
    let (_, names) = title(grid)?;
    let is_mark = |name: &str| VALID.contains(&name) || INVALID.contains(&name);
    let column = (0..names.len()).find(|k| !picks.contains(k) && is_mark(&folded(&names[*k])))?;
    let mark = f64::from(u8::from(INVALID.contains(&folded(&names[column]).as_str())));
    let is_flag = |row: &[f64]| [0.0, 1.0].contains(&row[column]);
    let columns = grid.columns;
    if !grid.values.chunks_exact(columns).all(is_flag) {
        return None;
    }
    let rows = grid.values.chunks_exact_mut(columns).filter(|row| row[column] == mark);
    let count = rows.map(|row| row[picks[2]] = f64::NAN).count();
    let name = shortened(&names[column]);
    (count > 0).then(|| format!("{count} points are missing, as the column \"{name}\" says"))
}
