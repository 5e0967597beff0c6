//! Stresses of a run: at output times and lock-ups, in every section, with margins.
//!
//! A [`StressAnalysis`] takes the snapshots and lock-ups of a run, finds the loads of every station
//! and hinge and the stresses that they make, and keeps for each station the worst that it has
//! seen: when, why, by which component of the load, and how far from yield. It changes nothing in
//! the run, and a run without one does not know of it.

mod analysis;
mod envelope;
mod error;
mod formulas;
mod settings;
mod slip;

pub use analysis::{StationStress, StressAnalysis};
pub use envelope::{Cause, Component, Worst};
pub use error::StrengthError;
pub use settings::Settings;
pub use slip::{Slip, Slips};
