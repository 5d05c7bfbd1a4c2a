//! A surface pressed at every scale by the same load.

use super::contact::press_scale;
use super::cutoffs::{Scale, cutoffs};
use super::numbers::{By, Numbers, Step};
use super::persson::persson;
use super::quantities::{Judged, verdicts};
use super::regimes::RegimeSlopes;
use super::self_affine::SelfAffine;
use super::slope_power::{Growth, SlopePower};
use super::slopes::Slopes;
use crate::half_space::{HalfSpace, HalfSpaceContact, HalfSpaceError, PressureLimit};
use crate::surface::filter::FilterError;
use crate::surface::height_map::MapError;
use crate::{ClosureLaw, Load, Material, SpectrumPoint, Surface, press};
use asperity_material::HardeningLaw;
use thiserror::Error;

/// Limits of pressure nearer than this share are one.
const SAME_LIMIT: f64 = 0.01;

/// The reason why a surface has no scales.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ScalesError {
    /// All heights are equal.
    #[error("the map is flat, and has no scales; check height_unit, level and filters")]
    Flat,
    /// The load is none.
    #[error("nothing touches at this load: give a pressure above 0, or a separation below the highest point")]
    NoTouch,
    /// Repeated maps are not of one size.
    #[error("the map has {0} x {1} points, its repetition {2} x {3}: cut or measure them alike")]
    Repeated(usize, usize, usize, usize),
    /// A half-space that does not carry the load.
    #[error(transparent)]
    HalfSpace(#[from] HalfSpaceError),
    /// A scale that is no map.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// A map without heights.
    #[error(transparent)]
    Map(#[from] MapError),
}

impl ScalesError {
    /// The key of a scene that it is about.
    pub fn key(&self) -> &'static str {
        match self {
            ScalesError::NoTouch => "load",
            ScalesError::HalfSpace(HalfSpaceError::Limit { .. }) => "load.pressure",
            ScalesError::HalfSpace(HalfSpaceError::Closed { .. }) => "load.separation",
            ScalesError::HalfSpace(_) => "half_space",
            _ => "surface",
        }
    }
}

/// The task of every scale.
#[derive(Clone, Debug)]
pub struct Task {
    /// The metal.
    pub material: Material,
    /// Its law of hardening, where the metal names none.
    pub law: HardeningLaw,
    /// The elastic half-space.
    pub body: HalfSpace,
    /// Closures of islands.
    pub closures: Vec<ClosureLaw>,
}

/// A surface at all its scales.
#[derive(Clone, Debug)]
pub struct Scales {
    /// From the coarsest cut-off to the whole map.
    pub steps: Vec<Step>,
    /// Nominal pressure of all of them, in Pa.
    pub pressure: f64,
    /// The power spectrum.
    pub spectrum: Vec<SpectrumPoint>,
    /// The same as that of a self-affine surface; None of a map with too few waves.
    pub fit: Option<SelfAffine>,
    /// Growth of the slope below the pixel.
    pub growth: Growth,
    /// The slopes at which the regimes of the metal end; None where nothing of its strength is known.
    pub regimes: Option<RegimeSlopes>,
    /// The verdicts.
    pub verdicts: Vec<Judged>,
    /// True where the nominal pressure is beyond the limit of pressure of a scale, which has no contact then.
    pub overloaded: bool,
}

impl Task {
    /// The nominal pressure (Pa) of `load` on the whole `surface`, which all scales carry.
    ///
    /// # Errors
    /// A flat surface, a load that touches nothing or cannot be carried.
    pub fn pressure(&self, surface: &Surface, load: Load) -> Result<f64, ScalesError> {
        if surface.extent.high <= surface.extent.low {
            return Err(ScalesError::Flat);
        }
        let pressure = match load {
            Load::Pressure(pressure) => pressure,
            held @ Load::Separation(_) => self.body.press(surface, held)?.pressure,
        };
        if pressure > 0.0 { Ok(pressure) } else { Err(ScalesError::NoTouch) }
    }

