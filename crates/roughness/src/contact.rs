//! The separation at which the islands carry the load, and what each of them carries there.

mod carrying;
mod seek;

use crate::closure::{Model, Regime, Response};
use crate::height_map::{Extent, HeightMap};
use crate::islands::Islands;
use crate::ladder::{self, Rungs};
use crate::numbers::Roughness;
use carrying::Carrying;
use std::f64::consts::PI;
use thiserror::Error;

/// Points of the load curve.
pub const CURVE_POINTS: usize = 64;
/// Why a surface cannot carry a load.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ContactError {
    /// No slope, so no force at any separation.
    #[error(
        "the surface is flat: it carries no load at any separation (largest load 0 MPa), but {wanted_mpa} MPa were asked for; \
         check height_unit and level, or set the pressure to 0"
    )]
    Flat {
        /// The pressure asked for, MPa.
        wanted_mpa: f64,
    },
    /// More than the surface carries when fully in contact.
    #[error(
        "a nominal pressure of {wanted_mpa} MPa is out of reach: with closure \"{closure}\" the largest load of this surface \
         is {largest_mpa} MPa; lower [load] pressure, or give a separation"
    )]
    Unreachable {
        /// The pressure asked for, MPa.
        wanted_mpa: f64,
        /// The largest pressure, MPa.
        largest_mpa: f64,
        /// The closure's name.
        closure: &'static str,
    },
}

/// What presses the plane on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// Nominal pressure in Pa.
    Pressure(f64),
    /// Separation of the plane from the mean height, in metres.
    Separation(f64),
}

/// A point of the load curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Separation from the mean height, in metres.
    pub separation: f64,
    /// Nominal pressure, in Pa.
    pub pressure: f64,
    /// Contact area over nominal area.
    pub area_ratio: f64,
}

/// The contact of a surface with a plane at one load, by one closure.
pub struct Contact {
    /// Plane above the mean height, in metres.
    pub separation: f64,
    /// Nominal pressure carried, in Pa: ΣF_j / A_nom.
    pub pressure: f64,
    /// |ΣF_j/(P A_nom) - 1|; None where no pressure was asked for.
    pub load_error: Option<f64>,
    /// The load jumps at the separation (islands of a concave closure merge): the residual is that of the nearer side.
    pub jump: bool,
    /// Contact area over nominal area.
    pub area_ratio: f64,
    /// Share of the contact area that is elastic, elastoplastic, plastic; None without contact.
    pub shares: Option<[f64; 3]>,
    /// Share of the load on islands outside the range of the closure; None without contact.
    pub outside_share: Option<f64>,
    /// Islands, with their ellipses.
    pub islands: Islands,
    /// What each island carries.
    pub responses: Vec<Response>,
    /// Nominal area, in m².
    pub nominal_area: f64,
    /// From first touch to the load.
    pub curve: Vec<CurvePoint>,
}

impl Contact {
    /// Force on island `j`, in newtons.
    pub fn force(&self, j: usize) -> f64 {
        self.responses[j].island_pressure * self.islands.islands[j].area
    }

    /// True contact area of island `j`, in m².
    pub fn contact_area(&self, j: usize) -> f64 {
        (self.responses[j].area_ratio * self.islands.islands[j].area).min(self.nominal_area)
    }

    /// Load over contact area, in Pa; None without contact.
    pub fn mean_pressure(&self) -> Option<f64> {
        (self.area_ratio > 0.0).then(|| self.pressure / self.area_ratio)
    }
}

/// A surface ready to be pressed.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    /// The levelled, filtered map.
    pub map: &'a HeightMap,
    /// Its extent.
    pub extent: Extent,
    /// Its roughness numbers.
    pub roughness: Roughness,
}

/// Presses a plane on `surface` until it carries `load`.
pub fn press(surface: &Surface, model: &Model, load: Load) -> Result<Contact, ContactError> {
    let (plane, jump, wanted) = match load {
        Load::Separation(separation) => (surface.roughness.mean + separation, false, None),
        Load::Pressure(0.0) => (surface.extent.high, false, None),
        Load::Pressure(pressure) => {
            let (plane, jump) = plane_for(surface, model, pressure)?;
            (plane, jump, Some(pressure))
        }
    };
    Ok(contact_at(surface, model, plane, jump, wanted))
}

