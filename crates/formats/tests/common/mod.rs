//! Shared by claims about curves.

use asperity_formats::indentation;

/// The curve (0.1 µm, 2 mN), (0.2 µm, 8 mN) and nothing else.
#[track_caller]
pub fn is_the_curve(text: &str) {
    let table = indentation::read(text, [None; 2], None).unwrap_or_else(|e| panic!("{text}: {e}"));
    let rounded = |row: &[f64; 2]| [1e9 * row[0], 1e6 * row[1]].map(f64::round);
    let rows: Vec<[f64; 2]> = table.series.iter().flat_map(|test| test.rows.iter().map(rounded)).collect();
    assert_eq!(rows, [[100.0, 2000.0], [200.0, 8000.0]], "{text}");
}
