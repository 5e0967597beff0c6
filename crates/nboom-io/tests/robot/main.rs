//! Robots in URDF.

#[path = "../support/mod.rs"]
mod support;

mod robustness;
mod rules;
mod wrong;
