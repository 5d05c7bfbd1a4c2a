//! Contact of a rough surface with a smooth rigid plane, asperity by asperity (Jourani et al., section 4).
//!
//! The order of the modules is the flow of the data: a height map is levelled and filtered, its roughness numbers are
//! taken, a plane cuts it into islands, a closure gives each island its force, and the separation that carries the
//! load is found.

pub mod format;
mod height_map;

mod fft;
mod filter;
mod level;
mod numbers;

mod generate;

mod cell;
mod ellipse;
mod islands;
mod ladder;

mod closure;
mod coefficient;

mod contact;
mod pressure;

pub mod scene;

pub use closure::{
    Closure, ClosureError, Metal, Model, PUBLISHED, Regime, Response, SINGLE_ASPERITY_EXPONENT,
};
pub use coefficient::{Angle, Coefficient, CoefficientError, Cone};
pub use contact::{CURVE_POINTS, Contact, ContactError, CurvePoint, Load, Surface, Unloading, press, unload};
pub use ellipse::Ellipse;
pub use filter::{FilterError, fill, l_filter, s_filter};
pub use generate::{GenerateError, Grid, Kind, KindName, Target, generate};
pub use height_map::{Extent, HeightMap, MapError};
pub use islands::{Island, Islands};
pub use ladder::{Above, Rungs, above_plane, above_rungs, plane_of};
pub use level::{Level, level};
pub use numbers::Roughness;
pub use pressure::{Loaded, PressureField, Profile};

#[cfg(test)]
mod exact_tests;
