//! Alicona `.al3d`: tags of 52 bytes, then the depth image in 32-bit floats, metres, rows padded to 8 bytes.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use std::path::Path;

const FORMAT: Format = Format("al3d");
const MAGIC: usize = 17;
const KEY: usize = 20;
const VALUE: usize = 30;
const TAG: usize = KEY + VALUE + 2;

/// Reads the depth image.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let file = Bytes { format: FORMAT, data: &data };
    let tags = tags(&file)?;
    let text = |name: &'static str| {
        let tag = tags.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str());
        tag.ok_or(FORMAT.header(name, "nothing", "this tag is needed"))
    };
    let number = |name: &'static str| -> Result<f64, ReadError> {
        let value = text(name)?;
        value.parse().map_err(|_| FORMAT.header(name, value, "it must be a number"))
    };
    let whole = |name: &'static str| -> Result<u64, ReadError> {
        let value = number(name)?;
        if (0.0..=1e15).contains(&value) && value.fract() == 0.0 {
            return Ok(value as u64);
        }
        let allowed = "it must be a whole number, not negative";
        Err(FORMAT.header(name, value.to_string(), allowed))
    };
    let (columns, rows) = (whole("Cols")?, whole("Rows")?);
    let count = FORMAT.nodes_within(columns, rows, 4, request)?;
    let pixel = [
        FORMAT.positive("PixelSizeXMeter", number("PixelSizeXMeter")?)?,
        FORMAT.positive("PixelSizeYMeter", number("PixelSizeYMeter")?)?,
    ];
    let start = whole("DepthImageOffset")? as usize;
    if start == 0 {
        return Err(FORMAT.header("DepthImageOffset", "0", "a file without depth image has no heights"));
    }
    let invalid = number("InvalidPixelValue").unwrap_or(f64::NAN);
    let row_length = columns as usize;
    let stride = (row_length * 4).div_ceil(8) * 8;
    // the last row need not be padded
    let length = stride.saturating_mul(rows as usize - 1).saturating_add(row_length * 4);
    let raw = file.slice("heights", start, length)?;
    let mut heights = vec![0.0; count];
    for (row, out) in heights.chunks_mut(row_length).enumerate() {
        Number::F32.decode(&raw[row * stride..], false, out);
        out.iter_mut().filter(|z| (**z - invalid).abs() <= 1e-6 * invalid.abs()).for_each(|z| *z = f64::NAN);
    }
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

/// Keys and values of the header; the second tag says how many follow.
fn tags(file: &Bytes) -> Result<Vec<(String, String)>, ReadError> {
    let tag = |i: usize| -> Result<(String, String), ReadError> {
        let at = MAGIC + i * TAG;
        Ok((file.text(at, KEY)?, file.text(at + KEY, VALUE)?))
    };
    let (name, count) = tag(1)?;
    let known = count.parse().ok().filter(|n| name == "TagCount" && *n < 10_000);
    let count: usize =
        known.ok_or(FORMAT.header("TagCount", count, "it must be a small whole number in the second tag"))?;
    (2..2 + count).map(tag).collect()
}
