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
    /// pixel, half of the relative error of the area, or what another slope gives; the most of this load and
    /// its neighbours.
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
/// Loads to each side that the slope of the law is taken over, where they are near and the contact is spots:
/// it is within the error of the chord there, and needs no loads of its own.
const NEIGHBOURS: usize = 2;
/// A load is near below so many times the other.
const NEAR_LOAD: f64 = 1.5;
/// Share of the area in contact up to which the law bends so little.
const SPOTS: f64 = 0.2;
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

/// A load on the way, with what its errors are of.
struct Step {
    point: JointPoint,
    /// Stiffness of the fixed set of pixels, elastic.
    rims: Option<f64>,
    /// True where the loads beside it give its stiffness.
    inner: bool,
}

impl Step {
    fn new(
        body: &HalfSpace,
        surface: &Surface,
        found: &HalfSpaceContact,
        first_gap: f64,
        inner: bool,
    ) -> Result<Step, HalfSpaceError> {
        // without a stiffness nothing touches, or no gap is left
        let touches = found.stiffness.is_some() || inner;
        let loading = if touches && !inner { chord(body, surface, found)? } else { None };
        let elastic = if touches && found.limited_share > 0.0 {
            let left = found.flattened_surface(surface);
            chord(&HalfSpace { limit: None, ..*body }, left.as_ref().unwrap_or(surface), found)?
        } else {
            loading
        };
        let point = JointPoint {
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
            error: None,
            repeatability: None,
        };
        let rims = body.elastic_stiffness(surface, found).map(|rims| rims.gap);
        Ok(Step { point, rims, inner })
    }
}

/// The points of `steps` with the stiffnesses that the loads beside them give, and all errors.
fn finished(steps: Vec<Step>) -> Vec<JointPoint> {
    let mut points: Vec<JointPoint> = steps.iter().map(|step| step.point).collect();
    for (i, step) in steps.iter().enumerate() {
        let mut bend = 0.0;
        if step.inner {
            let slope = |reach| slope_over_load(&steps, i, reach);
            let (wide, near) = (slope(2), slope(1));
            points[i].stiffness = wide.map(|s| s.gap);
            if step.point.limited_share == 0.0 {
                points[i].elastic = wide;
            }
            bend = wide.zip(near).map_or(0.0, |(wide, near)| (near.gap / wide.gap - 1.0).abs());
        }
        let area = points[i].area;
        // of a spot the stiffness is as its radius: half of the error of the area
        let of_area = (area.corrected > 0.0).then(|| 0.5 * area.error / area.corrected);
        let of_rims = points[i].elastic.zip(step.rims).map(|(found, rims)| (rims / found.gap - 1.0).abs());
        let known = of_rims.or((step.inner && points[i].elastic.is_some()).then_some(bend));
        points[i].error = known.zip(of_area).map(|(a, b)| a.max(b).max(bend));
    }
    let reach = |i: usize| if steps[i].inner { NEIGHBOURS } else { 1 };
    let found: Vec<Option<f64>> = points.iter().map(|point| point.error).collect();
    // rims may lie well at one load by chance
    for (i, point) in points.iter_mut().enumerate() {
        let near = &found[i.saturating_sub(reach(i))..(i + reach(i) + 1).min(found.len())];
        point.error = found[i].and_then(|_| near.iter().flatten().copied().reduce(f64::max));
    }
    points
}

