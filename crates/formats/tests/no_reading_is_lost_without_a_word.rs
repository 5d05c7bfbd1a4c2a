//! Claims about readings that were lost or changed without a word: rows written otherwise than the rest,
//! units below names that have others, factors behind units, columns that are corrected.

// a test fails by panicking
#![allow(clippy::unwrap_used)]

mod common;

use asperity_formats::indentation;
use common::is_the_curve;

const COLUMNS: [Option<&str>; 2] = [None; 2];

#[track_caller]
fn is_refused(text: &str, line: usize, words: &[&str]) {
    let fault = indentation::read(text, COLUMNS, None).map(|table| table.understood).unwrap_err();
    assert_eq!(fault.line, Some(line), "{text}: {fault}");
    for word in words {
        assert!(fault.message.contains(word), "{text}: {fault}");
    }
}

/// The minority took the table over: 14 rows of 104 with commas were the curve.
#[test]
fn rows_with_another_mark_before_decimals_are_refused() {
    is_refused("Depth (um)\tLoad (mN)\n0.1\t2.0\n0,2\t8,0\n0.3\t18.0\n", 2, &["\"0.1\"", "comma"]);
    is_refused("Depth (um)\tLoad (mN)\n0.125\t2.5\n0,250\t8\n0.3\t18.5\n", 2, &["\"0.125\"", "comma"]);
}

/// A format of fixed width writes 1215.19103368.05 when numbers touch.
#[test]
fn rows_with_fewer_numbers_than_columns_are_refused() {
    for row in ["200.1938000.05", "200"] {
        let rows = format!("100 2000\n{row}\n300 18000\n");
        is_refused(&format!("Depth (nm)   Load (uN)\n{rows}"), 3, &[]);
        is_refused(&format!("Depth (nm),Load (uN)\n{}", rows.replace(' ', ",")), 3, &[]);
    }
    // a test that ends before the one beside it, and a reading that was not taken
    let beside = "Depth (um),Load (mN),Depth (um),Load (mN)\n0.1,2,0.1,2\n0.2,8\n";
    let table = indentation::read(beside, COLUMNS, None).unwrap();
    assert_eq!(table.series.iter().map(|s| s.rows.len()).collect::<Vec<_>>(), [2, 1]);
    is_the_curve("Depth (um),Load (mN)\n0.1,2\n0.15,\n0.2,8\n");
}

#[test]
fn a_unit_below_a_name_that_has_another_is_refused() {
    for (names, units) in [
        ("Depth (um),Load (mN)", "nm,mN"),
        ("Depth (um),Load (mN)", "[nm],[mN]"),
        ("Depth (um),Load (N)", "um,mN"),
        ("Time (s),Depth (um),Load (mN)", "s,nm,mN"),
    ] {
        let rows = if names.starts_with("Time") { "0,0.1,2\n1,0.2,8\n" } else { "0.1,2\n0.2,8\n" };
        is_refused(&format!("{names}\n{units}\n{rows}"), 1, &["but the unit below it is"]);
    }
    is_the_curve("Depth (um),Load (mN)\num,mN\n0.1,2\n0.2,8\n");
    is_the_curve("Depth,Load\n(um),(mN)\n0.1,2\n0.2,8\n");
    is_refused("Depth,Load\num,mN\nnm,mN\n0.1,2\n0.2,8\n", 3, &["second line of units"]);
}

#[test]
fn a_factor_behind_the_unit_and_a_share_are_refused() {
    for load in ["Load (mN) x10", "Load (mN) /10", "Load (mN) * 1000", "Load (mN) 10^1", "Load (mN)^0.5"] {
        is_refused(&format!("Depth (um),{load}\n0.1,2\n0.2,8\n"), 1, &["factor"]);
    }
    for head in ["Depth (um),Normalized load (mN)", "Depth/hmax (um),Load (mN)"] {
        is_refused(&format!("{head}\n0.1,2\n0.2,8\n"), 1, &["function"]);
    }
    is_the_curve("Depth (um),Load increment (mN),Load (mN)\n0.1,1,2\n0.2,6,8\n");
}

#[test]
fn a_corrected_column_beside_a_bare_one_is_asked_about() {
    for other in
        ["Corrected depth", "Drift corrected depth", "Net depth", "True depth", "Depth above surface"]
    {
        is_refused(&format!("Depth (um),{other} (um),Load (mN)\n0.11,0.1,2\n0.22,0.2,8\n"), 1, &[other]);
        is_the_curve(&format!("{other} (um),Load (mN)\n0.1,2\n0.2,8\n"));
    }
    is_refused("Depth (um),Load (mN),Corrected load (mN)\n0.1,3,2\n0.2,9,8\n", 1, &["Corrected load"]);
    is_the_curve("Uncorrected depth (um),Depth (um),Load (mN)\n0.11,0.1,2\n0.22,0.2,8\n");
}

