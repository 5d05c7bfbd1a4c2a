//! Contact with a rigid plane: islands above it, what each carries by a closure, the separation that carries
//! the load.

pub(crate) mod ellipse;

pub(crate) mod bearing_area;
pub(crate) mod islands;

pub(crate) mod calibrated;
pub(crate) mod coefficient;
pub(crate) mod material;
pub(crate) mod own_closure;

pub(crate) mod response;

pub(crate) mod closures;

mod find_separation;
pub(crate) mod islands_contact;
mod load;

pub(crate) mod pressure;
pub(crate) mod unload;

#[cfg(test)]
mod tests;
