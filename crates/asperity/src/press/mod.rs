//! The contact of a rough surface with a rigid plane.

mod scene;

mod closures;

mod summary;
mod table;

mod rough;

mod charts;
mod files;

pub mod table1;

pub use closures::ClosureContact;
pub use files::Layers;
pub use rough::{Progress, Rough, press};
pub use scene::RoughScene;
pub use summary::{ClosureSummary, Summary};
pub use table::{LoadPoint, Phase, TableRow};

const MICROMETRE: f64 = 1e-6;
const MEGAPASCAL: f64 = 1e6;
