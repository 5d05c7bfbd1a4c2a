//! The force of crushed cones over slopes and metals, and the representative strain that makes it one curve
//! (Jourani et al., section 3.3).
//!
//! In the order of the data: a case (`case`), its path (`cone`) and its constant
//! (`loading_curvature`); the grid (`sweep`), its rows on disk (`row`, `journal`) and the run of a case
//! (`run`); the representative strain of a slope (`collapse`), of all (`fit`) and of parts (`sensitivity`),
//! the force as a formula (`dimensionless`) and the way back (`unloading`).
//!
//! ```
//! use asperity_calibration::row::CaseRow;
//! use asperity_calibration::solve_case::solve;
//! use asperity_calibration::sweep::Sweep;
//! use asperity_simulation::scene::Accuracy;
//!
//! // the last of the 480 cones: 10 degrees, E/σ_y = 300, n = 0.5
//! let cone = Sweep::default().cases()[479];
//! let row = CaseRow::from(&solve(&cone, Accuracy::Draft));
//! // softer than an elastic cone, K = (2/π) E*/tan β (Sneddon 1965)
//! let elastic = std::f64::consts::FRAC_2_PI * cone.elastic().reduced_modulus() / cone.tan_beta();
//! assert!(row.K_over_E.is_some_and(|k| k > 0.0 && k < elastic));
//! ```

pub mod case;

pub mod cone;

pub mod loading_curvature;

pub mod sweep;

pub mod row;

pub mod solve_case;

pub mod collapse;

pub mod fit;

pub mod dimensionless;

pub mod unloading;

pub mod indentation;

pub mod atlas;

pub mod cones;
