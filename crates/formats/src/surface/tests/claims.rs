//! Claims about words before the heights that name sides, units and counts, and about rows at the edges.

use super::*;

/// A map of 4 x 3 heights that are not even along a line.
const MAP: &str = "0.1 0.7 0.2 0.9\n0.5 0.3 0.8 0.4\n0.6 0.2 0.9 0.1\n";
const PIXEL: &str = "Pixel size: 2 um x 1 um\n";

fn found(text: &str) -> Result<Measured, String> {
    let folder = Folder::new();
    read_plain(&folder.file("a.txt", text.as_bytes())).map_err(|e| e.to_string())
}

/// The pixel in um that the words give, or what is said of it.
fn pixel(words: &str) -> Result<[f64; 2], String> {
    let map = found(&format!("{words}{MAP}"))?;
    match map.spacing {
        Spacing::Metres(pixel) => Ok(pixel.map(|side| (side * 1e9).round() / 1e3)),
        _ => Err(map.notes.join("; ")),
    }
}

#[test]
fn sides_are_taken_where_the_words_are_certain() {
    for (words, wanted) in [
        ("Schrittweite x: 2 µm\nSchrittweite y: 1 µm\n", [2.0, 1.0]),
        ("Increment (x): 2 um\nIncrement (y): 1 um\n", [2.0, 1.0]),
        ("Image size: 4 x 3 px, 8 x 3 um\n", [2.0, 1.0]),
        ("Width: 4 px (8 um)\nHeight: 3 px / 3 um\n", [2.0, 1.0]),
        ("Pixel size (um): 2.0 1.0\n", [2.0, 1.0]),
        ("Pixel size: (2.0, 1.0) um\n", [2.0, 1.0]),
        ("Lateral resolution: 0.4 um\nPixel size: 0.2 um\n", [0.2, 0.2]),
        ("Lateral resolution: 0.4 um\nX size: 8 um\nY size: 3 um\n", [2.0, 1.0]),
        ("dx = 2 um\nLine distance = 10 um\n", [2.0, 10.0]),
        ("Sampling interval: 2 um\nProfile spacing: 10 um\n", [2.0, 10.0]),
        ("Width: 8 um\nDepth: 3 um\nHeight: 5 um\n", [2.0, 1.0]),
        ("# a: b\n# c: 8 um\n# d: 6 um\n# e: nm\n", [2.0, 2.0]),
    ] {
        assert_eq!(pixel(words), Ok(wanted), "{words}");
    }
}

#[test]
fn sides_that_are_not_certain_are_asked_for() {
    for (words, said) in [
        // other lengths than sides
        ("Stage X: 12.5 mm\nStage Y: 7.25 mm\nUnit: um\n", "unit of the heights"),
        ("Sa: 0.5 um\nSq: 0.6 um\nUnit: um\n", "unit of the heights"),
        ("# Steel: a\n# Sa: 0.5 um\n# Sq: 0.6 um\n# Unit: um\n", "unit of the heights"),
        ("X range [um]: 10 to 74\nY range [um]: 5 to 29\n", "line 1 \"X range [um]: 10 to 74\""),
        ("X range (um)\t10\t74\n", "several numbers"),
        ("Pitch: 0.08 um\nXY calibration: 2 um\n", "do not agree"),
        ("Pixel size: 2 um\nWidth: 100 um\nHeight: 75 um\n", "do not agree"),
        ("dx: -2 um\ndy: 1 um\n", "one side alone"),
        ("Width: 64 um\n", "one side alone"),
        ("Length: 64 um\nWidth: 24 um\n", "before the width"),
        ("Width: 1,024 um\nHeight: 1,200 um\n", "a thousand or a fraction"),
    ] {
        let notes = pixel(words).unwrap_err();
        assert!(notes.contains(said), "{words}: {notes}");
    }
    // decimal commas make the comma of the header one too
    let comma = format!("Breite: 1,024 µm\nHöhe: 1,200 µm\n{}", MAP.replace('.', ","));
    assert!(
        matches!(found(&comma).unwrap().spacing, Spacing::Metres([x, _]) if (x - 0.256e-6).abs() < 1e-12)
    );
}

#[test]
fn the_unit_of_heights_is_not_that_of_lengths() {
    for (words, wanted) in [
        ("Length unit: mm\nHeight unit: um\n", Some(1e-6)),
        ("Unit of x: mm\nUnit of y: mm\nUnit of z: um\n", Some(1e-6)),
        ("Scan unit: mm\nZ-unit: um\n", Some(1e-6)),
        ("Unit: mm\nZ unit: um\n", Some(1e-6)),
        ("Horizontal unit: mm\nVertical unit: um\n", Some(1e-6)),
        ("Unit ID: M\n", None),
        ("Unità: µm\n", Some(1e-6)),
        ("Height [nm]\n", Some(1e-9)),
        ("Heights in nm\n", Some(1e-9)),
        ("z: um\n", Some(1e-6)),
    ] {
        assert_eq!(found(&format!("{PIXEL}{words}{MAP}")).unwrap().height_unit, wanted, "{words}");
    }
    let both = found(&format!("Height unit: nm\nData unit: um\n{MAP}")).unwrap_err();
    assert!(both.contains("line 2") && both.contains("another unit"), "{both}");
    // units of x and y that differ are no one unit
    let differ = found(&format!("x-unit: mm\ny-unit: um\nz-unit: um\ndx: 0.002\ndy: 1\n{MAP}")).unwrap();
    assert_eq!(differ.spacing, Spacing::Numbers([0.002, 1.0]));
}

