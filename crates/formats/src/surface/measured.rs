//! The result of every reader: heights as a file holds them, or why it is no surface.

use thiserror::Error;

/// The reason why a file is no surface.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}; a path is relative to the folder of the file that names it")]
    Io(#[from] std::io::Error),
    /// No reader knows it.
    #[error("{found}; a surface is a .npy, .x3p, .sdf, .sur, .al3d, .xyz or .csv file")]
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
    /// A text file has something else than a number.
    #[error("line {line}: {problem}")]
    Text {
        /// Line, from 1.
        line: usize,
        /// The mistake.
        problem: String,
    },
    /// The zip container or its XML is damaged.
    #[error("the x3p file is damaged: {0}")]
    Container(String),
}

impl ReadError {
    pub(super) fn text(line: usize, problem: impl ToString) -> ReadError {
        ReadError::Text { line, problem: problem.to_string() }
    }
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

    /// The number of nodes of a map, checked against what can be handled.
    pub fn nodes(self, columns: u64, rows: u64) -> Result<usize, ReadError> {
        let count = columns.checked_mul(rows).filter(|n| *n > 0 && *n < MOST_NODES);
        let allowed = "a map has at least 1 and at most 2147483646 points";
        count
            .map(|n| n as usize)
            .ok_or_else(|| self.header("size", format_args!("{columns} x {rows} points"), allowed))
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

impl Measured {
    /// A grid whose lengths are all in metres.
    pub(super) fn in_metres(columns: u64, rows: u64, pixel: [f64; 2], heights: Vec<f64>) -> Measured {
        let (columns, rows) = (columns as usize, rows as usize);
        Measured { columns, rows, heights, spacing: Spacing::Metres(pixel), height_unit: Some(1.0) }
    }
}

/// Most nodes a header may ask for.
pub(super) const MOST_NODES: u64 = i32::MAX as u64;
