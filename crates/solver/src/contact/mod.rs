//! Contact with the rigid tool: its shape, the clipped surface edge, the penalty correction of the depth, flanks that meet.

pub mod tool;

pub mod edge;

mod roots;

pub mod penalty_correction;

pub mod self_contact;
