//! Claims about tables of text whose shape or words leave something open: they are read as what they can only
//! be, or refused with the way out.

use super::*;
use std::io::Write;

fn found(name: &str, text: &str) -> Result<Measured, String> {
    read_plain(&Folder::new().file(name, text.as_bytes())).map_err(|e| e.to_string())
}

/// A rough height in the unit of the file, with five digits.
fn rough(i: usize, j: usize) -> f64 {
    ((i * 37 + j * 61 + i * j * 7) % 101) as f64 / 100.0
}

fn line(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join("\t") + "\n"
}

/// Places 0, step, 2 step, … with so many digits behind the point, above and beside rough heights.
fn with_places(corner: &str, digits: usize, [dx, dy]: [f64; 2], [nx, ny]: [usize; 2]) -> String {
    let place = |k: usize, step: f64| format!("{:.digits$}", k as f64 * step);
    let top = line(std::iter::once(corner.to_string()).chain((0..nx).map(|i| place(i, dx))));
    let row = |j: usize| line(std::iter::once(place(j, dy)).chain((0..nx).map(|i| rough(i, j).to_string())));
    top + &(0..ny).map(row).collect::<String>()
}

#[track_caller]
fn has_step(map: &Measured, [dx, dy]: [f64; 2], sizes: [usize; 2]) {
    assert_eq!([map.columns, map.rows], sizes, "{:?}", map.notes);
    assert!((0..sizes[0] * sizes[1]).all(|k| map.heights[k] == rough(k % sizes[0], k / sizes[0])));
    let (Spacing::HeightUnits([x, y]) | Spacing::Metres([x, y])) = map.spacing else {
        panic!("{:?}", map.spacing)
    };
    let [off_x, off_y] = [(x / dx - 1.0).abs(), (y / dy - 1.0).abs()];
    assert!(off_x.max(off_y) <= map.spacing_error + 1e-9, "{off_x} {off_y} {}", map.spacing_error);
    assert!(map.spacing_error < 0.05, "{}", map.spacing_error);
}

/// The step that is not printed lies within the share that the rounding leaves open.
#[test]
fn places_rounded_to_their_last_digit_are_places() {
    let sizes = [30, 20];
    for (digits, step) in [(1, [0.695; 2]), (2, [0.0139, 0.0247]), (0, [1.39, 2.61]), (3, [0.0139; 2])] {
        for corner in ["", "0", "Y/X"] {
            let text = format!("unit: um\n{}", with_places(corner, digits, step, sizes));
            let map = found("a.txt", &text).unwrap();
            has_step(&map, step, sizes);
            assert!(map.notes.iter().any(|note| note.contains("rounded")), "{:?}", map.notes);
        }
    }
}

#[test]
fn points_whose_places_are_rounded_lie_on_their_grid() {
    let (sizes, step) = ([30, 20], [0.0695, 0.0347]);
    let point = |k: usize| {
        let (i, j) = (k % 30, k / 30);
        format!("{:.2} {:.2} {}\n", i as f64 * step[0], j as f64 * step[1], rough(i, j))
    };
    let map = found("a.xyz", &(0..600).map(point).collect::<String>()).unwrap();
    has_step(&map, step, sizes);
    assert!(map.spacing_error > 0.0);
    // places with all their digits leave nothing open
    let exact = |k: usize| {
        format!("{} {} {}\n", (k % 30) as f64 * 0.5, (k / 30) as f64 * 0.25, rough(k % 30, k / 30))
    };
    let map = found("a.xyz", &(0..600).map(exact).collect::<String>()).unwrap();
    has_step(&map, [0.5, 0.25], sizes);
    assert_eq!(map.spacing_error, 0.0);
}

/// Heights that are whole numbers on a tilted plane rise like rounded places, in all columns.
#[test]
fn rounded_heights_of_a_tilted_plane_are_no_places() {
    let height = |i: usize, j: usize| (1.39 * j as f64 + 1.21 * i as f64).round().to_string();
    let map =
        found("a.txt", &(0..20).map(|j| line((0..30).map(|i| height(i, j)))).collect::<String>()).unwrap();
    assert_eq!([map.columns, map.rows], [30, 20], "{:?}", map.notes);
}

