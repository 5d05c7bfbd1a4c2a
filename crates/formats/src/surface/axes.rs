//! Places and numbers of rows and columns beside a table of heights.

use super::even::{Step, slope};
use super::measured::ReadError;
use crate::dimension::Dimension;
use crate::text::{Grid, TextError, folded_name, header_cells, uncommented};

/// Rows from which even numbers beside others that are not are places, whatever stands in the corner.
const ROWS_OF_PLACES: usize = 8;
/// Rows from which they are places where the corner or the words above say so.
const ROWS_BELOW_A_CORNER: usize = 3;
/// The same where a unit of length stands in the corner.
const ROWS_BELOW_A_UNIT: usize = 2;
/// Largest distance of heights on a plane from their line, as a share of their step, rounded to whole
/// numbers.
const SCATTER_OF_HEIGHTS: f64 = 1.0;
/// Largest difference of slope of neighbouring lines on such a plane.
const SAME_SLOPE: f64 = 0.3;

/// Places and units that stood beside the heights.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Axes {
    /// Step along x and y where it was given.
    pub steps: [Option<Step>; 2],
    /// Metres per unit of the places, where the corner names it.
    pub lateral_unit: Option<f64>,
    /// Metres per unit of the heights, where the corner names it.
    pub height_unit: Option<f64>,
    /// The finding, in words.
    pub said: String,
    /// The reason why the steps are not certain.
    pub doubt: Option<String>,
}

impl Axes {
    /// Lengths of both steps, in the unit of the places.
    pub fn lengths(&self) -> Option<[f64; 2]> {
        Some([self.steps[0]?.length, self.steps[1]?.length])
    }
}

/// A row of places among the words above the heights.
struct Above {
    step: Step,
    start: f64,
    corner: String,
    line: usize,
}

/// Removes a first row and a first column that are places along x and y, or numbers of rows and columns.
///
/// # Errors
/// Places of which the first or the others do not fit, which may as well be heights.
pub(super) fn take(grid: &mut Grid<'_>) -> Result<Option<Axes>, ReadError> {
    let (columns, rows) = (grid.columns, grid.rows());
    if columns < 3 || rows < 2 {
        return Ok(None);
    }
    let column = |k: usize| grid.values.iter().skip(k).step_by(columns).copied().collect::<Vec<f64>>();
    let first = column(0);
    if let Some(above) = row_above(grid)
        && let Some(down) = Step::new(&first)
        && rows.min(columns - 1) >= above.least()
    {
        let mut axes = Axes { said: said([true; 2]), ..Axes::default() };
        axes.take_corner(&above.corner, above.line);
        axes.take_steps([Some((above.step, above.start)), Some((down, first[0]))]);
        remove(grid, [false, true]);
        return Ok(Some(axes));
    }
    let second = column(1);
    let (top, below) = (&grid.values[..columns], &grid.values[columns..2 * columns]);
    let corner_is_empty = grid.values[0].is_nan();
    let least = if corner_is_empty { ROWS_BELOW_A_CORNER } else { ROWS_OF_PLACES };
    let down = places(&first[1..], &second[1..], least);
    let across = places(&top[1..], &below[1..], least);
    let (is_down, is_across) = match (down, across) {
        (None, None) => return Ok(None),
        (Some(_), Some(_)) => (true, true),
        // one side alone goes through the corner, and takes many to be sure
        (Some(_), None) => (places(&first, &second, ROWS_OF_PLACES).is_some(), false),
        (None, Some(_)) => (false, places(top, below, ROWS_OF_PLACES).is_some()),
    };
    if !is_down && !is_across {
        let many = down.map_or(top.len(), |_| first.len()) > ROWS_OF_PLACES;
        return if many { Err(doubt(grid, down.is_some())) } else { Ok(None) };
    }
    let mut axes = Axes { said: said([is_across, is_down]), ..Axes::default() };
    let both = is_down && is_across;
    let start = |line: &[f64]| line[usize::from(both)];
    axes.take_steps([
        across.filter(|_| is_across).map(|step| (step, start(top))),
        down.filter(|_| is_down).map(|step| (step, start(&first))),
    ]);
    remove(grid, [is_across, is_down]);
    Ok(Some(axes))
}

