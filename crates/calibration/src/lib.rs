//! The force of crushed cones over slopes and metals, and the representative strain that makes it one curve
//! (Jourani et al., section 3.3).
//!
//! In the order of the data: a case (`case`), its mesh (`resolution`, `body`), its path (`cone`) and its constant
//! (`kick`).

pub mod case;

pub mod resolution;

pub mod body;

pub mod cone;

pub mod kick;

pub mod sweep;

pub mod row;

pub mod journal;

pub mod run;
