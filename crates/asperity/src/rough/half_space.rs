//! The contact of a surface on a half-space with its load curve, unloading, gap and leak.

use asperity_roughness::flow::{Axis, Constriction, Gap, Leak, constriction, leak};
use asperity_roughness::half_space::{
    HalfSpace, HalfSpaceContact, HalfSpaceError, LimitSource, PressureLimit, patches,
};
use asperity_roughness::scene::Scene;
use asperity_roughness::{CurvePoint, Load, Surface, fill};

/// Residual of the points of a load curve before its last: areas to a few per mille.
const CURVE_TOLERANCE: f64 = 1e-4;

/// Share by which a hardness may be off the plateau of yield stress and hardening without a word: what atlas
/// and slope leave.
pub(super) const CONTRADICTION: f64 = 0.1;

/// A surface on a half-space.
#[derive(Clone, Debug)]
pub struct SpaceContact {
    /// The half-space.
    pub body: HalfSpace,
    /// Its limit of pressure; None of an elastic one.
    pub limit: Option<PressureLimit>,
    /// The contact at the load.
    pub contact: HalfSpaceContact,
    /// From first touch to the load.
    pub curve: Vec<CurvePoint>,
    /// Back from the load, where unloading was asked for.
    pub unloading: Option<SpaceUnloading>,
    /// The gap along x and along y.
    pub passages: [Passage; 2],
    /// True where the flow was asked for.
    pub flows: bool,
    /// Patches of pixels in contact, joined over sides and corners.
    pub patches: usize,
}

/// The unloading of a half-space: elastic, on the surface as the flow left it.
#[derive(Clone, Debug)]
pub struct SpaceUnloading {
    /// First touch minus last touch, in metres.
    pub residual_displacement: f64,
    /// Work returned over work done; None without work.
    pub elastic_share: Option<f64>,
    /// Root mean square height of the surface after unloading, in metres.
    pub residual_sq: f64,
    /// From the load to the last touch.
    pub curve: Vec<CurvePoint>,
}

/// The gap along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The narrowest place of the widest path; None where no path crosses.
    pub narrowest: Option<Constriction>,
    /// The flow; None where nothing passes or no flow was asked for.
    pub leak: Option<Leak>,
    /// The place that only points without a height close.
    pub unknown: Option<UnknownPassage>,
}

/// A way that is closed because heights are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnknownPassage {
    /// Points without a height.
    pub missing: usize,
    /// The narrowest place of the widest path where they are filled from their rims; None where none crosses
    /// then either.
    pub filled: Option<Constriction>,
}

/// The half-space with the metal of `scene` and the limit of pressure `limit`; None of an elastic one.
pub(crate) fn body(scene: &Scene, limit: Option<f64>) -> HalfSpace {
    let reduced_modulus = scene.material.elastic().reduced_modulus();
    HalfSpace { reduced_modulus, limit, tolerance: scene.half_space.tolerance() }
}

impl SpaceContact {
    /// The results that a scene asks for of the contact `found` of `body` on `surface`.
    pub(super) fn evaluate(
        body: HalfSpace,
        limit: Option<PressureLimit>,
        surface: &Surface,
        scene: &Scene,
        found: HalfSpaceContact,
    ) -> Result<SpaceContact, HalfSpaceError> {
        let points = scene.half_space.load_points(surface.map.heights().len());
        let high = surface.extent.high - surface.parameters.mean;
        let curve = curve(&body, surface, &found, points, high)?;
        let unloading =
            scene.load.unload.then(|| unload(&body, surface, &found, &curve, points)).transpose()?;
        // in a comparison of closures the flow is a cost that only a fluid asks for
        let asked = scene.fluid.is_some() || !scene.closure.is_several();
        let flows = scene.half_space.leak.unwrap_or(asked);
        let passages = Passage::both(&body, surface, &found, flows)?;
        let patches = patches(&surface.map, &found.pressures);
        Ok(SpaceContact { body, limit, contact: found, curve, unloading, passages, flows, patches })
    }
}

