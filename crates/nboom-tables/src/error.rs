use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

use crate::{Format, RowsError};

/// Why tables could not be written in another format.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TablesError {
    /// The program is built without this format.
    #[error(
        "{name}: found a program without this format, expected nboom itself, with the feature {name}; its \
         `nboom tables` makes it of a run in CSV",
        name = .0.name()
    )]
    NotBuilt(Format),
    /// What should be the directory of a run lacks a file that each complete run has.
    #[error(
        "{}: no {file} found, the directory of a complete run of this version expected",
        directory.display()
    )]
    NoRun {
        /// The directory.
        directory: PathBuf,
        /// The file.
        file: &'static str,
    },
    /// The run was not finished.
    #[error(
        "{}: a run that is not complete found, a complete one expected; what it computed is in its \
         tables in CSV",
        directory.display()
    )]
    Incomplete {
        /// The directory.
        directory: PathBuf,
    },
    /// The summary or the description of the columns is not what a run writes.
    #[error("{}: {found} found, a file that nboom run has written expected", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        found: String,
    },
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A table is not what a run writes.
    #[error("{}: {source}", directory.display())]
    Rows {
        /// The directory.
        directory: PathBuf,
        /// What is wrong, and where.
        source: RowsError,
    },
    /// A table of any columns is not what was written.
    #[error("{}: {found} found, the table of its description expected", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        found: String,
    },
    /// A row that is not of its table.
    #[error(
        "{}, row {row}{}: {found}",
        path.display(),
        column.iter().map(|name| format!(", column {name}")).collect::<String>()
    )]
    Cell {
        /// The file.
        path: PathBuf,
        /// Which row, from 1, without the header.
        row: usize,
        /// Which column; none if there are too many or too few.
        column: Option<String>,
        /// What is wrong.
        found: String,
    },
    /// A file cannot be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: Box<dyn Error + Send + Sync>,
    },
}

impl TablesError {
    /// Whether the input or the command line is wrong, rather than the writing.
    pub fn is_of_input(&self) -> bool {
        !matches!(self, Self::Write { .. } | Self::Read { .. })
    }

    pub(crate) fn reading(path: &Path) -> impl Fn(io::Error) -> Self + use<'_> {
        move |source| Self::Read { path: path.to_owned(), source }
    }

    pub(crate) fn writing<E: Into<Box<dyn Error + Send + Sync>>>(
        path: &Path,
    ) -> impl Fn(E) -> Self + use<'_, E> {
        move |source| Self::Write { path: path.to_owned(), source: source.into() }
    }
}
