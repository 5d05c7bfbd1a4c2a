//! Bruker `.opdx` of Vision64: nested items (name, kind, content), little-endian; heights in 32-bit floats.
//! Source: the layout that SurfaceTopography (MIT) documents.

use super::bytes::{Bytes, Number};
use super::measured::{Format, Measured, ReadError, Request};
use crate::dimension::Dimension;
use std::collections::BTreeMap;
use std::path::Path;

const FORMAT: Format = Format("opdx");
/// A file begins so.
pub(super) const MAGIC: &[u8] = b"VCA DATA\x01\x00\x00\x55";
/// Deepest nesting of items, and longest name.
const DEEPEST: usize = 32;
const LONGEST_NAME: usize = 4096;

/// Content of an item that is looked at.
enum Item {
    Text(String),
    Texts(Vec<String>),
    /// A value in a unit.
    Quantity(f64, String),
    /// Place of the heights, rows and columns.
    Matrix(usize, u64, u64),
}

type Items = BTreeMap<String, Item>;

/// Reads the primary channel of heights.
pub(super) fn read(path: &Path, request: &Request<'_>) -> Result<Measured, ReadError> {
    let data = request.read_file(path)?;
    let mut items = Items::new();
    let mut reader = Reader { file: Bytes { format: FORMAT, data: &data }, place: MAGIC.len() };
    while reader.place < data.len() && reader.item("", 0, &mut items)? {}
    let channel = channel(&items)?;
    let find = |name: &str| items.get(&format!("/2D_Data/{channel}/{name}"));
    let quantity = |name: &'static str| -> Result<f64, ReadError> {
        let Some(Item::Quantity(value, unit)) = find(name) else {
            return Err(FORMAT.header(name, "nothing", "the channel needs it"));
        };
        let unit = Dimension::Length
            .scale(unit)
            .ok_or_else(|| FORMAT.header(name, format!("in \"{unit}\""), "it must have a unit of length"))?;
        FORMAT.positive(name, *value).map(|value| value * unit)
    };
    let Some(&Item::Matrix(start, rows, columns)) = find("Matrix") else {
        return Err(FORMAT.header("channel", &channel, "it must hold a matrix of heights"));
    };
    let count = FORMAT.nodes_within(columns, rows, 4, request)?;
    // the extent lies between the first and the last point
    let pixel = [
        quantity("Dimension2Extent")? / columns.saturating_sub(1).max(1) as f64,
        quantity("Dimension1Extent")? / rows.saturating_sub(1).max(1) as f64,
    ];
    let up = quantity("DataScale")?;
    let raw = Bytes { format: FORMAT, data: &data }.slice("heights", start, count * 4)?;
    let mut heights = Number::F32.decode_all(raw, count);
    heights.iter_mut().for_each(|z| *z = if z.is_finite() { *z * up } else { f64::NAN });
    Ok(Measured::in_metres(columns, rows, pixel, heights))
}

/// The primary channel, else the first one of heights.
fn channel(items: &Items) -> Result<String, ReadError> {
    if let Some(Item::Text(name)) = items.get("/MetaData/PrimaryData2D") {
        return Ok(name.clone());
    }
    if let Some(Item::Texts(names)) = items.get("/MetaData/2D_Channels/Height")
        && let Some(name) = names.first()
    {
        return Ok(name.clone());
    }
    Err(FORMAT.header(
        "channels",
        "nothing",
        "the file must hold a map of heights: a profile or picture is none",
    ))
}

/// A place in the file from which items are read.
struct Reader<'a> {
    file: Bytes<'a>,
    place: usize,
}

