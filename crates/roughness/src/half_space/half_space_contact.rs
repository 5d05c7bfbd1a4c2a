//! The contact of a surface with a plane when the body is a half-space: elastic, or elastic with a pressure
//! cut-off (p ≤ H).

use super::area::Area;
use super::cascade::{Answer, Task, spread};
use super::stiffness::{Stiffness, stiffness};
use crate::half_space::float::sums;
use crate::half_space::grid_level::Hold;
use crate::{HeightMap, Load, Surface};
use asperity_material::units::rounded;
use rayon::prelude::*;
use thiserror::Error;

/// Proven relative error of the pressures, in the norm of the energy, to which the contact is found unless
/// said otherwise: the pixels in contact are then those of 1e-8 but for a few in a million.
pub const TOLERANCE: f64 = 1e-6;
/// Long side over short side of a pixel up to which the search was seen to end: the preconditioner takes the
/// lines for neighbours that move each other.
const LONG_PIXEL: f64 = 30.0;
/// The least error that can be asked for.
pub const FINEST_TOLERANCE: f64 = 1e-10;
/// The largest that can be asked for.
const LOOSEST_TOLERANCE: f64 = 1e-2;
/// The contacts of a series are found to so many times the tolerance of a single one: pixels leave a curve a
/// hundred times less sure, and single precision proves it.
const LOOSER: f64 = 10.0;

/// The reason why a half-space cannot carry a load.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HalfSpaceError {
    /// More than the limit on every pixel.
    #[error(
        "a nominal pressure of {wanted_mpa} MPa is out of reach: with no pixel above {limit_mpa:.0} MPa the whole surface carries \
         less than that; lower the pressure, or give a harder metal (a limit that follows from the yield stress is that of the \
         slopes under this load)"
    )]
    Limit {
        /// The pressure asked for, MPa.
        wanted_mpa: f64,
        /// The limit of pressure, MPa.
        limit_mpa: f64,
    },
    /// A periodic elastic surface is flat before its separation is 0.
    #[error(
        "a separation of {wanted_um} µm is out of reach: the gaps of a periodic elastic surface close at 0 µm; raise it, or give a \
         pressure"
    )]
    Closed {
        /// The separation asked for, µm.
        wanted_um: f64,
    },
    /// The search did not end.
    #[error(
        "the contact was not found: the proven error of the pressures stopped at {reached:.1e} instead of {wanted:.1e}; raise half_space.tolerance, or \
         check the map for spikes"
    )]
    Unfinished {
        /// Error reached.
        reached: f64,
        /// Error asked for.
        wanted: f64,
    },
    /// The search did not end on pixels far from square.
    #[error(
        "the contact was not found: pixels are {ratio:.0} times as long as wide, and lines so far apart hardly feel each other, so \
         that the proven error stopped at {reached:.1e} instead of {wanted:.1e}; average points along the short side until the sides are \
         as 1 to {LONG_PIXEL:.0} or nearer, or raise half_space.tolerance"
    )]
    LongPixels {
        /// Long side of a pixel over its short one.
        ratio: f64,
        /// Error reached.
        reached: f64,
        /// Error asked for.
        wanted: f64,
    },
    /// Numbers that are no body.
    #[error("{name} = {value} is not possible: {allowed}")]
    Value {
        /// Name of the number.
        name: &'static str,
        /// The value.
        value: f64,
        /// The allowed range.
        allowed: &'static str,
    },
}

/// A body with a flat surface that the roughness lies upon, much larger than the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// E* = E/(1-ν²), in Pa.
    pub reduced_modulus: f64,
    /// Largest pressure that the metal carries, in Pa: it flows there. None of an elastic body.
    pub limit: Option<f64>,
    /// Proven relative error of the pressures, in the norm of the energy, at which the search ends.
    pub tolerance: f64,
}

