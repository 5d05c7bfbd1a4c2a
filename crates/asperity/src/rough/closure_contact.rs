//! The contact of one surface by one closure, with its warnings.

use super::half_space::{self, SpaceContact};
use crate::error::InputError;
use crate::results::units::MEGAPASCAL;
use crate::rough::rough_scene::RoughScene;
use asperity_roughness::half_space::{HalfSpace, HalfSpaceContact, HalfSpaceError, PressureLimit};
use asperity_roughness::scene::{Choice, Scene, SceneError};
use asperity_roughness::{
    Closure, ClosureLaw, Coefficient, Contact, ContactError, CurvePoint, Load, PressureField,
    SINGLE_ASPERITY_EXPONENT, Surface, Unloading, press, unload,
};

/// The contact of a surface by one closure at the load.
#[derive(Debug)]
pub struct ClosureContact {
    /// The closure.
    pub closure: Closure,
    /// The contact, or why there is none.
    pub body: Body,
    /// p(β)/H of the closure's elastic pressure at the mean slope.
    pub plasticity_index: Option<f64>,
    /// Nominal pressure: that asked for, or that carried at the separation asked for, in Pa.
    pub nominal: f64,
    /// Area and mean pressure over those of the half-space with the same metal.
    pub judged: Option<[f64; 2]>,
    /// The largest nominal pressure that it carries, in Pa, where that is less than was asked for.
    pub largest_load: Option<f64>,
}

/// The model that presses a surface, with its contact.
#[derive(Debug)]
pub enum Body {
    /// Islands, each by its closure.
    Islands(Box<IslandContact>),
    /// The whole surface at once.
    HalfSpace(Box<SpaceContact>),
    /// Nothing: the reason.
    Failed(String),
}

/// The contact of islands.
#[derive(Debug)]
pub struct IslandContact {
    /// The closure with its material.
    pub law: ClosureLaw,
    /// The contact.
    pub contact: Contact,
    /// Pressure on the pixels.
    pub field: PressureField,
    /// Elastic return, where unloading was asked for.
    pub unloading: Option<Unloading>,
}

impl ClosureContact {
    /// Name of the closure.
    pub fn name(&self) -> &'static str {
        self.closure.name()
    }

    /// The contact of islands, where the closure has them.
    pub fn islands(&self) -> Option<&IslandContact> {
        match &self.body {
            Body::Islands(one) => Some(one),
            _ => None,
        }
    }

    /// The contact on a half-space.
    pub fn space(&self) -> Option<&SpaceContact> {
        match &self.body {
            Body::HalfSpace(one) => Some(one),
            _ => None,
        }
    }

    /// `ok`, or why there are no numbers.
    pub fn status(&self) -> &str {
        match &self.body {
            Body::Failed(reason) => reason,
            _ => "ok",
        }
    }

    /// One of two values by what presses; None of nothing.
    pub(super) fn either<T>(
        &self,
        islands: impl FnOnce(&IslandContact) -> T,
        space: impl FnOnce(&SpaceContact) -> T,
    ) -> Option<T> {
        match &self.body {
            Body::Islands(one) => Some(islands(one)),
            Body::HalfSpace(one) => Some(space(one)),
            Body::Failed(_) => None,
        }
    }

    /// Contact area over nominal area.
    pub fn area_ratio(&self) -> Option<f64> {
        self.either(|i| i.contact.area_ratio, |s| s.contact.area.ratio)
    }

    /// Load over contact area, in Pa; None without contact.
    pub fn mean_pressure(&self) -> Option<f64> {
        self.either(|i| i.contact.mean_pressure(), |s| s.contact.mean_pressure()).flatten()
    }

    /// Largest pixel pressure over nominal pressure.
    pub fn peak_ratio(&self) -> Option<f64> {
        let largest = self.either(|i| i.field.largest, |s| s.contact.largest_pressure)?;
        (self.nominal > 0.0).then(|| largest / self.nominal)
    }

    /// Share of the contact area that is elastic, elastoplastic, plastic, where a limit tells them apart.
    pub fn shares(&self) -> Option<[f64; 3]> {
        let of_space = |s: &SpaceContact| {
            let plastic = s.contact.limited_share;
            (s.contact.area.ratio > 0.0).then_some([1.0 - plastic, 0.0, plastic])
        };
        self.either(|i| i.law.hardness.and(i.contact.shares), of_space).flatten()
    }

    /// From first touch to the load.
    pub fn curve(&self) -> &[CurvePoint] {
        self.either_ref(|i| &i.contact.curve, |s| &s.curve)
    }

    /// Back from the load; empty where unloading was not asked for.
    pub fn unloading_curve(&self) -> &[CurvePoint] {
        self.either_ref(
            |i| i.unloading.as_ref().map_or(&[][..], |u| &u.curve),
            |s| s.unloading.as_ref().map_or(&[][..], |u| &u.curve),
        )
    }

    fn either_ref<'a>(
        &'a self,
        islands: impl FnOnce(&'a IslandContact) -> &'a [CurvePoint],
        space: impl FnOnce(&'a SpaceContact) -> &'a [CurvePoint],
    ) -> &'a [CurvePoint] {
        match &self.body {
            Body::Islands(one) => islands(one),
            Body::HalfSpace(one) => space(one),
            Body::Failed(_) => &[],
        }
    }

    /// Whether unloading follows the load curve back.
    pub fn returns_everything(&self) -> bool {
        self.either(|i| i.law.returns_everything(), |s| s.body.limit.is_none()).unwrap_or(true)
    }
}

