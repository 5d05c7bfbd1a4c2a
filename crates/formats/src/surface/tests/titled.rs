//! Claims about text files that are known by their first line.

use super::*;

fn found(name: &str, text: &str) -> Result<Measured, String> {
    let folder = Folder::new();
    read_plain(&folder.file(name, text.as_bytes())).map_err(|e| e.to_string())
}

fn pixel_is(map: &Measured, pixel: [f64; 2]) -> bool {
    let Spacing::Metres(found) = map.spacing else { return false };
    (0..2).all(|k| (found[k] / pixel[k] - 1.0).abs() < 1e-12)
}

/// A file of MetroPro of 3 x 2 points, with `pixel` in its header and `sign` before its lines.
pub(super) fn zygo(pixel: &str, sign: &str) -> String {
    let header = [
        "Zygo XYZ Data File - Format 1",
        "1 8 1 5 \"Mon Feb 03 10:00:00 2020\"",
        "0 0 3 2 1 255",
        "10 20 3 2",
        "\"a lens\"",
        "\"\"",
        "\"\"",
        &format!("0 0.5 6.328e-007 0 1 0 {pixel} 1580720400"),
        "3 2 0 0 0 0 0",
        "1 1 0 20 2 0 0 0 0 0",
        "0 0 0",
        "\"\"",
        "#",
    ];
    let header: String = header.iter().map(|line| format!("{sign}{line}\n")).collect();
    header + "10 20 1\n11 20 2\n12 20 3\n10 21 4\n11 21 No Data\n12 21 6\n#\n"
}

#[test]
fn pixels_of_a_zygo_file_are_those_of_its_camera() {
    for sign in ["", "# "] {
        let map = found("a.xyz", &zygo("2.5e-006", sign)).unwrap();
        same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
        assert!(pixel_is(&map, [2.5e-6; 2]) && map.height_unit == Some(1e-6), "{map:?}");
    }
    let bare = found("a.xyz", &zygo("0", "")).unwrap();
    assert!(bare.spacing == Spacing::Unknown && bare.notes.iter().any(|n| n.contains("not calibrated")));
    for damaged in [zygo("none", ""), zygo("1e-6", "").replace("\n#\n", "\n")] {
        assert!(found("a.xyz", &damaged).unwrap_err().contains("export"));
    }
    assert!(
        found("a.asc", "Zygo ASCII Data File - Format 2\n1 2\n").unwrap_err().contains("export it as XYZ")
    );
    let true_map = found("a.tmd", "Binary TrueMap Data File v2.0\r\n\0").unwrap_err();
    assert!(true_map.contains("a TrueMap file (.tmd)") && true_map.contains("export it as"), "{true_map}");
}

#[test]
fn numbers_of_pixels_are_no_places() {
    let list = "0 0 1\n1 0 2\n2 0 3\n0 1 4\n1 1 nan\n2 1 6\n";
    let map = found("a.xyz", list).unwrap();
    same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    assert_eq!(map.spacing, Spacing::Unknown);
    assert!(matches!(
        found("a.xyz", &format!("x_um y_um z_um\n{list}")).unwrap().spacing,
        Spacing::Metres(_)
    ));
}

/// A file of Vision of 3 x 2 points: a line for each x, from the largest y down.
pub(super) fn wyko(flag: u8, further: &str) -> String {
    format!(
        "Wyko ASCII Data File Format 0\t{flag}\t1\nX Size\t3\nY Size\t2\nBlock Name\tType\tLength\tValue\n\
         Wavelength\t7\t4\t600\n{further}Pixel_size\t7\t4\t0.002\nTitle\t5\t20\tsample 7\nStageX\t7\t4\t12.5\n\
         RAW_DATA\t3\t24\t\n4\t1\nBad\t2\n6\t3\nIntensity\t6\t6\t\n7\t7\n7\t7\n7\t7\n"
    )
}

#[test]
fn heights_of_a_wyko_text_are_nanometres_or_waves_and_run_along_y() {
    for (flag, further, unit, pixel) in [
        (1, "", 1e-9, [2e-6, 2e-6]),
        (0, "", 600e-9, [2e-6, 2e-6]),
        (0, "Mult\t6\t2\t2\n", 300e-9, [2e-6, 2e-6]),
        (1, "Aspect\t7\t4\t0.8\n", 1e-9, [2e-6, 1.6e-6]),
    ] {
        let map = found("a.asc", &wyko(flag, further)).unwrap();
        same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
        assert!(pixel_is(&map, pixel) && (map.height_unit.unwrap() / unit - 1.0).abs() < 1e-12, "{map:?}");
    }
    for (damaged, word) in [
        (wyko(2, ""), "second flag"),
        (wyko(1, "").replace("Y Size\t2", "Y Size\t3"), "3 x 3, but 3 lines of 2"),
        (wyko(0, "").replace("Wavelength", "Other"), "Wavelength"),
        (wyko(1, "").replace("RAW_DATA", "PHASES"), "RAW_DATA"),
        (wyko(1, "Aspect\t7\t4\t0\n"), "Aspect"),
    ] {
        let refused = found("a.asc", &damaged).unwrap_err();
        assert!(refused.contains(word), "{refused}");
    }
}

#[test]
fn a_text_grid_of_surfer_is_read_from_its_lowest_row_up() {
    let grid = "DSAA\n3 2\n0 4\n1 2\n1 6\n1 2\n3\n\n4 1.70141e+038 6\n";
    let map = found("a.grd", grid).unwrap();
    same(&map, [1.0, 2.0, 3.0, 4.0, NAN, 6.0], 1.0);
    assert_eq!((map.spacing, map.height_unit), (Spacing::HeightUnits([2.0, 1.0]), None));
    for (damaged, word) in [
        (grid.replace("3 2\n", "3 3\n"), "3 x 3, but 6 heights"),
        (grid.replace("0 4", "4 0"), "range"),
        (grid.replace("1 6", "1 six"), "six"),
        ("DSAA\n3".into(), "nothing"),
    ] {
        let refused = found("a.grd", &damaged).unwrap_err();
        assert!(refused.contains(word), "{refused}");
    }
}
