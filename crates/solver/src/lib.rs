//! Axisymmetric and plane-strain large-strain elastoplastic finite elements with a rigid tool.
//!
//! The folders are the theory, in reading order: an integration point ([`point`]), an element ([`element`]), contact with the
//! tool ([`contact`]), the algebra of the system ([`algebra`]), the body with its state ([`body`]), a run along the load path
//! ([`run`]) and the scene that asks for it ([`scene`]).

pub mod point;

pub mod element;

pub mod contact;

pub mod algebra;

pub mod body;

pub mod run;

pub mod scene;
