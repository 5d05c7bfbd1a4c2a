//! Gwyddion `.gwy`: a container of named objects; the first channel whose values are lengths is the surface.
//! Source: user guide of Gwyddion, "Gwyddion native file format".

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use std::path::Path;

const FORMAT: Format = Format("gwy");

/// One component of an object: its name, the letter of its type, its bytes.
struct Part<'a> {
    name: &'a str,
    kind: u8,
    data: &'a [u8],
}

/// Reads the first channel of heights.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let (name, content, _) = object(&data[4..])?;
    if name != "GwyContainer" {
        return Err(FORMAT.header("object", name, "a file begins with a GwyContainer"));
    }
    let parts = parts(content)?;
    let mut fields: Vec<(usize, &Part<'_>)> =
        parts.iter().filter_map(|part| Some((channel(part)?, part))).collect();
    fields.sort_by_key(|(number, _)| *number);
    let mut others = Vec::new();
    for (i, (number, part)) in fields.iter().enumerate() {
        let (kind, content, _) = object(part.data)?;
        let field = self::parts(content)?;
        let unit = unit_of(&field, "si_unit_z")?;
        let (Some(up), "GwyDataField") = (Dimension::Length.scale(unit), kind) else {
            others.push(format!("channel {number} in \"{unit}\""));
            continue;
        };
        let mut notes = Vec::new();
        if fields.len() > 1 {
            notes.push(format!("channel {number}, the first of heights among {}", fields.len()));
        }
        if parts.iter().any(|part| part.name == format!("/{}/mask", fields[i].0)) {
            notes.push("its mask was passed over: points are missing only where they are no number".into());
        }
        return map(&field, up, notes, request);
    }
    Err(FORMAT.header("channels", others.join(", "), "one must hold heights in a unit of length"))
}

/// The number of a channel, `/0/data`.
fn channel(part: &Part<'_>) -> Option<usize> {
    let number = part.name.strip_prefix('/')?.strip_suffix("/data")?;
    (part.kind == b'o').then(|| number.parse().ok()).flatten()
}

/// The map of a data field with `up` metres in a unit of its values.
fn map(
    field: &[Part<'_>],
    up: f64,
    notes: Vec<String>,
    request: &Request<'_>,
) -> Result<Measured, ReadError> {
    let find = |name: &'static str, kind: u8| {
        let part = field.iter().find(|part| part.name == name && part.kind == kind);
        part.ok_or_else(|| FORMAT.header(name, "nothing", "a field of data needs it"))
    };
    let number = |name, kind, number| -> Result<f64, ReadError> {
        Bytes { format: FORMAT, data: find(name, kind)?.data }.number(number, 0)
    };
    let size = |name| Ok::<u64, ReadError>(number(name, b'i', Number::I32)?.max(0.0) as u64);
    let (columns, rows) = (size("xres")?, size("yres")?);
    let count = FORMAT.nodes_within(columns, rows, 8, request)?;
    let unit = unit_of(field, "si_unit_xy")?;
    let along = Dimension::Length.scale(unit);
    let along = along
        .ok_or_else(|| FORMAT.header("si_unit_xy", format!("\"{unit}\""), "it must be a unit of length"))?;
    let real = |name, points: u64| -> Result<f64, ReadError> {
        Ok(FORMAT.positive(name, number(name, b'd', Number::F64)?)? / points as f64 * along)
    };
    let pixel = [real("xreal", columns)?, real("yreal", rows)?];
    let raw = find("data", b'D')?.data;
    if raw.len() != count * 8 {
        return Err(FORMAT.truncated("heights", count as u64 * 8, raw.len() as u64));
    }
    let heights = Number::F64.decode_all(raw, count);
    Ok(Measured { height_unit: Some(up), notes, ..Measured::in_metres(columns, rows, pixel, heights) })
}

/// The unit in an object GwySIUnit of a field; none is a pure number.
fn unit_of<'a>(field: &[Part<'a>], name: &str) -> Result<&'a str, ReadError> {
    let Some(part) = field.iter().find(|part| part.name == name && part.kind == b'o') else { return Ok("") };
    let (_, content, _) = object(part.data)?;
    let text = parts(content)?.into_iter().find(|part| part.name == "unitstr" && part.kind == b's');
    Ok(text.map_or("", |part| std::str::from_utf8(part.data).unwrap_or("")))
}

/// A text that ends with a zero, and what follows.
fn text(data: &[u8]) -> Result<(&str, &[u8]), ReadError> {
    let end = data.iter().position(|b| *b == 0);
    let end = end.ok_or(FORMAT.truncated("a name", data.len() as u64 + 1, data.len() as u64))?;
    Ok((std::str::from_utf8(&data[..end]).unwrap_or("?"), &data[end + 1..]))
}

/// The first `length` bytes, and what follows.
fn split(data: &[u8], length: usize) -> Result<(&[u8], &[u8]), ReadError> {
    let short = || FORMAT.truncated("a part", length as u64, data.len() as u64);
    data.split_at_checked(length).ok_or_else(short)
}

fn length(data: &[u8]) -> Result<(usize, &[u8]), ReadError> {
    let (size, rest) = split(data, 4)?;
    Ok((u32::from_le_bytes([size[0], size[1], size[2], size[3]]) as usize, rest))
}

/// Name, content and whole length of the object that begins so.
fn object(data: &[u8]) -> Result<(&str, &[u8], usize), ReadError> {
    let (name, rest) = text(data)?;
    let (size, rest) = length(rest)?;
    let (content, rest) = split(rest, size)?;
    Ok((name, content, data.len() - rest.len()))
}

/// The components of an object.
fn parts(mut data: &[u8]) -> Result<Vec<Part<'_>>, ReadError> {
    let mut parts = Vec::new();
    while !data.is_empty() {
        let (name, rest) = text(data)?;
        let (kind, rest) = split(rest, 1)?;
        let kind = kind[0];
        let (content, rest) = match kind {
            b'b' | b'c' => split(rest, 1)?,
            b'i' => split(rest, 4)?,
            b'q' | b'd' => split(rest, 8)?,
            b's' => {
                let (content, rest) = text(rest)?;
                (content.as_bytes(), rest)
            }
            b'o' => split(rest, object(rest)?.2)?,
            b'C' | b'I' | b'Q' | b'D' => {
                let (count, rest) = length(rest)?;
                let size = match kind {
                    b'C' => 1,
                    b'I' => 4,
                    _ => 8,
                };
                split(rest, count.saturating_mul(size))?
            }
            b'S' | b'O' => {
                let (count, mut after) = length(rest)?;
                for _ in 0..count {
                    after = if kind == b'S' { text(after)?.1 } else { &after[object(after)?.2..] };
                }
                split(rest, rest.len() - after.len())?
            }
            _ => {
                let found = char::from(kind);
                return Err(FORMAT.header(
                    "type of a part",
                    format!("\"{found}\""),
                    "it must be one of bciqdsoCIQDSO",
                ));
            }
        };
        parts.push(Part { name, kind, data: content });
        data = rest;
    }
    Ok(parts)
}
