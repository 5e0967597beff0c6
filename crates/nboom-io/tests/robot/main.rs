//! Robots in URDF.

#[path = "../support/mod.rs"]
mod support;

mod public;
mod robustness;
mod rules;
mod wrong;
