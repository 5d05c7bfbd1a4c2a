//! A map of gaps, seen along one of its axes.

use crate::HeightMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Direction of a flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// From the left edge of the map to its right.
    X,
    /// From the first row to the last.
    Y,
}

/// Gaps on the pixels of a map; a pixel that is closed, or was not measured, lets nothing through.
#[derive(Clone, Copy, Debug)]
pub struct Gap<'a> {
    /// Pixels along x and y.
    pub nodes: [usize; 2],
    /// Sides of a pixel, in metres.
    pub pixel: [f64; 2],
    /// True where a flow leaves over one side and comes back over the other.
    pub periodic: bool,
    /// Gaps in metres, row by row.
    pub values: &'a [f32],
}

impl<'a> Gap<'a> {
    /// `values` (m), one per node of `map`.
    pub fn new(map: &HeightMap, values: &'a [f32]) -> Gap<'a> {
        let nodes = [map.columns(), map.rows()];
        Gap { nodes, pixel: map.pixel(), periodic: map.periodic(), values }
    }

    /// The gaps with the flow along their first axis: what is open, lines of the flow's direction one after
    /// the other.
    pub(super) fn oriented(&self, axis: Axis) -> Oriented {
        let [nx, ny] = self.nodes;
        let open = |z: f32| if z > 0.0 { f64::from(z) } else { 0.0 };
        match axis {
            Axis::X => Oriented {
                long: nx,
                wide: ny,
                pixel: self.pixel,
                periodic: self.periodic,
                gaps: self.values.iter().map(|z| open(*z)).collect(),
            },
            Axis::Y => Oriented {
                long: ny,
                wide: nx,
                pixel: [self.pixel[1], self.pixel[0]],
                periodic: self.periodic,
                gaps: (0..nx * ny).map(|i| open(self.values[i % ny * nx + i / ny])).collect(),
            },
        }
    }
}

/// Gaps with the flow along their first axis.
pub(super) struct Oriented {
    /// Pixels along the flow, and beside each other.
    pub long: usize,
    pub wide: usize,
    /// Sides of a pixel along and across the flow.
    pub pixel: [f64; 2],
    /// True where the lines are a ring.
    pub periodic: bool,
    /// Gaps, `long` to a line; 0 where closed.
    pub gaps: Vec<f64>,
}

impl Oriented {
    /// The pixel beside `i` on the next line, if there is one.
    pub fn next_line(&self, i: usize) -> Option<usize> {
        let next = i + self.long;
        if next < self.gaps.len() {
            Some(next)
        } else {
            (self.periodic && self.wide > 1).then(|| next - self.gaps.len())
        }
    }

    /// The next pixel along the flow, if there is one.
    pub fn ahead(&self, i: usize) -> Option<usize> {
        (i % self.long + 1 < self.long).then_some(i + 1)
    }
}