#[test]
fn rows_at_the_edges_do_not_vanish() {
    let sides = "Width: 8 um\nHeight: 3 um\nUnit: um\n";
    let map = MAP.replace(' ', ";");
    for (text, word) in [
        (format!("{sides};;;\n{map}"), "empty rows"),
        (format!("{sides}{map};;;\n"), "empty rows"),
        (format!("{sides}{}", map.replace('\n', ";;\n")), "empty columns"),
        (format!("{sides};{}", map.trim_end().replace('\n', "\n;") + "\n"), "empty columns"),
    ] {
        let found = found(&text).unwrap();
        assert_eq!(found.spacing, Spacing::Unknown, "{text}");
        assert!(found.notes.iter().any(|note| note.contains(word)), "{text} {:?}", found.notes);
    }
    let tabs = MAP.replace(' ', "\t");
    let hole = found(&format!("{sides}{}", tabs.replacen('\n', "\n\t\t\t\n", 1))).unwrap();
    assert_eq!((hole.rows, hole.heights[4].is_nan()), (4, true));
    let first = found(&format!("{sides}inf -inf 0.2 0.3\n{MAP}")).unwrap();
    assert_eq!((first.rows, first.heights[0].is_nan()), (4, true));
    let apart = found(&format!("{sides}1'000.5 1'020.5 500 8\n{MAP}")).unwrap();
    assert_eq!((apart.rows, apart.heights[0]), (4, 1000.5));
    let apart = found(&format!("{sides}1 017,81;1 017,82;500,1;0,2\n{}", map.replace('.', ","))).unwrap();
    assert_eq!((apart.rows, apart.heights[0]), (4, 1017.81));
    let refused = found(&format!("{sides}{MAP}undef 0.1 0.2 0.3\n")).unwrap_err();
    assert!(refused.contains("line 7: \"undef\""), "{refused}");
}

#[test]
fn lists_wrapped_rows_and_two_tables_are_no_map() {
    let list: String = (0..80).map(|i| format!("{} {} 0.{i} 7\n", i % 9, i / 9)).collect();
    let numbered: String = (0..80).map(|i| format!("{} {} {} 0.{i}\n", i + 1, i % 9, i / 9)).collect();
    let beside: String = (0..80).map(|i| format!("{}.5 0.{i} 1.{i}\n", 2 * i)).collect();
    for (text, word) in [
        (list, "shape of a list"),
        (beside, "places of profiles"),
        (numbered, "x = \"2\", y = \"3\", z = \"4\""),
        (format!("Samps/line: 6\nNumber of lines: 2\n{MAP}"), "line 1: says 6 and 2"),
        (format!("Matrix: 2 x 6\n{MAP}"), "3 lines of 4"),
        (format!("{MAP}\n{MAP}"), "2 tables of 3 rows"),
        (format!("{MAP}# second\n{MAP}"), "2 tables of 3 rows"),
    ] {
        let refused = found(&text).unwrap_err();
        assert!(refused.contains(word), "{refused}");
    }
    assert_eq!(found(&MAP.replace('\n', "\n\n")).unwrap().rows, 3);
    assert_eq!(found(&format!("Lines: 3\nPoints: 4\n{MAP}")).unwrap().rows, 3);
}

/// A program that parts columns by commas writes none before decimals.
#[test]
fn two_sizes_that_a_comma_parts_are_two() {
    let rows = MAP.replace(' ', ",");
    for (words, wanted) in [
        ("Pixel spacing,5,2,um\nHeight unit,um\n", [5.0, 2.0]),
        ("Pixel size (um),1,2\n", [1.0, 2.0]),
        ("\"Scan size\",\"8\",\"3\",\"um\"\n", [2.0, 1.0]),
        ("Step,2.5,um\n", [2.5, 2.5]),
    ] {
        let map = found(&format!("{words}{rows}")).unwrap();
        let Spacing::Metres(pixel) = map.spacing else { panic!("{words} {map:?}") };
        assert_eq!(pixel.map(|side| (side * 1e9).round() / 1e3), wanted, "{words}");
    }
}