fn plane_for(surface: &Surface, model: &Model, pressure: f64) -> Result<(f64, bool), ContactError> {
    let Extent { low, high, cells } = surface.extent;
    if high <= low || surface.roughness.mean_gradient == 0.0 {
        return Err(ContactError::Flat { wanted_mpa: pressure * 1e-6 });
    }
    let unreachable = |largest: f64| ContactError::Unreachable {
        wanted_mpa: pressure * 1e-6,
        largest_mpa: largest * 1e-6,
        closure: model.closure.name(),
    };
    match model.linear() {
        Some((coefficient, _)) => {
            let scale = coefficient * model.reduced_modulus() / cells as f64;
            let (plane, _) =
                ladder::plane_of(surface.map, &surface.extent, pressure / scale).ok_or_else(|| {
                    unreachable(coefficient * model.reduced_modulus() * surface.roughness.mean_gradient)
                })?;
            Ok((plane, false))
        }
        None => seek::plane_for(surface, model, pressure).map_err(unreachable),
    }
}

fn contact_at(surface: &Surface, model: &Model, plane: f64, jump: bool, wanted: Option<f64>) -> Contact {
    let nominal_area = surface.extent.cells as f64 * surface.map.cell_area();
    let islands = Islands::above(surface.map, plane);
    let responses: Vec<Response> = islands.islands.iter().map(|island| model.respond(island.slope)).collect();
    let mut contact = Contact {
        separation: plane - surface.roughness.mean,
        pressure: 0.0,
        load_error: None,
        jump,
        area_ratio: 0.0,
        shares: None,
        outside_share: None,
        islands,
        responses,
        nominal_area,
        curve: Vec::new(),
    };
    let (mut force, mut outside, mut areas) = (0.0, 0.0, [0.0; 3]);
    for (j, response) in contact.responses.iter().enumerate() {
        let regime = match response.regime {
            Regime::Elastic => 0,
            Regime::Elastoplastic => 1,
            Regime::Plastic => 2,
        };
        areas[regime] += contact.contact_area(j);
        force += contact.force(j);
        outside += if response.inside { 0.0 } else { contact.force(j) };
    }
    let area: f64 = areas.iter().sum();
    contact.pressure = force / nominal_area;
    contact.load_error = wanted.map(|wanted| (contact.pressure / wanted - 1.0).abs());
    contact.area_ratio = (area / nominal_area).min(1.0);
    contact.shares = (area > 0.0).then(|| areas.map(|a| a / area));
    contact.outside_share = (force > 0.0).then(|| outside / force);
    contact.curve = load_curve(surface, model, &contact, plane);
    contact
}

/// 64 points from first touch to the plane of `contact`.
fn load_curve(surface: &Surface, model: &Model, contact: &Contact, plane: f64) -> Vec<CurvePoint> {
    let high = surface.extent.high;
    let mean = surface.roughness.mean;
    let end = CurvePoint {
        separation: contact.separation,
        pressure: contact.pressure,
        area_ratio: contact.area_ratio,
    };
    if plane >= high {
        return vec![end];
    }
    let rungs = Rungs::between(plane, high, CURVE_POINTS);
    let mut curve: Vec<CurvePoint> = match model.linear() {
        Some((coefficient, area_ratio)) => {
            let cells = surface.extent.cells as f64;
            ladder::above_rungs(surface.map, rungs)
                .iter()
                .enumerate()
                .map(|(k, above)| CurvePoint {
                    separation: rungs.height(k) - mean,
                    pressure: coefficient * model.reduced_modulus() * above.slope_area / cells,
                    area_ratio: area_ratio * above.area / cells,
                })
                .collect()
        }
        None => {
            let mut within = Carrying::above(surface, model, plane);
            (0..CURVE_POINTS)
                .map(|k| {
                    let (pressure, area_ratio) = within.rise_to(rungs.height(k));
                    CurvePoint { separation: rungs.height(k) - mean, pressure, area_ratio }
                })
                .collect()
        }
    };
    curve[0] = end;
    curve[CURVE_POINTS - 1] = CurvePoint { separation: high - mean, pressure: 0.0, area_ratio: 0.0 };
    curve.reverse();
    curve
}

