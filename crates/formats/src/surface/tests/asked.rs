//! Claims about words that were taken for the pixel or the unit of the heights, or passed over, without a
//! remark: those of optics and cameras, of heights beside a unit of anything, of factors of whole numbers.

use super::*;

const MAP: &str = "0 1 2 3\n4 5 6 8\n1 2 3 4\n";

fn found(text: &str) -> Result<Measured, String> {
    let folder = Folder::new();
    read_plain(&folder.file("a.txt", text.as_bytes())).map_err(|e| e.to_string())
}

#[test]
fn a_resolution_or_the_pixel_of_a_camera_is_no_pixel_of_the_map() {
    for (words, said) in [
        ("Lateral resolution: 0.41 um\n", "may be the resolution of the optics"),
        ("Camera resolution: 0.41 um\n", "may be the resolution of the optics"),
        ("Pixel pitch (camera) = 6.45 um\n", "pixel_size"),
        ("Step size: 0.5 um (z)\n", "pixel_size"),
    ] {
        let map = found(&format!("{words}Z unit: um\n{MAP}")).unwrap();
        let notes = map.notes.join("; ");
        assert_eq!(map.spacing, Spacing::Unknown, "{words}");
        assert!(said == "pixel_size" || notes.contains(said), "{words}: {notes}");
    }
}

#[test]
fn a_unit_of_heights_goes_before_one_of_anything() {
    for words in ["Unit: um\nZ values in nm\n", "Z values in nm\nUnit: um\n", "Unit: um\nHeight [nm]\n"] {
        let map = found(&format!("{words}{MAP}")).unwrap();
        assert_eq!(map.height_unit, Some(1e-9), "{words}");
    }
}

#[test]
fn a_scale_of_whole_numbers_is_asked_about() {
    for words in
        ["Scale: 0.001", "Height scale: 1 nm/LSB", "Vertical step: 1 nm", "Digital resolution (um): 0.001"]
    {
        let fault = found(&format!("Z unit: um\n{words}\n{MAP}")).expect_err(words);
        assert!(fault.contains("multiply them"), "{words}: {fault}");
    }
}

#[test]
fn a_step_height_and_a_scale_bar_are_no_factors() {
    for words in ["Step height: 180 nm", "Scale bar: 10 um", "Z scale: 1 nm", "Scale: 1"] {
        let map = found(&format!("Z unit: nm\n{words}\n{MAP}")).unwrap();
        assert_eq!(map.height_unit, Some(1e-9), "{words}");
    }
}

/// Columns of rows and columns were proposed as x and y in turn: the map lay on its side.
#[test]
fn a_proposal_of_columns_takes_rows_for_y_and_heights_for_z() {
    for (names, proposed) in [
        ("Row,Col,Z [um]", "x = \"Col\", y = \"Row\", z = \"Z [um]\""),
        ("height,Points:0,Points:1", "x = \"Points:0\", y = \"Points:1\", z = \"height\""),
        ("a,b,Z [um]", "x = \"a\", y = \"b\", z = \"Z [um]\""),
    ] {
        let fault = found(&format!("{names}\n0,0,1\n0,1,2\n1,0,3\n1,1,5\n")).expect_err(names);
        assert!(fault.contains(proposed), "{names}: {fault}");
    }
}

const POINTS: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [0.0, 3.0], [2.0, 3.0], [4.0, 3.0]];

fn points(names: &str, heights: impl Fn(usize) -> String) -> String {
    let row = |(i, [x, y]): (usize, &[f64; 2])| format!("{x}\t{y}\t{}\n", heights(i));
    std::iter::once(format!("{names}\n")).chain(POINTS.iter().enumerate().map(row)).collect()
}

#[test]
fn a_line_between_names_and_units_describes_the_columns() {
    let map = found(&points("X\tY\tHeight\nstage\tstage\tfiltered\n[mm]\t[mm]\t[um]", |i| i.to_string()));
    let map = map.unwrap();
    assert_eq!((map.height_unit, map.heights.len()), (Some(1e-6), 6));
}