impl Passage {
    /// The gap of the contact `found` of `body` on `surface` along x and along y, with its flow where
    /// `flows`.
    ///
    /// # Errors
    /// A surface with its holes filled that does not carry the load, where points without a height decide.
    pub(crate) fn both(
        body: &HalfSpace,
        surface: &Surface,
        found: &HalfSpaceContact,
        flows: bool,
    ) -> Result<[Passage; 2], HalfSpaceError> {
        let gap = Gap::new(&surface.map, &found.gaps);
        let passage = |axis| {
            let narrowest = constriction(&gap, axis);
            let leak = narrowest.filter(|_| flows).and_then(|_| leak(&gap, axis));
            Passage { narrowest, leak, unknown: None }
        };
        let (mut x, mut y) = rayon::join(|| passage(Axis::X), || passage(Axis::Y));
        let closed = |one: &Passage, axis| one.narrowest.is_none() && is_closed_by_missing(&gap, axis);
        let unknown = [closed(&x, Axis::X), closed(&y, Axis::Y)];
        if unknown != [false; 2] {
            let filled = with_points_filled(body, surface, found.pressure)?;
            let tell = |axis| UnknownPassage {
                missing: surface.map.missing(),
                filled: constriction(&Gap::new(&surface.map, &filled.gaps), axis),
            };
            x.unknown = unknown[0].then(|| tell(Axis::X));
            y.unknown = unknown[1].then(|| tell(Axis::Y));
        }
        Ok([x, y])
    }

    /// Volume flux times viscosity over pressure difference, m³; 0 where nothing passes; None where it was
    /// not asked for, or points without a height decide.
    pub(crate) fn conductance(&self, flows: bool) -> Option<f64> {
        (flows && self.unknown.is_none()).then(|| self.leak.map_or(0.0, |leak| leak.conductance))
    }
}

/// True where a path would cross if every point without a height were open.
fn is_closed_by_missing(gap: &Gap<'_>, axis: Axis) -> bool {
    let opened: Vec<f32> = gap.values.iter().map(|z| if z.is_nan() { f32::MAX } else { *z }).collect();
    gap.values.iter().any(|z| z.is_nan()) && constriction(&Gap { values: &opened, ..*gap }, axis).is_some()
}

/// The contact at the same pressure where the holes of the surface are filled from their rims.
fn with_points_filled(
    body: &HalfSpace,
    surface: &Surface,
    pressure: f64,
) -> Result<HalfSpaceContact, HalfSpaceError> {
    let filled = fill(&surface.map).and_then(Surface::from_map);
    // a map that was pressed has a cell, and so has the filled one
    let filled = filled.unwrap_or_else(|_| surface.clone());
    body.press_without_stiffness(&filled, Load::Pressure(pressure), None)
}

impl SpaceContact {
    /// True where the load curve is two points with nothing between them.
    pub(super) fn has_ends_only(&self) -> bool {
        self.curve.len() == 2
    }

    /// True where an open path crosses along an axis; None where points without a height decide.
    pub fn percolates(&self, axis: usize) -> Option<bool> {
        let Passage { narrowest, unknown, .. } = &self.passages[axis];
        unknown.is_none().then_some(narrowest.is_some())
    }

    /// Flux times viscosity over pressure difference along an axis, m³; 0 where nothing passes; None where it
    /// was not asked for, or points without a height decide.
    pub fn leak(&self, axis: usize) -> Option<f64> {
        self.passages[axis].conductance(self.flows)
    }

    /// Relative error of the leak along an axis; None without one, or where nothing bounds it.
    pub fn leak_error(&self, axis: usize) -> Option<f64> {
        self.passages[axis].leak.map(|leak| leak.error).filter(|error| error.is_finite())
    }

    /// The origin of the limit of pressure, in words.
    pub(super) fn limit_from(&self) -> Option<String> {
        let words = match self.limit?.source {
            LimitSource::Hardness => "hardness",
            LimitSource::YieldStress => "3 yield_stress",
            LimitSource::Atlas(_) => "atlas of cones",
        };
        Some(words.into())
    }

