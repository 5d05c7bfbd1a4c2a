//! The path of the tool, the only one: adaptive increments to a travel, a depth or a force, back to zero
//! force, and again.

mod cutback;
mod energy_account;
mod increment;
mod load;
mod path;
mod target;
mod touches;
mod unload;

pub use increment::{Energies, Increment, Observer, Stop};
pub use path::{Counts, Path};
