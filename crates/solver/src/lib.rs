//! Axisymmetric and plane-strain large-strain elastoplastic finite elements with a rigid tool.
//!
//! In reading order: a metal point (`tensor`, `kinematics`, `material`, `j2`, `history`; with a
//! back stress `log_space`, `kinematic`), an element (`element`,
//! `quad4`, `quad8`), the tool (`tool`, `contact`, `penetration`), the system (`dofs`, `assemble`, `elimination`, `linear`, `newton`, `model`),
//! and a run (`scene`, `discretise`, `expected`, `problem`, `stepping`, `crush`, `record`, `curve`).

pub mod tensor;

pub mod kinematics;

pub mod material;

pub mod j2;

pub mod history;

pub mod log_space;

pub mod kinematic;

pub mod element;

pub mod quad4;
pub mod quad8;

pub mod tool;

pub mod contact;

pub mod penetration;

pub mod dofs;

pub mod assemble;

pub mod elimination;

pub mod linear;

pub mod newton;

pub mod floor;

pub mod secant;

pub mod model;

pub mod energy;

pub mod indentation;

pub mod fields;

pub mod folding;

pub mod islands;

pub mod scene;

pub mod discretise;

pub mod expected;

pub mod probe;

pub mod problem;

pub mod stepping;

pub mod estimate;

pub mod crush;

pub mod record;

pub mod curve;