impl Reader<'_> {
    fn number(&mut self, kind: Number) -> Result<f64, ReadError> {
        let number = self.file.number(kind, self.place)?;
        self.place += kind.size();
        Ok(number)
    }

    fn skip(&mut self, length: usize) -> Result<usize, ReadError> {
        let start = self.place;
        self.file.slice("an item", start, length)?;
        self.place += length;
        Ok(start)
    }

    fn text_of(&mut self, length: usize) -> Result<String, ReadError> {
        if length > LONGEST_NAME {
            return Err(FORMAT.header("length of a text", length, "it is at most 4096 bytes"));
        }
        let start = self.skip(length)?;
        Ok(String::from_utf8_lossy(&self.file.data[start..self.place]).into_owned())
    }

    fn name(&mut self) -> Result<String, ReadError> {
        let length = self.number(Number::U32)? as usize;
        self.text_of(length)
    }

    /// A length of one, two or four bytes.
    fn length(&mut self) -> Result<usize, ReadError> {
        let kind = match self.number(Number::U8)? {
            1.0 => Number::U8,
            2.0 => Number::U16,
            4.0 => Number::U32,
            bytes => return Err(FORMAT.header("bytes of a length", bytes, "it must be 1, 2 or 4")),
        };
        Ok(self.number(kind)? as usize)
    }

    /// The end of a content whose length stands here.
    fn end(&mut self) -> Result<usize, ReadError> {
        let length = self.length()?;
        self.file.slice("an item", self.place, length)?;
        Ok(self.place + length)
    }

    /// Reads an item under `prefix`; false at the end of a list of them.
    fn item(&mut self, prefix: &str, depth: usize, items: &mut Items) -> Result<bool, ReadError> {
        let path = format!("{prefix}/{}", self.name()?);
        let item = match self.number(Number::U8)? as u8 {
            0x7f => return Ok(false),
            0x7d | 0x46 | 0x47 => {
                if depth > DEEPEST {
                    return Err(FORMAT.header("nesting of items", depth, "it is at most 32 deep"));
                }
                let end = self.end()?;
                while self.place < end && self.item(&path, depth + 1, items)? {}
                self.place = end;
                return Ok(true);
            }
            0x00 => self.matrix(&path, true)?,
            0x45 => self.matrix(&path, false)?,
            kind => self.value(kind)?,
        };
        items.extend(item.map(|item| (path, item)));
        Ok(true)
    }

    /// A matrix, with the type of its elements before it or not.
    fn matrix(&mut self, path: &str, has_type: bool) -> Result<Option<Item>, ReadError> {
        self.name()?;
        if has_type {
            self.number(Number::U32)?;
            self.name()?;
        }
        let end = self.end()?;
        let (rows, columns) = (self.number(Number::U32)? as u64, self.number(Number::U32)? as u64);
        let start = self.place;
        if path.starts_with("/2D_Data")
            && Some(end.saturating_sub(start) as u64) != (rows * columns).checked_mul(4)
        {
            let found = format_args!("{columns} x {rows} points");
            return Err(FORMAT.header(
                "size of the matrix",
                found,
                "it must match its length in 32-bit floats",
            ));
        }
        self.place = end.max(start);
        Ok(Some(Item::Matrix(start, rows, columns)))
    }

    /// Any other item.
    fn value(&mut self, kind: u8) -> Result<Option<Item>, ReadError> {
        let plain = match kind {
            0x01 => 1,
            0x04 | 0x05 => 2,
            0x06 | 0x07 | 0x0c => 4,
            0x0a | 0x0b | 0x0d => 8,
            // a time
            0x15 => 9,
            _ => 0,
        };
        if plain > 0 {
            return self.skip(plain).map(|_| None);
        }
        match kind {
            0x12 => {
                let length = self.length()?;
                self.text_of(length).map(|text| Some(Item::Text(text)))
            }
            0x13 => {
                let end = self.end()?;
                let value = self.number(Number::F64)?;
                self.name()?;
                let unit = self.name()?;
                self.place = end;
                Ok(Some(Item::Quantity(value, unit)))
            }
            0x18 => {
                self.place = self.end()?;
                Ok(None)
            }
            0x42 => {
                self.name()?;
                let end = self.end()?;
                let mut texts = Vec::new();
                while self.place < end {
                    texts.push(self.name()?);
                }
                Ok(Some(Item::Texts(texts)))
            }
            0x0e | 0x40 | 0x7c => {
                self.name()?;
                self.place = self.end()?;
                Ok(None)
            }
            other => Err(FORMAT.header(
                "kind of an item",
                other,
                "this kind is not known: save it as .sur or ASCII",
            )),
        }
    }
}
