//! Wyko/Vision `.opd`: a directory of blocks (name, type, length), then the blocks in its order; heights in
//! parts of the wavelength, column by column from the bottom up. Little-endian.
//! Sources: the layout that SurfaceTopography (MIT) documents for files of Vision.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request, Spacing};
use std::path::Path;

const FORMAT: Format = Format("opd");
/// A file begins so.
pub(super) const MAGIC: &[u8] = b"\x01\x00Directory";
/// Bytes before the directory, and of one of its entries.
const START: usize = 2;
const ENTRY: usize = 24;
/// Names of blocks that hold heights.
const HEIGHTS: [&str; 5] = ["RAW DATA", "RAW_DATA", "OPD", "Raw", "SAMPLE_DATA"];
/// Kind of a block of numbers of a map.
const ARRAY: f64 = 3.0;

/// Place and length of a block.
struct Block {
    name: String,
    kind: f64,
    start: usize,
    length: usize,
}

/// Reads the first block of heights.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let file = Bytes { format: FORMAT, data: &data };
    let blocks = blocks(&file)?;
    let number = |name: &str| -> Result<Option<f64>, ReadError> {
        let Some(block) = blocks.iter().find(|block| block.name == name) else { return Ok(None) };
        let number = match (block.kind as i32, block.length) {
            (6, 2) | (7, 2) => Number::I16,
            (6 | 12, _) => Number::I32,
            (8, _) => Number::F64,
            _ => Number::F32,
        };
        file.number(number, block.start).map(Some)
    };
    let is_map = |block: &&Block| HEIGHTS.contains(&block.name.as_str()) && block.kind == ARRAY;
    let map = blocks.iter().find(is_map);
    let map = map.ok_or_else(|| {
        let names: Vec<&str> = blocks.iter().map(|block| block.name.as_str()).collect();
        FORMAT.header("blocks", names.join(", "), "one must hold heights (RAW_DATA, OPD, SAMPLE_DATA)")
    })?;
    let size = |k: usize| file.number(Number::U16, map.start + 2 * k);
    let (columns, rows) = (size(0)? as usize, size(1)? as usize);
    // a number from here on means that nothing was measured
    let (kind, missing) = match size(2)? {
        2.0 => (Number::I16, 32766.0),
        4.0 => (Number::F32, 1e37),
        bytes => return Err(FORMAT.header("bytes of a point", bytes, "heights have 2 or 4")),
    };
    let count = FORMAT.nodes_within(columns as u64, rows as u64, kind.size() + 8, request)?;
    if count * kind.size() + 6 > map.length {
        return Err(FORMAT.truncated("heights", (count * kind.size() + 6) as u64, map.length as u64));
    }
    let raw = kind.decode_all(file.slice("heights", map.start + 6, count * kind.size())?, count);
    let wavelength = number("Wavelength")?.ok_or_else(|| {
        FORMAT.header("Wavelength", "nothing", "heights are parts of it: export .sur or ASCII")
    })?;
    let step = FORMAT.positive("Wavelength", wavelength)? * 1e-9
        / FORMAT.positive("Mult", number("Mult")?.unwrap_or(1.0))?;
    let place = |i: usize| i % columns * rows + rows - 1 - i / columns;
    let value = |z: f64| if z.is_finite() && z < missing { z * step } else { f64::NAN };
    let heights = (0..count).map(|i| value(raw[place(i)])).collect();
    let aspect = FORMAT.positive("Aspect", number("Aspect")?.unwrap_or(1.0))?;
    let spacing = match number("Pixel_size")? {
        Some(size) => {
            let size = FORMAT.positive("Pixel_size", size)? * 1e-3;
            Spacing::Metres([size, size * aspect])
        }
        None => Spacing::Unknown,
    };
    Ok(Measured {
        columns,
        rows,
        heights,
        spacing,
        spacing_error: 0.0,
        height_unit: Some(1.0),
        notes: Vec::new(),
    })
}

/// The blocks that the directory names.
fn blocks(file: &Bytes<'_>) -> Result<Vec<Block>, ReadError> {
    let length =
        |entry: usize| file.number(Number::I32, START + entry * ENTRY + 18).map(|n| n.max(0.0) as usize);
    let entries = length(0)? / ENTRY;
    let mut start = START + length(0)?;
    let mut blocks = Vec::new();
    for entry in 1..entries {
        let place = START + entry * ENTRY;
        let length = length(entry)?;
        // a file may lack the blocks behind the heights
        let name = file.text(place, 16)?;
        blocks.push(Block { name, kind: file.number(Number::I16, place + 16)?, start, length });
        start = start.saturating_add(length);
    }
    Ok(blocks)
}
