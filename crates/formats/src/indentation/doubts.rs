//! Doubts about the rows of a test: signs, order, readings that are none.

use super::quantities::{DEPTH, FORCE};
use crate::text::{Series, SeriesTable, TextError};

/// The largest negative force over the largest positive one from which compression is counted negative: an
/// attraction of the tip is not so much larger than the load.
const NEGATIVE_SHARE: f64 = 5.0;

/// Refuses a `test` of `table` whose rows are no readings of one, in the order of time; `turned` tells which
/// signs a key turns.
///
/// # Errors
/// The first doubt, with a way out.
pub(super) fn refuse_doubtful(
    test: &Series<2>,
    table: &SeriesTable<2>,
    turned: [bool; 2],
) -> Result<(), TextError> {
    refuse_disorder(test)?;
    refuse_lone(test, table.scales)?;
    refuse_negative(test, &table.names, turned)?;
    refuse_reverse(test)?;
    refuse_baseline(test)?;
    refuse_last_row(test)
}

/// Refuses a test whose forces, or whose depths at the largest force, are negative.
///
/// # Errors
/// Such a test, with the key that turns the signs.
fn refuse_negative(test: &Series<2>, names: &[String; 2], turned: [bool; 2]) -> Result<(), TextError> {
    let force = |i: &usize| test.rows[*i][1];
    let end = |sign: f64| (0..test.rows.len()).max_by(|a, b| (sign * force(a)).total_cmp(&(sign * force(b))));
    let (Some(lowest), Some(highest)) = (end(-1.0), end(1.0)) else { return Ok(()) };
    let is_turned = -force(&lowest) > NEGATIVE_SHARE * force(&highest).max(0.0);
    let at = if is_turned { lowest } else { highest };
    let [depth, force] = test.rows[at];
    let is_negative = [depth < 0.0 && depth < test.rows[0][0] && force != 0.0, is_turned];
    if is_negative == [false; 2] {
        return Ok(());
    }
    let key = |k: usize| {
        let minus = if is_negative[k] != turned[k] { "-" } else { "" };
        format!("{} = \"{minus}{}\"", [DEPTH, FORCE][k].name, names[k])
    };
    let message = format!(
        "counts compression negative: its largest force is {:.4} mN, at a depth of {:.4} um. Depths and forces are positive into \
         the metal; a minus turns a sign: columns = {{ {}, {} }}",
        1e3 * force,
        1e6 * depth,
        key(0),
        key(1)
    );
    Err(TextError::new(test.lines[at], message))
}

/// Fewest readings that show whether a test stands in the order of time.
const MIN_ORDERED: usize = 30;
/// Size over the range of a test from which a step back and forth is none of noise.
const JUMP_SIZE: f64 = 0.1;
/// Such turns over all readings in rows without an order: cycles of a few readings have fewer.
const TURNS_WITHOUT_ORDER: f64 = 0.3;
/// Such turns in rows sorted by the other quantity: none belongs to a test that goes one way.
const TURNS_OF_SORTED: usize = 3;

/// Refuses a test that jumps back and forth: rows sorted by depth hold readings of both branches in turn.
///
/// # Errors
/// Such a test.
fn refuse_disorder(test: &Series<2>) -> Result<(), TextError> {
    let rows = &test.rows;
    for (k, quantity) in [DEPTH, FORCE].iter().enumerate().filter(|_| rows.len() >= MIN_ORDERED) {
        let values = || rows.iter().map(|row| row[k]);
        let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        let turns = (1..rows.len() - 1).filter(|i| {
            let [before, after] = [rows[*i][k] - rows[i - 1][k], rows[i + 1][k] - rows[*i][k]];
            before * after < 0.0 && before.abs().min(after.abs()) > JUMP_SIZE * range
        });
        let turns: Vec<usize> = turns.collect();
        let is_sorted = rows.is_sorted_by(|a, b| a[1 - k] <= b[1 - k]);
        let is_without_order = turns.len() as f64 > TURNS_WITHOUT_ORDER * rows.len() as f64;
        if is_without_order || is_sorted && turns.len() >= TURNS_OF_SORTED {
            let message = format!(
                "the {} jumps back and forth here and in {} other readings: the rows are not in the order in which they were measured; sort them by time",
                quantity.name,
                turns.len() - 1
            );
            return Err(TextError::new(test.lines[turns[0]], message));
        }
    }
    Ok(())
}

