//! The contact of a rough surface with a rigid plane.

pub mod rough_scene;

mod half_space;

mod closure_contact;
mod half_space_contacts;
mod press_closure;
mod warnings;

mod curves;

mod summary;
mod table;

pub mod contact;
mod several;
mod verdict;

pub mod charts;
mod files;
mod rough_report;

/// Tables of a rough scene.
pub use asperity_roughness::scene as tables;

pub use crate::crush::Phase;
pub use crate::rough::closure_contact::{Body, ClosureContact, IslandContact, Judged};
pub use crate::rough::contact::{Rough, press};
pub use crate::rough::rough_scene::RoughScene;
pub use curves::{BearingRow, GapShare, SpectrumRow};
pub use files::Layers;
pub(crate) use half_space::body as half_space_of;
pub use half_space::{Passage, SpaceContact, SpaceUnloading};
pub use several::{Several, SurfaceRow, press_several};
pub use summary::{ClosureSummary, Summary};
pub use table::{LoadPoint, TableRow};
pub(crate) use warnings::scene_warnings;