#[test]
fn a_height_of_the_map_is_no_unit_of_its_heights() {
    for words in [
        "Width (mm): 0.008\nHeight (mm): 0.003\n",
        "Breite (mm)\t0,008\nHöhe (mm)\t0,003\n",
        "Width [mm] = 0.008\nHeight [mm] = 0.003\n",
        "Width (mm) 0.008\nHeight (mm) 0.003\n",
    ] {
        let rows = if words.contains("0,") { MAP.replace('.', ",").replace(' ', "\t") } else { MAP.into() };
        let map = found(&format!("{words}{rows}")).unwrap();
        let Spacing::Metres(pixel) = map.spacing else { panic!("{words} {map:?}") };
        assert_eq!(pixel.map(|side| (side * 1e9).round() / 1e3), [2.0, 1.0], "{words}");
        assert_eq!(map.height_unit, None, "{words}");
    }
}

#[test]
fn what_a_whole_number_is_worth_is_asked_about() {
    let whole = "12 15 11 19\n15 13 18 14\n16 12 19 11\n";
    for words in ["Gain = 0.5", "Z Gain: 0.5 nm/LSB", "Sensitivity = 0.5 nm/V", "Facteur Z : 0.5"] {
        let refused = found(&format!("{words}\n{whole}")).unwrap_err();
        assert!(refused.contains("whole numbers"), "{words}: {refused}");
    }
    for words in ["Gain = 1", "Zoom factor: 20", "Pixel calibration: 0.5 um", "Camera gain: 3"] {
        assert!(found(&format!("{words}\n{whole}")).is_ok(), "{words}");
    }
}

#[test]
fn marks_of_missing_points_have_many_names() {
    for words in [
        "NODATA -9999",
        "NoData\t-9999",
        "Missing value: -9999 (not measured)",
        "Undefined value -9999",
        "null: -9999",
        "Invalid pixel value = -9999 um",
    ] {
        let map = found(&format!("{words}\n{}", MAP.replace("0.8", "-9999"))).unwrap();
        let missing = map.heights.iter().filter(|z| z.is_nan()).count();
        assert_eq!((map.columns, map.rows, missing), (4, 3, 1), "{words}");
    }
    for words in ["Invalid Bad", "Missing NaN"] {
        let map = found(&format!("{words}\n{}", MAP.replace("0.8", "Bad"))).unwrap();
        assert_eq!((map.columns, map.rows), (4, 3), "{words}");
    }
}

/// ESRI, ASCII grid: a carriage return is not required at the end of each row.
#[test]
fn rows_of_a_map_may_stand_in_several_lines() {
    let numbers: Vec<&str> = MAP.split_whitespace().collect();
    let broken: String = numbers.chunks(2).map(|two| two.join(" ") + "\n").collect();
    let map = found(&format!("ncols 4\nnrows 3\ncellsize 2\n{broken}")).unwrap();
    assert_eq!((map.columns, map.rows), (4, 3));
    assert_eq!(map.heights[4..8], [0.5, 0.3, 0.8, 0.4]);
    assert!(map.notes.iter().any(|note| note.contains("in 2 lines")), "{:?}", map.notes);
}

/// Coordinates in mm with three decimals, in um with two: each node is there, though its steps are of two
/// lengths. The true pixel lies within what is said to be known of it.
#[test]
fn places_rounded_coarser_than_half_a_step_are_those_of_the_whole_grid() {
    let pairs = [(2.5, 1.0), (1.25, 1.0), (1.5, 1.0), (1.7, 1.0), (2.764, 1.0), (19.53125, 10.0), (3.3, 1.0)];
    for (step, digit) in pairs {
        let place = |i: usize| (i as f64 * step / digit).round() * digit;
        let height = |i: usize, j: usize| ((i * 37 + j * 61 + i * j * 7) % 101) as f64;
        let (columns, rows) = (40, 30);
        let points: String = (0..columns * rows)
            .map(|n| (n % columns, n / columns))
            .map(|(i, j)| format!("{} {} {}\n", place(i), place(j), height(i, j)))
            .collect();
        let map = found(&format!("X Y Z\n{points}")).unwrap();
        assert_eq!((map.columns, map.rows), (columns, rows), "{step}");
        assert!((0..columns).all(|i| map.heights[3 * columns + i] == height(i, 3)), "{step}");
        let Spacing::HeightUnits(pixel) = map.spacing else { panic!("{step}: {:?}", map.spacing) };
        let off = (pixel[0] / step - 1.0).abs().max((pixel[1] / step - 1.0).abs());
        assert!(
            off <= map.spacing_error + 1e-12 && map.spacing_error < 0.02,
            "{step}: {off} {}",
            map.spacing_error
        );
    }
}

#[test]
fn a_number_of_points_above_a_cloud_is_none_of_them() {
    let map = found("6\n0 0 1\n2 0 2\n4 0 3\n0 1 4\n2 1 5\n4 1 6\n").unwrap();
    assert_eq!((map.columns, map.rows), (3, 2));
}
