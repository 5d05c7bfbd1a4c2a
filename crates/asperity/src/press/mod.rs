//! The contact of a rough surface with a rigid plane.

mod scene;

mod closures;

mod summary;
mod table;

mod rough;

pub(crate) mod charts;
mod files;

pub mod table1;

pub use crate::crush::Phase;
pub use closures::ClosureContact;
pub use files::Layers;
pub use rough::{Progress, Rough, press};
pub use scene::RoughScene;
pub use summary::{ClosureSummary, Summary};
pub use table::{LoadPoint, TableRow};
