//! Formats that are known by their first bytes but not read: their names, and an export that is read.

use super::measured::ReadError;

/// Bytes of the beginning of a file that tell its kind.
pub(super) const LOOKED_AT: u64 = 1024;

const SUR: &str =
    "export it as .sur, .x3p or text in its own program, or open it in Gwyddion and save it as .gwy or .gsf";
const PICTURE: &str = "colours are not heights: export the heights as .sur, .x3p or text";
const SHEET: &str = "save the sheet as CSV";

/// Beginning, name, and what to do.
const KINDS: [(&[u8], &str, &str); 25] = [
    (b"\x89PNG", "a PNG picture", PICTURE),
    (b"\xff\xd8\xff", "a JPEG picture", PICTURE),
    (b"GIF8", "a GIF picture", PICTURE),
    (b"BM", "a BMP picture", PICTURE),
    (b"%PDF", "a PDF document", "export the heights as .sur, .x3p or text"),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "a file of old Microsoft Office or of an instrument that stores so (.xls, .doc, .oir)",
        SHEET,
    ),
    (b"\x89HDF\r\n\x1a\n", "an HDF5 file (.datx of Zygo, .h5, .nid)", SUR),
    (b"CDF\x01", "a NetCDF file (.nc)", "save the heights by np.save(\"map.npy\", heights)"),
    (b"CDF\x02", "a NetCDF file (.nc)", "save the heights by np.save(\"map.npy\", heights)"),
    (b"VK4_", "a Keyence VK measurement (.vk4)", "export its heights as CSV in the VK analyzer"),
    (b"VK6", "a Keyence VK-X measurement (.vk6)", "export its heights as CSV in the MultiFileAnalyzer"),
    (b"VK7", "a Keyence VK-X measurement (.vk7)", "export its heights as CSV in the MultiFileAnalyzer"),
    (b"KPK0", "a Keyence VR measurement (.zon)", "export its heights as CSV in the analyzer"),
    (
        b"\x01\x00Directory",
        "a Wyko/Vision measurement (.opd)",
        "save it as ASCII (.asc), .sur or .sdf in Vision64",
    ),
    (
        b"\x01\x00",
        "a binary file, perhaps of Wyko/Vision (.opd)",
        "save it as ASCII (.asc), .sur or .sdf in Vision64",
    ),
    (b"\xca\xfe\xba\xbe", "a Bruker measurement (.opdx)", "save it as ASCII, .sur or .sdf in Vision64"),
    (
        b"VCA DATA\x01\x00\x00\x55",
        "a Bruker measurement (.opdx)",
        "save it as ASCII, .sur or .sdf in Vision64",
    ),
    (
        b"\\*File list",
        "a NanoScope measurement (.spm)",
        "export its heights as ASCII in NanoScope Analysis, with units",
    ),
    (
        b"\\*Force file list",
        "a NanoScope force curve (.spm)",
        "export the curve as ASCII for asperity identify",
    ),
    (
        b"\x88\x1b\x03\x6f",
        "a MetroPro measurement of Zygo (.dat)",
        "export it as .xyz or .sdf in MetroPro or Mx",
    ),
    (
        b"\x88\x1b\x03\x70",
        "a MetroPro measurement of Zygo (.dat)",
        "export it as .xyz or .sdf in MetroPro or Mx",
    ),
    (
        b"\x88\x1b\x03\x71",
        "a MetroPro measurement of Zygo (.dat)",
        "export it as .xyz or .sdf in MetroPro or Mx",
    ),
    (b"Rar!", "a RAR archive", "unpack it and give the file of the surface itself"),
    (b"7z\xbc\xaf", "a 7z archive", "unpack it and give the file of the surface itself"),
    (b"\x1f\x8b", "a gzip archive", "unpack it and give the file of the surface itself"),
];

/// The error that names a format by its beginning.
pub(super) fn named(start: &[u8]) -> Option<ReadError> {
    if let Some(error) = named_tiff(start) {
        return Some(error);
    }
    let (_, found, export) = KINDS.iter().find(|(magic, ..)| start.starts_with(magic))?;
    Some(ReadError::Foreign { found: (*found).into(), export })
}

/// A TIFF file, which may hold heights.
fn named_tiff(start: &[u8]) -> Option<ReadError> {
    let is_tiff = [&b"II*\0"[..], b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| start.starts_with(magic));
    is_tiff.then(|| ReadError::Foreign {
        found: "a TIFF file".into(),
        export: "if it holds heights as numbers of 32 bits, save them by np.save(\"map.npy\", tifffile.imread(\"map.tif\")) or export .sur; a picture's colours are not heights",
    })
}
