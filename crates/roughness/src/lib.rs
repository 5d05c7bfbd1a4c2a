#![doc = include_str!("../README.md")]
//!
//! In the order of the data: a height map is read or generated, levelled and filtered, its parameters are
//! taken (`surface`); a plane cuts it into islands, a closure gives each its force, and the separation that
//! carries the load is found (`contact`); the whole surface as a half-space ([`half_space`]) and the leak
//! through its gap ([`flow`]), at every load the law of a joint ([`joint`]), and with ever finer waves let in
//! what has stopped changing ([`scales`]); [`scene`] says all of it in a file.

mod surface;

#[cfg(test)]
mod test_waves;

mod contact;

pub mod asperities;

pub mod half_space;

pub mod flow;

pub mod joint;

pub mod scales;

pub mod scene;

pub use crate::contact::islands_contact::{Contact, ContactError, CurvePoint, Load, press};
pub use crate::surface::prepared_surface::{Surface, read_as};
pub use contact::closures::{
    Closure, ClosureError, ClosureLaw, PUBLISHED_COEFFICIENT, SINGLE_ASPERITY_EXPONENT,
};
pub use contact::coefficient::{Coefficient, CoefficientError, Nearest, SlopeTable};
pub use contact::ellipse::Ellipse;
pub use contact::islands::{Island, Islands};
pub use contact::material::Material;
pub use contact::own_closure::{IslandClosure, OwnClosure};
pub use contact::pressure::{LoadedPixel, PressureField, PressureProfile};
pub use contact::response::{Regime, Response};
pub use contact::unload::{Unloading, unload};
pub use surface::filter::{FilterError, fill, l_filter, s_filter};
pub use surface::generate::{GenerateError, Grid, Kind, KindName, Target, generate};
pub use surface::height_map::{Extent, HeightMap, MapError};
pub use surface::level::{Levelling, level};
pub use surface::parameters::Parameters;
pub use surface::spectrum::{SpectrumPoint, spectrum};
