//! Keyence: `.vk3` and `.vk4` of laser microscopes, `.vk6` and `.vk7` with the same in an archive, `.zon` of
//! the VR series. Little-endian. Sources: OSTI 1419732 (vk4); the layouts that SurfaceTopography (MIT)
//! documents.

use super::archive::Archive;
use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use roxmltree::Document;
use std::path::Path;

const VK: Format = Format("vk");
const ZON: Format = Format("zon");
/// The member of an archive that is a file of version 4.
const MEMBER: &str = "Vk4File";
/// Members of a `.zon`: heights, which of them are valid, calibration.
const HEIGHTS: &str = "4cdb0c75-5706-48cc-a9a1-adf395d609ae";
const VALID: &str = "9e7ca6dd-0e6a-4d7b-8986-f0a7b773c916";
const UNITS: &str = "686613b8-27b5-4a29-8ffc-438c2780873e";
/// Bits of a point that has no height: out of range, left out by the operator.
const INVALID: u8 = 3;
const PICOMETRE: f64 = 1e-12;

/// Reads a file of version 3 or 4.
pub(super) fn read_vk4(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    vk4(&request.read_file(path)?, request)
}

/// Reads an archive of version 6 or 7.
pub(super) fn read_vk6(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut archive = Archive::open(VK, path)?;
    vk4(&archive.member(MEMBER, request.memory())?, request)
}

fn vk4(data: &[u8], request: &Request<'_>) -> Result<Measured, ReadError> {
    let file = Bytes { format: VK, data };
    let is_known = data.starts_with(b"VK4_") || data.starts_with(b"VK3_");
    if !is_known {
        return Err(VK.header("beginning", file.text(0, 4)?, "it must be VK3_ or VK4_"));
    }
    // places of the parts stand in a table behind 12 bytes, places in the conditions are counted in words
    let number = |place: usize| file.number(Number::U32, place).map(|n| n as usize);
    let settings = number(12)?;
    let map = number(36)?;
    if map == 0 {
        return Err(VK.header(
            "place of the heights",
            0,
            "the file holds pictures alone: save it with its heights",
        ));
    }
    let step = |name, word: usize| -> Result<f64, ReadError> {
        Ok(VK.positive(name, number(settings.saturating_add(4 * word))? as f64)? * PICOMETRE)
    };
    let pixel = [step("length of a pixel along x", 42)?, step("length of a pixel along y", 43)?];
    let up = step("height of a digit", 44)?;
    let word = |k: usize| number(map.saturating_add(4 * k));
    let (columns, rows) = (word(0)? as u64, word(1)? as u64);
    let kind = match word(2)? {
        8 => Number::U8,
        16 => Number::U16,
        32 => Number::U32,
        bits => return Err(VK.header("bits of a point", bits, "it must be 8, 16 or 32")),
    };
    if word(3)? != 0 {
        return Err(VK.header("compression", word(3)?, "only 0 (none) is known"));
    }
    let count = VK.nodes_within(columns, rows, kind.size(), request)?;
    // a palette of 768 bytes lies between the sizes and the heights
    let raw = file.slice("heights", map.saturating_add(28 + 768), count * kind.size())?;
    let mut heights = kind.decode_all(raw, count);
    heights.iter_mut().for_each(|z| *z *= up);
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

/// Reads a `.zon`.
pub(super) fn read_zon(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let mut archive = Archive::open(ZON, path)?;
    let xml = archive.text(UNITS)?;
    let xml = Document::parse(&xml).map_err(|e| ZON.header("calibration", e, "it must be XML"))?;
    let length = |name: &'static str| {
        let node = xml.descendants().find(|node| node.has_tag_name(name));
        let text = node.and_then(|node| node.text()).unwrap_or("").trim();
        let length = text.parse().map_err(|_| ZON.header(name, text, "it must be a number"))?;
        ZON.positive(name, length)
    };
    let (along, up) = (length("MeterPerPixel")?, length("MeterPerUnit")?);
    let data = archive.member(HEIGHTS, request.memory())?;
    let (columns, rows, mut heights) = zon_map(&data, Number::I32, request)?;
    heights.iter_mut().for_each(|z| *z *= up);
    if archive.has(VALID) {
        let flags = archive.member(VALID, request.memory())?;
        let (across, down, flags) = zon_map(&flags, Number::U8, request)?;
        if (across, down) != (columns, rows) {
            let found = format_args!("{across} x {down} points");
            return Err(ZON.header("size of the valid points", found, "it must be that of the heights"));
        }
        let pairs = heights.iter_mut().zip(flags);
        pairs.filter(|(_, flag)| *flag as u8 & INVALID != 0).for_each(|(z, _)| *z = f64::NAN);
    }
    Ok(Measured::in_metres(columns, rows, [along; 2], heights))
}

/// A map of a `.zon`: columns, rows, bytes of a point and of a row, then rows.
fn zon_map(data: &[u8], kind: Number, request: &Request<'_>) -> Result<(u64, u64, Vec<f64>), ReadError> {
    let file = Bytes { format: ZON, data };
    let word = |k: usize| file.number(Number::I32, 4 * k).map(|n| n.max(0.0) as usize);
    let (columns, rows, size, stride) = (word(0)?, word(1)?, word(2)?, word(3)?);
    if size != kind.size() {
        return Err(ZON.header("bytes of a point", size, "heights have 4, marks of valid points 1"));
    }
    let count = ZON.nodes_within(columns as u64, rows as u64, size, request)?;
    if stride < columns * size {
        return Err(ZON.header("bytes of a row", stride, "it must hold the points of a row"));
    }
    let raw = file.slice("heights", 16, stride.saturating_mul(rows))?;
    let mut out = vec![0.0; count];
    out.chunks_mut(columns).zip(raw.chunks(stride)).for_each(|(out, raw)| kind.decode(raw, false, out));
    Ok((columns as u64, rows as u64, out))
}