#[test]
fn two_columns_of_heights_are_asked_about() {
    for (third, fourth) in [("Z nominal", "Z measured"), ("Height", "Height filtered"), ("Z std", "Z mean")] {
        let names = format!("X [um]\tY [um]\t{third} [um]\t{fourth} [um]");
        let fault = found(&points(&names, |i| format!("{i}\t{}", 2 * i))).expect_err(&names);
        assert!(fault.contains(fourth) && fault.contains("may both be"), "{names}: {fault}");
    }
    let map = found(&points("X [um]\tY [um]\tZ [um]\tZ error [um]", |i| format!("{i}\t0.1"))).unwrap();
    assert_eq!(map.heights, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
}

/// Numbers of columns and rows that are told make a map of one column, and are asked for where they are not.
#[test]
fn a_column_of_heights_is_a_map_where_its_sides_are_told() {
    let column = "0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n";
    let words = ["Data Width: 3 (pxl)\nData Height: 2 (pxl)\n", "Columns: 3\nRows: 2\n"];
    for words in words {
        let map = found(&format!("{words}{column}")).unwrap();
        assert_eq!((map.columns, map.rows, map.heights[3]), (3, 2, 0.4));
    }
    let fault = found(column).unwrap_err();
    assert!(fault.contains("Columns: 60 and Rows: 40"), "{fault}");
}

/// The worth of a whole number, in words that name no factor.
#[test]
fn a_step_of_heights_beside_whole_numbers_is_asked_about() {
    for step in ["dz=2.5 nm", "Z pitch (um),0.0025", "Höhenauflösung: 2,5 nm"] {
        let fault = found(&format!("dx=0.5 um\ndy=0.5 um\n{step}\nunits: nm\n1 2 3\n4 5 6\n7 8 9\n"));
        let fault = fault.expect_err(step);
        assert!(fault.contains("whole numbers"), "{step}: {fault}");
    }
}

/// The plane of the design, beside which the measured heights stand as deviations.
#[test]
fn heights_that_are_the_same_everywhere_are_asked_about() {
    let fault = found(&points("X [um]\tY [um]\tZ [um]\tDev [um]", |i| format!("5\t0.{i}"))).unwrap_err();
    assert!(fault.contains("column 3, is 5 at every point") && fault.contains("z = \"4\""), "{fault}");
    let alone = found(&points("X [um]\tY [um]\tZ [um]\tDev [um]", |_| "5\t0".into())).unwrap();
    assert!(alone.heights.iter().all(|z| *z == 5.0));
}

/// A minus before the name of a column of depths was passed over.
#[test]
fn depths_are_refused_or_turned() {
    for words in ["Depth map, positive values below the reference plane", "Channel: Depth", "Depth [um]"] {
        let fault = found(&format!("{words}\n{MAP}")).expect_err(words);
        assert!(fault.contains("point down"), "{words}: {fault}");
    }
    for name in ["Distance", "Abstand", "Sensor range"] {
        let fault =
            found(&points(&format!("X [um]\tY [um]\t{name} [um]"), |i| i.to_string())).expect_err(name);
        assert!(fault.contains("minus before the name"), "{name}: {fault}");
    }
    let folder = Folder::new();
    let path = folder.file("a.txt", points("X [um]\tY [um]\tDepth [um]", |i| i.to_string()).as_bytes());
    let columns = [Some("X"), Some("Y"), Some("-Depth")];
    let map = read(&path, &Request { columns, ..Request::default() }).unwrap();
    assert_eq!(map.heights, [0.0, -1.0, -2.0, -3.0, -4.0, -5.0]);
    let columns = [Some("X"), Some("-Y"), Some("-Depth")];
    let fault = read(&path, &Request { columns, ..Request::default() }).unwrap_err().to_string();
    assert!(fault.contains("columns.y") && fault.contains("leave it out"), "{fault}");
}

#[test]
fn sides_that_put_y_first_are_turned_or_asked_about() {
    for words in
        ["Pixel pitch (Y, X): 3 um, 2 um", "Spacing [y, x]: 3 um, 2 um", "Pitch (dy x dx): 3 um x 2 um"]
    {
        let map = found(&format!("{words}\nZ unit: um\n{MAP}")).unwrap();
        let Spacing::Metres([x, y]) = map.spacing else { panic!("{words}: {:?}", map.spacing) };
        assert!((x / 2e-6 - 1.0).abs() < 1e-9 && (y / 3e-6 - 1.0).abs() < 1e-9, "{words}");
    }
    // 3 lines of 4 heights, which the words name in the order of an array
    let map = found(&format!("Pixels: 3 x 4\nScan size: 9 um x 8 um\nZ unit: um\n{MAP}")).unwrap();
    assert_eq!(map.spacing, Spacing::Unknown);
    assert!(map.notes.join("; ").contains("may name y first"), "{:?}", map.notes);
}

/// Beside heights from -109 to 134, 999.9 is no height of a surface, and neither is -999 beside -217 to 268.
#[test]
fn a_round_number_far_from_all_heights_is_no_height() {
    let map = |mark: &str, size: f64| {
        let height = |i: usize| size * (1.7 * i as f64).sin() + 0.013 * i as f64;
        let cell =
            |i: usize| if [7, 20, 33].contains(&i) { mark.into() } else { format!("{:.3}", height(i)) };
        let rows = (0..6).map(|j| (0..8).map(|i| cell(8 * j + i)).collect::<Vec<_>>().join(" "));
        rows.collect::<Vec<_>>().join("\n")
    };
    for (mark, size) in [("999.9", 120.0), ("-999", 240.0), ("5000", 240.0), ("-1000", 120.0)] {
        let fault = found(&map(mark, size)).expect_err(mark);
        assert!(fault.contains(&format!("missing_value = {mark}")), "{mark}: {fault}");
    }
    // a spike of the surface itself
    assert!(found(&map("400.123", 240.0)).is_ok());
}

#[test]
fn an_axis_without_a_unit_is_in_that_of_the_next_one() {
    let rows = points("", |i| i.to_string());
    let map = found(&format!("# X, Y in mm, Z in um{rows}")).unwrap();
    assert_eq!((map.spacing, map.height_unit), (Spacing::Metres([2e-3, 3e-3]), Some(1e-6)));
}

/// Igor's waves have a line for each x: read by lines the map lay on its side.
#[test]
fn a_wave_of_igor_is_refused_with_a_way_out() {
    let fault = found(&format!("IGOR\nWAVES/D/N=(3,4) map\nBEGIN\n{MAP}END\n")).unwrap_err();
    assert!(fault.contains("line for each x"), "{fault}");
}