/// Work that a test returns over the work that was put into it from which its rows run backwards.
const MOST_RETURNED: f64 = 1.1;
/// Force over the largest one up to which a test begins and ends without a load.
const UNLOADED_SHARE: f64 = 0.2;

/// Refuses a test that returns more work than was put into it: its last row was measured first.
///
/// # Errors
/// Such a test.
fn refuse_reverse(test: &Series<2>) -> Result<(), TextError> {
    let most = test.rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let is_free = |row: Option<&[f64; 2]>| row.is_some_and(|row| row[1].abs() < UNLOADED_SHARE * most);
    let works = test.rows.windows(2).map(|two| 0.5 * (two[0][1] + two[1][1]) * (two[1][0] - two[0][0]));
    let (put_in, returned) = works.fold((0.0, 0.0), |(put_in, returned), work| {
        if work > 0.0 { (put_in + work, returned) } else { (put_in, returned - work) }
    });
    let is_reverse = test.rows.len() >= MIN_ORDERED && returned > MOST_RETURNED * put_in;
    if !is_reverse || !is_free(test.rows.first()) || !is_free(test.rows.last()) {
        return Ok(());
    }
    let message = format!(
        "the test returns {:.4} uJ and takes {:.4} uJ, as if its last row had been measured first: turn the order of the rows",
        1e6 * returned,
        1e6 * put_in
    );
    Err(TextError::new(test.lines[0], message))
}

/// Share of the range of both from which a depth that falls while the force rises is no reading.
const SHARE_OF_A_CONTRADICTION: f64 = 0.3;

/// Refuses a test whose last row is none of its readings: the largest depth and force once more behind an
/// unloading, or a depth that falls while the force rises, which no metal does.
///
/// # Errors
/// Such a row.
fn refuse_last_row(test: &Series<2>) -> Result<(), TextError> {
    let [before @ .., _, last] = &test.rows[..] else { return Ok(()) };
    let previous = test.rows[before.len()];
    let earlier = &test.rows[..=before.len()];
    let most = |k: usize| earlier.iter().map(|row| row[k]).fold(f64::NEG_INFINITY, f64::max);
    let range = [0, 1].map(|k| most(k) - earlier.iter().map(|row| row[k]).fold(f64::INFINITY, f64::min));
    let step = [0, 1].map(|k| (last[k] - previous[k]) / range[k]);
    let has_most = [0, 1].map(|k| last[k] == most(k));
    // a reload in one step comes from a load, or is none of the first
    let is_free = previous[1] < UNLOADED_SHARE * most(1);
    let rises = |two: &[[f64; 2]]| two[1][1] - two[0][1] > 0.5 * step[1] * range[1];
    let is_first = !earlier.windows(2).any(rises);
    let is_of_maxima = has_most == [true; 2] && is_free && is_first && step[1] > SHARE_OF_A_CONTRADICTION;
    // a tip that snaps off ends without a load
    let has_load = last[1] > SHARE_OF_A_CONTRADICTION * most(1);
    let is_contradiction =
        step[0] < -SHARE_OF_A_CONTRADICTION && step[1] > SHARE_OF_A_CONTRADICTION && has_load;
    if before.len() < MOST_LONE || !is_of_maxima && !is_contradiction {
        return Ok(());
    }
    let what = if is_of_maxima {
        "the last row holds the largest depth and force once more, as a line of maxima does"
    } else {
        "in the last row the depth falls and the force rises, as in no test"
    };
    let message = format!("{what}: delete it, or begin it with # if it is none of the readings");
    Err(TextError::new(test.lines[before.len() + 1], message))
}

/// Fewest readings of a test in which one can be told to stand alone.
const MIN_READINGS: usize = 12;
/// Size over the range of a test from which a way there and back within a few readings is no reading.
const LONE_SIZE: f64 = 0.5;
/// The same where a test begins or ends so: loads that double from reading to reading end far away too.
const LONE_SIZE_AT_AN_END: f64 = 20.0;
/// Most readings of different size that stand alone together.
pub(super) const MOST_LONE: usize = 3;

