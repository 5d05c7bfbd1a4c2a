//! The sweep of cones, the representative strain that makes its curves one, and what that strain depends on.

pub mod run_sweep;

mod fit;

mod calibration;
mod pictures;
mod sweep_report;

mod merge;

pub use crate::calibrate::run_sweep::Options;
pub use asperity_calibration::case::Tool;
pub use asperity_calibration::row::CaseRow;
pub use asperity_calibration::sweep::Sweep;
pub use calibration::{Calibration, calibrate};
pub use fit::{AngleFit, DevelopedFit, Fit, FunctionFit, PartFit, UnloadedCone};
pub use merge::{merge, read_sweep};
