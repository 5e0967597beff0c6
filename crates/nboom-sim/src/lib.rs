//! Runs a scene: integrates a mode, finds the next event, changes the mode, goes on.

mod options;
mod record;

pub use options::Options;
pub use record::{
    Conservation, Detail, Event, EventKind, Recorder, Snapshot, Summary, Totals,
};