/// The stiffness at load `i` of `steps` by the polynomial in the logarithm of the load through the `reach`
/// loads to both sides, or as many nearer the other end; None where it does not close there.
fn slope_over_load(steps: &[Step], i: usize, reach: usize) -> Option<Stiffness> {
    let first = steps.iter().position(|step| step.point.pressure > 0.0)?;
    let start = i.saturating_sub(reach).max(first).min(steps.len().checked_sub(2 * reach + 1)?);
    let near = start.max(first)..start + 2 * reach + 1;
    let load = |k: usize| steps[k].point.pressure.ln();
    // of Lagrange's polynomial that is 1 at load k, the slope at load i
    let weight = |k: usize| {
        let others = || near.clone().filter(move |m| *m != k);
        let part = |m: usize| {
            let rest = others().filter(|n| *n != m);
            rest.map(|n| (load(i) - load(n)) / (load(k) - load(n))).product::<f64>() / (load(k) - load(m))
        };
        others().map(part).sum::<f64>()
    };
    let weights: Vec<(usize, f64)> = near.clone().map(|k| (k, weight(k))).collect();
    let slope =
        |of: &dyn Fn(&JointPoint) -> f64| -weights.iter().map(|(k, w)| w * of(&steps[*k].point)).sum::<f64>();
    let (gap, plane) = (slope(&|point| point.mean_gap), slope(&|point| point.separation));
    let pressure = steps[i].point.pressure;
    (gap > 0.0 && plane > 0.0).then(|| Stiffness { gap: pressure / gap, plane: pressure / plane })
}

/// True where the loads beside `pressures[i]` are so near that the stiffness is the slope between them.
fn lies_between(pressures: &[f64], i: usize) -> bool {
    let last = pressures.len() - 1;
    let near = &pressures[i.saturating_sub(NEIGHBOURS)..(i + NEIGHBOURS + 1).min(pressures.len())];
    (1..last).contains(&i)
        && last >= 2 * NEIGHBOURS
        && near.windows(2).all(|pair| pair[1] <= NEAR_LOAD * pair[0] && pair[0] < pair[1])
}

/// The contact `last` with its pressures extrapolated from those of `before`, to start from.
fn extrapolated(last: &HalfSpaceContact, before: &HalfSpaceContact, pressure: f64) -> HalfSpaceContact {
    let ahead = ((pressure - last.pressure) / (last.pressure - before.pressure)) as f32;
    let mut start = last.clone();
    for (p, old) in start.pressures.iter_mut().zip(&before.pressures) {
        *p = (*p + ahead * (*p - old)).max(0.0);
    }
    start
}

impl JointPoint {
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
    let body = &body.for_a_series();
    let mut steps = vec![Step::new(body, surface, &touch, first_gap, false)?];
    let (mut last, mut before): (Option<HalfSpaceContact>, Option<HalfSpaceContact>) = (None, None);
    let mut stopped = false;
    for (i, pressure) in pressures.iter().enumerate() {
        let near = lies_between(pressures, i);
        let rising = last.as_ref().zip(before.as_ref()).filter(|(a, b)| a.pressure > b.pressure);
        let ahead = rising.map(|(a, b)| extrapolated(a, b, *pressure));
        let (start, load) = (ahead.as_ref().or(last.as_ref()), Load::Pressure(*pressure));
        let spots = last.as_ref().is_some_and(|last| NEAR_LOAD * last.area.ratio <= SPOTS);
        let inner = near && spots;
        // every other load has the errors of those beside it
        let found = if inner && i % 2 == 1 {
            body.press_without_stiffness(surface, load, start)?
        } else {
            body.press_from(surface, load, start)?
        };
        steps.push(Step::new(body, surface, &found, first_gap, inner)?);
        stopped = !visit(steps.len() - 1, &found)?;
        before = last.replace(found);
        if stopped {
            break;
        }
    }
    drop(before);
    let loading = finished(steps);
    let unloading = match last.filter(|_| !stopped) {
        Some(peak) => way_back(body, surface, &loading, &peak)?,
        None => Vec::new(),
    };
    Ok(JointPath { loading, unloading, nominal_area: touch.nominal_area, stopped })
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
    let mut steps: Vec<Step> = Vec::new();
    let mut last = peak.clone();
    for from in back.step_by(WAY_BACK_STRIDE).chain(loading.first()) {
        if steps.last().is_some_and(|one| one.point.pressure <= from.pressure) {
            continue;
        }
        last = elastic.press_from(left, Load::Pressure(from.pressure), Some(&last))?;
        let mut step = Step::new(&elastic, left, &last, loading[0].mean_gap, false)?;
        step.point.separation -= shift;
        steps.push(step);
    }
    Ok(finished(steps))
}
