//! Gwyddion Simple Field `.gsf`: lines `key = value`, one to four zeros up to a multiple of four bytes, then
//! heights in 32-bit floats, row by row. Source: user guide of Gwyddion, "Gwyddion Simple Field file format".

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use std::path::Path;

const FORMAT: Format = Format("gsf");
/// The first line.
pub(super) const MAGIC: &[u8] = b"Gwyddion Simple Field 1.0\n";

/// Reads the field; values that are no lengths are refused.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let end = data.iter().position(|b| *b == 0).unwrap_or(data.len());
    let header = String::from_utf8_lossy(&data[..end]);
    let words = |name: &str| {
        let mut pairs = header.lines().filter_map(|line| line.split_once('='));
        pairs.find(|(key, _)| key.trim().eq_ignore_ascii_case(name)).map(|(_, value)| value.trim())
    };
    let number = |name: &'static str, absent: Option<f64>| -> Result<f64, ReadError> {
        let value = words(name).unwrap_or("");
        let read = if value.is_empty() { absent } else { value.parse().ok() };
        read.ok_or_else(|| FORMAT.header(name, format!("\"{value}\""), "it must be a number"))
    };
    let size = |name: &'static str| {
        let size = number(name, None)?;
        let is_whole = (1.0..1e9).contains(&size) && size.fract() == 0.0;
        is_whole
            .then_some(size as u64)
            .ok_or_else(|| FORMAT.header(name, size, "it must be a whole number of points"))
    };
    let (columns, rows) = (size("XRes")?, size("YRes")?);
    let count = FORMAT.nodes_within(columns, rows, 4, request)?;
    let unit = |name: &'static str| {
        let unit = words(name).unwrap_or("");
        Dimension::Length.scale(unit).ok_or_else(|| {
            FORMAT.header(
                name,
                format!("\"{unit}\""),
                "it must be a unit of length: export the channel of heights",
            )
        })
    };
    let (along, up) = (unit("XYUnits")?, unit("ZUnits")?);
    let real = |name: &'static str, points: u64| -> Result<f64, ReadError> {
        Ok(FORMAT.positive(name, number(name, Some(1.0))?)? / points as f64 * along)
    };
    let pixel = [real("XReal", columns)?, real("YReal", rows)?];
    let file = Bytes { format: FORMAT, data: &data };
    let start = (end / 4 + 1) * 4;
    let raw = file.slice("heights", start, count * Number::F32.size())?;
    let heights = Number::F32.decode_all(raw, count);
    Ok(Measured { height_unit: Some(up), ..Measured::in_metres(columns, rows, pixel, heights) })
}
