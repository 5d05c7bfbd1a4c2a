//! SDF of ISO 25178-71, versions 1.0 and 2.0, its ancestor BCR and the form of NIST: ASCII or binary, all
//! lengths in metres.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use std::path::Path;

const FORMAT: Format = Format("sdf");
/// Beginnings behind the letter for ASCII or binary.
pub(super) const VERSIONS: [&str; 4] = ["ISO-1.0", "ISO-2.0", "NIST-1.0", "BCR-1.0"];
/// Bytes of a binary header whose numbers of points have two bytes each.
const BINARY_HEADER: usize = 81;

/// Reads either kind.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    if data.first() == Some(&b'b') {
        binary(&data, request)
    } else {
        ascii(&String::from_utf8_lossy(&data), request)
    }
}

/// The number that stands for a missing point. ISO takes the smallest of a signed type, its ancestor BCR the
/// largest; of unsigned types and floats both take the largest.
fn missing_number(number: Number, is_bcr: bool) -> f64 {
    let signed = |smallest: f64| if is_bcr { -1.0 - smallest } else { smallest };
    match number {
        Number::U8 => f64::from(u8::MAX),
        Number::U16 => f64::from(u16::MAX),
        Number::U32 => f64::from(u32::MAX),
        Number::I8 => signed(f64::from(i8::MIN)),
        Number::I16 => signed(f64::from(i16::MIN)),
        Number::I32 => signed(f64::from(i32::MIN)),
        Number::F32 => 3.4e38,
        _ => 1.7e308,
    }
}

/// Puts NaN where a point is missing.
fn mark_missing(heights: &mut [f64], number: Number, is_bcr: bool) {
    let missing = missing_number(number, is_bcr);
    let is_float = matches!(number, Number::F32 | Number::F64);
    let is_missing = |z: f64| if is_float { z.abs() >= missing } else { z == missing };
    heights.iter_mut().filter(|z| is_missing(**z)).for_each(|z| *z = f64::NAN);
}

/// The type of the heights by its number.
fn number_of(kind: f64) -> Option<Number> {
    let types = [
        Number::U8,
        Number::U16,
        Number::U32,
        Number::F32,
        Number::I8,
        Number::I16,
        Number::I32,
        Number::F64,
    ];
    (kind.fract() == 0.0 && kind >= 0.0).then(|| types.get(kind as usize).copied()).flatten()
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

fn binary(data: &[u8], request: &Request<'_>) -> Result<Measured, ReadError> {
    let file = Bytes { format: FORMAT, data };
    // the second version has four bytes for each number of points
    let (size, wide) = if data[1..].starts_with(b"ISO-2.0") { (Number::U32, 4) } else { (Number::U16, 0) };
    let header = Header {
        columns: file.number(size, 42)? as u64,
        rows: file.number(size, 42 + size.size())? as u64,
        pixel: [file.number(Number::F64, 46 + wide)?, file.number(Number::F64, 54 + wide)?],
        scale: file.number(Number::F64, 62 + wide)?,
    };
    let byte = |place: usize| Ok::<u8, ReadError>(file.slice("header", place + wide, 1)?[0]);
    let (compression, kind) = (byte(78)?, byte(79)?);
    if compression != 0 {
        return Err(FORMAT.header("Compression", compression, "only 0 (none) is known"));
    }
    let number =
        number_of(f64::from(kind)).ok_or_else(|| FORMAT.header("DataType", kind, "it must be 0 to 7"))?;
    let count = FORMAT.nodes_within(header.columns, header.rows, number.size(), request)?;
    let raw = file.slice("heights", BINARY_HEADER + wide, count * number.size())?;
    let mut heights = number.decode_all(raw, count);
    mark_missing(&mut heights, number, data[1..].starts_with(b"BCR"));
    header.measured(heights)
}

fn ascii(text: &str, request: &Request<'_>) -> Result<Measured, ReadError> {
    // a line with a star ends the header, another one the heights; a comment may hold stars too
    let is_end = |line: &&str| line.trim() == "*";
    let lines: Vec<&str> = text.lines().collect();
    let length = text.len() as u64;
    let end = lines.iter().position(is_end).ok_or(FORMAT.truncated("header", length + 1, length))?;
    let (head, body) = lines.split_at(end);
    let body = body[1..].iter().take_while(|line| !is_end(line)).flat_map(|line| line.split_whitespace());
    let words = |name: &str| {
        // a semicolon begins a comment
        let lines = head.iter().map(|line| line.split(';').next().unwrap_or(""));
        let mut pairs = lines.filter_map(|line| line.split_once('='));
        let line = pairs.find(|(key, _)| key.trim().eq_ignore_ascii_case(name));
        line.map_or("", |(_, value)| value.trim())
    };
    let value = |name: &'static str| -> Result<f64, ReadError> {
        let value = words(name);
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
    let count = FORMAT.nodes_within(header.columns, header.rows, 0, request)?;
    if count as u64 * 2 > length + 1 {
        return Err(FORMAT.truncated("heights (as text)", count as u64 * 2, length));
    }
    let number = match words("DataType").to_ascii_uppercase().as_str() {
        "INTEGER" => Some(Number::I32),
        "FLOAT" | "REAL" | "SINGLE" => Some(Number::F32),
        "" | "DOUBLE" => Some(Number::F64),
        kind => kind.parse().ok().and_then(number_of),
    };
    let number = number.ok_or_else(|| FORMAT.header("DataType", words("DataType"), "it must be 0 to 7"))?;
    let mut heights = Vec::new();
    for word in body.take(count) {
        heights.push(match word {
            word if word.eq_ignore_ascii_case("bad") => f64::NAN,
            word => word.parse().map_err(|_| {
                FORMAT.header("a height", format!("\"{word}\""), "heights are numbers or BAD")
            })?,
        });
    }
    if heights.len() < count {
        return Err(FORMAT.truncated("heights (as numbers)", count as u64, heights.len() as u64));
    }
    // BCR has no word for a missing point: the number says so in ASCII too
    if text.get(1..8) == Some("BCR-1.0") {
        let fits_short = heights.iter().all(|z| z.is_nan() || z.abs() <= f64::from(i16::MAX));
        let is_short = number == Number::I32 && fits_short;
        mark_missing(&mut heights, if is_short { Number::I16 } else { number }, true);
    }
    header.measured(heights)
}
