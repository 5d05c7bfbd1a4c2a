//! The contact of one surface by one closure.

use super::half_space::SpaceContact;
use asperity_roughness::{Closure, ClosureLaw, Contact, CurvePoint, PressureField, Unloading};

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
    /// Comparison with the half-space of the same metal.
    pub judged: Option<Judged>,
    /// The largest nominal pressure that it carries, in Pa, where that is less than was asked for.
    pub largest_load: Option<f64>,
}

/// A contact beside that of the half-space with the same metal, areas being those corrected for pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// The half-space: elastic, or with the limit of pressure of the metal.
    pub by: Closure,
    /// Area over that of the half-space.
    pub area: f64,
    /// Mean pressure over that of the half-space.
    pub pressure: f64,
    /// Relative error of the area of the half-space.
    pub area_error: f64,
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

    /// The same as well as it is known: of a half-space corrected for the rims of its pixels.
    pub fn corrected_ratio(&self) -> Option<f64> {
        self.either(|i| i.contact.area_ratio, |s| s.contact.area.corrected)
    }

    /// Area over which the load is nominal, in m²: of islands that of the cells with a height at each corner,
    /// of a half-space that of the pixels with a height.
    pub fn nominal_area(&self) -> Option<f64> {
        self.either(|i| i.contact.nominal_area, |s| s.contact.nominal_area)
    }

    /// The half-space of the same metal: elastic for closures of elastic cones, with the limit of pressure
    /// for the others.
    pub fn half_space_of_its_metal(&self) -> Closure {
        match self.closure {
            Closure::Sneddon | Closure::HalfSpace => Closure::HalfSpace,
            _ => Closure::HalfSpacePlastic,
        }
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

    /// True where unloading follows the load curve back.
    pub fn returns_everything(&self) -> bool {
        self.either(|i| i.law.returns_everything(), |s| s.body.limit.is_none()).unwrap_or(true)
    }
}
