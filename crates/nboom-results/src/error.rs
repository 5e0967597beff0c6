use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

use nboom_strength::StrengthError;

/// Why the files of a run could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// The directory cannot be made.
    #[error("cannot create the directory {}", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be made, written or replaced.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Stresses cannot be computed.
    #[error(transparent)]
    Stresses(#[from] StrengthError),
}

impl ResultsError {
    pub(crate) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }

    /// The same error for callers who know only of [`io::Error`]; its kind is kept.
    pub(crate) fn into_io(self) -> io::Error {
        let kind = match &self {
            Self::Directory { source, .. } | Self::Write { source, .. } => source.kind(),
            Self::Stresses(_) => io::ErrorKind::Other,
        };
        io::Error::new(kind, self)
    }
}

/// An error and its causes in one line, `what: why: why`.
///
/// A cause that the error already quotes is not said twice.
pub fn with_causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let why = error.to_string();
        if !text.contains(&why) {
            text = format!("{text}: {why}");
        }
        cause = error.source();
    }
    text
}
