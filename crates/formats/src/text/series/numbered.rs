//! Tests that columns number: those of a specimen, of its indents, of a run.

use super::table::Series;
use std::collections::HashMap;

/// Between the numbers of a test in several columns, until all rows are there.
const BETWEEN: &str = "\u{1f}";

/// Readings of a test below which a number beside that of a specimen counts something else.
const FEWEST_READINGS: usize = 6;

/// Steps of the readings before it within which a row with a note is the next of them.
const STEPS_TO_THE_NEXT: f64 = 2.0;

/// True of a row that goes on where `rows` end, by the largest of their last steps; also where these are too
/// few to tell.
pub(super) fn is_next<const N: usize>(rows: &[[f64; N]], next: &[f64; N]) -> bool {
    let last = &rows[rows.len().saturating_sub(4)..];
    let [.., end] = last else { return true };
    let is_near = |k: usize| {
        let steps = last.windows(2).map(|two| (two[1][k] - two[0][k]).abs());
        (next[k] - end[k]).abs() <= STEPS_TO_THE_NEXT * steps.fold(0.0, f64::max)
    };
    last.len() < 3 || (0..N).all(is_near)
}

/// The label of a row by the cells that number its test; `None` where there are none.
pub(super) fn label_of<'c>(cells: impl Iterator<Item = &'c str>) -> Option<String> {
    let cells: Vec<&str> = cells.collect();
    (!cells.is_empty()).then(|| cells.join(BETWEEN))
}

/// Labels tests by the columns that tell them apart: one that counts rows holds another number in nearly
/// each, and tells nothing.
pub(super) fn one_label<const N: usize>(tests: &mut Vec<Series<N>>) {
    let mut rows: Vec<(usize, usize, [f64; N])> = Vec::new();
    for (test, series) in tests.iter().enumerate() {
        rows.extend(series.lines.iter().zip(&series.rows).map(|(line, row)| (*line, test, *row)));
    }
    rows.sort_by_key(|(line, ..)| *line);
    let numbers: Vec<Vec<&str>> = tests.iter().map(|test| test.label.split(BETWEEN).collect()).collect();
    let columns = numbers.iter().map(Vec::len).max().unwrap_or(0);
    // beside another column the parts of a test must be long enough to be tests
    let least = if columns > 1 { FEWEST_READINGS } else { 2 };
    let counts_rows = |column: &usize| {
        let number = |test: usize| numbers[test].get(*column);
        let is_change =
            |two: &&[(usize, usize, [f64; N])]| two[0].0 != two[1].0 && number(two[0].1) != number(two[1].1);
        tests.len() > 2 && least * rows.windows(2).filter(is_change).count() > rows.len()
    };
    let telling: Vec<usize> = (0..columns).filter(|column| !counts_rows(column)).collect();
    let label = |test: usize| {
        let told: Vec<&str> = telling.iter().filter_map(|c| numbers[test].get(*c).copied()).collect();
        if told.is_empty() { "1".to_string() } else { told.join(" ") }
    };
    if telling.len() == columns {
        let labels: Vec<String> = (0..tests.len()).map(label).collect();
        tests.iter_mut().zip(labels).for_each(|(test, label)| test.label = label);
        return;
    }
    let (mut places, mut told): (HashMap<String, usize>, Vec<Series<N>>) = (HashMap::new(), Vec::new());
    for (line, test, row) in &rows {
        let place = *places.entry(label(*test)).or_insert_with_key(|label| {
            told.push(Series { label: label.clone(), rows: Vec::new(), lines: Vec::new() });
            told.len() - 1
        });
        told[place].rows.push(*row);
        told[place].lines.push(*line);
    }
    *tests = told;
}