impl Axes {
    /// Steps of places; mere numbers of rows and columns say nothing.
    fn take_steps(&mut self, found: [Option<(Step, f64)>; 2]) {
        let is_number = |(step, start): (Step, f64)| step.length == 1.0 && (start == 0.0 || start == 1.0);
        if found.iter().flatten().all(|found| is_number(*found)) && self.lateral_unit.is_none() {
            self.said.push_str(", which count from 0 or 1");
        } else {
            self.steps = found.map(|found| found.map(|(step, _)| step));
            let error = self.error();
            if error > 0.0 {
                self.said.push_str(&format!(", rounded so that steps are known to {:.1} %", 100.0 * error));
            }
        }
    }

    /// Share of the steps that the rounding of the places leaves open.
    pub fn error(&self) -> f64 {
        self.steps.iter().flatten().map(|step| step.error).fold(0.0, f64::max)
    }

    /// The unit in a corner like `y\x (um)` or `Height [um]`.
    fn take_corner(&mut self, corner: &str, line: usize) {
        if Dimension::Length.scale(corner.trim()).is_some() {
            self.doubt = Some(format!(
                "line {line}: \"{corner}\" may be the unit of the places or of the heights: no size was taken from them"
            ));
            return;
        }
        let (name, unit) = folded_name(corner);
        let Some(unit) = unit.and_then(|unit| Dimension::Length.scale(&unit)) else { return };
        let words: Vec<&str> = name.split([' ', '\\', '|']).collect();
        if words.iter().any(|word| ["x", "y"].contains(word)) {
            self.lateral_unit = Some(unit);
        } else {
            self.height_unit = Some(unit);
        }
    }
}

fn said([across, down]: [bool; 2]) -> String {
    let what = match (across, down) {
        (true, true) => "the first row and column are",
        (true, false) => "the first row is",
        _ => "the first column is",
    };
    format!("{what} taken as places along the map, not as heights")
}

impl Above {
    /// Rows and columns from which it is no list of a few numbers behind a name.
    fn least(&self) -> usize {
        let unit = folded_name(&self.corner).1.and_then(|unit| Dimension::Length.scale(&unit));
        unit.map_or(ROWS_BELOW_A_CORNER, |_| ROWS_BELOW_A_UNIT)
    }
}

/// The row of places that stands with a word in its corner, and so among the words above the numbers.
fn row_above(grid: &Grid<'_>) -> Option<Above> {
    let &(line, text) = grid.before.iter().rev().find(|(_, line)| !line.is_empty())?;
    let text = uncommented(text);
    let cells = header_cells(&grid.dialect, text, Some(grid.columns));
    let corner = cells.first().filter(|_| cells.len() == grid.columns)?;
    if grid.dialect.number(corner).is_some_and(|v| !v.is_nan()) {
        return None;
    }
    let places: Option<Vec<f64>> = cells[1..].iter().map(|cell| grid.dialect.number(cell)).collect();
    let places = places?;
    Some(Above { step: Step::new(&places)?, start: *places.first()?, corner: corner.clone(), line })
}

/// The step of numbers that are places: even, and beside heights that are not. A plane without noise is
/// even in all of its rows and columns.
fn places(line: &[f64], beside: &[f64], least: usize) -> Option<Step> {
    let step = Step::new(line).filter(|_| line.len() >= least)?;
    let is_near = |other: f64| (other.abs() / step.length - 1.0).abs() < SAME_SLOPE;
    let is_plane = slope(beside, super::even::SCATTER).is_some()
        || slope(beside, SCATTER_OF_HEIGHTS).is_some_and(is_near);
    let is_told = beside.iter().filter(|z| z.is_finite()).count() > 2;
    (least < ROWS_OF_PLACES || !(is_told && is_plane)).then_some(step)
}

fn doubt(grid: &Grid<'_>, down: bool) -> ReadError {
    let (line, other) = if down { ("column", "row") } else { ("row", "column") };
    let problem = format!(
        "the first {line} rises evenly like places, but the first {other} does not, and neither does their corner fit: \
         remove the {line} if it holds places, or begin it with a place"
    );
    TextError::new(grid.lines[0], problem).into()
}

fn remove(grid: &mut Grid<'_>, [row, column]: [bool; 2]) {
    let (skip, from) = (usize::from(row), usize::from(column));
    let rows = grid.values.chunks_exact(grid.columns).skip(skip);
    grid.values = rows.flat_map(|row| row[from..].to_vec()).collect();
    grid.columns -= from;
}
