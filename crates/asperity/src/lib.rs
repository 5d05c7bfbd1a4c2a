#![doc = include_str!("../README.md")]
//!
//! The command line is a thin layer over these functions; whatever a command computes, a function returns as
//! typed rows and summaries in SI, and writes them under the names and in the units of the files of the
//! command.
//!
//! # One crush
//! ```
//! use asperity::tables::{Accuracy, Asperity, Loading, Material, Scene as Tables, Symmetry, Tool};
//! use asperity::{Length, Scene, Stress, crush};
//!
//! let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3);
//! let cone = Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6));
//! let tables = Tables::new(Symmetry::Axisymmetric, steel, Tool::plane(), Loading::to_depth(Length(5e-6)))
//!     .with(cone)
//!     .with_accuracy(Accuracy::Draft);
//! let scene = Scene::new(&tables)?;
//! let result = crush(&scene, &mut |_| true)?;
//! let summary = &result.summary;
//! assert!((summary.peak_force / 5.5 - 1.0).abs() < summary.estimated_error);
//! assert_eq!(result.curve.last().map(|row| row.force), Some(summary.peak_force));
//!
//! // the observer ends a run by `false`: what was reached stays, without a stated error
//! let part = crush(&scene, &mut |progress| progress.done < 10)?.summary;
//! assert!(part.stopped.is_some() && part.estimated_error.is_nan());
//! # Ok::<(), asperity::Error>(())
//! ```
//! # A sweep of cones
//! ```
//! use asperity::calibrate::{Options, Tool};
//! use asperity::tables::Accuracy;
//! use asperity::{HardeningLaw, Stress, Sweep, calibrate};
//!
//! let sweep = Sweep {
//!     slopes_deg: vec![8.0],
//!     youngs_modulus: vec![Stress(210e9)],
//!     yield_stress: vec![Stress(300e6)],
//!     hardening_exponent: vec![0.2],
//!     hardening_law: HardeningLaw::Swift,
//!     tool: Tool::Cone,
//!     accuracy: Accuracy::Draft,
//!     ..Sweep::default()
//! };
//! let swept = calibrate(&sweep, &Options::default(), &mut |_| true)?;
//! assert!(swept.cases[0].K_over_E.is_some());
//! # Ok::<(), asperity::Error>(())
//! ```
//!
//! # A rough surface
//! ```
//! use asperity::rough::tables::{Choice, GenerateScene, KindName, LoadScene, Material, Scene, SurfaceScene};
//! use asperity::{Closure, Length, RoughScene, Stress, press};
//! use std::path::Path;
//!
//! let sanded = GenerateScene {
//!     kind: KindName::Sanded,
//!     ra: Some(Length(1e-6)),
//!     mean_slope_deg: Some(8.0),
//!     size: [Length(0.2e-3); 2],
//!     pixels: [128; 2],
//!     seed: 1,
//!     hurst: None,
//!     rolloff: None,
//!     cutoff: None,
//! };
//! let surface = SurfaceScene { generate: Some(sanded), ..SurfaceScene::default() };
//! let steel = Material {
//!     youngs_modulus: Stress(210e9),
//!     poissons_ratio: 0.3,
//!     hardness: Some(Stress(1280e6)),
//!     hardness_error: None,
//!     yield_stress: None,
//!     hardening_exponent: None,
//!     hardening_law: None,
//! };
//! let load = LoadScene { pressure: Some(Stress(100e6)), separation: None, unload: false };
//! let scene = RoughScene::new(Scene::new(Choice::Johnson, surface, steel, load), Path::new(""));
//! let pressed = press(&scene, &mut |_| true)?;
//! assert_eq!(pressed.table[0].closure, Closure::Johnson);
//! assert!((0.05..0.3).contains(&pressed.table[0].contact_area_ratio));
//! # Ok::<(), asperity::Error>(())
//! ```
//!
//! # Files
//! Scenes as text are read by [`Scene::from_toml`] and [`RoughScene::from_toml`], files of sweeps by
//! [`calibrate::read_sweep`]. [`crush::Crush::write`] and its like leave the files of the command in a
//! [`output::Directory`].

pub mod error;

pub mod results;

pub mod progress;

pub mod batch;

pub mod scenes;

pub mod input;

pub mod mesh;

pub mod calculix;
pub mod calibrate;
pub mod crush;
pub mod extract;
pub mod identify;
pub mod joint;
pub mod rough;
pub mod scales;
pub mod study;
pub mod trade;

pub use asperity_draw as draw;

pub mod page;

pub use crate::rough::{Rough, RoughScene, press};
pub use asperity_material::units::{Compliance, Force, Length, LineForce, Stiffness, Stress};
pub use asperity_material::{FlowCurve, HardeningLaw, HardeningMode, StressMeasure};
pub use asperity_mesh::{Penetration, ToolOutline};
pub use asperity_roughness::{Closure, IslandClosure, Regime, Response};
pub use asperity_simulation::scene as tables;
pub use calibrate::{Calibration, Sweep, calibrate};
pub use crush::{Crush, crush, crush_into};
pub use error::{Error, InputError};
pub use extract::{Extracted, Extraction, extract};
pub use identify::{Fit, Identification, identify};
pub use input::scene::Scene;
pub use joint::{Joint, joint};
pub use mesh::{Mesh, mesh};
pub use progress::{Observer, Progress};
pub use results::{columns, numbers, output, units};
pub use scales::{Scales, scales};
pub use study::{Study, study};

/// The crates below, for their types in the signatures here: a program needs no other dependency.
#[doc(no_inline)]
pub use {
    asperity_calibration as calibration, asperity_formats as formats,
    asperity_identification as identification, asperity_material as material, asperity_numerics as numerics,
    asperity_roughness as roughness, asperity_simulation as simulation, asperity_solver as solver,
};
