//! Digital Surf `.sur`: a header of 512 bytes, a comment, a private zone, 16- or 32-bit heights;
//! little-endian.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::memory::MOST_UNPACKED;
use crate::units::Length;
use flate2::read::ZlibDecoder;
use std::io::Read;
use std::path::Path;

const HEADER: usize = 512;
const FORMAT: Format = Format("sur");

/// Types of objects that hold a surface.
const PROFILE: i16 = 1;
const SURFACE: i16 = 2;
const MULTILAYER: i16 = 8;
const INTENSITY_SURFACE: i16 = 11;
const RGB_SURFACE: i16 = 13;
const RGB_INTENSITY_SURFACE: i16 = 16;

/// Metres per unit named in a header, where µ may be of another code page.
fn metres(unit: &str) -> Option<f64> {
    let unit = unit.replace('\u{fffd}', "µ");
    Length::UNITS.iter().find(|(name, _)| *name == unit).map(|(_, metres)| *metres)
}

/// Remarks on the kind of object and on their number; refused if it holds no heights of a surface.
fn remarks_of_kind(header: &Bytes<'_>, kind: f64, rows: u64) -> Result<Vec<String>, ReadError> {
    let objects = header.number(Number::I16, 14)?;
    let mut notes = Vec::new();
    match kind as i16 {
        SURFACE if objects > 1.0 => {
            let allowed = "only one can be pressed: export the heights alone";
            return Err(FORMAT.header("number of objects", objects, allowed));
        }
        SURFACE => {}
        PROFILE if rows > 1 => notes.push(format!("its {rows} profiles side by side are a surface")),
        MULTILAYER | INTENSITY_SURFACE | RGB_SURFACE | RGB_INTENSITY_SURFACE => {
            notes.push("of its layers and pictures the first layer was read, the heights".into());
        }
        _ => {
            let allowed = "only a surface (1 of several lines, 2, 8, 11, 13, 16) can be pressed, no profile, series, image or force curve";
            return Err(FORMAT.header("object type", kind, allowed));
        }
    }
    Ok(notes)
}

/// Reads a surface; profiles, series and pictures are refused.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let header = Bytes { format: FORMAT, data: &data };
    let compressed = header.text(0, 12)? == "DSCOMPRESSED";
    let (byte_order, kind) = (header.number(Number::I16, 12)?, header.number(Number::I16, 18)?);
    if byte_order != 0.0 {
        return Err(FORMAT.header("format", byte_order, "only 0 (little-endian) is known"));
    }
    let (columns, rows) = (header.number(Number::I32, 108)? as u64, header.number(Number::I32, 112)? as u64);
    let notes = remarks_of_kind(&header, kind, rows)?;
    let points = header.number(Number::I32, 116)?;
    if points != 0.0 && points != columns as f64 * rows as f64 {
        let allowed = "it must be the product of the points of a line and the lines";
        return Err(FORMAT.header("number of points", points, allowed));
    }
    let special = header.number(Number::I16, 86)? == 1.0;
    let number = match header.number(Number::I16, 98)? {
        16.0 => Number::I16,
        32.0 => Number::I32,
        bits => return Err(FORMAT.header("size of points", bits, "it must be 16 or 32 bits")),
    };
    let lowest = header.number(Number::I32, 100)?;
    let count = FORMAT.nodes_within(columns, rows, number.size(), request)?;
    let unit = |name: &'static str, offset: usize| {
        let text = header.text(offset, 16)?;
        metres(&text).ok_or_else(|| FORMAT.header(name, text, "it must be m, cm, mm, µm, nm or pm"))
    };
    let pixel = [
        FORMAT.positive("x step", header.number(Number::F32, 120)?.abs())? * unit("x step unit", 180)?,
        FORMAT.positive("y step", header.number(Number::F32, 124)?.abs())? * unit("y step unit", 196)?,
    ];
    let step = FORMAT.positive("z step", header.number(Number::F32, 128)?)?;
    let height_unit = unit("z step unit", 212)?;
    let offset = header.number(Number::F32, 474)?;
    let offset = if offset.is_finite() { offset } else { 0.0 };
    let comment = header.number(Number::U16, 334)? as usize;
    let private = header.number(Number::U16, 336)? as usize;
    let start = HEADER + comment + private;
    let size = count * number.size();
    let unpacked;
    let raw = if compressed {
        unpacked = inflate(&header, start, size)?;
        &unpacked[..]
    } else {
        if kind as i16 == SURFACE && data.len() > start + size {
            let allowed = "the file is longer than its points: the header or the file is damaged";
            return Err(FORMAT.header("number of points", count, allowed));
        }
        header.slice("heights", start, size)?
    };
    let mut heights = number.decode_all(raw, count);
    for z in &mut heights {
        // a point that was not measured is stored two below the lowest
        *z = if special && *z == lowest - 2.0 { f64::NAN } else { *z * step + offset };
    }
    Ok(Measured {
        height_unit: Some(height_unit),
        notes,
        ..Measured::in_metres(columns, rows, pixel, heights)
    })
}

/// Heights of a compressed file: a directory of zlib streams (unpacked length, packed length), then the
/// streams.
fn inflate(file: &Bytes, start: usize, size: usize) -> Result<Vec<u8>, ReadError> {
    let streams = file.number(Number::U32, start)? as usize;
    let directory = file.slice("directory", start + 4, streams.saturating_mul(8))?;
    let directory = Bytes { format: FORMAT, data: directory };
    let most = file.data.len() as u64 * MOST_UNPACKED;
    if size as u64 > most {
        return Err(FORMAT.truncated("heights", size as u64, most));
    }
    let mut at = start + 4 + streams * 8;
    let mut out = Vec::new();
    for stream in 0..streams {
        let packed = directory.number(Number::U32, 8 * stream + 4)? as usize;
        let raw = file.slice("compressed heights", at, packed)?;
        // one byte more than the header's size, so that the end of the stream and its sum are looked at
        let room = (size - out.len()) as u64 + 1;
        let unpacked = ZlibDecoder::new(raw).take(room).read_to_end(&mut out);
        unpacked.map_err(|e| FORMAT.header("compressed heights", e, "the file is damaged"))?;
        if out.len() > size {
            let allowed = "the streams hold more than its points: the header or the file is damaged";
            return Err(FORMAT.header("number of points", size, allowed));
        }
        at += packed;
    }
    if out.len() < size {
        let found = out.len() as u64;
        return Err(FORMAT.truncated("heights", size as u64, found));
    }
    Ok(out)
}
