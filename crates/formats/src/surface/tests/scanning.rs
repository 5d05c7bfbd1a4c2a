//! Claims about files of scanning probe microscopes that are laid out here.

use super::*;

fn found(name: &str, content: &[u8]) -> Result<Measured, String> {
    read_plain(&Folder::new().file(name, content)).map_err(|e| e.to_string())
}

/// A file of SPIP of 3 x 2 points, 0.5 x 0.25 um, of [`HEIGHTS`] in nm: `kind` is bcrstm or bcrf, `line` one
/// more of the header.
pub(super) fn bcr(kind: &str, big_endian: bool, line: &str) -> Vec<u8> {
    let is_float = kind.starts_with("bcrf");
    let header = format!(
        "fileformat = {kind}\nheadersize = 2048\nxpixels = 3\nypixels = 2\nxlength = 1500\nylength = 0.5\nyunit = µm\n\
         intelmode = {}\nbit2nm = {}\nvoidpixels = 1\n{line}\n",
        u8::from(!big_endian),
        if is_float { 1.0 } else { 0.5 }
    );
    let header: Vec<char> = header.chars().chain([' '; 2048]).take(2048).collect();
    let mut file: Vec<u8> = if kind.ends_with("unicode") {
        header.iter().flat_map(|c| (*c as u16).to_le_bytes()).collect()
    } else {
        header.iter().map(|c| *c as u8).collect()
    };
    for z in HEIGHTS {
        let float = if z.is_nan() { 1.70141e38 } else { z as f32 };
        let whole = if z.is_nan() { i16::MAX } else { (z / 0.5) as i16 };
        match (is_float, big_endian) {
            (true, false) => file.extend(float.to_le_bytes()),
            (true, true) => file.extend(float.to_be_bytes()),
            (false, false) => file.extend(whole.to_le_bytes()),
            (false, true) => file.extend(whole.to_be_bytes()),
        }
    }
    file
}

const HEIGHTS: [f64; 6] = [1.0, -2.0, 3.0, 4.0, NAN, 6.0];

/// Image Metrology, SPIP reference guide, "BCR-STM File Format": units are nm where none stands, a header of
/// two bytes to a character has twice the size. The half-open range of a void pixel is that of SPIP's files.
#[test]
fn bcr_of_every_kind_and_order_gives_heights_pixels_and_voids() {
    for kind in ["bcrstm", "bcrf", "bcrstm_unicode", "bcrf_unicode"] {
        for big_endian in [false, true] {
            let map = found("a.bcr", &bcr(kind, big_endian, "")).unwrap_or_else(|e| panic!("{kind}: {e}"));
            same(&map, HEIGHTS, 1.0);
            assert_eq!(map.height_unit, Some(1e-9), "{kind}");
            let Spacing::Metres(p) = map.spacing else { panic!() };
            assert!((p[0] / 0.5e-6 - 1.0).abs() < 1e-12 && (p[1] / 0.25e-6 - 1.0).abs() < 1e-12, "{p:?}");
        }
    }
    let marked = [&[0xff, 0xfe][..], &bcr("bcrf_unicode", false, "")].concat();
    same(&found("a.bcrf", &marked).unwrap(), HEIGHTS, 1.0);
    let micrometres = found("a.bcr", &bcr("bcrf", false, "zunit = um")).unwrap();
    assert_eq!(micrometres.height_unit, Some(1e-6));
    let refused = found("a.bcr", &bcr("bcrf", false, "zunit = nA")).unwrap_err();
    assert!(refused.contains("zunit") && refused.contains("channel of heights"), "{refused}");
    let text = String::from_utf8_lossy(&bcr("bcrf", false, "")).replace("bit2nm = 1", "bit2nm = 2");
    let refused = found("a.bcr", text.as_bytes()).unwrap_err();
    assert!(refused.contains("bit2nm") && refused.contains("override"), "{refused}");
    let whole = bcr("bcrstm", false, "");
    assert!((0..whole.len()).step_by(11).all(|end| found("a.bcr", &whole[..end]).is_err()));
}

/// A file of Nanosurf: deflection of 2 x 2 points, then heights of 3 x 2 over 1 um, both in `bits`.
pub(super) fn nid(bits: u32, unit: &str) -> Vec<u8> {
    let channel = |name: &str, points: u32, quantity: &str, unit: &str| {
        format!(
            "[{name}]\r\nPoints={points}\r\nLines=2\r\nFrame=Scan forward\r\nDim0Unit=m\r\nDim0Range=1.5e-6\r\nDim1Unit=m\r\n\
             Dim1Range=5e-7\r\nDim2Name={quantity}\r\nDim2Unit={unit}\r\nDim2Min=-5e-7\r\nDim2Range=1e-6\r\nSaveBits={bits}\r\n\r\n"
        )
    };
    let header = "[DataSet]\r\nGroupCount=1\r\nGr0-Name=Scan forward\r\nGr0-Count=2\r\nGr0-Ch0=DataSet-0:0\r\n\
                  Gr0-Ch1=DataSet-0:1\r\n\r\n";
    let [deflection, topography] =
        [channel("DataSet-0:0", 2, "Deflection", "V"), channel("DataSet-0:1", 3, "Z-Axis", unit)];
    let mut file = format!("{header}{deflection}{topography}#!").into_bytes();
    let mut put = |number: i32| match bits {
        16 => file.extend(((number >> 16) as i16).to_le_bytes()),
        _ => file.extend(number.to_le_bytes()),
    };
    [7; 4].into_iter().for_each(&mut put);
    // sixteenths of the range, from the bottom row up
    [4, 5, 6, -8, 0, 3].into_iter().for_each(|sixteenth| put(sixteenth << 28));
    file
}

