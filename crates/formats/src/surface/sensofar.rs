//! Sensofar `.plu` (a header of 500 bytes, layers of 32-bit floats, little-endian) and `.plux` (an archive of
//! index.xml and layers). Lengths in micrometres. Sources: the layouts that SurfaceTopography (MIT)
//! documents.

use super::archive::Archive;
use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use roxmltree::Document;
use std::path::Path;

const PLU: Format = Format("plu");
const PLUX: Format = Format("plux");
const MICROMETRE: f64 = 1e-6;
const HEADER: usize = 500;
/// Kind of a measurement that is a map.
const TOPOGRAPHY: f64 = 3.0;
/// The height of a point that was not measured, in a `.plu`.
const MISSING: f64 = 1_000_001.0;

/// Reads the first layer of a `.plu`, which no magic tells.
pub(super) fn read_plu(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let file = Bytes { format: PLU, data: &data };
    let kind = file.number(Number::U32, 428)?;
    if kind != TOPOGRAPHY {
        return Err(PLU.header(
            "kind of measurement",
            kind,
            "only 3, a map, can be pressed, no profile or picture",
        ));
    }
    let pixel = [
        PLU.positive("pixel along x", file.number(Number::F32, 404)?)? * MICROMETRE,
        PLU.positive("pixel along y", file.number(Number::F32, 408)?)? * MICROMETRE,
    ];
    let size = |place| file.number(Number::U32, place).map(|n| n as u64);
    let (rows, columns) = (size(388)?, size(392)?);
    // most files repeat the sizes before each layer
    let start = if [size(HEADER)?, size(HEADER + 4)?] == [rows, columns] { HEADER + 8 } else { HEADER };
    let count = PLU.nodes_within(columns, rows, 4, request)?;
    let raw = file.slice("heights", start, count * 4)?;
    let mut heights = Number::F32.decode_all(raw, count);
    heights.iter_mut().for_each(|z| *z = if *z < MISSING { *z * MICROMETRE } else { f64::NAN });
    let mut map = Measured::in_metres(columns, rows, pixel, heights);
    let layers = file.slice("header", 489, 1)?[0];
    if layers > 1 {
        map.notes.push(format!("of its {layers} layers the first was read"));
    }
    Ok(map)
}

/// Reads the first layer of a `.plux`.
pub(super) fn read_plux(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut archive = Archive::open(PLUX, path)?;
    let xml = archive.text("index.xml")?;
    let xml = Document::parse(&xml).map_err(|e| PLUX.header("index.xml", e, "it must be XML"))?;
    let text = |place: &'static str| {
        let mut node = Some(xml.root_element());
        for name in place.split('/') {
            node = node.and_then(|node| node.children().find(|child| child.has_tag_name(name)));
        }
        node.and_then(|node| node.text()).map(str::trim)
    };
    let number = |name: &'static str| -> Result<f64, ReadError> {
        let value = text(name).unwrap_or("");
        let number =
            value.parse().map_err(|_| PLUX.header(name, format!("\"{value}\""), "it must be a number"))?;
        PLUX.positive(name, number)
    };
    let (columns, rows) = (number("GENERAL/IMAGE_SIZE_X")? as u64, number("GENERAL/IMAGE_SIZE_Y")? as u64);
    let pixel = [number("GENERAL/FOV_X")? * MICROMETRE, number("GENERAL/FOV_Y")? * MICROMETRE];
    let count = PLUX.nodes_within(columns, rows, 4, request)?;
    let layer = text("LAYER_0/FILENAME_Z").filter(|name| !name.is_empty());
    let layer = layer.ok_or_else(|| {
        PLUX.header("LAYER_0/FILENAME_Z", "nothing", "a file of pictures alone has no heights")
    })?;
    let raw = archive.member(layer, count as u64 * 4)?;
    let raw = Bytes { format: PLUX, data: &raw };
    let mut heights = Number::F32.decode_all(raw.slice("heights", 0, count * 4)?, count);
    heights.iter_mut().for_each(|z| *z = if z.is_finite() { *z * MICROMETRE } else { f64::NAN });
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}
