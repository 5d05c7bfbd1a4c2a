//! The contact of a rough surface with a rigid plane.

mod scene;

mod half_space;

mod closures;

mod curves;

mod summary;
mod table;

mod rough;
mod several;
mod verdict;

pub(crate) mod charts;
mod files;
mod report;

pub mod table1;

/// Tables of a rough scene.
pub use asperity_roughness::scene as tables;

pub use crate::crush::Phase;
pub use closures::{Body, ClosureContact, IslandContact};
pub use curves::{BearingRow, GapShare, SpectrumRow};
pub use files::Layers;
pub(crate) use half_space::body as half_space_of;
pub use half_space::{Passage, SpaceContact, SpaceUnloading};
pub use rough::{Progress, Rough, press};
pub use scene::RoughScene;
pub use several::{Several, SurfaceRow, press_several};
pub use summary::{ClosureSummary, Summary};
pub use table::{LoadPoint, TableRow};
