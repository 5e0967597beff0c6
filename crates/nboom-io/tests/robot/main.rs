//! Robots in URDF.

mod robustness;
mod rules;
mod wrong;
