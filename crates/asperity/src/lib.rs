//! Crushes rough metal on the computer, from one conical asperity to a whole measured surface, and says how far each number
//! can be trusted.

mod csv_file;
pub mod error;
mod json_file;
pub mod output;

pub mod input;

pub mod calculix;
pub mod calibrate;
pub mod crush;
pub mod press;
pub mod reproduce;
pub mod trade;

pub mod draw;

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;

pub use calibrate::{Calibration, Sweep, calibrate};
pub use error::{Error, InputError};
pub use press::{Rough, RoughScene, press};
