//! A scene as a complete input of CalculiX (and Abaqus): body, material, tool, contact, and a step for every
//! point of the curve.

mod outline;

mod deck;

mod write;

pub use deck::{Deck, Reader};
