//! Contact of a rough surface with a smooth rigid plane: asperity by asperity (Jourani et al., section 4), or as a half-space,
//! with the leak through the gap.
//!
//! In the order of the data: a height map is read or generated, levelled and filtered, its parameters are taken
//! (`surface`); a plane cuts it into islands, a closure gives each its force, and the separation that carries the load
//! is found (`contact`); [`scene`] says all of it in a file. Lengths are in metres, stresses in pascals.
//!
//! ```
//! use asperity_material::units::Stress;
//! use asperity_roughness::{Closure, ClosureLaw, Grid, Kind, Load, Material, Surface, Target, generate, press};
//!
//! let grid = Grid { nodes: [128, 128], pixel: [2e-6, 2e-6], seed: 1 };
//! let map = generate(Kind::Sanded, &grid, Target::Height(1e-6))?;
//! let steel = Material {
//!     youngs_modulus: Stress(210e9),
//!     poissons_ratio: 0.3,
//!     hardness: Some(Stress(1280e6)),
//!     yield_stress: None,
//!     hardening_exponent: None,
//!     hardening_law: None,
//! };
//! let law = ClosureLaw::new(Closure::Johnson, &steel, None)?;
//! let contact = press(&Surface::of(map)?, &law, Load::Pressure(100e6))?;
//! assert!(contact.area_ratio > 0.05 && contact.area_ratio < 0.3);
//! assert!((contact.pressure / 100e6 - 1.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod surface;

mod contact;

pub mod asperities;

pub mod half_space;

pub mod flow;

pub mod scene;

pub use crate::contact::islands_contact::{Contact, ContactError, CurvePoint, Load, press};
pub use crate::surface::prepared_surface::Surface;
pub use contact::closures::{
    Closure, ClosureError, ClosureLaw, PUBLISHED, Regime, Response, SINGLE_ASPERITY_EXPONENT,
};
pub use contact::coefficient::{Coefficient, CoefficientError, Nearest, SlopeTable};
pub use contact::ellipse::Ellipse;
pub use contact::islands::{Island, Islands};
pub use contact::material::Material;
pub use contact::own_closure::{IslandClosure, OwnClosure};
pub use contact::pressure::{LoadedPixel, PressureField, PressureProfile};
pub use contact::unload::{Unloading, unload};
pub use surface::filter::{FilterError, fill, l_filter, s_filter};
pub use surface::generate::{GenerateError, Grid, Kind, KindName, Target, generate};
pub use surface::height_map::{Extent, HeightMap, MapError};
pub use surface::level::{Levelling, level};
pub use surface::parameters::Parameters;
pub use surface::spectrum::{SpectrumPoint, spectrum};
