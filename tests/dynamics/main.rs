//! The recursive formulation against reference data and identities.

#[path = "../support/mod.rs"]
mod support;

mod closed_forms;
mod forward_dynamics;
mod scalars;