/// Refuses a test with readings far from those before and after them: glitches, or marks of missing ones.
fn refuse_lone(test: &Series<2>, scales: [f64; 2]) -> Result<(), TextError> {
    for (k, quantity) in [DEPTH, FORCE].iter().enumerate().filter(|_| test.rows.len() >= MIN_READINGS) {
        let values: Vec<f64> = test.rows.iter().map(|row| row[k] / scales[k]).collect();
        let lone = lone(&values, *quantity == FORCE);
        // more of them are a path that the rows do not follow in time
        let Some(&first) = lone.first().filter(|_| 10 * lone.len() <= values.len()) else { continue };
        let around = |i: usize| values.get(i).map_or(String::new(), |value| format!(", {value}"));
        let message = format!(
            "the {} {} stands alone ({}{}{}): delete such lines, or set missing_value = {} if that means that nothing was read",
            quantity.name,
            values[first],
            first
                .checked_sub(1)
                .map_or_else(|| "at the beginning".into(), |i| format!("between {}", values[i])),
            around(first),
            around(first + 1),
            values[first]
        );
        return Err(TextError::new(test.lines[first], message));
    }
    Ok(())
}

/// Places in `values` of those that stand alone; `has_ends` where the first and the last may too.
fn lone(values: &[f64], has_ends: bool) -> Vec<usize> {
    let mut sorted: Vec<f64> = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let share = |part: f64| sorted[(part * (sorted.len() - 1) as f64) as usize];
    let [low, high] = [share(0.05), share(0.95)];
    let range = high - low;
    let mut found = Vec::new();
    for i in 1..values.len() - 1 {
        let (before, sign) = (values[i - 1], (values[i] - values[i - 1]).signum());
        // a way down and back may be an unloading: only one that leaves all others is doubted
        let is_far = sign > 0.0 || values[i] < low - LONE_SIZE * range;
        if !is_far || (values[i] - before).abs() <= LONE_SIZE * range {
            continue;
        }
        let equal = values[i..].iter().take_while(|v| **v == values[i]).count();
        for count in 1..=equal.max(MOST_LONE) {
            let Some(after) = values.get(i + count) else { break };
            let least = values[i..i + count]
                .iter()
                .map(|v| (sign * (v - before)).min(sign * (v - after)))
                .fold(f64::INFINITY, f64::min);
            if least > LONE_SIZE * range && (after - before).abs() < 0.2 * least {
                found.push(i);
                break;
            }
        }
    }
    let ends = [(0, 1), (values.len() - 1, values.len() - 2)];
    let is_off =
        |(end, next): &(usize, usize)| (values[*end] - values[*next]).abs() > LONE_SIZE_AT_AN_END * range;
    found.extend(ends.iter().filter(|end| has_ends && is_off(end)).map(|(end, _)| *end));
    found
}

/// Fewest readings of an approach, and the share of the largest force from which a force that stays over all
/// of them is a baseline: a first touch is found at a smaller one.
const MIN_APPROACH: usize = 5;
const BASELINE_SHARE: f64 = 0.03;
/// Largest change of such a force, over itself.
const BASELINE_CHANGE: f64 = 0.3;

/// Refuses a test whose force is not 0 before the tool touches.
fn refuse_baseline(test: &Series<2>) -> Result<(), TextError> {
    let most = test.rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let approach: Vec<f64> = test.rows.iter().take_while(|row| row[0] < 0.0).map(|row| row[1]).collect();
    let mean = approach.iter().sum::<f64>() / approach.len().max(1) as f64;
    let is_flat = approach.iter().all(|force| (force - mean).abs() < 0.5 * BASELINE_CHANGE * mean.abs());
    if approach.len() < MIN_APPROACH || mean.abs() < BASELINE_SHARE * most || !is_flat {
        return Ok(());
    }
    let message = format!(
        "the force is {:.4} mN at all {} readings before the depth 0, {:.1} % of the largest one: subtract it from all forces if it is \
         there without contact, else leave these readings out",
        1e3 * mean,
        approach.len(),
        100.0 * mean / most
    );
    Err(TextError::new(test.lines[0], message))
}
