//! Height maps in files. Readers give heights in the file's unit and say what the file says of units and pixels.

mod al3d;
mod bytes;
mod npy;
mod sdf;
mod sur;
mod text;
mod vti;
mod x3p;

pub use npy::write_npy;
pub use vti::{CellArray, write_vti};
pub use x3p::write_x3p;

use std::fs::File;
use std::io::Read;
use std::path::Path;
use thiserror::Error;

/// Why a file is no surface.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// No reader knows it.
    #[error("{found}; a surface is a .npy, .x3p, .sdf, .sur, .al3d, .xyz or .csv file")]
    Unknown {
        /// What it seems to be.
        found: String,
    },
    /// A header asks for more than the file holds.
    #[error(
        "the {format} header promises {promised} bytes of {what}, the file holds {found}: it is truncated or damaged"
    )]
    Truncated {
        /// Format.
        format: &'static str,
        /// What is too short.
        what: &'static str,
        /// Bytes promised.
        promised: u64,
        /// Bytes there are.
        found: u64,
    },
    /// A value of the header makes no sense.
    #[error("the {format} header says {name} = {value}, but {allowed}")]
    Header {
        /// Format.
        format: &'static str,
        /// Which value.
        name: &'static str,
        /// What it is.
        value: String,
        /// What it may be.
        allowed: &'static str,
    },
    /// A text file has something else than a number.
    #[error("line {line}: {problem}")]
    Text {
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// The zip container or its XML is damaged.
    #[error("the x3p file is damaged: {0}")]
    Container(String),
}

/// What a file says of the distance of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Nothing.
    Unknown,
    /// In metres.
    Metres([f64; 2]),
    /// In the unit of the heights, which the file does not name.
    HeightUnits([f64; 2]),
}

/// Heights as a file holds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Nodes along x.
    pub columns: usize,
    /// Nodes along y.
    pub rows: usize,
    /// Heights in the file's unit, row by row; NaN where missing.
    pub heights: Vec<f64>,
    /// Distance of the nodes.
    pub spacing: Spacing,
    /// Metres per unit of height, where the file says.
    pub height_unit: Option<f64>,
}

/// Most nodes a header may ask for.
const MOST_NODES: u64 = i32::MAX as u64;

/// The number of nodes of a map, checked against what can be handled.
fn nodes(format: &'static str, columns: u64, rows: u64) -> Result<usize, ReadError> {
    let count = columns.checked_mul(rows).filter(|n| *n > 0 && *n < MOST_NODES);
    count.map(|n| n as usize).ok_or_else(|| ReadError::Header {
        format,
        name: "size",
        value: format!("{columns} x {rows} points"),
        allowed: "a map has at least 1 and at most 2147483646 points",
    })
}

/// A positive finite length of a header.
fn positive(format: &'static str, name: &'static str, value: f64) -> Result<f64, ReadError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(ReadError::Header {
            format,
            name,
            value: value.to_string(),
            allowed: "it must be finite and above 0",
        })
    }
}

/// What reads one format.
type Reader = fn(&Path) -> Result<Measured, ReadError>;

/// Reads a surface file, told apart by its first bytes, else by its name.
pub fn read(path: &Path) -> Result<Measured, ReadError> {
    let mut start = Vec::new();
    File::open(path)?.take(16).read_to_end(&mut start)?;
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let known: [(&[u8], Reader); 10] = [
        (b"\x93NUMPY", npy::read),
        (b"PK\x03\x04", x3p::read),
        (b"DIGITAL SURF", sur::read),
        (b"DSCOMPRESSED", sur::read),
        (b"AliconaImaging", al3d::read),
        (b"aISO-1.0", sdf::read),
        (b"aBCR-1.0", sdf::read),
        (b"bISO-1.0", sdf::read),
        (b"bBCR-1.0", sdf::read),
        (b" ISO-1.0", sdf::read),
    ];
    if let Some((_, reader)) = known.iter().find(|(magic, _)| start.starts_with(magic)) {
        return reader(path);
    }
    if start.is_empty() || picture(&start).is_some() {
        return Err(ReadError::Unknown { found: describe(&start, &extension) });
    }
    match extension.as_str() {
        "xyz" => text::read_points(path),
        "csv" | "txt" | "asc" | "dat" => text::read_table(path),
        _ => Err(ReadError::Unknown { found: describe(&start, &extension) }),
    }
}

/// The kind of picture that begins so.
fn picture(start: &[u8]) -> Option<&'static str> {
    let images: [(&[u8], &str); 6] = [
        (b"\x89PNG", "a PNG picture"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"II*\0", "a TIFF picture"),
        (b"MM\0*", "a TIFF picture"),
        (b"BM", "a BMP picture"),
        (b"GIF8", "a GIF picture"),
    ];
    images.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, name)| *name)
}

/// What a file that is no surface seems to be.
fn describe(start: &[u8], extension: &str) -> String {
    if let Some(name) = picture(start) {
        return format!("this is {name}: colours are not heights");
    }
    if start.is_empty() {
        return "the file is empty".into();
    }
    match extension {
        "npy" | "x3p" | "sdf" | "sur" | "al3d" => {
            format!("the name says .{extension}, but the file does not begin like one")
        }
        "" => "the file has no known beginning and no extension".into(),
        other => format!("files of type .{other} are not known"),
    }
}

#[cfg(test)]
mod tests;
