//! Nanosurf `.nid`: sections of lines `key=value`, then `#!` and the channels that `[DataSet]` lists, group
//! by group, in signed little-endian integers, row by row from the bottom up. The least integer is `Dim2Min`,
//! the range of all integers `Dim2Range`.
//! Source: NSFopen of Nanosurf (MIT), which reads the same layout.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use crate::text::decode;
use std::collections::HashMap;
use std::path::Path;

const FORMAT: Format = Format("nid");
/// The first line.
pub(super) const MAGIC: &[u8] = b"[DataSet]";
/// Mark between header and channels.
const END: &[u8] = b"#!";
/// Most groups, and channels of a group, that are looked for.
const MOST: usize = 64;

/// Sections of the header.
type Sections = HashMap<String, HashMap<String, String>>;

/// Reads the first channel of heights that has several lines.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let end = data.windows(END.len()).position(|two| two == END);
    let end = end.ok_or_else(|| FORMAT.damaged("its header has no end, which is #!"))?;
    let sections = sections(&data[..end]);
    let listed = |group: usize, channel: usize| {
        sections.get("DataSet").and_then(|set| set.get(&format!("Gr{group}-Ch{channel}")))
    };
    let mut start = end + END.len();
    let mut others = Vec::new();
    for name in (0..MOST).flat_map(|group| (0..MOST).filter_map(move |channel| listed(group, channel))) {
        let Some(channel) = sections.get(name) else { continue };
        let words = |key: &str| channel.get(key).map_or("", String::as_str);
        let number = |key: &'static str| -> Result<f64, ReadError> {
            let value: Option<f64> = words(key).parse().ok();
            value
                .filter(|v| v.is_finite())
                .ok_or_else(|| FORMAT.header(key, format!("\"{}\"", words(key)), "it must be a number"))
        };
        let points = |key: &'static str| {
            let count = number(key)?;
            let is_whole = (1.0..1e9).contains(&count) && count.fract() == 0.0;
            is_whole
                .then_some(count as u64)
                .ok_or_else(|| FORMAT.header(key, count, "it must be a whole number"))
        };
        let (columns, rows) = (points("Points")?, points("Lines")?);
        let kind = match words("SaveBits") {
            "16" => Number::I16,
            "32" | "" => Number::I32,
            bits => return Err(FORMAT.header("SaveBits", bits, "heights have 16 or 32")),
        };
        let count = FORMAT.nodes_within(columns, rows, kind.size(), request)?;
        let Some(unit) = Dimension::Length.scale(words("Dim2Unit")).filter(|_| rows > 1) else {
            others.push(format!("{} in {}", words("Dim2Name"), words("Dim2Unit")));
            start = start.saturating_add(count * kind.size());
            continue;
        };
        let lateral = |key: &'static str| {
            let allowed = "it must be a unit of length";
            Dimension::Length.scale(words(key)).ok_or_else(|| FORMAT.header(key, words(key), allowed))
        };
        let pixel = [
            FORMAT.positive("Dim0Range", number("Dim0Range")?)? * lateral("Dim0Unit")? / columns as f64,
            FORMAT.positive("Dim1Range", number("Dim1Range")?)? * lateral("Dim1Unit")? / rows as f64,
        ];
        let steps = 2f64.powi(8 * kind.size() as i32);
        let (least, range) = (number("Dim2Min")?, FORMAT.positive("Dim2Range", number("Dim2Range")?)?);
        let raw = Bytes { format: FORMAT, data: &data }.slice("heights", start, count * kind.size())?;
        let raw = kind.decode_all(raw, count);
        let height = |z: &f64| least + range * (z / steps + 0.5);
        let heights = raw.chunks(columns as usize).rev().flatten().map(height).collect();
        let mut map = Measured::in_metres(columns, rows, pixel, heights);
        map.height_unit = Some(unit);
        map.notes.push(format!(
            "channel \"{}\" of \"{}\", the first of heights",
            words("Dim2Name"),
            words("Frame")
        ));
        return Ok(map);
    }
    let found = if others.is_empty() { "nothing".into() } else { others.join(", ") };
    Err(FORMAT.header("channels", found, "one must be a map of heights: export the topography"))
}

/// The sections of the header with their keys.
fn sections(header: &[u8]) -> Sections {
    // micrometres stand in Windows-1252
    let text = decode(header).map(|(text, _)| text.into_owned()).unwrap_or_default();
    let mut sections = Sections::new();
    let mut name = String::new();
    for line in text.lines().map(str::trim) {
        if let Some(inside) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            name = inside.into();
        } else if let Some((key, value)) = line.split_once('=') {
            sections.entry(name.clone()).or_default().insert(key.trim().into(), value.trim().into());
        }
    }
    sections
}
