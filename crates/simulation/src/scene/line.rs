//! A measured line as the free surface of a scene in plane strain, parted into its asperities.

use super::SceneError;
use super::measured::{Points, Smoothing, refused};
use super::messages::error;
use asperity_material::units::Length;
use asperity_mesh::outline::{Outline, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// A measured line as written: the whole free surface in plane strain, from its first valley to its last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineProfile {
    /// A csv file, relative to the scene file, with columns such as x_um,z_um (or nm, mm, m), z up. A resolved scene has
    /// `points` in its place.
    #[schemars(example = "line.csv")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Instead of `file`: x and z, point by point.
    #[schemars(extend("examples" = [[["0 um", "0 um"], ["5 um", "1 um"], ["10 um", "0 um"]]]))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Points>,
    /// Standard deviation of its heights that is smoothed away; absent: as far as neighbouring points scatter.
    #[schemars(example = "10 nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Length>,
}

/// A measured line with its asperities, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The line between its outermost valleys, at its own places; drop from its highest summit.
    pub outline: Arc<Outline>,
    /// Drop of its lowest valley.
    pub height: f64,
    /// From left to right.
    pub asperities: Vec<LineAsperity>,
}

/// An asperity of a line, from valley to valley, m.
#[derive(Clone, Debug, PartialEq)]
pub struct LineAsperity {
    /// Seen from its summit.
    pub outline: Arc<Outline>,
    /// Place of the summit.
    pub centre: f64,
    /// Height of the summit over the lowest valley of the line.
    pub height: f64,
}

/// Least height of a summit over the higher of its valleys, as a share of the height of the line: Wolf
/// pruning of ISO 25178-2.
const PRUNED: f64 = 0.05;

/// Most asperities of a line.
const MOST: usize = 500;

impl LineProfile {
    /// The line and its asperities.
    ///
    /// # Errors
    /// Points that are no line, or a line without a summit between two valleys; the path is relative to the
    /// table.
    pub fn line(&self) -> Result<Line, SceneError> {
        let points = match (&self.points, &self.file) {
            (Some(points), None) => points,
            (Some(_), Some(_)) => {
                return Err(error("file", "does not go with `points`: remove one of the two"));
            }
            (None, Some(_)) => {
                return Err(error("file", "was not read: give `points`, or read the scene with its files"));
            }
            (None, None) => return Err(error("", "`file` is missing: give file = \"line.csv\"")),
        };
        let fit = points.fit(Span::Whole, self.tolerance, false).map_err(|e| refused(points, e))?;
        let turns = turns(&fit.outline, PRUNED * fit.outline.lowest());
        let (Some(first), Some(last)) = (turns.first(), turns.last()) else {
            return Err(error(
                "points",
                "the points have no summit between two valleys: give a longer line, or an [[asperity]] with `profile`",
            ));
        };
        let highest = turns.iter().skip(1).step_by(2).fold(f64::INFINITY, |m, t| m.min(t[1]));
        let outline = fit.outline.part_between(first[0], last[0]).seen_from(0.0, highest);
        let height = outline.lowest();
        let asperity = |t: &[[f64; 2]]| LineAsperity {
            outline: fit.outline.part_between(t[0][0], t[2][0]).seen_from(t[1][0], t[1][1]).shared(),
            centre: t[1][0],
            height: height - (t[1][1] - highest),
        };
        let asperities: Vec<LineAsperity> = turns.windows(3).step_by(2).map(asperity).collect();
        if asperities.len() > MOST {
            return Err(error(
                "points",
                format!(
                    "the points have {} asperities, more than the {MOST} of a mesh: cut out a part, or smooth with a greater `tolerance`",
                    asperities.len()
                ),
            ));
        }
        Ok(Line { outline: outline.shared(), height, asperities })
    }

    /// The curve fitted to its points, in numbers.
    pub(super) fn smoothing(&self, table: String) -> Option<Smoothing> {
        let points = self.points.as_ref()?;
        let fit = points.fit(Span::Whole, self.tolerance, false).ok()?;
        Some(Smoothing::new(table, points, &fit))
    }
}

/// Valleys and summits of `outline` in turn, from the first valley to the last, (place, drop), each at least
/// `least` from its neighbours in height; empty without a summit between two valleys.
fn turns(outline: &Outline, least: f64) -> Vec<[f64; 2]> {
    let mut turns: Vec<[f64; 2]> = Vec::new();
    for point in outline.extremes() {
        // on a flank the last point so far is no turn
        if let [.., a, b] = turns[..]
            && (b[1] - a[1]) * (point[1] - b[1]) >= 0.0
        {
            turns.pop();
        }
        turns.push(point);
    }
    while let Some(i) = smallest_step(&turns).filter(|&i| (turns[i + 1][1] - turns[i][1]).abs() < least) {
        if i == 0 {
            turns.remove(0);
        } else if i + 2 == turns.len() {
            turns.pop();
        } else {
            turns.drain(i..i + 2);
        }
    }
    // an end that is a summit is only a part of one
    let is_summit = |a: [f64; 2], b: [f64; 2]| a[1] < b[1];
    if turns.len() >= 2 && is_summit(turns[0], turns[1]) {
        turns.remove(0);
    }
    if let [.., a, b] = turns[..]
        && is_summit(b, a)
    {
        turns.pop();
    }
    if turns.len() < 3 { Vec::new() } else { turns }
}

/// Index of the first of the two neighbours that differ least.
fn smallest_step(turns: &[[f64; 2]]) -> Option<usize> {
    let step = |i: usize| (turns[i + 1][1] - turns[i][1]).abs();
    (0..turns.len().saturating_sub(1)).min_by(|&a, &b| step(a).total_cmp(&step(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sum of two waves: five high summits, ten in all.
    fn wave(second: f64) -> LineProfile {
        let z = |x: f64| 1e-6 * (1.0 - (0.2 * x).cos() + second * (0.2 * x * 7.0).cos());
        let points = (0..=1570).map(|i| 0.1 * f64::from(i)).map(|x| [1e-6 * x, z(x)]).collect();
        LineProfile { file: None, points: Some(Points::new(points)), tolerance: None }
    }

    #[test]
    fn a_wave_has_its_summits_and_ripples_are_none() {
        for second in [0.0, 0.03] {
            let line = wave(second).line().unwrap();
            assert_eq!(line.asperities.len(), 5);
            for (i, asperity) in line.asperities.iter().enumerate() {
                let centre = (f64::from(i as u32) + 0.5) * 31.4159e-6;
                assert!((asperity.centre - centre).abs() < 2e-6, "{i} {}", asperity.centre);
                assert!((asperity.height / 2e-6 - 1.0).abs() < 0.05, "{}", asperity.height);
            }
        }
        assert!(wave(0.4).line().unwrap().asperities.len() > 10);
    }
}