/// Results above the test opened one of a single reading.
#[test]
fn largest_readings_are_no_curve() {
    let summary = "Sample,Max depth (um),Max load (mN),H (GPa)\n1,2.0,280,5.1\n";
    is_the_curve(&format!("{summary}Depth (um),Load (mN)\n0.1,2\n0.2,8\n"));
}

/// Shimadzu's titles of two specimens were taken for numbers, so that blanks parted the columns.
#[test]
fn titles_of_numbers_and_an_underscore_are_titles() {
    let head = "1 _ 1,,,1 _ 2,,\nTime,Force,Stroke,Time,Force,Stroke\nsec,N,mm,sec,N,mm\n";
    let rows = "0,0.002,0.0001,0,0.002,0.0001\n1,0.008,0.0002,1,0.008,0.0002\n";
    let table = indentation::read(&format!("{head}{rows}"), COLUMNS, None).unwrap();
    assert_eq!(table.series.iter().map(|s| s.rows.len()).collect::<Vec<_>>(), [2, 2]);
}

/// An exporter in capitals alone: a force of 280 MN.
#[test]
fn beside_micrometres_in_capitals_mn_is_a_millinewton() {
    is_the_curve("Depth [UM]\tLoad [MN]\n0.1\t2\n0.2\t8\n");
}

/// Notes of an operator, times of a day and places in a grid made all decimals commas.
#[test]
fn a_comma_in_a_note_says_nothing_of_decimals() {
    for note in ["rate 0,5 mN/s", "points 12,13", "(1,2)", "14:02:01,001"] {
        is_the_curve(&format!("Depth (um)\tLoad (mN)\tNote\n0.1\t2.0\t\n0.2\t8.0\t{note}\n"));
        is_the_curve(&format!("Depth (um)\tLoad (mN)\tNote\n0,1\t2,0\t\n0,2\t8,0\t{note}\n"));
    }
}

/// KLA writes the name of a segment before its first reading alone, and a sign of numbers above row numbers.
#[test]
fn a_segment_is_named_in_the_row_of_its_first_reading() {
    let rows = "Load,0.1,2\nHold,0.2,8\n";
    is_the_curve(&format!("Segment,Depth (um),Load (mN)\n{rows}"));
    let table = indentation::read(
        "Segment,Depth (um),Load (mN)\nLoad,0.05,0.5\n,0.1,2\nHold,0.2,8\n,0.2,8\nUnload,0.1,1\n,0.05,0\n",
        COLUMNS,
        None,
    );
    assert_eq!(table.unwrap().series[0].rows.len(), 6);
    is_the_curve("Segment\tDepth\tLoad\n#\tum\tmN\n1\t0.1\t2\n1\t0.2\t8\n");
}

/// F = h² up to 1 and F = (5 h - 4)² from there back to 0.8, in the order of time.
fn loop_of_a_cone() -> Vec<[f64; 2]> {
    let up = (0..=40).map(|i| f64::from(i) / 40.0).map(|h| [h, h * h]);
    let down = (1..=40).map(|i| 1.0 - f64::from(i) / 200.0).map(|h| [h, (5.0 * h - 4.0).powi(2)]);
    up.chain(down).collect()
}

fn written(rows: &[[f64; 2]]) -> String {
    let rows: String = rows.iter().map(|[depth, force]| format!("{depth},{force}\n")).collect();
    format!("Depth (um),Load (mN)\n{rows}")
}

/// A database hands rows out by a value; a logger writes the last one first.
#[test]
fn rows_out_of_the_order_of_time_are_refused() {
    let rows = loop_of_a_cone();
    let read = |rows: &[[f64; 2]]| indentation::read(&written(rows), COLUMNS, None);
    assert_eq!(read(&rows).unwrap().series[0].rows.len(), rows.len());
    let mut backwards = rows.clone();
    backwards.reverse();
    let fault = read(&backwards).unwrap_err().message;
    assert!(fault.contains("turn the order of the rows"), "{fault}");
    for k in [0, 1] {
        let mut sorted = rows.clone();
        sorted.sort_by(|a, b| a[k].total_cmp(&b[k]));
        let fault = read(&sorted).unwrap_err().message;
        assert!(fault.contains("sort them by time"), "{k}: {fault}");
    }
    // an elastic test gives its work back, and a test may go up and down as often as it likes
    let way_in = &rows[..=40];
    let mut elastic = way_in.to_vec();
    elastic.extend(way_in.iter().rev());
    assert!(read(&elastic).is_ok());
    let cycles: Vec<[f64; 2]> = (0..6).flat_map(|_| elastic.iter().step_by(5).copied()).collect();
    assert!(read(&cycles).is_ok());
}