/// What taking the load off gives back.
#[derive(Clone, Debug, PartialEq)]
pub struct Unloading {
    /// First touch minus final separation minus the largest elastic return, in metres.
    pub residual_displacement: f64,
    /// Work returned over work done, at most 1; None without work.
    pub elastic_share: Option<f64>,
    /// The same as the unloading law gives it. Above 1 where islands are shallower than the cones that stand for them.
    pub elastic_share_by_law: Option<f64>,
    /// Share of the load on islands that the law would raise by more than they were pressed; None without load.
    pub limited_share: Option<f64>,
    /// From the load to the last touch.
    pub curve: Vec<CurvePoint>,
}

/// Takes the load off: every island returns by F = F_j (1 - u/u_j)^m with u_j = m F_j/(2 E* a_j).
///
/// m is the exponent measured on unloaded cones, a_j the radius of the true contact; the stiffness at the start is that
/// of a circular contact, 2 E* a_j, and so the contact area falls as (1 - u/u_j)^(2(m-1)). Closures without a limit of
/// pressure are elastic and return along the load curve.
///
/// For a cone u_j stays below its depth and F_j u_j/(m+1) below its work F_j h_j/3. A long ridge, or a wide island with
/// roughness upon it, was pressed by d_j far below h_j = tan β_j √(A_j/π): u_j is limited to d_j there, and as the work
/// of a body that is no cone may still be less than F_j d_j/(m+1), the sum is limited to the work of the load curve.
pub fn unload(contact: &Contact, model: &Model, exponent: f64) -> Unloading {
    let work = contact
        .curve
        .windows(2)
        .map(|w| 0.5 * (w[0].pressure + w[1].pressure) * (w[0].separation - w[1].separation))
        .sum::<f64>()
        * contact.nominal_area;
    if model.returns_everything() {
        let curve = contact.curve.iter().rev().copied().collect();
        let whole = (work > 0.0).then_some(1.0);
        return Unloading {
            residual_displacement: 0.0,
            elastic_share: whole,
            elastic_share_by_law: whole,
            limited_share: whole.map(|_| 0.0),
            curve,
        };
    }
    let (mut load, mut limited) = (0.0, 0.0);
    let returns: Vec<(f64, f64, f64)> = (0..contact.responses.len())
        .map(|j| {
            let (force, area) = (contact.force(j), contact.contact_area(j));
            let radius = (area / PI).sqrt();
            let stiffness = 2.0 * model.reduced_modulus() * radius;
            let u = if stiffness > 0.0 { exponent * force / stiffness } else { 0.0 };
            let approach = contact.islands.islands[j].approach;
            load += force;
            limited += if u > approach { force } else { 0.0 };
            (force, area, u.min(approach))
        })
        .collect();
    let largest = returns.iter().fold(0.0, |u: f64, r| u.max(r.2));
    let energy: f64 = returns.iter().map(|(force, _, u)| force * u / (exponent + 1.0)).sum();
    let by_law = (work > 0.0).then(|| energy / work);
    let first_touch = contact.curve.first().map_or(contact.separation, |p| p.separation);
    let curve = (0..CURVE_POINTS)
        .map(|k| {
            let rise = largest * k as f64 / (CURVE_POINTS - 1) as f64;
            let (mut force, mut area) = (0.0, 0.0);
            for (f, a, u) in returns.iter().filter(|(_, _, u)| *u > rise) {
                let left = 1.0 - rise / u;
                force += f * left.powf(exponent);
                area += a * left.powf(2.0 * (exponent - 1.0));
            }
            CurvePoint {
                separation: contact.separation + rise,
                pressure: force / contact.nominal_area,
                area_ratio: (area / contact.nominal_area).min(1.0),
            }
        })
        .collect();
    Unloading {
        residual_displacement: first_touch - contact.separation - largest,
        elastic_share: by_law.map(|share| share.min(1.0)),
        elastic_share_by_law: by_law,
        limited_share: (load > 0.0).then(|| limited / load),
        curve,
    }
}
