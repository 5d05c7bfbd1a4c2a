//! The sweep of cones, the representative strain that makes its curves one, and what that strain depends on.

mod run;

mod fit;

mod calibration;
mod pictures;
mod report;

mod merge;
mod sensitivity;

pub use asperity_calibration::case::Tool;
pub use asperity_calibration::row::CaseRow;
pub use asperity_calibration::sweep::Sweep;
pub use calibration::{Calibration, calibrate};
pub use fit::{AngleFit, DevelopedFit, Fit, FunctionFit, PartFit, UnloadedCone};
pub use merge::{merge, read_sweep};
pub use run::{Options, Progress};
pub use sensitivity::{Sensitivity, SensitivityLine, sensitivity};
