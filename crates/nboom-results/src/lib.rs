//! Files of a run: `states.csv`, `events.csv`, `summary.json`, `listing.txt`, with hinge loads
//! `hinge_loads.csv`, `latch_impulses.csv` and `hinge_load_envelope.csv`, and with stresses
//! `stress.csv` and `stress_envelope.csv` too.
//!
//! [`RunDirectory`] is a [`nboom_sim::Recorder`]: it writes each row as soon as it is known, so
//! that a run that fails leaves everything computed before, with a summary that says
//! `"complete": false`. Each writer also works alone, on anything that is [`std::io::Write`].
//!
//! Angles in the tables are radians and numbers read back to the same `f64`; only the listing
//! is for people, in degrees and with ten digits. Nothing is computed here but the Euler angles
//! of the listing, and no unit is converted.
//!
//! ```
//! let mut table = Vec::new();
//! let mut states = nboom_results::StatesWriter::new(&mut table, &[])?;
//! states.flush()?;
//! assert!(table.starts_with(b"t,rho_x,rho_y,rho_z,v_x,v_y,v_z,chi,"));
//! # Ok::<(), std::io::Error>(())
//! ```

mod directory;
mod error;
mod euler;
mod events;
mod layout;
mod listing;
mod number;
mod row_text;
mod rows;
mod signs;
mod states;
mod stress;
mod summary;
mod trust;
mod units;
mod verdict;

#[cfg(test)]
mod fixture;

pub use directory::{Outcome, RunDirectory};
pub use error::{ResultsError, with_causes};
pub use euler::euler_angles;
pub use events::{EventsWriter, event_order};
pub use listing::ListingWriter;
pub use signs::StressSigns;
pub use states::StatesWriter;
pub use stress::StressTables;
pub use summary::{RunDescription, SummaryFile};
pub use trust::{TRUST_FILE, write_trust};
pub use units::UnitSystem;
pub use verdict::WorstLoads;

/// Name of the table of states within a run's directory.
pub const STATES_FILE: &str = "states.csv";
/// Name of the table of events within a run's directory.
pub const EVENTS_FILE: &str = "events.csv";
/// Name of the summary within a run's directory.
pub const SUMMARY_FILE: &str = "summary.json";
/// Name of the table of stresses within a run's directory.
pub const STRESS_FILE: &str = "stress.csv";
/// Name of the table of hinge loads within a run's directory.
pub const HINGE_LOADS_FILE: &str = "hinge_loads.csv";
/// Name of the table of impulses that hinges transmit at lock-ups within a run's directory.
pub const LATCH_IMPULSES_FILE: &str = "latch_impulses.csv";
/// Name of the table of each hinge's largest loads within a run's directory.
pub const HINGE_ENVELOPE_FILE: &str = "hinge_load_envelope.csv";
/// Name of the table of each station's worst stress within a run's directory.
pub const ENVELOPE_FILE: &str = "stress_envelope.csv";
/// Name of the printout within a run's directory.
pub const LISTING_FILE: &str = "listing.txt";
