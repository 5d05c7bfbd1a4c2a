//! Outlines that were measured: their points as a scene holds them, and the curves that a run takes of them.

use super::SceneError;
use super::messages::{error, length};
use asperity_material::units::Length;
use asperity_mesh::outline::{Fit, FitError, Outline, Span, deepest_dent, fit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, OnceLock};

/// Places and heights of an outline, point by point. Its curve is found once, whichever copy is asked first.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Vec<(Length, Length)>", into = "Vec<(Length, Length)>")]
#[schemars(with = "Vec<(Length, Length)>", inline)]
pub struct Points {
    points: Arc<Vec<[f64; 2]>>,
    found: Arc<OnceLock<(Asked, Found)>>,
}

/// Key of a fitted curve: the span, the bits of the tolerance, and whether the outline is that of a tool.
type Asked = (Span, Option<u64>, bool);

type Found = Result<Arc<Fit>, FitError>;

impl Points {
    /// Of places and heights in metres.
    pub fn new(points: Vec<[f64; 2]>) -> Points {
        Points { points: Arc::new(points), found: Arc::default() }
    }

    /// Places and heights, m.
    pub fn metres(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The curve through the points, upside down for a tool.
    pub(super) fn fit(&self, span: Span, tolerance: Option<Length>, is_tool: bool) -> Found {
        let asked = (span, tolerance.map(|t| t.0.to_bits()), is_tool);
        let find = || {
            let sign = if is_tool { -1.0 } else { 1.0 };
            let points: Vec<[f64; 2]> = self.points.iter().map(|[x, z]| [*x, sign * z]).collect();
            fit(&points, span, tolerance.map(|t| t.0)).map(Arc::new)
        };
        let (first, found) = self.found.get_or_init(|| (asked, find()));
        if *first == asked { found.clone() } else { find() }
    }
}

impl PartialEq for Points {
    fn eq(&self, other: &Points) -> bool {
        self.points == other.points
    }
}

impl From<Vec<(Length, Length)>> for Points {
    fn from(pairs: Vec<(Length, Length)>) -> Points {
        Points::new(pairs.into_iter().map(|(x, z)| [x.0, z.0]).collect())
    }
}

impl From<Points> for Vec<(Length, Length)> {
    fn from(points: Points) -> Self {
        points.points.iter().map(|[x, z]| (Length(*x), Length(*z))).collect()
    }
}

/// The curve fitted to measured points, in numbers.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Smoothing {
    /// Table of the scene that names the points: `asperity[0]`, `tool`.
    pub table: String,
    /// Number of points.
    pub points: usize,
    /// Number of arcs of the curve.
    pub arcs: usize,
    /// Standard deviation of the points about the curve that was allowed for, m.
    pub tolerance: f64,
    /// Greatest distance of a point from the curve, m.
    pub farthest: f64,
    /// Places of the corners that were kept, m.
    pub corners: Vec<f64>,
}

impl Smoothing {
    pub(super) fn new(table: impl Into<String>, points: &Points, fit: &Fit) -> Smoothing {
        Smoothing {
            table: table.into(),
            points: points.metres().len(),
            arcs: fit.outline.arc_count(),
            tolerance: fit.tolerance,
            farthest: fit.farthest,
            corners: fit.corners.clone(),
        }
    }
}

/// The error of a fit of `points` in the words of a scene; paths are relative to the table, a point is
/// `points[i]`.
pub(super) fn refused(points: &Points, e: FitError) -> SceneError {
    match e.point {
        Some(point) => {
            let place = points.metres().get(point).map_or(f64::NAN, |p| p[0]);
            error(format!("points[{point}]"), format!("the point at {} {}", length(place), e.message))
        }
        None => error("points", format!("the points {}", e.message)),
    }
}

/// Least share of the height at which a half begins: what begins lower is a whole section, from foot to foot.
const HALF_WAY: f64 = 0.5;

/// The part of a section that the points of an asperity are: a half begins on its axis, at least half way up.
pub(super) fn span_of(points: &[[f64; 2]]) -> Span {
    let heights = || points.iter().map(|p| p[1]);
    let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    let begins_high = points.first().is_some_and(|p| p[0] >= 0.0 && p[1] >= low + HALF_WAY * (high - low));
    if begins_high { Span::Half } else { Span::Whole }
}

/// Steepest slope (tangent) that a mesh follows.
const STEEPEST: f64 = 3.0;

