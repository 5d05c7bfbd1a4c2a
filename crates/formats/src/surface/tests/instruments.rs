//! Claims about instruments' files. Those named after a package of Python were written by it (tifffile
//! 2026.3.3, h5py 3.16.0, openpyxl 3.1.5, odfpy 1.4.1, xlwt 1.3.0); those named `hand` were laid out by
//! hand, and SurfaceTopography 1.27.1 reads from them the points, sizes, missing points and heights that
//! stand here.

use super::*;

/// A file of the folder of data.
macro_rules! data {
    ($name:literal) => {
        ($name, include_bytes!(concat!("data/", $name)) as &[u8])
    };
}

/// Heights in nm, row by row, of all these files.
pub(super) const HEIGHTS: [f64; 12] =
    [100.0, 200.0, -300.0, 400.0, 500.0, 600.0, NAN, 800.0, -900.0, 1000.0, 1100.0, 1200.0];

/// Files whose heights are in metres or say their unit, with pixels in nm, the step in nm to which heights
/// are stored, and the height that stands for the missing point where a format has no mark of one.
type Known = ((&'static str, &'static [u8]), [f64; 2], f64, f64);

pub(super) const FILES: [Known; 20] = [
    (data!("hand-f32.opd"), [500.0, 250.0], 1e-4, NAN),
    (data!("hand-i16.opd"), [500.0, 250.0], 0.3, NAN),
    (data!("hand.dat"), [500.0, 500.0], 0.01, NAN),
    (data!("hand-3.dat"), [500.0, 500.0], 0.01, NAN),
    (data!("hand.vk4"), [500.0, 250.0], 1e-9, -1000.0),
    (data!("hand.vk6"), [500.0, 250.0], 1e-9, -1000.0),
    (data!("hand.zon"), [500.0, 500.0], 1e-9, NAN),
    (data!("hand.plu"), [500.0, 250.0], 1e-4, NAN),
    (data!("hand.plux"), [500.0, 250.0], 1e-4, NAN),
    (data!("hand.opdx"), [500.0, 250.0], 1e-4, NAN),
    (data!("hand-16.spm"), [500.0, 250.0], 0.07, 700.0),
    (data!("hand-32.spm"), [500.0, 250.0], 1e-5, 700.0),
    (data!("h5py.datx"), [500.0, 250.0], 1e-9, NAN),
    (data!("h5py-plain.datx"), [500.0, 250.0], 1e-9, NAN),
    (data!("openpyxl-map.xlsx"), [500.0, 250.0], 1e-9, NAN),
    (data!("odfpy-map.ods"), [500.0, 250.0], 1e-9, NAN),
    (data!("xlwt-map.xls"), [500.0, 250.0], 1e-9, NAN),
    (data!("tifffile-imagej.tif"), [500.0, 250.0], 1e-4, NAN),
    (data!("tifffile-deflate.tif"), [0.0, 0.0], 1e-9, NAN),
    (data!("tifffile-big.tif"), [0.0, 0.0], 1e-4, NAN),
];

#[test]
fn files_of_instruments_give_points_pixels_units_missing_and_heights() {
    let folder = Folder::new();
    for ((name, content), pixel, step, unmarked) in FILES {
        let map = read_plain(&folder.file(name, content)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((map.columns, map.rows), (4, 3), "{name}");
        match map.spacing {
            Spacing::Metres(p) => {
                assert!((0..2).all(|k| (p[k] * 1e9 / pixel[k] - 1.0).abs() < 1e-6), "{name}: {p:?}");
            }
            other => assert!(other == Spacing::Unknown && pixel == [0.0; 2], "{name}: {other:?}"),
        }
        // a plain TIFF has no unit, its numbers are micrometres
        let nanometres = map.height_unit.unwrap_or(1e-6) * 1e9;
        assert_eq!(map.height_unit.is_none(), name.ends_with(".tif"), "{name}");
        for (found, want) in map.heights.iter().zip(HEIGHTS) {
            let want = if want.is_nan() { unmarked } else { want };
            // a vk4 counts from the lowest point of its range
            let from = if name.contains(".vk") { 1000.0 } else { 0.0 };
            let is_near = (found * nanometres - from - want).abs() <= step;
            assert!(is_near || found.is_nan() && want.is_nan(), "{name}: {found} {want}");
        }
    }
}

/// GDAL writes the number that means missing as text.
#[test]
fn a_tiff_is_refused_unless_it_holds_heights() {
    let folder = Folder::new();
    let map = read_plain(&folder.file("a.tif", include_bytes!("data/tifffile-nodata.tif"))).unwrap();
    assert!(map.heights[6].is_nan() && map.heights.iter().filter(|z| z.is_nan()).count() == 1);
    // the same with MinIsWhite, 0, for MinIsBlack, 1, as its photometric interpretation
    let mut turned = include_bytes!("data/tifffile-nodata.tif").to_vec();
    let entry = [6, 1, 3, 0, 1, 0, 0, 0, 1, 0];
    let place = turned.windows(entry.len()).position(|bytes| bytes == entry).unwrap();
    turned[place + 8] = 0;
    let fault = read_plain(&folder.file("a.tif", &turned)).unwrap_err().to_string();
    assert!(fault.contains("MinIsWhite") && fault.contains("export MinIsBlack"), "{fault}");
    let grey = read_plain(&folder.file("a.tif", include_bytes!("data/tifffile-u16.tif"))).unwrap_err();
    assert!(grey.to_string().contains("grey levels"), "{grey}");
}

#[test]
fn an_hdf5_file_of_other_programs_is_named() {
    let folder = Folder::new();
    let refused = read_plain(&folder.file("a.h5", include_bytes!("data/h5py-other.h5"))).unwrap_err();
    assert!(refused.to_string().contains("HDF5") && refused.to_string().contains("np.save"), "{refused}");
}

/// Cuts at every 97th byte, and at all of the headers.
#[test]
fn a_cut_file_of_an_instrument_is_refused_or_whole() {
    let folder = Folder::new();
    for ((name, content), ..) in FILES {
        let right = read_plain(&folder.file(name, content)).unwrap();
        for end in (0..content.len()).filter(|end| end % 97 == 0 || content.len() < 1500 && end % 7 == 0) {
            if let Ok(map) = read_plain(&folder.file(name, &content[..end])) {
                assert_eq!(format!("{:?}", map.heights), format!("{:?}", right.heights), "{name} {end}");
            }
        }
    }
}

/// A header that promises more than there is takes no memory.
#[test]
fn sizes_that_lie_are_refused() {
    let folder = Folder::new();
    for (name, at, word) in [
        ("hand-f32.opd", 170, 2),
        ("hand.dat", 68, 4),
        ("hand.vk4", 372, 4),
        ("hand.plu", 388, 4),
        ("hand.plu", 392, 4),
    ] {
        let (_, content) = FILES.iter().find(|file| file.0.0 == name).unwrap().0;
        let mut content = content.to_vec();
        content[at..at + word].fill(0x3f);
        let refused = read_plain(&folder.file(name, &content)).unwrap_err().to_string();
        let words = ["promises", "memory_limit", "at most 2147483646"];
        assert!(words.iter().any(|word| refused.contains(word)), "{name} {at}: {refused}");
    }
}
