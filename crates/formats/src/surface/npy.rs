//! NumPy arrays: two dimensions, axis 0 is y.

use super::bytes::Number;
use super::measured::{Format, Measured, ReadError, Request, Spacing};
use asperity_numerics::transpose::transposed;
use npyz::{DType, Endianness, NpyHeader, Order, TypeChar, WriterBuilder};
use rayon::prelude::*;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, SeekFrom};
use std::path::Path;

const FORMAT: Format = Format("npy");
/// A header longer than this describes no plain array.
const LONGEST_HEADER: usize = 1 << 14;
/// Heights that one task reads at a time.
const CHUNK: usize = 1 << 20;

/// The text of the header, its length with the magic, checked so that a parser can be let loose on it.
fn header_bytes(path: &Path, length: u64) -> Result<Vec<u8>, ReadError> {
    let mut reader = BufReader::new(File::open(path)?);
    let mut start = vec![0; 12.min(length as usize)];
    reader.read_exact(&mut start)?;
    if start.len() < 12 {
        return Err(FORMAT.truncated("header", 12, length));
    }
    let text = match start[6] {
        1 => usize::from(u16::from_le_bytes([start[8], start[9]])) + 10,
        2 | 3 => u32::from_le_bytes([start[8], start[9], start[10], start[11]]) as usize + 12,
        v => return Err(FORMAT.header("version", v, "versions 1, 2 and 3 are known")),
    };
    if text as u64 > length {
        return Err(FORMAT.truncated("header", text as u64, length));
    }
    if text > LONGEST_HEADER {
        return Err(FORMAT.header("length", text, "a plain array has a header below 16384 bytes"));
    }
    let mut header = vec![0; text];
    reader.seek(SeekFrom::Start(0))?;
    reader.read_exact(&mut header)?;
    plausible(&header)?;
    Ok(header)
}

/// Refuses what is nested or has other than two sizes below 1e9, before the header is parsed.
fn plausible(header: &[u8]) -> Result<(), ReadError> {
    let text = String::from_utf8_lossy(header);
    if text.matches(['(', '[', '{']).count() > 2 {
        return Err(FORMAT.header("descr", "a record", "heights must be plain numbers"));
    }
    let shape = text.split("shape").nth(1).unwrap_or("");
    let shape = shape.split(')').next().unwrap_or("");
    let sizes: Vec<&str> = shape.split(|c: char| !c.is_ascii_digit()).filter(|s| !s.is_empty()).collect();
    if sizes.len() != 2 || sizes.iter().any(|s| s.len() > 9) {
        let value = if sizes.is_empty() { "?".into() } else { sizes.join(" x ") };
        return Err(FORMAT.header("shape", value, "a map has two dimensions, (y, x), each below 1000000000"));
    }
    Ok(())
}

fn number(dtype: &DType) -> Result<(Number, bool), ReadError> {
    let refused = || {
        FORMAT.header(
            "descr",
            dtype.descr(),
            "heights must be real numbers of 1, 2, 4 or 8 bytes (f2-f8, i1-i8, u1-u8)",
        )
    };
    let DType::Plain(kind) = dtype else { return Err(refused()) };
    let number = match (kind.type_char(), kind.size_field()) {
        (TypeChar::Float, 2) => Number::F16,
        (TypeChar::Float, 4) => Number::F32,
        (TypeChar::Float, 8) => Number::F64,
        (TypeChar::Int, 1) => Number::I8,
        (TypeChar::Int, 2) => Number::I16,
        (TypeChar::Int, 4) => Number::I32,
        (TypeChar::Int, 8) => Number::I64,
        (TypeChar::Uint, 1) => Number::U8,
        (TypeChar::Uint, 2) => Number::U16,
        (TypeChar::Uint, 4) => Number::U32,
        (TypeChar::Uint, 8) => Number::U64,
        _ => return Err(refused()),
    };
    Ok((number, kind.endianness() == Endianness::Big))
}

/// Reads an array; several tasks read and decode parts of the file at once.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let length = std::fs::metadata(path)?.len();
    let bytes = header_bytes(path, length)?;
    let header = NpyHeader::from_reader(&bytes[..])
        .map_err(|e| FORMAT.header("dictionary", e, "it must be one that numpy.save writes"))?;
    let (number, big_endian) = number(&header.dtype())?;
    let &[rows, columns] = header.shape() else {
        return Err(FORMAT.header(
            "shape",
            format!("{:?}", header.shape()),
            "a map has two dimensions, (y, x)",
        ));
    };
    // parts are decoded one after the other: the bytes of the file are never held together
    let count = FORMAT.nodes_within(columns, rows, 0, request)?;
    let start = bytes.len() as u64;
    let promised = count as u64 * number.size() as u64;
    if length - start < promised {
        return Err(FORMAT.truncated("heights", promised, length - start));
    }
    let mut heights = vec![0.0; count];
    heights.par_chunks_mut(CHUNK).enumerate().try_for_each(|(i, part)| -> Result<(), ReadError> {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start(start + (i * CHUNK * number.size()) as u64))?;
        if number == Number::F64 && !big_endian && cfg!(target_endian = "little") {
            file.read_exact(bytemuck::cast_slice_mut(part))?;
        } else {
            let mut raw = vec![0; part.len() * number.size()];
            file.read_exact(&mut raw)?;
            number.decode(&raw, big_endian, part);
        }
        Ok(())
    })?;
    let (columns, rows) = (columns as usize, rows as usize);
    if header.order() == Order::Fortran {
        heights = transposed(&heights, rows);
    }
    Ok(Measured {
        columns,
        rows,
        heights,
        spacing: Spacing::Unknown,
        spacing_error: 0.0,
        height_unit: None,
        notes: Vec::new(),
    })
}

/// Writes heights as an array of f64, axis 0 = y.
pub fn write_npy(path: &Path, columns: usize, rows: usize, heights: &[f64]) -> std::io::Result<()> {
    let mut writer = npyz::WriteOptions::new()
        .default_dtype()
        .shape(&[rows as u64, columns as u64])
        .writer(BufWriter::new(File::create(path)?))
        .begin_nd()?;
    npyz::NpyWriter::extend(&mut writer, heights.iter().copied())?;
    writer.finish()?;
    Ok(())
}