/// The contact of a surface on a half-space at one load.
///
/// Maps have one number a node of the height map, row by row; a node stands for the pixel around it.
#[derive(Clone, Debug)]
pub struct HalfSpaceContact {
    /// Nominal pressure: force over the area of the pixels used, in Pa.
    pub pressure: f64,
    /// Plane above the mean height, in metres; displacements count from their mean where the map is periodic,
    /// else from the half-space far away.
    pub separation: f64,
    /// Mean distance of plane and surface over the pixels used, in metres.
    pub mean_gap: f64,
    /// Contact area, of pixels and corrected for their edges.
    pub area: Area,
    /// Largest pressure that the metal carries, in Pa; None of an elastic half-space.
    pub limit: Option<f64>,
    /// Share of the contact area at the limit of pressure.
    pub limited_share: f64,
    /// Largest pressure of a pixel, in Pa.
    pub largest_pressure: f64,
    /// -dp/d(mean gap), in Pa/m, pixels at the limit carrying no more; None without contact or without gap.
    pub stiffness: Option<f64>,
    /// The same by the way of the plane.
    pub plane_stiffness: Option<f64>,
    /// Work stored and returned on unloading, in J.
    pub elastic_work: f64,
    /// Work spent on flow, in J.
    pub plastic_work: f64,
    /// Highest point of the surface minus its highest point after unloading, in metres.
    pub residual_displacement: f64,
    /// Residual of the complementarity conditions: Σ p|g| over Σ p times the rms height.
    pub residual: f64,
    /// Proven bound of the relative error of the pressures in the norm of the energy: √(δ·Kδ / p·Sp). Its
    /// square bounds that of the energy.
    pub pressure_error: f64,
    /// Convolutions on the finest grid.
    pub convolutions: usize,
    /// Pixels that are used: those with a height.
    pub pixels: usize,
    /// Area of the pixels used, in m².
    pub nominal_area: f64,
    /// Pressure, in Pa.
    pub pressures: Vec<f32>,
    /// Distance of plane and surface, in metres; 0 in contact, NaN where nothing was measured.
    pub gaps: Vec<f32>,
    /// The depth by which flow flattened the surface, in metres; empty of an elastic body.
    pub flattened: Vec<f32>,
}

/// Factors between metres and pascals and the units of the solver.
struct Units {
    height: f64,
    low: f64,
    mean: f64,
    /// Pressure of one solver unit, in Pa.
    stress: f64,
    /// Pixels used over pixels.
    used: f64,
}

impl Units {
    /// Stiffness of one solver unit, of pressures over the pixels used, in Pa/m.
    fn stiffness(&self) -> f64 {
        self.stress / self.height / self.used
    }
}

impl HalfSpace {
    /// The same for contacts of which a curve is drawn: they are found to ten times the
    /// tolerance, 0.01 at most.
    pub fn for_a_series(&self) -> HalfSpace {
        HalfSpace { tolerance: (LOOSER * self.tolerance).min(LOOSEST_TOLERANCE), ..*self }
    }

    /// Presses a rigid plane on `surface` until it carries `load`.
    ///
    /// # Errors
    /// A load beyond the limit of pressure, a separation that cannot be reached, a search that does not end.
    pub fn press(&self, surface: &Surface, load: Load) -> Result<HalfSpaceContact, HalfSpaceError> {
        self.press_from(surface, load, None)
    }

    /// The same from the contact at another load, which is quicker than from nothing.
    ///
    /// # Errors
    /// As for [`HalfSpace::press`].
    pub fn press_from(
        &self,
        surface: &Surface,
        load: Load,
        start: Option<&HalfSpaceContact>,
    ) -> Result<HalfSpaceContact, HalfSpaceError> {
        self.search(surface, load, start, true)
    }

    /// The same without its stiffnesses, which take about as long as the contact.
    ///
    /// # Errors
    /// As for [`HalfSpace::press`].
    pub fn press_without_stiffness(
        &self,
        surface: &Surface,
        load: Load,
        start: Option<&HalfSpaceContact>,
    ) -> Result<HalfSpaceContact, HalfSpaceError> {
        self.search(surface, load, start, false)
    }

    fn search(
        &self,
        surface: &Surface,
        load: Load,
        start: Option<&HalfSpaceContact>,
        stiffnesses: bool,
    ) -> Result<HalfSpaceContact, HalfSpaceError> {
        self.check()?;
        let map = &surface.map;
        let pixels = map.heights().len() - map.missing();
        let (task, units) = self.task(surface, pixels);
        let hold = match load {
            Load::Pressure(p) => {
                self.bears(p)?;
                Hold::Pressure(p / units.stress * units.used)
            }
            Load::Separation(s) => {
                if map.periodic() && self.limit.is_none() && map.missing() == 0 && s <= 0.0 {
                    return Err(HalfSpaceError::Closed { wanted_um: s * 1e6 });
                }
                Hold::Plane((s + units.mean - units.low) / units.height)
            }
        };
        let touches = match hold {
            Hold::Pressure(p) => p > 0.0,
            Hold::Plane(plane) => plane < (surface.extent.high - units.low) / units.height,
        };
        if !touches {
            let plane = match hold {
                Hold::Pressure(_) => (surface.extent.high - units.low) / units.height,
                Hold::Plane(plane) => plane,
            };
            let answer = Answer {
                pressure: vec![0.0; task.heights.len()],
                lift: task.heights.iter().map(|h| -h).collect(),
                plane,
                residual: 0.0,
                error: 0.0,
                convolutions: 0,
            };
            return Ok(self.contact(surface, &task, &units, pixels, answer, None));
        }
        let start = start.filter(|s| s.pressures.len() == task.heights.len() && s.pressure > 0.0);
        let start: Option<Vec<f64>> =
            start.map(|s| s.pressures.par_iter().map(|p| f64::from(*p) / units.stress).collect());
        let answer = task.solve(hold, start.as_deref(), self.tolerance);
        if answer.error.is_nan() || answer.error > 3.0 * self.tolerance {
            let (reached, wanted) = (answer.error, self.tolerance);
            let [a, b] = task.sides;
            let ratio = (a / b).max(b / a);
            return Err(if ratio > LONG_PIXEL {
                HalfSpaceError::LongPixels { ratio, reached, wanted }
            } else {
                HalfSpaceError::Unfinished { reached, wanted }
            });
        }
        let slope = if stiffnesses { stiffness(&task, &answer.pressure) } else { None };
        Ok(self.contact(surface, &task, &units, pixels, answer, slope))
    }

