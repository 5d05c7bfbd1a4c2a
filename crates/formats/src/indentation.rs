//! Curves of depth and force, as indentation and testing instruments write them.

use crate::cantilever;
use crate::text::{Asked, Decimal, MINUS, Series, SeriesTable, TextError, read_series};
use doubts::{MOST_LONE, refuse_doubtful};
use std::mem::take;

mod doubts;
mod quantities;

pub use quantities::{DEPTH, FORCE};

/// Depth and force, m and N, as they were read, one after the other in time.
pub type Readings = Vec<[f64; 2]>;

/// Reads the tests of `text`; `columns` names those of depth and force where their names are unusual, with a
/// minus before a name whose numbers change sign, and `missing` is a number that stands for no reading.
///
/// # Errors
/// No columns of depth and force, units that are missing or unknown, cells that are no numbers, compression
/// counted negative.
pub fn read(
    text: &str,
    columns: [Option<&str>; 2],
    missing: Option<f64>,
) -> Result<SeriesTable<2>, TextError> {
    read_as(text, columns, missing, None)
}

/// [`read`] where the file does not tell what stands before decimals: `decimal` does.
///
/// # Errors
/// Those of [`read`].
pub fn read_as(
    text: &str,
    columns: [Option<&str>; 2],
    missing: Option<f64>,
    decimal: Option<Decimal>,
) -> Result<SeriesTable<2>, TextError> {
    let turned = columns.map(|name| name.is_some_and(|name| name.starts_with(MINUS)));
    let bare = columns.map(|name| name.map(|name| name.trim_start_matches(MINUS)));
    let named = Asked { columns: bare, missing, decimal, key: Some("columns"), ..Asked::default() };
    let mut table = read_series(text, &[DEPTH, FORCE], &named).map_err(|error| {
        let of_cantilever = cantilever::refusal(text).filter(|_| columns == [None; 2]);
        of_cantilever.unwrap_or(error)
    })?;
    for (k, quantity) in [DEPTH, FORCE].iter().enumerate().filter(|(k, _)| turned[*k]) {
        table.series.iter_mut().flat_map(|test| &mut test.rows).for_each(|row| row[k] = -row[k]);
        table.understood += &format!("; the sign of the {} turned", quantity.name);
    }
    join_parts(&mut table);
    part_tests(&mut table);
    for test in &table.series {
        refuse_doubtful(test, &table, turned)?;
    }
    Ok(table)
}

/// Distance in depth and in force up to which a part goes on where the one before it ends: as a share of the
/// largest ones, and over the steps of the readings beside, behind so many of them.
const DISTANCE_OF_PARTS: f64 = 0.05;
const STEPS_BETWEEN_PARTS: f64 = 1.5;
const MOST_DISTANCE_OF_PARTS: f64 = 0.5;
const MIN_READINGS_OF_A_PART: usize = 4;
/// Depth over the largest one from which a part begins within a test: others begin at the surface.
const LEAST_DEPTH_OF_A_PART: f64 = 0.2;

/// Joins the parts of a test (loading, hold, unloading) that stand under headers of their own, side by side,
/// or under numbers of segments: each begins where the one before it ends.
fn join_parts(table: &mut SeriesTable<2>) {
    let count = table.series.len();
    let mut tests: Vec<Series<2>> = Vec::with_capacity(count);
    for part in table.series.drain(..) {
        match tests.last_mut() {
            Some(test) if goes_on(&test.rows, &part.rows) => {
                test.rows.extend(part.rows);
                test.lines.extend(part.lines);
            }
            _ => tests.push(part),
        }
    }
    if tests.len() < count {
        let what = if tests.len() == 1 { "one test".into() } else { format!("{} tests", tests.len()) };
        table.understood += &format!("; {count} parts joined to {what}");
    }
    table.series = tests;
}

/// Depth over the largest one before it below which the depth, where it falls at once, begins another test.
const DEPTH_OF_A_START: f64 = 0.1;
/// Depth over the largest one before it from which a fall to such a start is none of an elastic unloading.
const LEAST_FALL: f64 = 0.3;
/// Depth and force over the largest ones before it that the next test reaches at least: it may be lighter.
const LEAST_OF_A_TEST: [f64; 2] = [0.2, 0.03];
/// Such a fall over the median step between readings.
const FALL_OVER_STEPS: f64 = 5.0;

