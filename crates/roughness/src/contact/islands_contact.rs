//! The separation at which the islands carry the load, and what each of them carries there.

use super::bearing_area::{self, Planes};
use super::closures::ClosureLaw;
use super::find_separation;
use super::islands::Islands;
use super::load::Carrying;
use super::response::Response;
use crate::surface::height_map::Extent;
use crate::surface::prepared_surface::Surface;
use asperity_material::units::rounded;
use thiserror::Error;

/// Points of the load curve.
pub const CURVE_POINTS: usize = 64;
/// The reason why a surface cannot carry a load.
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
         is {largest_mpa:.4} MPa; lower [load] pressure, give a separation, or look whether height_unit is right"
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

/// Load of the plane.
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
#[derive(Clone, Debug)]
pub struct Contact {
    /// Plane above the mean height, in metres.
    pub separation: f64,
    /// Nominal pressure carried, in Pa: ΣF_j / A_nom.
    pub pressure: f64,
    /// |ΣF_j/(P A_nom) - 1|; None where no pressure was asked for.
    pub load_error: Option<f64>,
    /// The load jumps at the separation (islands of a concave closure merge): the residual is that of the
    /// nearer side.
    pub jump: bool,
    /// Contact area over nominal area.
    pub area_ratio: f64,
    /// Share of the contact area that is elastic, elastoplastic, plastic; None without contact.
    pub shares: Option<[f64; 3]>,
    /// Share of the load on islands outside the range of the closure; None without contact.
    pub outside_share: Option<f64>,
    /// Islands, with their ellipses.
    pub islands: Islands,
    /// Response of each island.
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

/// Presses a plane on `surface` until it carries `load`.
///
/// # Errors
/// A load that no plane carries, with the largest that one does.
pub fn press(surface: &Surface, model: &ClosureLaw, load: Load) -> Result<Contact, ContactError> {
    let (plane, jump, wanted) = match load {
        Load::Separation(separation) => (surface.parameters.mean + separation, false, None),
        Load::Pressure(0.0) => (surface.extent.high, false, None),
        Load::Pressure(pressure) => {
            let (plane, jump) = plane_for(surface, model, pressure)?;
            (plane, jump, Some(pressure))
        }
    };
    Ok(contact_at(surface, model, plane, jump, wanted))
}

fn plane_for(surface: &Surface, model: &ClosureLaw, pressure: f64) -> Result<(f64, bool), ContactError> {
    let Extent { low, high, cells } = surface.extent;
    if high <= low || surface.parameters.mean_gradient == 0.0 {
        return Err(ContactError::Flat { wanted_mpa: rounded(pressure * 1e-6, 6) });
    }
    let unreachable = |largest: f64| ContactError::Unreachable {
        wanted_mpa: rounded(pressure * 1e-6, 6),
        largest_mpa: rounded(largest * 1e-6, 6),
        closure: model.closure.name(),
    };
    match model.linear() {
        Some((coefficient, _)) => {
            let scale = coefficient * model.reduced_modulus / cells as f64;
            let (plane, _) = bearing_area::plane_of(&surface.map, &surface.extent, pressure / scale)
                .ok_or_else(|| {
                    unreachable(coefficient * model.reduced_modulus * surface.parameters.mean_gradient)
                })?;
            Ok((plane, false))
        }
        None => find_separation::plane_for(surface, model, pressure).map_err(unreachable),
    }
}

fn contact_at(surface: &Surface, model: &ClosureLaw, plane: f64, jump: bool, wanted: Option<f64>) -> Contact {
    let nominal_area = surface.extent.cells as f64 * surface.map.cell_area();
    let islands = Islands::above_plane(&surface.map, plane);
    let responses: Vec<Response> = islands.islands.iter().map(|island| model.respond(island.slope)).collect();
    let mut contact = Contact {
        separation: plane - surface.parameters.mean,
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
        areas[response.regime as usize] += contact.contact_area(j);
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
fn load_curve(surface: &Surface, model: &ClosureLaw, contact: &Contact, plane: f64) -> Vec<CurvePoint> {
    let (high, mean) = (surface.extent.high, surface.parameters.mean);
    let point = |plane: f64, (pressure, area_ratio): (f64, f64)| {
        let separation = plane - mean;
        CurvePoint { separation, pressure, area_ratio }
    };
    let end = point(plane, (contact.pressure, contact.area_ratio));
    if plane >= high {
        return vec![end];
    }
    let planes = Planes::evenly_spaced(plane, high, CURVE_POINTS);
    let carried: Vec<(f64, f64)> = match model.linear() {
        Some((coefficient, area_ratio)) => {
            let (stress, cells) = (coefficient * model.reduced_modulus, surface.extent.cells as f64);
            let above = bearing_area::above_planes(&surface.map, planes);
            above.iter().map(|a| (stress * a.slope_area / cells, area_ratio * a.area / cells)).collect()
        }
        None => {
            let mut within = Carrying::new(surface, model, plane);
            (0..CURVE_POINTS).map(|k| within.rise_to(planes.height(k))).collect()
        }
    };
    let curve = carried.into_iter().enumerate().map(|(k, carried)| point(planes.height(k), carried));
    let mut curve: Vec<CurvePoint> = curve.collect();
    curve[0] = end;
    curve[CURVE_POINTS - 1] = point(high, (0.0, 0.0));
    curve.reverse();
    curve
}
