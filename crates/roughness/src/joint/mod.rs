//! The law of a joint: what a surface pressed by a plane is at every load, for programs that take it as a
//! boundary condition.
//!
//! The half-space is pressed from first touch to a largest load and back (`path`); between its loads the law
//! is a smooth curve (`law`), thinned for tables; conductances follow from its stiffness (`conductance`),
//! bounds of roughness that was left out from two such curves (`bounds`), formulas from fits (`fit`).
//!
//! Sources: Barber 2003 (conductance, bounds), Fritsch and Carlson 1980 (monotone cubics).

mod loads;

mod path;
mod several;

mod law;

mod bounds;
mod conductance;
mod fit;
mod transport;

pub use bounds::{Bounds, bounds};
pub use conductance::{Bodies, conductance_table, of_medium};
pub use fit::{Exponential, Fit, Fits, Power};
pub use law::Law;
pub use loads::{FEWEST_LOADS, USUAL_LOADS, largest_pressure, loads};
pub use path::{JointError, JointPath, JointPoint, follow};
pub use transport::{BodiesAndMedium, Conductors, Flow};

#[cfg(test)]
mod tests;