/// Parts tests that stand below each other with nothing between them, or under a number that comes again: the
/// tool is at the surface at once.
fn part_tests(table: &mut SeriesTable<2>) {
    let is_one = table.series.len() == 1;
    let (mut tests, mut lines): (Vec<Series<2>>, Vec<usize>) = (Vec::new(), Vec::new());
    let of_tests: Vec<Vec<usize>> = table.series.iter().map(|test| test.lines.clone()).collect();
    for mut test in take(&mut table.series) {
        // a number that comes again behind those of other tests is that of another specimen
        let comes_again = |row: &usize| {
            let [before, line] = [test.lines[row - 1], test.lines[*row]];
            let is_between =
                |of: &Vec<usize>| of.get(of.partition_point(|l| *l <= before)).is_some_and(|l| *l < line);
            of_tests.iter().any(is_between)
        };
        let starts: Vec<usize> = if is_one {
            starts_of_tests(&test.rows, FALL_OVER_STEPS)
        } else {
            starts_of_tests(&test.rows, 0.0).into_iter().filter(comes_again).collect()
        };
        lines.extend(starts.iter().map(|&row| test.lines[row]));
        let count = starts.len();
        let mut parts: Vec<Series<2>> = Vec::with_capacity(count + 1);
        for (part, &start) in starts.iter().enumerate().rev() {
            let (rows, lines) = (test.rows.split_off(start), test.lines.split_off(start));
            let label =
                if is_one { (part + 2).to_string() } else { format!("{} ({})", test.label, part + 2) };
            parts.push(Series { label, rows, lines });
        }
        if is_one && count > 0 {
            test.label = "1".into();
        }
        parts.push(test);
        tests.extend(parts.into_iter().rev());
    }
    if !lines.is_empty() {
        lines.sort_unstable();
        let at: Vec<String> = lines.iter().map(usize::to_string).collect();
        let begins = if lines.len() > 1 { "begins again at lines" } else { "begins again at line" };
        table.understood +=
            &format!("; {} tests below each other: the depth {begins} {}", tests.len(), at.join(", "));
    }
    tests.sort_by_key(|test| test.lines.first().copied());
    table.series = tests;
}

/// The rows at which another test begins. Depth and force fall there from one row to the next to those of a
/// start, by more than `steps` median steps, and go up again by more readings than may stand alone.
fn starts_of_tests(rows: &[[f64; 2]], steps: f64) -> Vec<usize> {
    let mut sizes: Vec<f64> = rows.windows(2).map(|two| (two[1][0] - two[0][0]).abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let step = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let (mut starts, mut most, mut since) = (Vec::new(), [0.0_f64; 2], 0);
    for (row, two) in rows.windows(2).enumerate().map(|(i, two)| (i + 1, two)) {
        most = [0, 1].map(|k| most[k].max(two[0][k]));
        let [[before, _], [depth, force]] = [two[0], two[1]];
        let is_fall = before >= LEAST_FALL * most[0] && before - depth >= steps * step;
        let is_start = depth <= DEPTH_OF_A_START * most[0] && force <= DEPTH_OF_A_START * most[1];
        let goes_up = || {
            // readings of nothing end at once
            let goes_on = |two: &[[f64; 2]]| two[1][0] - two[0][0] < LEAST_FALL * most[0];
            let reaches = |k: usize| rows[row..].iter().any(|next| next[k] >= LEAST_OF_A_TEST[k] * most[k]);
            let next = rows.get(row..=row + MOST_LONE).unwrap_or_default();
            !next.is_empty() && next.windows(2).all(goes_on) && reaches(0) && reaches(1)
        };
        if is_fall && is_start && most[0] > 0.0 && row - since > MOST_LONE && goes_up() {
            starts.push(row);
            (most, since) = ([0.0; 2], row);
        }
    }
    starts
}

/// True where `next` begins where `test` ends.
fn goes_on(test: &[[f64; 2]], next: &[[f64; 2]]) -> bool {
    let (Some(end), Some(start)) = (test.last(), next.first()) else { return false };
    let most = |k: usize| test.iter().map(|row| row[k].abs()).fold(0.0, f64::max);
    let step = |two: Option<&[[f64; 2]]>, k: usize| two.map_or(0.0, |two| (two[1][k] - two[0][k]).abs());
    let steps = |k: usize| step(test.windows(2).next_back(), k).max(step(next.windows(2).next(), k));
    // a metal takes more force where the tool goes deeper
    let is_a_way = (start[0] - end[0]) * (start[1] - end[1]) > 0.0;
    let has_steps = is_a_way && test.len() >= MIN_READINGS_OF_A_PART;
    let is_near = |k: usize| {
        let near = if has_steps { STEPS_BETWEEN_PARTS * steps(k) } else { 0.0 };
        let near = near.min(MOST_DISTANCE_OF_PARTS * most(k)).max(DISTANCE_OF_PARTS * most(k));
        (start[k] - end[k]).abs() <= near
    };
    is_near(0) && is_near(1) && start[0] >= LEAST_DEPTH_OF_A_PART * most(0)
}