/// Remarks on the trust in the numbers.
pub type Warnings = Vec<String>;

/// The contact by `closure` with its warnings; of a scene with all closures, one that lacks its material is a warning alone
/// and one that cannot carry the load says so in its row.
pub(super) fn press_by(
    closure: Closure,
    scene: &RoughScene,
    surface: &Surface,
    coefficient: Option<&Coefficient>,
    spaces: &mut Spaces,
) -> Result<(Option<ClosureContact>, Warnings), InputError> {
    let tables = scene.tables();
    let all = tables.closure == Choice::All;
    let wrong = |key: &str, message: String| scene.error(&SceneError::new(key, message));
    let load = tables.load.load().map_err(|e| scene.error(&e))?;
    let hardness = tables.material.limit();
    let made = |body: Body, elastic: f64, nominal: f64| ClosureContact {
        closure,
        body,
        plasticity_index: hardness.map(|h| elastic / h),
        nominal,
        judged: None,
        largest_load: None,
    };
    let asked = match load {
        Load::Pressure(p) => p,
        Load::Separation(_) => 0.0,
    };
    // on the contact an elastic cone of the mean slope has half of E* tan β
    let sneddon = 0.5 * tables.material.elastic().reduced_modulus() * surface.parameters.mean_gradient;
    if closure.is_half_space() {
        let limit = match closure {
            Closure::HalfSpace => None,
            _ => spaces.limit(scene, surface, load)?,
        };
        if limit.is_none() && closure != Closure::HalfSpace {
            let message = format!(
                "closure \"{}\" needs hardness or yield_stress in [material]: add it, or choose \"half-space\"",
                closure.name()
            );
            return if all {
                Ok((None, vec![format!("skipped: {message}")]))
            } else {
                Err(wrong("closure", message))
            };
        }
        let body = half_space::body(tables, limit.map(|l| l.pressure));
        let found = spaces.contact(&body, surface, load);
        let source = limit.map(|l| l.source);
        let pressed = found.and_then(|found| SpaceContact::of(body, source, surface, tables, found));
        return match pressed {
            Ok(one) => {
                let nominal = if asked > 0.0 { asked } else { one.contact.pressure };
                let warnings = space_remarks(closure, &one, tables);
                Ok((Some(made(Body::HalfSpace(Box::new(one)), sneddon, nominal)), warnings))
            }
            Err(e) if all => {
                let largest_load = match e {
                    HalfSpaceError::Limit { limit_mpa, .. } => Some(limit_mpa * MEGAPASCAL),
                    _ => None,
                };
                let failed = made(Body::Failed(e.to_string()), sneddon, asked);
                let warnings = vec![format!("{}: {e}", closure.name())];
                Ok((Some(ClosureContact { largest_load, ..failed }), warnings))
            }
            Err(e @ HalfSpaceError::Closed { .. }) => Err(wrong("load.separation", e.to_string())),
            Err(e) => Err(wrong("load.pressure", e.to_string())),
        };
    }
    let own = tables.custom.as_ref().filter(|_| closure == Closure::Custom);
    let law = match own.map_or_else(
        || ClosureLaw::new(closure, &tables.material, coefficient),
        |own| Ok(ClosureLaw::own(own, &tables.material)),
    ) {
        Ok(law) => law,
        Err(e) if all => return Ok((None, vec![format!("skipped: {e}")])),
        Err(e) => return Err(wrong("closure", e.to_string())),
    };
    let elastic = law.elastic_pressure(surface.parameters.mean_gradient);
    match press_islands(scene, surface, law, load, coefficient) {
        Ok(one) => {
            let warnings = remarks(closure, &one, coefficient);
            let nominal = if asked > 0.0 { asked } else { one.contact.pressure };
            Ok((Some(made(Body::Islands(Box::new(one)), elastic, nominal)), warnings))
        }
        Err(e @ ContactError::Unreachable { largest_mpa, .. }) if all => {
            let failed = made(Body::Failed(e.to_string()), elastic, asked);
            let warnings = vec![format!("{}: {e}", closure.name())];
            let largest_load = Some(largest_mpa * MEGAPASCAL);
            Ok((Some(ClosureContact { largest_load, ..failed }), warnings))
        }
        Err(e) => Err(wrong("load.pressure", e.to_string())),
    }
}

