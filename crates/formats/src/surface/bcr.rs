//! BCR-STM `.bcr` and `.bcrf`: lines `key = value` in 2048 characters or as many as `headersize` says, then
//! heights row by row, in 16-bit integers (bcrstm) or 32-bit floats (bcrf).
//! Source: Image Metrology, SPIP reference guide, "BCR-STM File Format"; for the mark of a void pixel and the
//! row where the file begins, what SurfaceTopography (MIT) and Gwyddion read.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use crate::text::decode;
use std::path::Path;

const FORMAT: Format = Format("bcr");
/// Beginnings of the first line, whose characters have one byte or two.
pub(super) const MAGICS: [&[u8]; 4] = [
    b"fileformat = bcr",
    b"fileformat=bcr",
    b"f\0i\0l\0e\0f\0o\0r\0m\0a\0t\0 \0=\0 \0b\0c\0r\0",
    b"\xff\xfef\0i\0l\0e\0f\0o\0r\0m\0a\0t\0",
];
/// Characters of a header that does not name their number.
const HEADER: f64 = 2048.0;
/// The integer of a void pixel, and the least float of one.
const VOID: [f64; 2] = [32767.0, 1e37];

/// Reads the image; values that are no lengths are refused.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let mark = usize::from(data.starts_with(&[0xff, 0xfe])) * 2;
    let width = if data.get(mark + 1) == Some(&0) { 2 } else { 1 };
    let start = &data[mark..data.len().min(mark + HEADER as usize * width)];
    let printed: Vec<u8> =
        start.iter().step_by(width).copied().take_while(|b| *b >= b' ' || b.is_ascii_whitespace()).collect();
    let header = decode(&printed).map(|(text, _)| text.into_owned()).unwrap_or_default();
    let words = |name: &str| {
        let mut pairs = header.lines().filter_map(|line| line.split_once('='));
        pairs.find(|(key, _)| key.trim().eq_ignore_ascii_case(name)).map_or("", |(_, value)| value.trim())
    };
    let number = |name: &'static str, absent: Option<f64>| -> Result<f64, ReadError> {
        let value = words(name);
        let read = if value.is_empty() { absent } else { value.replace(',', ".").parse().ok() };
        read.filter(|v: &f64| v.is_finite())
            .ok_or_else(|| FORMAT.header(name, format!("\"{value}\""), "it must be a number"))
    };
    let whole = |name: &'static str, absent: Option<f64>| {
        let size = number(name, absent)?;
        let is_whole = (1.0..1e9).contains(&size) && size.fract() == 0.0;
        is_whole.then_some(size as u64).ok_or_else(|| FORMAT.header(name, size, "it must be a whole number"))
    };
    let unit = |name: &'static str| {
        let unit = if words(name).is_empty() { "nm" } else { words(name) };
        let allowed = "it must be a unit of length: export the channel of heights";
        Dimension::Length.scale(unit).ok_or_else(|| FORMAT.header(name, format!("\"{unit}\""), allowed))
    };
    let (columns, rows) = (whole("xpixels", None)?, whole("ypixels", None)?);
    let is_float = words("fileformat").starts_with("bcrf");
    let (kind, void) = if is_float { (Number::F32, VOID[1]) } else { (Number::I16, VOID[0]) };
    let count = FORMAT.nodes_within(columns, rows, kind.size(), request)?;
    let step = FORMAT.positive("bit2nm", number("bit2nm", Some(1.0))?)?;
    if is_float && step != 1.0 && !request.override_file {
        let allowed = "programs differ on whether heights in floating point are to be multiplied by it: export .sur, .x3p or \
                       .bcr, or set override = true if they are in zunit as they stand";
        return Err(FORMAT.header("bit2nm", step, allowed));
    }
    let side = |name: &'static str, axis: &'static str, points: u64| -> Result<f64, ReadError> {
        Ok(FORMAT.positive(name, number(name, None)?)? * unit(axis)? / points as f64)
    };
    let pixel = [side("xlength", "xunit", columns)?, side("ylength", "yunit", rows)?];
    let file = Bytes { format: FORMAT, data: &data };
    let start = mark + whole("headersize", Some(HEADER))? as usize * width;
    let mut heights = kind.decode_all_ordered(
        file.slice("heights", start, count * kind.size())?,
        count,
        words("intelmode") == "0",
    );
    let has_void = is_float || number("voidpixels", Some(0.0))? != 0.0;
    let step = if is_float { 1.0 } else { step };
    for z in &mut heights {
        *z = if has_void && *z >= void || !z.is_finite() { f64::NAN } else { *z * step };
    }
    Ok(Measured { height_unit: Some(unit("zunit")?), ..Measured::in_metres(columns, rows, pixel, heights) })
}
