//! Whole runs against reference trajectories.
//!
//! The references were integrated in 80-bit arithmetic with Kane's equations and agree to about
//! 1e-13 with a second, independent program, so that every difference above 1e-12 is ours.

#[path = "../support/mod.rs"]
mod support;

#[path = "../support/collect.rs"]
mod collect;

#[path = "../support/random_scene.rs"]
mod random_scene;

#[path = "../support/scaled.rs"]
mod scaled;

mod ats;
mod catalog;
mod code;
mod compare;
mod control;
mod decks;
mod embedding;
mod event_times;
mod lanes;
mod lock_ups;
mod momenta;
mod nbod2;
mod prepared;
mod stiff;
mod tolerance;
mod trajectories;
mod trust;
mod unit_sets;
mod units;
