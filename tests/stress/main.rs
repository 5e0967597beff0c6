//! Stresses of whole runs.

#[path = "../support/collect.rs"]
mod collect;

mod closed_forms;
mod envelope;
mod follow;
mod instants;
mod joint;
