//! Contact with a rigid plane: islands above it, what each carries by a closure, the separation that carries the load.

pub(crate) mod ellipse;

pub(crate) mod bearing_area;
pub(crate) mod islands;

pub(crate) mod calibrated;
pub(crate) mod coefficient;
pub(crate) mod material;

pub(crate) mod closures;

mod find_separation;
mod load;
pub(crate) mod press;

pub(crate) mod pressure;
pub(crate) mod unload;

#[cfg(test)]
mod tests;
