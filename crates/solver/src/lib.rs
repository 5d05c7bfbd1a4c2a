//! One increment of an axisymmetric or plane-strain body at large elastoplastic strains, under a rigid tool.
//!
//! The folders are the theory, in reading order: an integration point ([`point`]), an element ([`element`]), contact with the
//! tool ([`contact`]), the body with its state ([`body`]), its mesh made anew ([`remesh`]) and the equilibrium of an
//! increment ([`equilibrium`]).
//!
//! The book of the repository derives what they compute, with the same symbols: `docs/src/theory`, from `kinematics.md` on.
//!
//! Callers need [`point`]; the other folders are open to the crates above and hidden from these pages.
//!
//! A point alone, stretched by 1 % along z in plane strain:
//! ```
//! use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};
//! use asperity_solver::point::j2::{Tangent, update};
//! use asperity_solver::point::material::Metal;
//! use asperity_solver::point::tensor::von_mises;
//!
//! let law = Hardening { law: HardeningLaw::Swift, yield_stress: 0.002, exponent: 0.2, youngs_modulus: 1.0 };
//! let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
//! let stress_measure = StressMeasure::Kirchhoff;
//! let metal = Metal { elastic, hardening: Some(law.into()), kinematic_share: 0.0, stress_measure };
//! let end = update(&metal, &metal.virgin(), &[0.0, 0.0, 0.0, 0.01, 0.0], Tangent::None).unwrap();
//! assert!(end.plastic && (von_mises(&end.stress) / end.state.yield_stress - 1.0).abs() < 1e-12);
//! ```

pub mod point;

#[doc(hidden)]
pub mod element;

#[doc(hidden)]
pub mod contact;

#[doc(hidden)]
pub mod body;

#[doc(hidden)]
pub mod remesh;

#[doc(hidden)]
pub mod equilibrium;