fn press_islands(
    scene: &RoughScene,
    surface: &Surface,
    law: ClosureLaw,
    load: Load,
    coefficient: Option<&Coefficient>,
) -> Result<IslandContact, ContactError> {
    let contact = press(surface, &law, load)?;
    let scene = scene.tables();
    let field = PressureField::of(&surface.map, &contact, scene.pressure_profile);
    let exponent = coefficient.map_or(SINGLE_ASPERITY_EXPONENT, |c| c.unloading_exponent);
    let unloading = scene.load.unload.then(|| unload(&contact, &law, exponent));
    Ok(IslandContact { law, contact, field, unloading })
}

/// Contacts on half-spaces that were found, for those that are asked for again, and the limit of pressure of the metal on this surface.
#[derive(Default)]
pub(super) struct Spaces {
    limit: Option<Option<PressureLimit>>,
    found: Vec<(HalfSpace, Result<HalfSpaceContact, HalfSpaceError>)>,
}

impl Spaces {
    /// The largest pressure that the metal bears under the patches of `surface` at `load`; None where nothing of its strength is known.
    ///
    /// # Errors
    /// A calibration that cannot be read, of metal whose law of hardening is that of the calibration.
    pub fn limit(
        &mut self,
        scene: &RoughScene,
        surface: &Surface,
        load: Load,
    ) -> Result<Option<PressureLimit>, InputError> {
        if let Some(known) = self.limit {
            return Ok(known);
        }
        let limit = PressureLimit::of(&scene.tables().material, scene.hardening_law()?, surface, load);
        self.limit = Some(limit);
        Ok(limit)
    }

    /// The contact of `surface` at `load`, found once.
    ///
    /// # Errors
    /// Why the half-space has none.
    pub fn contact(
        &mut self,
        body: &HalfSpace,
        surface: &Surface,
        load: Load,
    ) -> Result<HalfSpaceContact, HalfSpaceError> {
        if let Some((_, found)) = self.found.iter().find(|(known, _)| known == body) {
            return found.clone();
        }
        let found = body.press(surface, load);
        self.found.push((*body, found.clone()));
        found
    }
}

