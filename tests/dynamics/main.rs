//! The recursive formulation against reference data and identities.

#[path = "../support/random_scene.rs"]
mod random_scene;
#[path = "../support/mod.rs"]
mod support;

mod accuracy;
mod closed_forms;
mod derivatives;
mod embedding;
mod formulations;
mod forward_dynamics;
mod generated;
mod gimbals;
mod inverse;
mod limbs;
mod lines;
mod momenta;
mod renewed;
mod right_side;
mod robots;
mod satellites;
mod scalars;
