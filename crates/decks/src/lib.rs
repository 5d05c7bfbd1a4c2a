#![doc = include_str!("../README.md")]

mod outline;

mod abaqus;
mod alike;
mod deck;

mod write;

pub use alike::is_alike;
pub use deck::{Deck, Reader};