#[test]
fn a_unit_alone_in_the_corner_tells_no_size() {
    let map = found("a.txt", &with_places("mm", 3, [0.002, 0.001], [12, 9])).unwrap();
    assert_eq!(([map.columns, map.rows], map.spacing), ([12, 9], Spacing::Unknown));
    assert!(map.notes.iter().any(|note| note.contains("line 1: \"mm\" may be the unit")), "{:?}", map.notes);
}

/// The exports of WSxM as text, which begin like its images (Horcas et al. 2007, its manual).
#[test]
fn text_of_wsxm_is_read_and_its_images_are_named() {
    let body: String = (0..3).map(|j| line((0..4).map(|i| rough(i, j).to_string()))).collect();
    let head = "WSxM file copyright UAM\nWSxM ASCII Matrix file\nX Amplitude: 8 um\nY Amplitude: 3 um\nZ Amplitude: 2 um\n\
                Number of rows: 3\nNumber of columns: 4\n\n";
    let map = found("a.txt", &format!("{head}{body}")).unwrap();
    has_step(&map, [2e-6, 1e-6], [4, 3]);
    let points: String =
        (0..12).map(|k| format!("{}\t{}\t{}\n", 2 * (k % 4), k / 4, rough(k % 4, k / 4))).collect();
    let head = "WSxM file copyright UAM\nWSxM ASCII XYZ file\nX[um]\tY[um]\tZ[nm]\n";
    let map = found("a.txt", &format!("{head}{points}")).unwrap();
    has_step(&map, [2e-6, 1e-6], [4, 3]);
    assert_eq!(map.height_unit, Some(1e-9));
    let image =
        found("a.stp", "WSxM file copyright UAM\nSxM Image file\nImage header size: 9\n").unwrap_err();
    assert!(image.contains("WSxM image"), "{image}");
}

#[test]
fn a_factor_of_the_heights_is_asked_for() {
    let body: String = (0..3).map(|j| line((0..4).map(|i| rough(i, j).to_string()))).collect();
    for (words, is_doubted) in [
        ("Z scale: 0.001", true),
        ("Height factor = 10", true),
        ("Z scale: 1", false),
        ("Z scale: 2 um", false),
        ("Z resolution: 0.1 nm", false),
    ] {
        let read = found("a.txt", &format!("{words}\n{body}"));
        assert_eq!(read.is_err(), is_doubted, "{words} {read:?}");
        assert!(read.err().is_none_or(|e| e.contains("line 1") && e.contains("multiplied")), "{words}");
    }
}

/// Two maps that an empty row or column of a sheet parts would be one with a trench.
#[test]
fn tables_parted_by_empty_cells_are_refused() {
    let row = |j: usize, empty: Option<usize>| {
        line((0..7).map(|i| if Some(i) == empty { String::new() } else { rough(i, j).to_string() }))
    };
    let empty = "\t".repeat(6) + "\n";
    let below: String = (0..5).map(|j| if j == 2 { empty.clone() } else { row(j, None) }).collect();
    let beside: String = (0..4).map(|j| row(j, Some(3))).collect();
    for (text, words) in [(below, "2 tables of 2 rows"), (beside, "2 tables of 3 columns")] {
        let refused = found("a.txt", &text).unwrap_err();
        assert!(refused.contains(words), "{refused}");
        let forced = Request { override_file: true, ..Request::default() };
        assert!(read(&Folder::new().file("a.txt", text.as_bytes()), &forced).is_ok());
    }
    // a row that was not measured, off the middle
    let hole: String = (0..6).map(|j| if j == 2 { empty.clone() } else { row(j, None) }).collect();
    let map = found("a.txt", &hole).unwrap();
    assert_eq!([map.columns, map.rows], [7, 6]);
    assert!(map.heights[14..21].iter().all(|z| z.is_nan()));
}