    /// Stiffness of `contact` on `surface` as it stands, elastic: every pixel in contact moves with the
    /// plane, those at the limit of pressure too. None without contact or without gap.
    pub fn elastic_stiffness(&self, surface: &Surface, contact: &HalfSpaceContact) -> Option<Stiffness> {
        if contact.limited_share == 0.0 {
            let (gap, plane) = (contact.stiffness?, contact.plane_stiffness?);
            return Some(Stiffness { gap, plane });
        }
        let (task, units) = HalfSpace { limit: None, ..*self }.task(surface, contact.pixels);
        let pressure: Vec<f64> = contact.pressures.par_iter().map(|p| f64::from(*p)).collect();
        stiffness(&task, &pressure).map(|s| s.scaled(units.stiffness()))
    }

    /// Says whether a surface of this metal can carry the nominal `pressure` (Pa).
    ///
    /// # Errors
    /// More than the limit of pressure on every pixel.
    pub fn bears(&self, pressure: f64) -> Result<(), HalfSpaceError> {
        match self.limit.filter(|limit| pressure >= *limit) {
            Some(limit) => Err(HalfSpaceError::Limit {
                wanted_mpa: rounded(pressure * 1e-6, 6),
                limit_mpa: rounded(limit * 1e-6, 6),
            }),
            None => Ok(()),
        }
    }

    fn check(&self) -> Result<(), HalfSpaceError> {
        let error = |name, value, allowed| Err(HalfSpaceError::Value { name, value, allowed });
        if !(self.reduced_modulus > 0.0 && self.reduced_modulus.is_finite()) {
            return error("reduced_modulus", self.reduced_modulus, "it must be finite and above 0");
        }
        if !(FINEST_TOLERANCE..=LOOSEST_TOLERANCE).contains(&self.tolerance) {
            return error("tolerance", self.tolerance, "between 1e-10 and 0.01");
        }
        match self.limit {
            Some(limit) if limit.is_nan() || limit <= 0.0 => {
                error("limit", limit, "the limit of pressure must be above 0")
            }
            _ => Ok(()),
        }
    }

    fn task(&self, surface: &Surface, pixels: usize) -> (Task, Units) {
        let (map, extent) = (&surface.map, &surface.extent);
        let side = map.cell_area().sqrt();
        let range = extent.high - extent.low;
        // a flat map has no range: any length does
        let height = if range > 0.0 { range } else { side };
        let heights: Vec<f64> = map.heights().par_iter().map(|z| (z - extent.low) / height).collect();
        let (mean, rms) = spread(&heights);
        let stress = self.reduced_modulus * height / side;
        let task = Task {
            nodes: [map.columns(), map.rows()],
            sides: map.pixel().map(|p| p / side),
            periodic: map.periodic(),
            heights,
            rms: if rms > 0.0 { rms } else { 1.0 },
            // a number of both types, so that the bound is met exactly in either
            limit: self.limit.map_or(f64::INFINITY, |limit| f64::from((limit / stress) as f32)),
        };
        let used = pixels as f64 / map.heights().len() as f64;
        (task, Units { height, low: extent.low, mean: extent.low + mean * height, stress, used })
    }

