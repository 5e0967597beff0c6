//! Loads and stresses of a run: the largest of every section and hinge, with margins.
//!
//! A [`StressAnalysis`] is a [`nboom_sim::Recorder`] that sees every step and instant of a run,
//! finds the loads of every station and hinge and their stresses, and keeps for each the worst of
//! the motion: when, why, by which component of the load, and how far from yield. The search covers
//! the inside of every step, so the result depends neither on output times nor on the length of the
//! run. The analysis changes nothing in the run, and a run without it costs nothing.

mod analysis;
mod envelope;
mod error;
mod finder;
mod formulas;
mod gauge;
mod idle;
mod margins;
mod nodes;
mod peak;
mod piece;
mod pulse;
mod record;
mod recorder;
mod search;
mod settings;
mod slip;
mod station;
mod wanted;

pub use analysis::StressAnalysis;
pub use envelope::{Cause, Component, HingeQuantity, LatchImpulses, Worst, WorstHingeLoad};
pub use error::StrengthError;
pub use idle::{ActsOn, Idle};
pub use margins::{Limit, Margins};
pub use pulse::PulseShape;
pub use settings::Settings;
pub use slip::{Slip, Slips};
pub use station::{PulsePeaks, StationLoad, StationStress, Stations};
pub use wanted::{Loads, WantedLoads};