/// A workbook of one sheet whose cells of numbers stand in the places given.
fn workbook(cells: &[(usize, usize, f64)]) -> Vec<u8> {
    let rows: std::collections::BTreeSet<usize> = cells.iter().map(|cell| cell.0).collect();
    let cell = |(row, column, z): &(usize, usize, f64)| {
        format!("<c r=\"{}{}\"><v>{z}</v></c>", char::from(b'A' + *column as u8), row + 1)
    };
    let row = |row: &usize| {
        let cells: String = cells.iter().filter(|c| c.0 == *row).map(cell).collect();
        format!("<row r=\"{}\">{cells}</row>", row + 1)
    };
    let sheet: String = rows.iter().map(row).collect();
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let of = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let members = [
        (
            "[Content_Types].xml",
            "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"/>".to_string(),
        ),
        (
            "_rels/.rels",
            format!(
                "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r1\" \
                 Type=\"{of}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook xmlns=\"{main}\" xmlns:r=\"{of}\"><sheets><sheet name=\"S\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r1\" \
                 Type=\"{of}/worksheet\" Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/worksheets/sheet1.xml",
            format!("<worksheet xmlns=\"{main}\"><sheetData>{sheet}</sheetData></worksheet>"),
        ),
    ];
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, text) in members {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn rows_of_a_workbook_without_a_cell_are_rows_that_were_not_measured() {
    let cells: Vec<(usize, usize, f64)> = (0..9)
        .filter(|row| *row != 3)
        .flat_map(|row| (0..4).map(move |column| (row, column, 1.0 + rough(column, row))))
        .collect();
    let map = read_plain(&Folder::new().file("a.xlsx", &workbook(&cells))).unwrap();
    assert_eq!([map.columns, map.rows], [4, 9], "{:?}", map.notes);
    let missing: Vec<usize> = (0..36).filter(|k| map.heights[*k].is_nan()).collect();
    assert_eq!(missing, [12, 13, 14, 15]);
    assert_eq!(map.heights[16], 1.0 + rough(0, 4));
}

#[test]
fn a_third_column_of_another_name_is_z_where_its_unit_says_so() {
    let points: String = (0..600)
        .map(|k| format!("{},{},{}\n", 0.5 * (k % 30) as f64, 0.25 * (k / 30) as f64, rough(k % 30, k / 30)))
        .collect();
    let map = found("a.csv", &format!("x (mm),y (mm),k (um)\n{points}")).unwrap();
    has_step(&map, [0.5e-3, 0.25e-3], [30, 20]);
    assert_eq!(map.height_unit, Some(1e-6));
    for names in ["x (mm),y (mm),Depth (um)", "Row,Column,Height"] {
        let refused = found("a.csv", &format!("{names}\n{points}")).unwrap_err();
        assert!(refused.contains("columns = {"), "{names}: {refused}");
    }
}

#[test]
fn a_number_that_stands_far_off_again_and_again_is_asked_for() {
    let map = |mark: f64, low: f64| -> String {
        let height = |i: usize, j: usize| if (i * j) % 17 == 5 { mark } else { low + rough(i, j) };
        (0..20).map(|j| line((0..30).map(|i| height(i, j).to_string()))).collect()
    };
    for (mark, low) in [(-1000.0, 0.0), (123.0, 0.0), (0.0, 3.0)] {
        let refused = found("a.txt", &map(mark, low)).unwrap_err();
        assert!(refused.contains(&format!("missing_value = {mark}")), "{refused}");
    }
    // 0 close below the heights is a floor
    assert!(found("a.txt", &map(0.0, 0.2)).is_ok());
}

/// Files that wrap their rows: the two counts among the words of the head refuse them.
#[test]
fn wrapped_rows_are_refused_by_the_counts_in_the_words() {
    let heights: Vec<String> = (0..600).map(|k| format!("{:.2}", rough(k % 30, k / 30))).collect();
    let body: String = heights.chunks(8).map(|row| row.join(" ") + "\n").collect();
    let refused = found("a.txt", &format!("FIGURE\nGRD 30 20 SUR SSZ 9999 NDA 32767\n{body}")).unwrap_err();
    assert!(refused.contains("30 and 20"), "{refused}");
}
