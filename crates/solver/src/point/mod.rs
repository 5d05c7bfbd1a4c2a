//! An integration point: tensors, kinematics, Hencky elasticity, return mapping, second-order flow.

pub mod failure;

pub mod tensor;

pub mod kinematics;

pub mod material;

pub mod j2;

#[doc(hidden)]
pub mod bdf2;

#[doc(hidden)]
pub mod log_space;

pub mod kinematic_hardening;
