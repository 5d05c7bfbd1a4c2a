//! The scales of a surface: slopes and contact as ever finer waves are let in, and of each answer whether it
//! has stopped changing.

mod press_scales;

mod summary;
mod table;

mod files;

pub use press_scales::{Scales, scales};
pub use summary::{IntervalRow, Summary, VerdictRow};
pub use table::{ScaleRow, SlopeRow};