    fn contact(
        &self,
        surface: &Surface,
        task: &Task,
        units: &Units,
        pixels: usize,
        answer: Answer,
        slope: Option<Stiffness>,
    ) -> HalfSpaceContact {
        let map = &surface.map;
        let Answer { pressure, lift, plane, residual, error, convolutions } = answer;
        let limit = task.limit;
        let gap = |i: usize| lift[i] + plane;
        let [load, touching, limited, gaps, stored, spent] = sums(pressure.len(), |range| {
            let mut sum = [0.0; 6];
            for i in range.filter(|i| !task.heights[*i].is_nan()) {
                let (p, g) = (pressure[i], gap(i));
                sum[0] += p;
                sum[1] += if p > 0.0 { 1.0 } else { 0.0 };
                sum[2] += if p >= limit { 1.0 } else { 0.0 };
                sum[3] += if p > 0.0 { 0.0 } else { g.max(0.0) };
                sum[4] += 0.5 * p * (lift[i] + task.heights[i]);
                sum[5] += if p >= limit { p * (-g).max(0.0) } else { 0.0 };
            }
            sum
        });
        let cell = map.cell_area();
        let n = pixels as f64;
        let slope = slope.map(|s| s.scaled(units.stiffness()));
        let flattened: Vec<f32> = if limit.is_finite() {
            let flat = |i: usize| {
                if pressure[i] >= limit { ((-gap(i)).max(0.0) * units.height) as f32 } else { 0.0 }
            };
            (0..pressure.len()).into_par_iter().map(flat).collect()
        } else {
            Vec::new()
        };
        let pressures: Vec<f32> = pressure.par_iter().map(|p| (p * units.stress) as f32).collect();
        let gap_map = |i: usize| match (task.heights[i].is_nan(), pressure[i] > 0.0) {
            (true, _) => f32::NAN,
            (_, true) => 0.0,
            _ => (gap(i).max(0.0) * units.height) as f32,
        };
        HalfSpaceContact {
            pressure: load * units.stress / n,
            separation: plane * units.height + units.low - units.mean,
            mean_gap: gaps * units.height / n,
            area: Area::from_pixels(map, &pressures, [touching as usize, pixels], load / limit / n),
            limit: self.limit,
            limited_share: if touching > 0.0 { limited / touching } else { 0.0 },
            largest_pressure: pressure.par_iter().copied().reduce(|| 0.0, f64::max) * units.stress,
            stiffness: slope.map(|s| s.gap),
            plane_stiffness: slope.map(|s| s.plane),
            elastic_work: stored * units.stress * units.height * cell,
            plastic_work: spent * units.stress * units.height * cell,
            residual_displacement: lowered(map, &flattened, surface.extent.high),
            residual,
            pressure_error: error,
            convolutions,
            pixels,
            nominal_area: n * cell,
            gaps: (0..pressure.len()).into_par_iter().map(gap_map).collect(),
            pressures,
            flattened,
        }
    }
}

/// The depth by which the highest point comes down when a map is flattened.
fn lowered(map: &HeightMap, flattened: &[f32], high: f64) -> f64 {
    let left = map.heights().par_iter().zip(flattened).filter(|(z, _)| !z.is_nan());
    let highest = left.map(|(z, f)| z - f64::from(*f)).reduce(|| f64::NEG_INFINITY, f64::max);
    if highest.is_finite() { (high - highest).max(0.0) } else { 0.0 }
}

impl HalfSpaceContact {
    /// Load over contact area, in Pa; None without contact.
    pub fn mean_pressure(&self) -> Option<f64> {
        (self.area.ratio > 0.0).then(|| self.pressure / self.area.ratio)
    }

    /// Relative change of the contact area by that of the limit of pressure `limit` (Pa), its sign turned: 1
    /// where the area is load over limit, else at most the share of the load that is at the limit, which is
    /// given; 0 of an elastic contact.
    ///
    /// A little more limit takes load from the other pixels, which lowers their pressures and moves the rim;
    /// the rest of the load does not feel it.
    pub fn limit_sensitivity(&self, limit: f64) -> f64 {
        let least = self.pressure / limit;
        if self.area.ratio <= 0.0 || !limit.is_finite() {
            return 0.0;
        }
        if self.area.corrected <= least * (1.0 + 1e-6) {
            1.0
        } else {
            self.limited_share * self.area.ratio / least
        }
    }

    /// The surface as the flow left it, without load.
    ///
    /// # Errors
    /// None that is known: a surface that was pressed has a cell.
    pub fn flattened_surface(&self, surface: &Surface) -> Result<Surface, crate::MapError> {
        if self.flattened.is_empty() {
            return Ok(surface.clone());
        }
        let heights = surface.map.heights().iter().zip(&self.flattened).map(|(z, f)| z - f64::from(*f));
        Surface::from_map(surface.map.with_heights(heights.collect())?)
    }
}
