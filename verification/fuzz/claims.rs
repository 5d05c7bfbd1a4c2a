//! Claims about readers, whatever bytes they get: a result that the bytes can hold, or an error.

use asperity_formats::surface::{Request, Spacing, read};
use std::path::Path;

/// Deflate packs at most 1032 to 1; an entry of one byte is at most eight bytes of heights.
const LARGEST: usize = 1032 * 8;

/// A surface file is a map of its own size or refused; true where it is a map.
///
/// # Panics
/// The claim does not hold.
pub fn surface_is_answered(file: &Path, content: &[u8]) -> bool {
    std::fs::write(file, content).expect("room for a file");
    // what is free must not decide which files are refused
    let request = Request { memory_limit: Some(1 << 30), ..Request::default() };
    let Ok(map) = read(file, &request) else { return false };
    assert_eq!(map.heights.len(), map.columns * map.rows, "points");
    assert!(map.heights.len() <= LARGEST * content.len().max(8), "more points than the bytes can hold");
    assert!(map.heights.iter().all(|z| !z.is_infinite()), "a height without end");
    let is_length = |length: &f64| length.is_finite() && *length > 0.0;
    if let Spacing::Metres(steps) | Spacing::HeightUnits(steps) | Spacing::Numbers(steps) = map.spacing {
        assert!(steps.iter().all(is_length), "pixels of {steps:?}");
    }
    assert!(map.height_unit.iter().all(is_length), "a height unit of {:?} m", map.height_unit);
    true
}

/// A curve of indentation has finite readings or is refused; true where it has some.
///
/// # Panics
/// The claim does not hold.
pub fn curve_is_answered(content: &[u8]) -> bool {
    let Ok((text, _)) = asperity_formats::text::decode(content) else { return false };
    let Ok(table) = asperity_formats::indentation::read(&text, [None; 2], None) else { return false };
    for test in &table.series {
        assert_eq!(test.rows.len(), test.lines.len(), "lines");
        assert!(test.rows.iter().flatten().all(|number| number.is_finite()), "a reading that is no number");
    }
    true
}
