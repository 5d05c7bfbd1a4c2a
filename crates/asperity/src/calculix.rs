//! A scene as a complete input of CalculiX or Abaqus.

use crate::error::Error;
use crate::input::scene::Scene;
use crate::mesh::problem;

pub use asperity_decks::{Deck, Reader, is_alike};

/// The deck of `scene`, called `name` in its heading, for `reader`.
///
/// # Errors
/// A scene that such a deck cannot express, pointing at its line.
pub fn deck(name: &str, scene: &Scene, reader: Reader) -> Result<Deck, Error> {
    let problem = problem(scene)?;
    Deck::new(name, scene.tables(), &problem, reader).map_err(|e| scene.error(&e).into())
}
