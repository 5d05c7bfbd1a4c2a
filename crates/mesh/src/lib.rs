#![doc = include_str!("../README.md")]

pub mod build;
pub mod grading;
mod inp;
mod mesh;
mod msh;
pub mod outline;
pub mod profile;
mod punch;
mod quality;
pub mod regions;
pub mod smoothing;
mod tool_outline;
mod vtu;

pub use inp::{Section, write_inp, write_inp_side};
pub use mesh::{Edge, ElementKind, Mesh, Sides};
pub use msh::{MshError, read_msh, write_msh};
pub use punch::Punch;
pub use quality::Quality;
pub use tool_outline::{OwnTool, Penetration, ToolOutline};
pub use vtu::{FieldArray, VtuError, write_vtu};
