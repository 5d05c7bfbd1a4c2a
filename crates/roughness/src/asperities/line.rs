//! A row or a column of a map as a line.

use crate::surface::height_map::HeightMap;
use thiserror::Error;

/// The direction in which a line runs over the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along x: a row of nodes.
    X,
    /// Along y: a column of nodes.
    Y,
}

/// The reason why a line cannot be taken.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LineError {
    /// It lies beside the map.
    #[error("a line at {at_um} µm lies beside the map, which reaches from 0 to {most_um} µm there")]
    Beside {
        /// The position that was asked for, µm.
        at_um: f64,
        /// Size of the map across the line, µm.
        most_um: f64,
    },
    /// Too little of it was measured.
    #[error(
        "{missing} of the {nodes} points of the line at {at_um} µm were not measured: at most one in ten may be missing; take another \
         line, or missing = \"fill\""
    )]
    Missing {
        /// Its position, µm.
        at_um: f64,
        /// Points without a height.
        missing: usize,
        /// Points in all.
        nodes: usize,
    },
}

/// Heights along a line of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceLine {
    /// Way along the line and height, m.
    pub points: Vec<[f64; 2]>,
    /// Position of the line across its direction, m.
    pub at: f64,
}

/// The row (column) of nodes nearest to `at` (m) across it. Single missing points lie straight between those
/// beside them.
///
/// # Errors
/// A line beside the map, or one with more than a tenth of its points missing.
pub fn line(map: &HeightMap, direction: Direction, at: f64) -> Result<SurfaceLine, LineError> {
    let (along, across) = if direction == Direction::X { (0, 1) } else { (1, 0) };
    let (size, pixel) = ([map.columns(), map.rows()], map.pixel());
    let number = (at / pixel[across]).round();
    if !(number >= 0.0 && number < size[across] as f64) {
        let most_um = (size[across] as f64 - 1.0) * pixel[across] * 1e6;
        return Err(LineError::Beside { at_um: at * 1e6, most_um });
    }
    let number = number as usize;
    let height = |i: usize| match direction {
        Direction::X => map.row(number)[i],
        Direction::Y => map.row(i)[number],
    };
    let measured: Vec<[f64; 2]> = (0..size[along])
        .map(|i| [i as f64 * pixel[along], height(i)])
        .filter(|point| !point[1].is_nan())
        .collect();
    let (missing, nodes) = (size[along] - measured.len(), size[along]);
    if 10 * missing > nodes || measured.len() < 2 {
        return Err(LineError::Missing { at_um: at * 1e6, missing, nodes });
    }
    // a line through the points beside a gap fills it without points of its own
    Ok(SurfaceLine { points: measured, at: number as f64 * pixel[across] })
}
