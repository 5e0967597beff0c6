use std::io;
use std::path::{Path, PathBuf};

use nboom_results::{Kind, ResultsError};
use nboom_tables::TablesError;

use crate::Shard;

/// Why a sweep could not be made, continued or put together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The directory is in use or has something else in it, or a file cannot be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// A table cannot be written or read.
    #[error(transparent)]
    Tables(#[from] TablesError),
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something that was not written by a sweep has the name of a file of a sweep.
    #[error(
        "{}: found {found} that no sweep has written, expected a file of a sweep or nothing; move or \
         delete it, or name another directory",
        path.display()
    )]
    Foreign {
        /// The path.
        path: PathBuf,
        /// What is there.
        found: Kind,
    },
    /// A file is not what a sweep writes.
    #[error("{}: {found} found, a file that nboom sweep has written expected", path.display())]
    NoSweep {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        found: String,
    },
    /// A finished sweep lacks one of its files.
    #[error(
        "{}: nothing found, a file of a finished sweep expected; restore it, or delete the directory and sweep again",
        path.display()
    )]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// A file of a sweep is not what the sweep wrote.
    #[error(
        "{}: {found} found, {expected} expected, as the sweep wrote it; restore it, or delete the \
         directory and sweep again",
        path.display()
    )]
    Altered {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: String,
        /// What the sweep wrote.
        expected: String,
    },
    /// A journal is not what a sweep writes.
    #[error(
        "{}, byte {byte}: {found} found; restore the file, or delete the directory and sweep again",
        path.display()
    )]
    Journal {
        /// The file.
        path: PathBuf,
        /// Where the batch begins.
        byte: u64,
        /// What is wrong.
        found: String,
    },
    /// A sweep was begun and may be continued.
    #[error(
        "{}: a sweep with {done} of {cases} cases found, nothing or a finished one expected; \
         continue it with --resume",
        directory.display()
    )]
    Unfinished {
        /// The directory.
        directory: PathBuf,
        /// Cases that are done.
        done: u64,
        /// Cases in all.
        cases: u64,
    },
    /// The directory has the same sweep with fewer draws.
    #[error(
        "{}: a sweep with {draws} draws of this study found; --resume runs the others",
        directory.display()
    )]
    FewerDraws {
        /// The directory.
        directory: PathBuf,
        /// Its draws.
        draws: u64,
    },
    /// The directory has another sweep.
    #[error(
        "{}: another sweep found: {}; name another directory for this one, new or empty",
        directory.display(), differences.join("; ")
    )]
    Different {
        /// The directory.
        directory: PathBuf,
        /// What is different, in words.
        differences: Vec<String>,
    },
    /// The same sweep, but of another program or machine.
    #[error(
        "{}: a sweep by another program or machine found: {}; its last digits may differ; \
         --accept-difference goes on",
        directory.display(), differences.join("; ")
    )]
    MadeElsewhere {
        /// The directory.
        directory: PathBuf,
        /// What is different, in words.
        differences: Vec<String>,
    },
    /// The disk is too small for what would be written.
    #[error(
        "{}: {free} MB free found, about {needed} MB expected for what a sweep of {cases} cases writes",
        directory.display()
    )]
    Space {
        /// The directory.
        directory: PathBuf,
        /// Megabytes that are free.
        free: u64,
        /// Megabytes that are needed.
        needed: u64,
        /// Cases in all.
        cases: u64,
    },
    /// Memory is too small for the trajectories of runs that go on at once.
    #[error(
        "{free} MB of memory free found, about {needed} MB expected for trajectories of {rows} rows in {jobs} \
         threads; take fewer output times, or fewer threads with --jobs"
    )]
    Memory {
        /// Megabytes that are free.
        free: u64,
        /// Megabytes that are needed.
        needed: u64,
        /// Rows of a trajectory.
        rows: u64,
        /// Threads.
        jobs: u64,
    },
    /// A case stopped by a mistake of the program.
    #[error("case {case} stopped by a mistake of nboom: {found}; cases before it are kept")]
    Panic {
        /// The case.
        case: u64,
        /// What the program says.
        found: String,
    },
    /// The system does not start so many threads.
    #[error(
        "thread {number} of {jobs} cannot be started; fewer jobs expected; cases that were done are kept"
    )]
    Threads {
        /// Which one, from 1.
        number: usize,
        /// How many there should be.
        jobs: usize,
        /// What the system says.
        source: io::Error,
    },
    /// Something that should be a batch of cases from elsewhere is none.
    #[error("{found} found, a batch of cases of this sweep expected")]
    NoBatch {
        /// What it is.
        found: String,
    },
    /// A directory that should be a finished shard is none.
    #[error("{}: {found} found, a finished shard expected", directory.display())]
    NoShard {
        /// The directory.
        directory: PathBuf,
        /// What it is.
        found: String,
    },
    /// A shard is of another sweep than those before it.
    #[error(
        "{}: a shard of another sweep found: {}; shards of one sweep expected",
        directory.display(), differences.join("; ")
    )]
    ShardOfAnother {
        /// The directory.
        directory: PathBuf,
        /// What is different, in words.
        differences: Vec<String>,
    },
    /// A directory has a part of a sweep.
    #[error(
        "{}: the shard {shard} found, a whole sweep expected; nboom merge puts shards together",
        directory.display()
    )]
    Shard {
        /// The directory.
        directory: PathBuf,
        /// The shard.
        shard: Shard,
    },
    /// Two directories are the same shard.
    #[error("{} and {} are both the shard {shard}", directories[0].display(), directories[1].display())]
    ShardTwice {
        /// The shard.
        shard: Shard,
        /// The directories.
        directories: [PathBuf; 2],
    },
    /// Tables of a shard are asked for.
    #[error(
        "tables in CSV of the shard {shard} found, of a whole sweep expected; nboom merge --csv writes those of all \
         shards"
    )]
    TablesOfShard {
        /// The shard.
        shard: Shard,
    },
    /// Not all shards are given.
    #[error("{given} of {of} shards given, all expected; missing: {}", missing.join(", "))]
    ShardsMissing {
        /// How many there are.
        given: u64,
        /// How many there should be.
        of: u64,
        /// The first of those that are missing.
        missing: Vec<String>,
    },
}

impl StudyError {
    /// Whether the directory, the disk or what is asked for was refused before anything was computed.
    pub fn is_refusal(&self) -> bool {
        match self {
            Self::Results(error) => error.is_refusal(),
            Self::Tables(_) | Self::Read { .. } | Self::Panic { .. } | Self::Threads { .. } => {
                false
            }
            _ => true,
        }
    }

    /// A file of a sweep has another SHA-256 than what the sweep wrote.
    pub(crate) fn altered(path: &Path, found: &str, expected: &str) -> Self {
        let [found, expected] = [found, expected].map(|sum| format!("SHA-256 {sum}"));
        Self::Altered { path: path.to_owned(), found, expected }
    }

    pub(crate) fn reading(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Read { path, source }
    }

    pub(crate) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| ResultsError::Write { path, source }.into()
    }
}
