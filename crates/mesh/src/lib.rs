//! Meshes of conical asperities on a substrate: profiles, grading, quality, files.
//!
//! ```
//! use asperity_mesh::ElementKind;
//! use asperity_mesh::build::{Contact, Plan, build};
//! use asperity_mesh::grading::Grading;
//! use asperity_mesh::profile::Profile;
//!
//! // a flat body of radius and depth 100, fine under a contact of radius 1
//! let mesh = build(&Plan {
//!     profile: Profile { asperities: Vec::new(), line: None },
//!     contacts: vec![Contact { centre: 0.0, half_width: 1.0, foot: 10.0, sides: [1.0; 2], slope: 0.0 }],
//!     row: [0.0, 0.0],
//!     width: [0.0, 100.0],
//!     depth: 100.0,
//!     grading: Grading { fineness: 0.25, start: 0.2, fine: 1.6, far: 0.4 },
//!     kind: ElementKind::Quad8,
//! });
//! assert!(mesh.quality().is_some_and(|q| q.min_scaled_jacobian > 0.3));
//! ```

pub mod build;
pub mod grading;
mod inp;
mod mesh;
mod msh;
pub mod outline;
pub mod profile;
mod punch;
mod quality;
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
