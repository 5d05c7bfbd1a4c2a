//! SDF of ISO 25178-71 (and its ancestor BCR): ASCII or binary, all lengths in metres.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError};
use std::path::Path;

const FORMAT: Format = Format("sdf");
const BINARY_HEADER: usize = 81;

/// Reads either kind.
pub(super) fn read(path: &Path) -> Result<Measured, ReadError> {
    let data = std::fs::read(path)?;
    if data.first() == Some(&b'b') { binary(&data) } else { ascii(&String::from_utf8_lossy(&data)) }
}

/// Content of both headers.
struct Header {
    columns: u64,
    rows: u64,
    pixel: [f64; 2],
    scale: f64,
}

impl Header {
    fn measured(self, mut heights: Vec<f64>) -> Result<Measured, ReadError> {
        let pixel = [FORMAT.positive("Xscale", self.pixel[0])?, FORMAT.positive("Yscale", self.pixel[1])?];
        let scale = FORMAT.positive("Zscale", self.scale)?;
        heights.iter_mut().for_each(|z| *z *= scale);
        Ok(Measured::in_metres(self.columns, self.rows, pixel, heights))
    }
}

fn binary(data: &[u8]) -> Result<Measured, ReadError> {
    let file = Bytes { format: FORMAT, data };
    let header = Header {
        columns: file.number(Number::U16, 42)? as u64,
        rows: file.number(Number::U16, 44)? as u64,
        pixel: [file.number(Number::F64, 46)?, file.number(Number::F64, 54)?],
        scale: file.number(Number::F64, 62)?,
    };
    let (compression, kind) = (file.slice("header", 78, 1)?[0], file.slice("header", 79, 1)?[0]);
    if compression != 0 {
        return Err(FORMAT.header("Compression", compression, "only 0 (none) is known"));
    }
    // (type, what stands for a missing point)
    let (number, missing) = match kind {
        0 => (Number::U8, f64::from(u8::MAX)),
        1 => (Number::U16, f64::from(u16::MAX)),
        2 => (Number::U32, f64::from(u32::MAX)),
        3 => (Number::F32, f64::from(f32::MAX)),
        4 => (Number::I8, f64::from(i8::MIN)),
        5 => (Number::I16, f64::from(i16::MIN)),
        6 => (Number::I32, f64::from(i32::MIN)),
        7 => (Number::F64, f64::MAX),
        _ => return Err(FORMAT.header("DataType", kind, "it must be 0 to 7")),
    };
    let count = FORMAT.nodes(header.columns, header.rows)?;
    let raw = file.slice("heights", BINARY_HEADER, count * number.size())?;
    let mut heights = number.decode_all(raw, count);
    heights.iter_mut().filter(|z| z.abs() >= missing.abs() && **z == missing.copysign(**z)).for_each(|z| {
        if *z == missing || matches!(number, Number::F32 | Number::F64) {
            *z = f64::NAN;
        }
    });
    header.measured(heights)
}

fn ascii(text: &str) -> Result<Measured, ReadError> {
    // a line with a star ends the header, another one the heights; a comment may hold stars too
    let is_end = |line: &&str| line.trim() == "*";
    let lines: Vec<&str> = text.lines().collect();
    let length = text.len() as u64;
    let end = lines.iter().position(is_end).ok_or(FORMAT.truncated("header", length + 1, length))?;
    let (head, body) = lines.split_at(end);
    let body = body[1..].iter().take_while(|line| !is_end(line)).flat_map(|line| line.split_whitespace());
    let value = |name: &'static str| -> Result<f64, ReadError> {
        let mut pairs = head.iter().filter_map(|l| l.split_once('='));
        let line = pairs.find(|(key, _)| key.trim().eq_ignore_ascii_case(name));
        let value = line.map_or("", |(_, value)| value.trim());
        value.parse().map_err(|_| FORMAT.header(name, format!("\"{value}\""), "it must be a number"))
    };
    let size = |name: &'static str| {
        let size = value(name)?;
        let whole = (1.0..1e9).contains(&size) && size.fract() == 0.0;
        let refused = || FORMAT.header(name, size, "it must be a whole number of points");
        whole.then_some(size as u64).ok_or_else(refused)
    };
    let header = Header {
        columns: size("NumPoints")?,
        rows: size("NumProfiles")?,
        pixel: [value("Xscale")?, value("Yscale")?],
        scale: value("Zscale")?,
    };
    let count = FORMAT.nodes(header.columns, header.rows)?;
    let mut heights = Vec::new();
    for word in body.take(count) {
        heights.push(match word {
            "BAD" => f64::NAN,
            word => word.parse().map_err(|_| {
                FORMAT.header("a height", format!("\"{word}\""), "heights are numbers or BAD")
            })?,
        });
    }
    if heights.len() < count {
        return Err(FORMAT.truncated("heights (as numbers)", count as u64, heights.len() as u64));
    }
    header.measured(heights)
}
