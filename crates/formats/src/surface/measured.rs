//! The result of every reader: heights as a file holds them, or why it is no surface.

use crate::memory::{default_limit, read_file};
use crate::text::{Decimal, TextError};
use std::path::Path;
use thiserror::Error;

/// The reason why a file is no surface.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}; a path is relative to the folder of the file that names it")]
    Io(#[from] std::io::Error),
    /// No reader knows it.
    #[error(
        "{found}; a surface is a .sur, .x3p, .sdf, .al3d, .plu, .plux, .opd, .opdx, .spm, .vk4, .vk6, .zon, .dat, .datx, .gwy, .gsf, .bcr, .bcrf, .nid, .tif or .npy file, a workbook (.xlsx, .xls, .ods), or text (.csv, .txt, .xyz)"
    )]
    Unknown {
        /// Its probable kind.
        found: String,
    },
    /// A header asks for more than the file holds.
    #[error(
        "the {format} header promises {promised} bytes of {what}, the file holds {found}: it is truncated or damaged"
    )]
    Truncated {
        /// Format.
        format: &'static str,
        /// The part that is too short.
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
        /// The value.
        name: &'static str,
        /// Its value.
        value: String,
        /// The allowed range.
        allowed: &'static str,
    },
    /// A text file has something else than rows of heights.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The container in which the heights lie, or its XML, is damaged.
    #[error("the {format} file is damaged: {what}")]
    Container {
        /// Format.
        format: &'static str,
        /// The damage.
        what: String,
    },
    /// More memory than may be taken.
    #[error(
        "the {format} file holds {points} points, which take {needed:.2} GB, more than memory_limit, {limit:.2} GB (half of what is free unless told): raise it, or thin the map out"
    )]
    Memory {
        /// Format.
        format: &'static str,
        /// Points of the map.
        points: u64,
        /// Memory that they take, GB.
        needed: f64,
        /// Memory that may be taken, GB.
        limit: f64,
    },
    /// A format that is known by its beginning, but not read.
    #[error("this is {found}, which is not read: {export}")]
    Foreign {
        /// Its name.
        found: String,
        /// An export that is read.
        export: &'static str,
    },
}

/// A format with a header, by its name in errors.
#[derive(Clone, Copy)]
pub(super) struct Format(pub &'static str);

impl Format {
    /// A value of the header that makes no sense.
    pub fn header(self, name: &'static str, value: impl ToString, allowed: &'static str) -> ReadError {
        ReadError::Header { format: self.0, name, value: value.to_string(), allowed }
    }

    /// A file that is shorter than its header says.
    pub fn truncated(self, what: &'static str, promised: u64, found: u64) -> ReadError {
        ReadError::Truncated { format: self.0, what, promised, found }
    }

    /// A container that cannot be read.
    pub fn damaged(self, what: impl ToString) -> ReadError {
        ReadError::Container { format: self.0, what: what.to_string() }
    }

    /// The number of nodes of a map, checked against what can be handled.
    pub fn nodes(self, columns: u64, rows: u64) -> Result<usize, ReadError> {
        let count = columns.checked_mul(rows).filter(|n| *n > 0 && *n < MOST_NODES);
        let allowed = "a map has at least 1 and at most 2147483646 points";
        count
            .map(|n| n as usize)
            .ok_or_else(|| self.header("size", format_args!("{columns} x {rows} points"), allowed))
    }

    /// The number of nodes of a map of `bytes` to a point, checked against the memory that may be taken.
    pub fn nodes_within(
        self,
        columns: u64,
        rows: u64,
        bytes: usize,
        request: &Request<'_>,
    ) -> Result<usize, ReadError> {
        let count = self.nodes(columns, rows)?;
        // the heights as they are computed with, beside those of the file
        let needed = count as u64 * (8 + bytes as u64);
        let limit = request.memory();
        if needed > limit {
            let (needed, limit) = (needed as f64 / 1e9, limit as f64 / 1e9);
            return Err(ReadError::Memory { format: self.0, points: count as u64, needed, limit });
        }
        Ok(count)
    }

    /// A positive finite length of the header.
    pub fn positive(self, name: &'static str, value: f64) -> Result<f64, ReadError> {
        let positive = value.is_finite() && value > 0.0;
        positive.then_some(value).ok_or_else(|| self.header(name, value, "it must be finite and above 0"))
    }
}

/// Distance of the points, as far as a file says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Nothing.
    Unknown,
    /// In metres.
    Metres([f64; 2]),
    /// In the unit of the heights, which the file does not name.
    HeightUnits([f64; 2]),
    /// In a unit that the file does not name.
    Numbers([f64; 2]),
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
    /// Share of it that digits printed in the file leave open.
    pub spacing_error: f64,
    /// Metres per unit of height, where the file says.
    pub height_unit: Option<f64>,
    /// Interpretation of the file, and remarks on it, each a sentence without its full stop.
    pub notes: Vec<String>,
}

impl Measured {
    /// A grid whose lengths are all in metres.
    pub(super) fn in_metres(columns: u64, rows: u64, pixel: [f64; 2], heights: Vec<f64>) -> Measured {
        let (columns, rows) = (columns as usize, rows as usize);
        Measured {
            columns,
            rows,
            heights,
            spacing: Spacing::Metres(pixel),
            spacing_error: 0.0,
            height_unit: Some(1.0),
            notes: Vec::new(),
        }
    }
}

/// Requests on a file beside its name.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Request<'a> {
    /// Columns of x, y and z in a list of points, by name or number.
    pub columns: [Option<&'a str>; 3],
    /// A number that means that a point was not measured, in the unit of the file.
    pub missing_value: Option<f64>,
    /// Mark before decimals in text, where the file does not tell.
    pub decimal: Option<Decimal>,
    /// True where sums that do not hold, and values that are said to be no heights, are passed over.
    pub override_file: bool,
    /// Bytes that may be taken; `None`: [`default_limit`].
    pub memory_limit: Option<u64>,
}

impl Request<'_> {
    /// Bytes that may be taken.
    pub(super) fn memory(&self) -> u64 {
        self.memory_limit.unwrap_or_else(default_limit)
    }

    /// The whole file.
    pub(super) fn read_file(&self, path: &Path) -> Result<Vec<u8>, ReadError> {
        Ok(read_file(path, self.memory(), "memory_limit")?)
    }
}

/// Most nodes a header may ask for.
pub(super) const MOST_NODES: u64 = i32::MAX as u64;
