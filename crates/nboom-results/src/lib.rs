//! Files of a run: `states.csv`, `events.csv`, `summary.json`, `datapackage.json`, `listing.txt`, with hinge loads
//! `hinge_loads.csv`, `latch_impulses.csv` and `hinge_load_envelope.csv`, and with stresses
//! `stress.csv` and `stress_envelope.csv` too.
//!
//! [`RunDirectory`] is a [`nboom_sim::Recorder`]: it writes each row as soon as it is known, so
//! that a run that fails leaves everything computed before, with a summary that says
//! `"complete": false`. Each writer also works alone, on anything that is [`std::io::Write`].
//!
//! Angles in the tables are radians and numbers read back to the same `f64`; only the listing
//! is for people, in degrees and with ten digits, of late times more. Nothing is computed here but the Euler angles
//! of the listing, and no unit is converted.
//!
//! ```
//! let mut table = Vec::new();
//! let mut states = nboom_results::StatesWriter::new(&mut table, &[])?;
//! states.flush()?;
//! assert!(table.starts_with(b"t,rho_x,rho_y,rho_z,v_x,v_y,v_z,chi,"));
//! # Ok::<(), std::io::Error>(())
//! ```

mod composer;
mod destination;
mod directory;
mod earlier;
mod error;
mod euler;
mod events;
mod heads;
mod kept;
mod kind;
mod label_keys;
mod layout;
mod ledger;
mod listing;
mod load_heads;
mod lock;
mod maker;
mod moment;
mod names;
mod number;
mod package;
mod peaks;
mod plots;
mod quantities;
mod row_text;
mod rows;
mod signs;
mod states;
mod stress;
mod summary;
mod trust;
mod verdict;
mod whole;

#[cfg(test)]
mod fixture;

pub use destination::{is_page, require_named};
pub use directory::{Outcome, RunDirectory};
pub use error::{ResultsError, with_causes};
pub use euler::euler_angles;
pub use events::{EventsWriter, event_heads, event_order};
pub use heads::{Head, Headings, Holds, column_name, motion_heads};
pub use kept::Kept;
pub use kind::Kind;
pub use listing::ListingWriter;
pub use lock::{Holder, LOCK_FILE, Lock};
pub use maker::Maker;
pub use moment::time_digits;
pub use names::*;
pub use peaks::{PeakDigits, peak_digits};
pub use plots::{PLOT_MARK, PLOTS_FOLDER, check_plots, write_plots};
pub use quantities::quantity;
pub use signs::StressSigns;
pub use states::StatesWriter;
pub use stress::StressTables;
pub use summary::{RunDescription, StressDescription, SummaryFile, WantedOutput};
pub use verdict::WorstLoads;
pub use whole::{make_file, write_file};
