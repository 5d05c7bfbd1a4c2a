#![doc = include_str!("../README.md")]

mod outline;

mod abaqus;
mod deck;

mod write;

pub use deck::{Deck, Reader};