/// The outline of an asperity as seen from its summit, from foot to foot, and its height (m). The feet are
/// the lowest points on either side; the side whose foot is higher goes on to the base plane, with its mean
/// slope at least.
pub(super) fn asperity(
    points: &Points,
    tolerance: Option<Length>,
) -> Result<(Arc<Outline>, f64), SceneError> {
    let span = span_of(points.metres());
    let fit = points.fit(span, tolerance, false).map_err(|e| refused(points, e))?;
    let steepest = fit.outline.steepest();
    if steepest > STEEPEST {
        return Err(error(
            "points",
            format!(
                "the points rise at {:.0} degrees, more than the {:.0} that a mesh follows: cut the outline off where it is too steep, or smooth it with a greater `tolerance`",
                steepest.atan().to_degrees(),
                STEEPEST.atan().to_degrees()
            ),
        ));
    }
    if span == Span::Half {
        let foot = lowest_place(&fit.outline);
        let (cut, height) = (fit.outline.cut(foot), fit.outline.depth_at(foot));
        return if height > 0.0 && height.is_finite() { Ok((cut.shared(), height)) } else { Err(level()) };
    }
    let [x, drop] = fit.outline.summit();
    let seen = fit.outline.seen_from(x, drop);
    let [left, right] = seen.ends();
    if left >= 0.0 || right <= 0.0 {
        return Err(error(
            "points",
            "the points have their highest at an end: give a ridge from foot to foot, or half of it from its axis outward",
        ));
    }
    let image = seen.reversed();
    let (to_left, to_right) = (lowest_place(&image), lowest_place(&seen));
    let height = image.depth_at(to_left).max(seen.depth_at(to_right));
    if !(height > 0.0 && height.is_finite()) {
        return Err(level());
    }
    let seen = seen.part_between(-to_left, to_right).down_to(height);
    Ok((seen.reversed().down_to(height).reversed().shared(), height))
}

/// The error of an outline of which nothing is left.
fn level() -> SceneError {
    error(
        "points",
        "the points fall from no summit once they are smoothed: give the outline to its foot, and a smaller `tolerance`",
    )
}

/// The place of the greatest drop to the right of 0.
fn lowest_place(outline: &Outline) -> f64 {
    let right = outline.extremes().into_iter().filter(|p| p[0] > 0.0);
    right.fold([0.0, f64::NEG_INFINITY], |low, p| if p[1] > low[1] { p } else { low })[0]
}

/// Dent over height up to which a tool counts as convex, and the same in tolerances.
const FLAT_DENT: f64 = 1e-3;
const DENT_IN_TOLERANCES: f64 = 3.0;

/// The outline of a tool, as the rise from its apex.
pub(super) fn tool(points: &Points, tolerance: Option<Length>) -> Result<Arc<Outline>, SceneError> {
    let fit = points.fit(Span::Half, tolerance, true).map_err(|e| refused(points, e))?;
    let (outline, height) = (&fit.outline, fit.outline.lowest());
    let dent = deepest_dent(outline);
    let most = (FLAT_DENT * height).max(DENT_IN_TOLERANCES * fit.tolerance);
    let point_at = |x: f64| {
        let all = points.metres().iter().map(|p| (p[0] - x).abs()).enumerate();
        let point = all.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i);
        format!("points[{point}]")
    };
    if outline.depth_at(0.0) > most {
        let [x, _] = outline.summit();
        return Err(error(
            point_at(x),
            format!(
                "the point is the lowest of the tool, but lies {} from the axis, where the tool is {} higher: its apex must be on the axis; count the places from there, and close a hole in the middle",
                length(x),
                length(outline.depth_at(0.0))
            ),
        ));
    }
    if dent.depth > most {
        return Err(error(
            point_at(dent.x),
            format!(
                "the point lies in a dent {} deep, at {} from the axis: a tool must be convex (to {} here), its apex on the axis and its outline rising ever more steeply; close the dent, or smooth it with a greater `tolerance`",
                length(dent.depth),
                length(dent.x),
                length(most)
            ),
        ));
    }
    let steepest = outline.steepest();
    if steepest > STEEPEST_TOOL {
        return Err(error(
            "points",
            format!(
                "the points rise at {:.1} degrees, more than the {:.0} up to which a tool presses: cut the outline off where it stands upright",
                steepest.atan().to_degrees(),
                STEEPEST_TOOL.atan().to_degrees()
            ),
        ));
    }
    Ok(Arc::new(outline.clone()))
}

/// Steepest slope (tangent) of a tool.
const STEEPEST_TOOL: f64 = 12.0;
