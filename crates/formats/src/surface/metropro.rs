//! MetroPro `.dat` of Zygo: a header of 834 or 4096 bytes, frames of intensity, phases in 32-bit integers;
//! big-endian. Source: MetroPro Reference Guide OMP-0347, "MetroPro data format".

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request, Spacing};
use std::path::Path;

const FORMAT: Format = Format("MetroPro");
/// Beginnings of the three versions.
pub(super) const MAGICS: [&[u8]; 3] = [b"\x88\x1b\x03\x6f", b"\x88\x1b\x03\x70", b"\x88\x1b\x03\x71"];
/// Phases from here on mean that nothing was measured.
const MISSING: f64 = 2_147_483_640.0;

/// Reads the heights of the connected phases.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let file = Bytes { format: FORMAT, data: &data };
    let number = |kind, place| file.big_number(kind, place);
    let (columns, rows) = (number(Number::U16, 68)? as u64, number(Number::U16, 70)? as u64);
    if columns * rows == 0 {
        let allowed = "the file holds intensities alone: save it with its heights";
        return Err(FORMAT.header("size of the phase map", format_args!("{columns} x {rows}"), allowed));
    }
    let count = FORMAT.nodes_within(columns, rows, 4, request)?;
    let parts = match number(Number::I16, 218)? {
        0.0 => 4096.0,
        1.0 => 32768.0,
        2.0 => 131_072.0,
        other => return Err(FORMAT.header("phase resolution", other, "it must be 0, 1 or 2")),
    };
    let factor = |name, place| FORMAT.positive(name, number(Number::F32, place)?);
    let sign = if number(Number::I16, 232)? == 0.0 { 1.0 } else { -1.0 };
    let step =
        sign * factor("scale factor", 164)? * factor("wavelength", 168)? * factor("obliquity", 176)? / parts;
    let start = number(Number::U32, 6)? as usize + number(Number::U32, 60)? as usize;
    let raw = file.slice("heights", start, count * 4)?;
    let mut heights = vec![0.0; count];
    Number::I32.decode(raw, true, &mut heights);
    heights.iter_mut().for_each(|z| *z = if *z < MISSING { *z * step } else { f64::NAN });
    let pixel = number(Number::F32, 184)?;
    // an instrument that was not calibrated along the surface writes 0
    let (spacing, notes) = if pixel == 0.0 {
        (Spacing::Unknown, vec!["its places along the surface were not calibrated".into()])
    } else {
        (Spacing::Metres([FORMAT.positive("lateral resolution", pixel)?; 2]), Vec::new())
    };
    let (columns, rows) = (columns as usize, rows as usize);
    Ok(Measured { columns, rows, heights, spacing, spacing_error: 0.0, height_unit: Some(1.0), notes })
}
