//! Contact with the rigid tool: its shape, the clipped surface edge, friction, the penalty correction of the
//! depth, the surface in contact with itself. `edge` integrates the pressure over what touches of each edge;
//! `pieces` are the stretches of it along which the tool is smooth, `roots` finds on them where contact
//! begins and ends, and `parts` holds what is found.

pub mod tool;

pub mod parts;
pub mod pieces;

pub mod slip;

pub mod edge;

pub mod friction;

mod roots;

pub mod depth_correction;

pub mod projection;

pub mod self_contact;
