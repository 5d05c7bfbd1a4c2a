#![doc = include_str!("../README.md")]
//!
//! The folders are the theory, in reading order: an integration point ([`point`]), an element ([`element`]),
//! contact with the tool ([`contact`]), the body with its state ([`body`]), its mesh made anew ([`remesh`])
//! and the equilibrium of an increment ([`equilibrium`]).
//!
//! The book of the repository derives what they compute, with the same symbols: `docs/src/theory`, from
//! `kinematics.md` on.
//!
//! Callers need [`point`]; the other folders are open to the crates above and hidden from these pages.

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
