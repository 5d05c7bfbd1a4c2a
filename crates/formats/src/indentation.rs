//! Curves of depth and force, as indentation and testing instruments write them.

use crate::cantilever;
use crate::dimension::Dimension;
use crate::text::{Asked, Decimal, MINUS, Quantity, Series, SeriesTable, TextError, read_series};
use std::mem::take;

/// Depth and force, m and N, as they were read, one after the other in time.
pub type Readings = Vec<[f64; 2]>;

/// The depth of a curve.
pub const DEPTH: Quantity = Quantity {
    name: "depth",
    dimension: Dimension::Length,
    called: &[
        "depth",
        "displacement",
        "indentation depth",
        "penetration depth",
        "penetration",
        "indentation",
        "travel",
        "disp",
        "h",
        "pd",
        "extension",
        "crosshead",
        "lvdt",
        "wegaufnehmer",
        "extensometer",
        "extensometre",
        "net displacement",
        "stroke",
        "compression",
        "eindringtiefe",
        "tiefe",
        "weg",
        "standardweg",
        "traversenweg",
        "hub",
        "verschiebung",
        "enfoncement",
        "profondeur",
        "deplacement",
        "course",
        "profondita",
        "spostamento",
        "corsa",
        "profundidad",
        "desplazamiento",
        "penetracion",
        "carrera",
        "profundidade",
        "deslocamento",
        "深さ",
        "押込み深さ",
        "押し込み深さ",
        "変位",
        "ストローク",
        "位移",
        "深度",
        "压入深度",
        "压痕深度",
        "변위",
        "깊이",
        "глубина",
        "глубина внедрения",
        "перемещение",
        "głębokość",
        "przemieszczenie",
        "diepte",
        "indringdiepte",
        "verplaatsing",
        "djup",
        "intryckningsdjup",
        "forskjutning",
        "hloubka",
    ],
    example: "depth_um",
};

/// The force of a curve.
pub const FORCE: Quantity = Quantity {
    name: "force",
    dimension: Dimension::Force,
    called: &[
        "force",
        "load",
        "p",
        "f",
        "fn",
        "fz",
        "normal force",
        "kraft",
        "prufkraft",
        "pruefkraft",
        "normalkraft",
        "standardkraft",
        "last",
        "charge",
        "force normale",
        "effort",
        "forza",
        "carico",
        "fuerza",
        "carga",
        "forca",
        "荷重",
        "試験力",
        "载荷",
        "力",
        "하중",
        "нагрузка",
        "сила",
        "усилие",
        "siła",
        "obciążenie",
        "kracht",
        "belasting",
        "sila",
        "zatiženi",
    ],
    example: "force_mN",
};

/// The largest negative force over the largest positive one from which compression is counted negative: an
/// attraction of the tip is not so much larger than the load.
const NEGATIVE_SHARE: f64 = 5.0;

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
        refuse_disorder(test)?;
        refuse_lone(test, table.scales)?;
        refuse_negative(test, &table.names, turned)?;
        refuse_reverse(test)?;
        refuse_baseline(test)?;
    }
    Ok(table)
}

/// Distance in depth and in force, as a share of the largest ones, up to which a part goes on where the one
/// before it ends.
const DISTANCE_OF_PARTS: f64 = 0.05;
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

/// Parts tests that stand below each other with nothing between them: the tool is at the surface at once.
fn part_tests(table: &mut SeriesTable<2>) {
    let [test] = &mut table.series[..] else { return };
    let starts = starts_of_tests(&test.rows);
    if starts.is_empty() {
        return;
    }
    let lines: Vec<String> = starts.iter().map(|&row| test.lines[row].to_string()).collect();
    let mut parts: Vec<Series<2>> = Vec::with_capacity(starts.len() + 1);
    for &start in starts.iter().rev() {
        let (rows, lines) = (test.rows.split_off(start), test.lines.split_off(start));
        parts.push(Series { label: String::new(), rows, lines });
    }
    parts.push(Series { label: String::new(), rows: take(&mut test.rows), lines: take(&mut test.lines) });
    parts.reverse();
    for (number, part) in parts.iter_mut().enumerate() {
        part.label = (number + 1).to_string();
    }
    table.understood += &format!(
        "; {} tests below each other: the depth begins again at line{} {}",
        parts.len(),
        if lines.len() > 1 { "s" } else { "" },
        lines.join(", ")
    );
    table.series = parts;
}

/// The rows at which another test begins. Depth and force fall there from one row to the next to those of a
/// start, and go up again by more readings than may stand alone.
fn starts_of_tests(rows: &[[f64; 2]]) -> Vec<usize> {
    let mut steps: Vec<f64> = rows.windows(2).map(|two| (two[1][0] - two[0][0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    let step = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let (mut starts, mut most, mut since) = (Vec::new(), [0.0_f64; 2], 0);
    for (row, two) in rows.windows(2).enumerate().map(|(i, two)| (i + 1, two)) {
        most = [0, 1].map(|k| most[k].max(two[0][k]));
        let [[before, _], [depth, force]] = [two[0], two[1]];
        let is_fall = before >= LEAST_FALL * most[0] && before - depth >= FALL_OVER_STEPS * step;
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
    let is_near = |k: usize| (start[k] - end[k]).abs() <= DISTANCE_OF_PARTS * most(k);
    is_near(0) && is_near(1) && start[0] >= LEAST_DEPTH_OF_A_PART * most(0)
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

/// Fewest readings of a test in which one can be told to stand alone.
const MIN_READINGS: usize = 12;
/// Size over the range of a test from which a way there and back within a few readings is no reading.
const LONE_SIZE: f64 = 0.5;
/// The same where a test begins or ends so: loads that double from reading to reading end far away too.
const LONE_SIZE_AT_AN_END: f64 = 20.0;
/// Most readings of different size that stand alone together.
const MOST_LONE: usize = 3;

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
