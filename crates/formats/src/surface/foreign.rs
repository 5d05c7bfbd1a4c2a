//! Formats that are known by their first bytes but not read: their names, and an export that is read.

use super::measured::ReadError;

/// Bytes of the beginning of a file that tell its kind.
pub(super) const LOOKED_AT: u64 = 1024;

const PICTURE: &str = "colours are not heights: export the heights as .sur, .x3p or text";

const MESH: &str = "save its points as text x y z on a regular grid, or its heights as .x3p or .sur";

const GXF: &str = "save it as a text grid of Surfer (DSAA, .grd) or ESRI (.asc), or as XYZ";

const GREY: &str = "a picture of grey levels (.pgm, .pfm)";

/// Beginning, name, and what to do.
const KINDS: [(&[u8], &str, &str); 27] = [
    (b"\x89PNG", "a PNG picture", PICTURE),
    (b"\xff\xd8\xff", "a JPEG picture", PICTURE),
    (b"GIF8", "a GIF picture", PICTURE),
    (b"BM", "a BMP picture", PICTURE),
    (b"%PDF", "a PDF document", "export the heights as .sur, .x3p or text"),
    (b"CDF\x01", "a NetCDF file (.nc)", "save the heights by np.save(\"map.npy\", heights)"),
    (b"CDF\x02", "a NetCDF file (.nc)", "save the heights by np.save(\"map.npy\", heights)"),
    (b"KPK1", "a Keyence VR measurement packed by zstd (.zon)", "export its heights as CSV in the analyzer"),
    (
        b"\\*Force file list",
        "a NanoScope force curve (.spm)",
        "an ASCII export holds the way of the piezo and the bending of the cantilever: write a table depth_nm,force_nN from \
         them for asperity identify, depth = ramp - bending (nm, both from first touch)",
    ),
    (
        b"\x05\x00",
        "an Igor binary wave (.ibw)",
        "export the heights as .gwy, .gsf or text (Gwyddion opens the file)",
    ),
    (
        b":NANONIS_VERSION:",
        "a Nanonis scan (.sxm)",
        "export the heights as .gwy, .gsf or text (Gwyddion opens it)",
    ),
    (b"WSxM file copyright", "a WSxM image (.stp, .top)", "export the heights as text with a header in WSxM"),
    (
        b"ISO/TC 201 SPM data transfer format",
        "an ISO 28600 file (.spm)",
        "export the heights as .gwy, .gsf or text (Gwyddion opens it)",
    ),
    (b"#TITLE", "a GXF grid (.gxf)", GXF),
    (b"#POINTS", "a GXF grid (.gxf)", GXF),
    (b"ply", "a mesh of points (.ply)", MESH),
    (
        b"Zygo ASCII Data File",
        "a Zygo ASCII file of raw phase",
        "export it as XYZ, .datx or .dat in MetroPro or Mx",
    ),
    (
        b"Binary TrueMap Data File",
        "a TrueMap file (.tmd)",
        "export it as .sur, .x3p or text in TrueMap (Gwyddion opens it, too)",
    ),
    (b"DSBB", "a binary grid of Surfer (.grd)", "save it as a text grid (DSAA) or as XYZ in Surfer"),
    (
        b"# vtk DataFile",
        "a legacy file of VTK (.vtk)",
        "save its heights as image data (.vti, in ParaView), as text x y z, or by np.save(\"map.npy\", heights)",
    ),
    (b"P2\n", GREY, PICTURE),
    (b"P5\n", GREY, PICTURE),
    (b"PF\n", GREY, PICTURE),
    (b"Pf\n", GREY, PICTURE),
    (b"Rar!", "a RAR archive", "unpack it and give the file of the surface itself"),
    (b"7z\xbc\xaf", "a 7z archive", "unpack it and give the file of the surface itself"),
    (b"\x1f\x8b", "a gzip archive", "unpack it and give the file of the surface itself"),
];

/// The error that names a format by its beginning.
pub(super) fn named(start: &[u8]) -> Option<ReadError> {
    // WSxM begins its exports of text as its images
    let is_text = start.split(|b| *b == b'\n').nth(1).is_some_and(|line| line.starts_with(b"WSxM ASCII"));
    let (_, found, export) = KINDS.iter().find(|(magic, ..)| start.starts_with(magic) && !is_text)?;
    Some(ReadError::Foreign { found: (*found).into(), export })
}

/// The error that names a mesh of triangles by its extension.
pub(super) fn mesh(extension: &str) -> ReadError {
    ReadError::Foreign { found: format!("a mesh of triangles (.{extension})"), export: MESH }
}

/// The kind of an archive that is not read, by the names in it.
pub(super) fn archive(names: &[String]) -> ReadError {
    let has = |test: &dyn Fn(&str) -> bool| names.iter().any(|name| test(&name.to_ascii_lowercase()));
    let (found, export) = if has(&|n| n.starts_with("word/")) {
        ("a Word document".to_string(), "save the table as plain text")
    } else if has(&|n| n.ends_with(".npy")) {
        (
            "a NumPy archive of several arrays (.npz)".into(),
            "save the heights alone by np.save(\"map.npy\", heights)",
        )
    } else {
        let shown: Vec<&str> = names.iter().take(3).map(String::as_str).collect();
        (
            format!("an archive of {}", if shown.is_empty() { "nothing".into() } else { shown.join(", ") }),
            "unpack it and give the file of the surface itself; an x3p holds a main.xml",
        )
    };
    ReadError::Foreign { found, export }
}