/// Area and mean pressure of each closure over those of the half-space with the same metal: elastic for "sneddon", with its
/// limit of pressure for the others.
pub(super) fn judge(
    contacts: &mut [ClosureContact],
    scene: &RoughScene,
    surface: &Surface,
    spaces: &mut Spaces,
) {
    let tables = scene.tables();
    let Ok(load) = tables.load.load() else { return };
    for one in contacts.iter_mut() {
        let elastic = matches!(one.closure, Closure::Sneddon | Closure::HalfSpace);
        let limit = if elastic { None } else { spaces.limit(scene, surface, load).ok().flatten() };
        let known = elastic || limit.is_some();
        let body = half_space::body(tables, limit.map(|l| l.pressure));
        let found = known.then(|| spaces.contact(&body, surface, load));
        if let (Some(Ok(found)), Some(area)) = (found, one.area_ratio())
            && let (Some(pressure), Some(mean)) = (found.mean_pressure(), one.mean_pressure())
        {
            one.judged = Some([area / found.area.ratio, mean / pressure]);
        }
    }
}

fn space_remarks(closure: Closure, one: &SpaceContact, scene: &Scene) -> Warnings {
    let leaks = one.passages.iter().filter_map(|p| p.leak);
    let unbalanced = leaks.filter(|l| l.imbalance > 1e-2).map(|l| {
        format!(
            "{}: the leak was not found to the end (in- and outflow differ by {:.1e})",
            closure.name(),
            l.imbalance
        )
    });
    let area = &one.contact.area;
    let coarse = (area.error > 0.1 * area.ratio).then(|| {
        format!(
            "{}: the contact is made of few pixels: its area is uncertain by {:.0} %; measure finer, or smooth with s_filter",
            closure.name(),
            100.0 * area.error / area.ratio
        )
    });
    let ends = (one.has_ends_only() && scene.half_space.load_points.is_none()).then(|| {
        format!(
            "{}: on so large a map the load curve has first touch and the load alone: for points between them give half_space.load_points \
             (--set half_space.load_points=6), each of which takes about as long as the load",
            closure.name()
        )
    });
    unbalanced.chain(coarse).chain(ends).collect()
}

/// Share of the load below which nothing is said of it: no number moves by more.
const SEEN: f64 = 5e-3;

fn remarks(closure: Closure, one: &IslandContact, coefficient: Option<&Coefficient>) -> Warnings {
    let name = closure.name();
    let mut remarks = Vec::new();
    if one.contact.jump {
        remarks.push(format!(
            "{name}: the load jumps where islands merge; no separation carries it, the nearer side is reported (load error {:.1e})",
            one.contact.load_error.unwrap_or(0.0)
        ));
    }
    if let Some(share) = one.contact.outside_share.filter(|s| *s > SEEN) {
        remarks.push(format!(
            "{name}: {:.1} % of the load is on asperities outside the ranges of the calibration and of the atlas of cones",
            100.0 * share
        ));
    }
    if one.unloading.is_some() && !one.law.returns_everything() && coefficient.is_none() {
        remarks.push(format!(
            "{name}: unloading exponent {} is that of the paper's single asperity, not of a calibration",
            SINGLE_ASPERITY_EXPONENT
        ));
    }
    if let Some(unloading) = &one.unloading
        && let Some(law) = unloading.elastic_share_by_law.filter(|share| *share > 1.0)
    {
        let limited = unloading.limited_share.filter(|s| *s > SEEN).map_or_else(String::new, |share| {
            format!(
                " ({:.0} % of the load is on ones pressed by less than their cones would return)",
                100.0 * share
            )
        });
        remarks.push(format!(
            "{name}: the unloading law, made for cones, returns {law:.2} times the work done on asperities that are long or \
             flat{limited}: elastic_energy_share is limited to 1, plastic work is not resolved"
        ));
    }
    remarks
}
