//! Flow of a fluid through the gap between a rough surface and a plane: whether a path is open, where it is
//! narrowest, and how much leaks along x and along y.
//!
//! Sources: Reynolds 1886 (thin films), Persson and Yang 2008 (critical constriction), Trottenberg, Oosterlee
//! and Schüller 2001 (multigrid), Dapp, Lücke, Persson and Müser 2012 (leak near percolation).

mod gap;

mod constriction;

mod multigrid;

mod reynolds;

pub use constriction::{Constriction, constriction};
pub use gap::{Axis, Gap};
pub use reynolds::{Leak, leak};

#[cfg(test)]
mod tests;
