//! Bodies of revolution and lines that stand for a part of a map.

use asperity_roughness::asperities::{Asperity, Direction, RadialProfile};

/// A body of revolution that stands for an asperity, with its scene.
#[derive(Clone, Debug)]
pub struct Body {
    /// Number of the asperity, from 1 at the highest.
    pub number: usize,
    /// The asperity on the map.
    pub asperity: Asperity,
    /// The mean height around its summit.
    pub profile: RadialProfile,
    /// Depth to which it is to be crushed, m.
    pub depth: f64,
    /// Text of its scene; the profile lies in ../profiles/NNN.csv.
    pub scene: String,
}

/// A line of the map with its scene in plane strain.
#[derive(Clone, Debug)]
pub struct Line {
    /// Name of its files, such as `line-y-200um`.
    pub name: String,
    /// The direction in which it runs.
    pub direction: Direction,
    /// Its position across that, m.
    pub at: f64,
    /// Way along it and height above its lowest point, m.
    pub points: Vec<[f64; 2]>,
    /// Depth to which its highest point is to be crushed, m.
    pub depth: f64,
    /// Text of its scene; the profile lies in ../profiles.
    pub scene: String,
}

impl Line {
    /// From its first to its last point, m.
    pub fn length(&self) -> f64 {
        match &self.points[..] {
            [first, .., last] => last[0] - first[0],
            _ => 0.0,
        }
    }
}
