use std::io;
use std::path::PathBuf;

use nboom_tables::RowsError;

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// What should be the directory of a run is none.
    #[error("{}: no directory of a run found, one with the files of nboom run expected", path.display())]
    NoDirectory {
        /// The path.
        path: PathBuf,
    },
    /// The directory has no file of a run.
    #[error(
        "{}: neither summary.json nor states.csv found; a directory that nboom run has written expected{}",
        path.display(), if *.has_partial { "; unfinished results are in the directory with .partial at its end" } else { "" }
    )]
    NothingOfARun {
        /// The path.
        path: PathBuf,
        /// Whether there are unfinished results beside it.
        has_partial: bool,
    },
}

/// What is missing in a run, or cannot be read; the page names it and shows the rest.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Gap {
    /// A file that every run of this version has.
    #[error("{file} is missing, so there is no {shows}")]
    Missing {
        /// The file.
        file: &'static str,
        /// What is made from it.
        shows: &'static str,
    },
    /// A file that the run has written and that is gone.
    #[error("{file} is missing, though summary.json has it among the files of the run")]
    Gone {
        /// The file.
        file: &'static str,
    },
    /// A file that cannot be read.
    #[error("{file} cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: &'static str,
        /// Why.
        source: io::Error,
    },
    /// A table without columns that every version has.
    #[error("{file}, line 1: the column {expected} is missing, so the table is left out")]
    NoColumn {
        /// The file.
        file: &'static str,
        /// The column.
        expected: String,
    },
    /// A row that is none.
    #[error("{file}, line {line}: {found}; this row and those after it are left out")]
    Row {
        /// The file.
        file: &'static str,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        found: String,
    },
    /// More rows than a page shows.
    #[error("{file} has more than {most} rows; those after them are left out")]
    TooMany {
        /// The file.
        file: &'static str,
        /// How many are shown.
        most: usize,
    },
    /// More loads than a page shows.
    #[error("{file} has more than {most} rows; those with the smallest loads are left out")]
    TooManyLoads {
        /// The file.
        file: &'static str,
        /// How many are shown.
        most: usize,
    },
    /// A file in JSON that is cut off, or is something else.
    #[error("{file} is not what a run writes: {found}")]
    Json {
        /// The file.
        file: &'static str,
        /// What is wrong.
        found: String,
    },
    /// The scene cannot be read by this version.
    #[error("scene.toml cannot be read, so there is no picture: {found}")]
    Scene {
        /// What is wrong.
        found: String,
    },
    /// The scene and the table of the motion are of different runs.
    #[error("scene.toml has {scene} joints and states.csv has {table}; there is no picture")]
    OtherScene {
        /// In the scene.
        scene: usize,
        /// In the table.
        table: usize,
    },
    /// A run of another version.
    #[error(
        "the run was made by nboom {found}, this page by nboom {expected}; what one does not know of the other is left out"
    )]
    Version {
        /// That of the run.
        found: String,
        /// That of this program.
        expected: &'static str,
    },
}

impl From<RowsError> for Gap {
    fn from(error: RowsError) -> Self {
        match error {
            RowsError::Unreadable { file, source } => Self::Unreadable { file, source },
            RowsError::NoColumn { file, expected } => Self::NoColumn { file, expected },
            RowsError::Row { file, line, found } => Self::Row { file, line, found },
        }
    }
}
