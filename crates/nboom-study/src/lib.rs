//! Studies: many runs of one scene with varied numbers.
//!
//! A [`Study`] says which numbers of a scene vary, by which distributions, which faults there may be, and
//! what is wanted of each run. A case is one run; its number alone says all that is drawn for it. A [`Sweep`] runs
//! all cases into a directory, so that nothing is lost whatever ends it, and [`merge`] puts parts of one together.
//! [`statistics`] sum up the table of all cases, and [`page`] shows them.

mod case;
mod cases;
mod correlation;
mod description;
mod directory;
mod distribution;
mod error;
mod fault;
mod file;
mod finished;
mod frame;
mod gathering;
mod growth;
mod hinges;
mod journal;
mod merge;
mod observer;
mod page;
mod plan;
mod rejection;
mod requirement;
mod row;
mod selected;
mod shard;
mod side_by_side;
mod space;
pub mod statistics;
mod study;
mod sweep;
mod table;
mod tables;
mod task;
mod wanted;
mod watcher;
mod workers;

pub use case::Runner;
pub use description::{Description, Source};
pub use directory::{
    CASES_CSV_FILE, CASES_FILE, JOURNAL_FILE, PAGE_FILE, STATISTICS_FILE, STUDY_FILE,
    STUDY_JSON_FILE, SWEPT_SCENE_FILE, TRAJECTORIES_CSV_FILE, TRAJECTORIES_FILE, require_as_swept,
};
pub use distribution::Distribution;
pub use error::StudyError;
pub use fault::FaultError;
pub use file::schema;
pub use finished::SweepDirectory;
pub use gathering::Gathering;
pub use merge::merge;
pub use nboom_results::Maker;
pub use page::{Facts, page};
pub use plan::{Case, Plan};
pub use rejection::Rejection;
pub use requirement::Requirement;
pub use row::{Outcome, Row, Value};
pub use selected::Selected;
pub use shard::{NoSuchShard, Shard};
pub use study::{
    Change, Correlation, FailureMode, Fault, LateRelease, Method, Relation, RunSettings, Study,
    Variable,
};
pub use sweep::Sweep;
pub use table::{columns, trajectory_columns};
pub use task::{End, Report};
pub use wanted::{UnknownResult, Wanted};
pub use watcher::Watcher;
