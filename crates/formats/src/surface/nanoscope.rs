//! NanoScope `.spm` (and `.001`): a header of lines `\key: value` in sections, then channels of 16- or 32-bit
//! integers, row by row from the bottom up; little-endian.
//! Source: Digital Instruments, "NanoScope file formats", header version 4.3 and later.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use crate::text::decode;
use std::collections::HashMap;

const FORMAT: Format = Format("NanoScope");
/// The first line.
pub(super) const MAGIC: &[u8] = b"\\*File list";
/// Bytes in which a header ends.
pub(super) const LONGEST_HEADER: usize = 1 << 20;
/// The full scale of a converter.
const STEPS: f64 = 65536.0;

/// Keys, in small letters, with their values.
pub(super) type Section = HashMap<String, String>;

/// Reads the first channel of heights of the bytes of a file, whose header has these sections.
pub(super) fn read(
    data: &[u8],
    sections: &[(String, Section)],
    request: &Request<'_>,
) -> Result<Measured, ReadError> {
    let images: Vec<&Section> = images(sections).collect();
    let mut others = Vec::new();
    for (i, image) in images.iter().enumerate() {
        match step(image, sections) {
            Ok(step) => {
                let mut map = map(data, image, step, request)?;
                if images.len() > 1 {
                    map.notes.push(format!("channel {}, the first of heights among {}", i + 1, images.len()));
                }
                return Ok(map);
            }
            Err(unit) => others.push(unit),
        }
    }
    let found = if others.is_empty() { "nothing".into() } else { others.join(", ") };
    Err(FORMAT.header("@2:Z scale", found, "one channel must hold heights: export the Height channel"))
}

/// The sections of the images, in order.
pub(super) fn images(sections: &[(String, Section)]) -> impl Iterator<Item = &Section> {
    sections.iter().filter(|(name, _)| name == "ciao image list").map(|(_, keys)| keys)
}

/// The sections of the header, in order.
pub(super) fn sections(data: &[u8]) -> Vec<(String, Section)> {
    let start = &data[..data.len().min(LONGEST_HEADER)];
    let end = start.iter().position(|b| *b == 0x1a || *b == 0).unwrap_or(start.len());
    // degrees and micrometres stand in Windows-1252
    let text = decode(&start[..end]).map(|(text, _)| text.into_owned()).unwrap_or_default();
    let mut sections: Vec<(String, Section)> = Vec::new();
    // some versions quote the lines of a text
    let bare = |line: &'_ str| line.trim().trim_matches('"').strip_prefix('\\').map(str::to_string);
    for line in text.lines().map_while(bare) {
        if let Some(name) = line.strip_prefix('*') {
            if name.trim().eq_ignore_ascii_case("file list end") {
                break;
            }
            sections.push((name.trim().to_ascii_lowercase(), Section::new()));
        } else if let (Some((_, keys)), Some((key, value))) = (sections.last_mut(), line.split_once(": ")) {
            keys.insert(key.to_ascii_lowercase(), value.trim().into());
        }
    }
    sections
}

/// Metres of height per step of the converter: `V [Sens. Zsens] (0.0001 V/LSB) 12.5 V` is the full scale of
/// it, and `@Sens. Zsens: V 8.1 nm/V` another section; or the scale as it stands where it is no length.
fn step(image: &Section, sections: &[(String, Section)]) -> Result<f64, String> {
    let scale = image.get("@2:z scale").map_or("", String::as_str);
    let refused = || scale.to_string();
    let (before, full) = scale.rsplit_once(')').ok_or_else(refused)?;
    let (full, unit) = number_and_unit(full).ok_or_else(refused)?;
    let sensor = before.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(name, _)| name);
    let Some(sensor) = sensor else {
        return Dimension::Length.scale(unit).map(|metres| full / STEPS * metres).ok_or_else(refused);
    };
    let key = format!("@{}", sensor.to_ascii_lowercase());
    let said = sections.iter().find_map(|(_, keys)| keys.get(&key)).ok_or_else(refused)?;
    let (factor, ratio) = said.strip_prefix("V ").and_then(number_and_unit).ok_or_else(refused)?;
    let (up, per) = ratio.split_once('/').ok_or_else(refused)?;
    let same = match (unit, per) {
        _ if unit == per => 1.0,
        ("mV", "V") => 1e-3,
        ("V", "mV") => 1e3,
        _ => return Err(refused()),
    };
    let metres = Dimension::Length.scale(up).ok_or_else(refused)?;
    Ok(full / STEPS * same * factor * metres)
}

fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = text.trim().split_once(' ')?;
    Some((number.parse().ok()?, unit.trim()))
}

fn map(data: &[u8], image: &Section, step: f64, request: &Request<'_>) -> Result<Measured, ReadError> {
    let words = |key: &str| image.get(key).map_or("", String::as_str);
    let whole = |key: &'static str| {
        let value = words(key);
        value
            .parse::<u64>()
            .map_err(|_| FORMAT.header(key, format!("\"{value}\""), "it must be a whole number"))
    };
    let (columns, rows) = (whole("samps/line")?, whole("number of lines")?);
    let (number, step) = match whole("bytes/pixel")? {
        2 => (Number::I16, step),
        4 => (Number::I32, step / STEPS),
        bytes => return Err(FORMAT.header("bytes/pixel", bytes, "it must be 2 or 4")),
    };
    let count = FORMAT.nodes_within(columns, rows, number.size(), request)?;
    let pixel = pixel(image, [columns, rows])?;
    let file = Bytes { format: FORMAT, data };
    let raw = file.slice("heights", whole("data offset")? as usize, count * number.size())?;
    let raw = number.decode_all(raw, count);
    let heights = raw.chunks(columns as usize).rev().flatten().map(|z| z * step).collect();
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

/// Distance of so many columns and rows of an image, by its scan size.
pub(super) fn pixel(image: &Section, [columns, rows]: [u64; 2]) -> Result<[f64; 2], ReadError> {
    let size = image.get("scan size").map_or("", String::as_str);
    let bad_size = || FORMAT.header("scan size", size, "it must be two numbers and a unit of length");
    let words: Vec<&str> = size.split_whitespace().collect();
    let [x, .., unit] = words[..] else { return Err(bad_size()) };
    let y = if words.len() > 2 { words[1] } else { x };
    // an old spelling of micrometres
    let unit = Dimension::Length.scale(if unit == "~m" { "um" } else { unit }).ok_or_else(bad_size)?;
    let side = |text: &str, points: u64| -> Result<f64, ReadError> {
        let length: f64 = text.parse().map_err(|_| bad_size())?;
        Ok(FORMAT.positive("scan size", length)? * unit / points as f64)
    };
    Ok([side(x, columns)?, side(y, rows)?])
}
