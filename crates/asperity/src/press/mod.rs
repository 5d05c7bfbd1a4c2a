//! The contact of a rough surface with a rigid plane.

mod scene;

mod closures;

mod charts;
mod maps;
mod table;

mod rough;
mod summary;

pub mod table1;

pub use closures::ClosureContact;
pub use rough::{Progress, Rough, press};
pub use scene::RoughScene;
pub use summary::{ClosureSummary, Summary};
pub use table::{LoadPoint, Phase, TableRow};

const MICROMETRE: f64 = 1e-6;
const MEGAPASCAL: f64 = 1e6;