    /// Slope at which the atlas was read, degrees.
    pub(super) fn limit_slope_deg(&self) -> Option<f64> {
        match self.limit?.source {
            LimitSource::Atlas(tan) => Some(tan.atan().to_degrees()),
            _ => None,
        }
    }

    /// 95 % bound of the error of the corrected area ratio: of its pixels, and of the limit of pressure.
    pub fn area_error(&self) -> f64 {
        area_error(&self.contact, self.limit.map_or(0.0, |limit| limit.error))
    }

    /// True where the area is load over limit to a twentieth: the roughness hardly matters.
    pub(super) fn saturated(&self) -> bool {
        const NEARLY: f64 = 1.05;
        let area = self.contact.area.corrected;
        self.body.limit.is_some_and(|limit| area > 0.0 && area <= NEARLY * self.contact.pressure / limit)
    }

    /// Relative error of the load where `asked` is what was asked for, in Pa.
    pub(super) fn load_error(&self, asked: f64) -> Option<f64> {
        (asked > 0.0).then(|| (self.contact.pressure / asked - 1.0).abs())
    }
}

/// 95 % bound of the error of the corrected area ratio of `contact`, whose limit of pressure is uncertain
/// by the share `limit_error`.
pub(super) fn area_error(contact: &HalfSpaceContact, limit_error: f64) -> f64 {
    let of_limit = contact.limit.map_or(0.0, |limit| contact.limit_sensitivity(limit) * limit_error);
    contact.area.error.hypot(contact.area.corrected * of_limit)
}

fn point(contact: &HalfSpaceContact) -> CurvePoint {
    CurvePoint { separation: contact.separation, pressure: contact.pressure, area_ratio: contact.area.ratio }
}

/// From first touch at `high` above the mean to the load: pressures rising as squares.
///
/// Each is searched from coarse grids: the contact at a lower load lacks the places that a higher one adds,
/// and from there the search takes two to five times as many convolutions.
fn curve(
    body: &HalfSpace,
    surface: &Surface,
    end: &HalfSpaceContact,
    points: usize,
    high: f64,
) -> Result<Vec<CurvePoint>, HalfSpaceError> {
    let mut curve = vec![CurvePoint { separation: high, pressure: 0.0, area_ratio: 0.0 }];
    if end.pressure <= 0.0 {
        return Ok(vec![point(end)]);
    }
    let rough = HalfSpace { tolerance: body.tolerance.max(CURVE_TOLERANCE), ..*body };
    for k in 1..points {
        let share = (k as f64 / points as f64).powi(2);
        let load = Load::Pressure(share * end.pressure);
        curve.push(point(&rough.press_without_stiffness(surface, load, None)?));
    }
    curve.push(point(end));
    Ok(curve)
}

fn unload(
    body: &HalfSpace,
    surface: &Surface,
    found: &HalfSpaceContact,
    loading: &[CurvePoint],
    points: usize,
) -> Result<SpaceUnloading, HalfSpaceError> {
    let work = found.elastic_work + found.plastic_work;
    let left = found.flattened_surface(surface).ok();
    let left = left.as_ref().unwrap_or(surface);
    let mut back = if body.limit.is_none() {
        loading.to_vec()
    } else {
        let elastic = HalfSpace { limit: None, ..*body };
        let high = left.extent.high - surface.parameters.mean;
        let mut back = curve(&elastic, left, found, points, high)?;
        // separations count from the mean of the surface as it was
        let shift = left.parameters.mean - surface.parameters.mean;
        let inner = back.len().saturating_sub(1);
        back[1..inner.max(1)].iter_mut().for_each(|p| p.separation += shift);
        back
    };
    back.reverse();
    Ok(SpaceUnloading {
        residual_displacement: found.residual_displacement,
        elastic_share: (work > 0.0).then(|| found.elastic_work / work),
        residual_sq: left.parameters.sq,
        curve: back,
    })
}
