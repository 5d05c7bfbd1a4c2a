//! A map of gaps, seen along one of its axes.

use crate::{HeightMap, fill};
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
    /// True where a flow leaves over one side and enters again over the other.
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

    /// The same on pixels of twice the sides, each with the gap of equal g³ on the mean: that of its parts
    /// that were measured, or with those that were not as `closed` ones.
    pub(super) fn halved(&self, closed: bool) -> Halved {
        let nodes = self.nodes.map(|n| n.div_ceil(2));
        let pixel = [0, 1].map(|k| self.pixel[k] * self.nodes[k] as f64 / nodes[k] as f64);
        let [nx, ny] = self.nodes;
        let mean = |i: usize| {
            let (x, y) = (2 * (i % nodes[0]), 2 * (i / nodes[0]));
            let (mut cubes, mut count) = (0.0, 0.0);
            for row in y..(y + 2).min(ny) {
                for gap in &self.values[row * nx + x..row * nx + (x + 2).min(nx)] {
                    if gap.is_nan() && !closed {
                        continue;
                    }
                    count += 1.0;
                    cubes += if *gap > 0.0 { f64::from(*gap).powi(3) } else { 0.0 };
                }
            }
            if count > 0.0 { (cubes / count).cbrt() as f32 } else { f32::NAN }
        };
        let values = (0..nodes[0] * nodes[1]).map(mean).collect();
        Halved { nodes, pixel, periodic: self.periodic, values }
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

/// Gaps on pixels twice as wide.
pub(super) struct Halved {
    nodes: [usize; 2],
    pixel: [f64; 2],
    periodic: bool,
    values: Vec<f32>,
}

impl Halved {
    /// A view of them.
    pub fn gap(&self) -> Gap<'_> {
        Gap { nodes: self.nodes, pixel: self.pixel, periodic: self.periodic, values: &self.values }
    }

    /// With the holes filled smoothly from their rims; None where too little is left for that.
    pub fn filled(self) -> Option<Halved> {
        let heights = self.values.iter().map(|gap| f64::from(*gap)).collect();
        let map = HeightMap::new(self.nodes[0], self.nodes[1], self.pixel, heights).ok()?;
        let filled = fill(&map).ok()?;
        Some(Halved { values: filled.heights().iter().map(|gap| *gap as f32).collect(), ..self })
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

    /// The largest gap; 0 where all is closed.
    pub fn largest(&self) -> f64 {
        self.gaps.iter().copied().fold(0.0, f64::max)
    }

    /// The next pixel along the flow, if there is one.
    pub fn ahead(&self, i: usize) -> Option<usize> {
        (i % self.long + 1 < self.long).then_some(i + 1)
    }
}