/// Heights of `nid` by the formula of NSFopen 2.2.4 (Nanosurf): Dim2Min for the least integer.
#[test]
fn nid_gives_the_first_channel_of_heights_from_the_top() {
    let want = [-5e-7, 0.0, 3e-6 / 16.0, 4e-6 / 16.0, 5e-6 / 16.0, 6e-6 / 16.0];
    for bits in [16, 32] {
        let map = found("a.nid", &nid(bits, "m")).unwrap();
        same(&map, want, 1.0);
        let Spacing::Metres(p) = map.spacing else { panic!() };
        assert!((p[0] / 0.5e-6 - 1.0).abs() < 1e-12 && (p[1] / 0.25e-6 - 1.0).abs() < 1e-12, "{p:?}");
        assert!(map.notes[0].contains("Z-Axis"), "{:?}", map.notes);
    }
    let refused = found("a.nid", &nid(32, "A")).unwrap_err();
    assert!(refused.contains("Deflection in V, Z-Axis in A"), "{refused}");
    let whole = nid(32, "m");
    assert!((9..whole.len()).step_by(11).all(|end| found("a.nid", &whole[..end]).is_err()));
}

#[test]
fn files_of_other_microscopes_are_named_with_an_export() {
    for (start, word) in [
        (&b"\x05\x00\x12\x34"[..], "Igor"),
        (b":NANONIS_VERSION:\n2\n", "Nanonis"),
        (b"WSxM file copyright", "WSxM"),
        (b"ply\nformat ascii 1.0\n", "mesh"),
    ] {
        let refused = found("a.dat", start).unwrap_err();
        assert!(refused.contains(word) && refused.contains("export") | refused.contains("save"), "{refused}");
    }
    let force = found("a.001", b"\\*Force file list\r\n").unwrap_err();
    assert!(force.contains("depth = ramp - bending"), "{force}");
}

/// A header of NanoScope (images of 3 x 2 points over 1.5 x 0.5 um), whose lines stand in `quotes`.
fn nanoscope_header(quotes: &str) -> String {
    let lines = [
        "*File list",
        "Version: 0x09400202",
        "*Ciao image list",
        "Data offset: 40960",
        "Data length: 12",
        "Bytes/pixel: 2",
        "Scan Size: 1.5 0.5 ~m",
        "Samps/line: 3",
        "Number of lines: 2",
        "@2:Z scale: V [Sens. Zsens] (0.0067 V/LSB) 440.0 V",
        "*File list end",
    ];
    lines.iter().map(|line| format!("{quotes}\\{line}{quotes}\r\n")).collect()
}

/// Exported as text, numbers stand behind the header of the file of bytes: they were read as 16-bit counts.
/// Rows from the bottom up, as in the file of bytes.
#[test]
fn text_that_nanoscope_exports_is_no_file_of_bytes() {
    let rows = "1.5\t-2\t3\r\n4\t5.25\t6\r\n";
    let column = rows.replace('\t', "\r\n");
    let heights = [4.0, 5.25, 6.0, 1.5, -2.0, 3.0];
    for quotes in ["", "\""] {
        for (behind, unit) in [
            (format!("\r\n\"Height(nm)\"\t\r\n{column}"), Some(1e-9)),
            (format!("\"Height Sensor(um)\"\r\n{rows}"), Some(1e-6)),
            (format!("\\Exported image units: nm\r\n{rows}"), Some(1e-9)),
            (rows.to_string(), None),
            (column.clone(), None),
            (
                format!(
                    "\"Phase(deg)\"\t\"Height(nm)\"\r\n{}",
                    column.lines().map(|z| format!("7\t{z}\r\n")).collect::<String>()
                ),
                Some(1e-9),
            ),
            (
                format!(
                    "\\Exported image units: nm\r\nPhase(deg)\tHeight(um)\r\n{}",
                    column.lines().map(|z| format!("7\t{z}\r\n")).collect::<String>()
                ),
                Some(1e-6),
            ),
        ] {
            let text = format!("{}{behind}", nanoscope_header(quotes));
            let map = found("a.txt", text.as_bytes()).unwrap_or_else(|e| panic!("{behind}: {e}"));
            same(&map, heights, 1.0);
            assert_eq!(map.height_unit, unit, "{behind}");
            let Spacing::Metres(p) = map.spacing else { panic!() };
            assert!((p[0] / 0.5e-6 - 1.0).abs() < 1e-12 && (p[1] / 0.25e-6 - 1.0).abs() < 1e-12, "{p:?}");
        }
    }
    for (behind, word) in
        [("1\t2\r\n3\t4\r\n", "Samps/line"), ("Phase(deg)\r\n1\t2\t3\r\n4\t5\t6\r\n", "Height")]
    {
        let refused = found("a.txt", format!("{}{behind}", nanoscope_header("")).as_bytes()).unwrap_err();
        assert!(refused.contains(word), "{refused}");
    }
}
