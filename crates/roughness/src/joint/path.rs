//! A surface pressed from first touch to a largest load, and back.

use crate::half_space::{Area, HalfSpace, HalfSpaceContact, HalfSpaceError, Stiffness};
use crate::{Load, Surface};
use thiserror::Error;

/// Loads between two of unloading, where flow has changed the surface.
const WAY_BACK_STRIDE: usize = 3;

/// The reason why a surface has no law.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum JointError {
    /// The half-space cannot carry a load.
    #[error(transparent)]
    HalfSpace(#[from] HalfSpaceError),
    /// The largest load is none.
    #[error(
        "nothing touches at this load, so that the joint has no law: give a pressure above 0, or a separation below the highest point"
    )]
    NoTouch,
    /// All heights are equal.
    #[error(
        "the map is flat: a plane touches all of it at once, and no gap is left that a law could be of; check height_unit, level and filters"
    )]
    Flat,
}

/// A joint at one load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPoint {
    /// Nominal pressure, in Pa.
    pub pressure: f64,
    /// Plane above the mean height, in metres; of a map that stands free the dent of the body is in it.
    pub separation: f64,
    /// Mean distance of plane and surface, in metres.
    pub mean_gap: f64,
    /// Fall of the mean gap since first touch, in metres.
    pub approach: f64,
    /// Contact area.
    pub area: Area,
    /// Largest pressure of a pixel, in Pa.
    pub largest_pressure: f64,
    /// Share of the contact area at the limit of pressure.
    pub limited_share: f64,
    /// dp/d(approach) on loading, pixels at the limit carrying no more, in Pa/m; none without contact or gap.
    pub stiffness: Option<f64>,
    /// Elastic stiffness of the contact as it stands, in Pa/m; none without contact or gap.
    pub elastic: Option<Stiffness>,
    /// Work stored in the body since first touch, in J.
    pub elastic_work: f64,
    /// Relative error of the elastic stiffness by the pixels: what it jumps by as rims go from pixel to
    /// pixel, or half of the relative error of the area, the most of this load and its neighbours.
    pub error: Option<f64>,
    /// Two relative standard deviations of the elastic stiffness between maps of the same surface: what
    /// another map may differ by. None of one map.
    pub repeatability: Option<f64>,
}

/// A joint from first touch to its largest load, and back.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPath {
    /// Rising from first touch, which carries nothing.
    pub loading: Vec<JointPoint>,
    /// From the largest load to last touch: elastic, on the surface as flow left it. A second loading
    /// follows the same curve.
    pub unloading: Vec<JointPoint>,
    /// Area over which the pressure is nominal, in m².
    pub nominal_area: f64,
    /// True where the observer ended it.
    pub stopped: bool,
}

/// Chords of the law reach so far to both sides of a load, as a share of it: its rims move by pixels there,
/// which the stiffness of a fixed set of pixels jumps with.
const REACH: f64 = 0.1;
/// Share of the gap below which a chord that closes it is halved, so often at most: there the law bends too
/// much for it.
const LEAST_GAP: f64 = 0.25;
const HALVINGS: usize = 3;

/// The stiffness of `body` on `surface` about the contact `found`: the chord of its law over a tenth of the
/// load to both sides. None without a gap.
fn chord(
    body: &HalfSpace,
    surface: &Surface,
    found: &HalfSpaceContact,
) -> Result<Option<Stiffness>, HalfSpaceError> {
    let p = found.pressure;
    let press = |pressure: f64| body.press_without_stiffness(surface, Load::Pressure(pressure), Some(found));
    let room = body.limit.map_or(f64::INFINITY, |limit| 0.5 * (limit - p));
    let mut reach = (REACH * p).min(room);
    let mut above = press(p + reach)?;
    for _ in 0..HALVINGS {
        if above.mean_gap >= LEAST_GAP * found.mean_gap {
            break;
        }
        reach *= 0.5;
        above = press(p + reach)?;
    }
    let below = press(p - reach)?;
    let load = above.pressure - below.pressure;
    let (gap, plane) = (below.mean_gap - above.mean_gap, below.separation - above.separation);
    let closes = found.mean_gap > 0.0 && gap > 0.0 && plane > 0.0;
    Ok(closes.then(|| Stiffness { gap: load / gap, plane: load / plane }))
}

