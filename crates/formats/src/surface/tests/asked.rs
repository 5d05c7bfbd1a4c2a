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
