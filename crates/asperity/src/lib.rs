//! Crushes rough metal on the computer, from one conical asperity to a whole measured surface, and says how far each number
//! can be trusted.
//!
//! The command line is a thin layer over these functions; whatever a command computes, a function returns as typed rows
//! and summaries, named as in the files that the command writes.
//!
//! Tutorials, theory, the meaning of every key and column, what was verified and what is not modelled stand in the book of the
//! repository, `docs/src`.
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
//!     .at(Accuracy::Draft);
//! // the observer ends the run by `false`
//! let result = crush(&Scene::new(&tables)?, &mut |progress| progress.row.depth_um < 10.0)?;
//! let summary = &result.summary;
//! assert!((summary.peak_force_N / 5.5 - 1.0).abs() < summary.estimated_error);
//! assert_eq!(result.curve.last().map(|row| row.force_N), Some(summary.peak_force_N));
//! # Ok::<(), asperity::Error>(())
//! ```
//! The same scene as text is read by [`Scene::from_toml`], and [`crush::Crush::write`] leaves the files of the command in
//! a [`output::Directory`].

pub mod error;
pub mod output;
pub mod units;

pub mod batch;

pub mod input;

pub mod mesh;

pub mod calculix;
pub mod calibrate;
pub mod crush;
pub mod extract;
pub mod identify;
pub mod press;
pub mod reproduce;
pub mod study;
pub mod trade;

pub mod draw;

mod page;

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;

pub use asperity_law::units::{Force, Length, Stress};
pub use asperity_solver::scene as tables;
pub use calibrate::{Calibration, Sweep, calibrate};
pub use crush::{Crush, crush, crush_into};
pub use error::{Error, InputError};
pub use extract::{Extracted, Extraction, extract};
pub use identify::{Fit, Identification, identify};
pub use input::scene::Scene;
pub use mesh::mesh;
pub use press::{Rough, RoughScene, press};
pub use study::{Study, study};