impl JointPoint {
    fn new(
        body: &HalfSpace,
        surface: &Surface,
        found: &HalfSpaceContact,
        first_gap: f64,
    ) -> Result<JointPoint, HalfSpaceError> {
        // without a stiffness nothing touches, or no gap is left
        let loading = if found.stiffness.is_some() { chord(body, surface, found)? } else { None };
        let elastic = match loading {
            Some(_) if found.limited_share > 0.0 => {
                let left = found.flattened_surface(surface);
                chord(&HalfSpace { limit: None, ..*body }, left.as_ref().unwrap_or(surface), found)?
            }
            same => same,
        };
        // of a spot the stiffness is as its radius: half of the error of the area
        let of_area = (found.area.corrected > 0.0).then(|| 0.5 * found.area.error / found.area.corrected);
        let of_rims = elastic.zip(body.elastic_stiffness(surface, found));
        let of_rims = of_rims.map(|(chord, rims)| (rims.gap / chord.gap - 1.0).abs());
        Ok(JointPoint {
            pressure: found.pressure,
            separation: found.separation,
            mean_gap: found.mean_gap,
            approach: first_gap - found.mean_gap,
            area: found.area,
            largest_pressure: found.largest_pressure,
            limited_share: found.limited_share,
            stiffness: loading.map(|s| s.gap),
            elastic,
            elastic_work: found.elastic_work,
            error: of_rims.zip(of_area).map(|(a, b)| a.max(b)),
            repeatability: None,
        })
    }

    /// Relative error of the elastic stiffness and of the conductances: pixels and repeatability together.
    pub fn whole_error(&self) -> Option<f64> {
        let parts = [self.error, self.repeatability];
        parts.into_iter().flatten().reduce(f64::hypot)
    }
}

/// Presses `surface` by each of `pressures` (Pa, rising), every contact started from the one before, and lets
/// go again. `visit` sees each contact of the loading with its place in the path; false ends the way there.
///
/// # Errors
/// A load that the half-space cannot carry, or those of `visit`.
pub fn follow(
    body: &HalfSpace,
    surface: &Surface,
    pressures: &[f64],
    visit: &mut dyn FnMut(usize, &HalfSpaceContact) -> Result<bool, HalfSpaceError>,
) -> Result<JointPath, JointError> {
    let touch = body.press(surface, Load::Pressure(0.0))?;
    let first_gap = touch.mean_gap;
    let mut path = JointPath {
        loading: vec![JointPoint::new(body, surface, &touch, first_gap)?],
        unloading: Vec::new(),
        nominal_area: touch.nominal_area,
        stopped: false,
    };
    let mut last: Option<HalfSpaceContact> = None;
    for pressure in pressures {
        let found = body.press_from(surface, Load::Pressure(*pressure), last.as_ref())?;
        path.loading.push(JointPoint::new(body, surface, &found, first_gap)?);
        let goes_on = visit(path.loading.len() - 1, &found)?;
        last = Some(found);
        if !goes_on {
            path.stopped = true;
            break;
        }
    }
    take_worst_of_neighbours(&mut path.loading);
    if let Some(peak) = last.filter(|_| !path.stopped) {
        path.unloading = way_back(body, surface, &path.loading, &peak)?;
    }
    Ok(path)
}

/// The elastic unloading from `peak`.
fn way_back(
    body: &HalfSpace,
    surface: &Surface,
    loading: &[JointPoint],
    peak: &HalfSpaceContact,
) -> Result<Vec<JointPoint>, JointError> {
    let back = loading.iter().rev();
    if loading.iter().all(|point| point.limited_share == 0.0) {
        return Ok(back.copied().collect());
    }
    let elastic = HalfSpace { limit: None, ..*body };
    let left = peak.flattened_surface(surface);
    let left = left.as_ref().unwrap_or(surface);
    // separations count from the mean of the surface as it was
    let shift = peak.flattened.iter().map(|f| f64::from(*f)).sum::<f64>() / peak.pixels as f64;
    let mut points = Vec::new();
    let mut last = peak.clone();
    for from in back.step_by(WAY_BACK_STRIDE).chain(loading.first()) {
        if points.last().is_some_and(|one: &JointPoint| one.pressure <= from.pressure) {
            continue;
        }
        last = elastic.press_from(left, Load::Pressure(from.pressure), Some(&last))?;
        let mut point = JointPoint::new(&elastic, left, &last, loading[0].mean_gap)?;
        point.separation -= shift;
        points.push(point);
    }
    take_worst_of_neighbours(&mut points);
    Ok(points)
}

/// Gives each of `points` the largest error of itself and its neighbours: rims may lie well at one load by
/// chance.
fn take_worst_of_neighbours(points: &mut [JointPoint]) {
    let found: Vec<Option<f64>> = points.iter().map(|point| point.error).collect();
    for (i, point) in points.iter_mut().enumerate() {
        let near = &found[i.saturating_sub(1)..(i + 2).min(found.len())];
        point.error = found[i].and_then(|_| near.iter().flatten().copied().reduce(f64::max));
    }
}