    /// Presses `surface` by `load` at every scale. `visit` is told the scales done, all of them, and the next
    /// cut-off (m); false ends the way, and nothing is given.
    ///
    /// # Errors
    /// A surface or a load without scales, a contact that is not found.
    pub fn follow(
        &self,
        surface: &Surface,
        load: Load,
        visit: &mut dyn FnMut(usize, usize, f64) -> bool,
    ) -> Result<Option<Scales>, ScalesError> {
        let pressure = self.pressure(surface, load)?;
        let (power, spectrum) = SlopePower::new(&surface.map)?;
        let regimes = RegimeSlopes::new(&self.material, self.law);
        let all = cutoffs(&surface.map);
        let mut starts = [None, None, None];
        let (mut steps, mut overloaded) = (Vec::new(), false);
        for (i, cutoff) in all.iter().enumerate() {
            if !visit(i, all.len(), *cutoff) {
                return Ok(None);
            }
            let scale = Scale::new(surface, *cutoff)?;
            let slopes = Slopes::new(&scale, &surface.map, &power);
            let (contacts, carried) = self.press(&scale, &slopes, pressure, regimes.as_ref(), &mut starts)?;
            overloaded |= !carried;
            let (grid, sq) = (scale.surface.map.pixel()[0], scale.surface.parameters.sq);
            steps.push(Step { cutoff: *cutoff, wave: scale.wave, grid, sq, slopes, contacts });
        }
        let fit = SelfAffine::new(&surface.map, &spectrum);
        let growth = power.growth();
        let verdicts = verdicts(&steps, growth, fit.is_some_and(|fit| fit.has_rolloff()));
        Ok(Some(Scales { steps, pressure, spectrum, fit, growth, regimes, verdicts, overloaded }))
    }

    /// The contacts at one scale, and whether the limits of pressure are above the load.
    fn press(
        &self,
        scale: &Scale,
        slopes: &Slopes,
        pressure: f64,
        regimes: Option<&RegimeSlopes>,
        starts: &mut [Option<HalfSpaceContact>; 3],
    ) -> Result<(Vec<(By, Numbers)>, bool), ScalesError> {
        let (surface, load) = (&scale.surface, Load::Pressure(pressure));
        let limit =
            PressureLimit::on_surface(&self.material, self.law, surface, load).map(|limit| limit.pressure);
        let by_slope = PressureLimit::at_slope(&self.material, self.law, slopes.mean).map(|l| l.pressure);
        let other = by_slope.zip(limit).filter(|(a, b)| (a / b - 1.0).abs() > SAME_LIMIT).map(|(a, _)| a);
        let carries = |limit: &f64| pressure < *limit;
        let carried = limit.iter().chain(&other).all(carries);
        let (mut contacts, body) = (Vec::new(), self.body.for_a_series());
        let bodies = [
            Some((By::Elastic, None)),
            limit.filter(carries).map(|limit| (By::Limited, Some(limit))),
            other.filter(carries).map(|limit| (By::LimitedBySlope, Some(limit))),
        ];
        for (start, pressed) in starts.iter_mut().zip(bodies) {
            let Some((by, limit)) = pressed else { continue };
            // the grid of the last scale may be this one, and its contact near
            let (found, contact) =
                press_scale(&HalfSpace { limit, ..body }, surface, pressure, regimes, start.as_ref())?;
            contacts.push((by, found));
            *start = Some(contact);
        }
        // a closure that does not carry the load has no contact at this scale
        let islands = self.closures.iter().filter_map(|law| {
            let found = press(surface, law, load).ok()?;
            Some((By::Islands(law.closure.name()), Numbers::of_islands(&found, law.hardness)))
        });
        contacts.extend(islands);
        let theory = |by, limit| {
            let found = persson(slopes.rms, pressure, self.body.reduced_modulus, limit)?;
            Some((by, Numbers::of_persson(&found, pressure, limit)))
        };
        contacts.extend(theory(By::Persson, None));
        if let Some(limit) = limit.filter(carries) {
            contacts.extend(theory(By::PerssonLimited, Some(limit)));
            contacts.push((By::Bearing, Numbers::of_area(pressure / limit, pressure, Some(limit))));
        }
        Ok((contacts, carried))
    }
}

impl Scales {
    /// Steps with the numbers of what pressed them by `by`.
    pub fn contacts(&self, by: By) -> impl Iterator<Item = (&Step, &Numbers)> {
        let of = move |step: &'_ Step| step.contacts.iter().position(|(one, _)| *one == by);
        self.steps.iter().filter_map(move |step| Some((step, &step.contacts[of(step)?].1)))
    }
}
