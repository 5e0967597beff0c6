//! Stresses of whole runs.

#[path = "../support/collect.rs"]
mod collect;
#[path = "../support/random_scene.rs"]
mod random_scene;

mod closed_forms;
mod envelope;
mod follow;
mod instants;
mod joint;
mod pulses;
mod random;
mod search;
