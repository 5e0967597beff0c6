//! Stress: scenes far from ordinary ones, whose every figure has a bound with a reason.
//!
//! What is measured stands in `docs/accuracy.md`.

#[path = "../support/collect.rs"]
mod collect;

mod stress;

mod dashpots;
mod instants;
mod long_spin;
mod masses;
mod postures;
mod scales;
