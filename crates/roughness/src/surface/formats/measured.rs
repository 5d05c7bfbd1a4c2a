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
        /// Which value.
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
    pub(super) fn header(
        format: &'static str,
        name: &'static str,
        value: impl ToString,
        allowed: &'static str,
    ) -> ReadError {
        ReadError::Header { format, name, value: value.to_string(), allowed }
    }

    pub(super) fn truncated(
        format: &'static str,
        what: &'static str,
        promised: u64,
        found: u64,
    ) -> ReadError {
        ReadError::Truncated { format, what, promised, found }
    }

    pub(super) fn text(line: usize, problem: impl ToString) -> ReadError {
        ReadError::Text { line, problem: problem.to_string() }
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

/// Most nodes a header may ask for.
pub(super) const MOST_NODES: u64 = i32::MAX as u64;

/// The number of nodes of a map, checked against what can be handled.
pub(super) fn nodes(format: &'static str, columns: u64, rows: u64) -> Result<usize, ReadError> {
    let count = columns.checked_mul(rows).filter(|n| *n > 0 && *n < MOST_NODES);
    let allowed = "a map has at least 1 and at most 2147483646 points";
    count
        .map(|n| n as usize)
        .ok_or_else(|| ReadError::header(format, "size", format_args!("{columns} x {rows} points"), allowed))
}

/// A positive finite length of a header.
pub(super) fn positive(format: &'static str, name: &'static str, value: f64) -> Result<f64, ReadError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(ReadError::header(format, name, value, "it must be finite and above 0"))
    }
}
