use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

use nboom_strength::StrengthError;

use crate::kind::Kind;
use crate::lock::Holder;
use crate::number::NotFinite;

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
    /// Results are being written into a directory.
    #[error("{work} into {} is going on, by {}", directory.display(), holder.told())]
    InUse {
        /// What writes them, in words.
        work: &'static str,
        /// The directory for its results.
        directory: PathBuf,
        /// Who holds it.
        holder: Holder,
    },
    /// Something that was not written by a run has the name of a file of a run.
    #[error(
        "{}: found {found} that no run has written, expected a file of a run or nothing; move or \
         delete it, or name another directory",
        path.display()
    )]
    Foreign {
        /// The path.
        path: PathBuf,
        /// What is there.
        found: Kind,
    },
    /// Results cannot go into something that is not a directory.
    #[error("{}: found {found}, expected a directory or nothing", path.display())]
    NotADirectory {
        /// The path.
        path: PathBuf,
        /// What is there.
        found: Kind,
    },
    /// `.partial` cannot be added to the name of a directory for results, or is there already.
    #[error(
        "{}: found a directory that results cannot go into, expected one that has a name, which does not end in \
         .partial, as that of unfinished results does",
        path.display()
    )]
    Name {
        /// The path.
        path: PathBuf,
    },
    /// A directory for results is the root of a volume, so nothing beside it can be moved in.
    #[error(
        "{}: found a volume of its own, expected a directory of one; name one within it",
        path.display()
    )]
    Mounted {
        /// The path.
        path: PathBuf,
    },
    /// Results that were written cannot be put into their place.
    #[error(
        "cannot move results to {}, so that they are in {}; the next run into this directory tries \
         again",
        to.display(), from.display()
    )]
    Misplaced {
        /// Where they are.
        from: PathBuf,
        /// Where they should be.
        to: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Stresses cannot be computed.
    #[error(transparent)]
    Stresses(#[from] StrengthError),
}

impl ResultsError {
    /// Whether the place for the results was refused before anything was written.
    pub fn is_refusal(&self) -> bool {
        use ResultsError::{Foreign, InUse, Mounted, Name, NotADirectory};
        matches!(
            self,
            InUse { .. } | Foreign { .. } | NotADirectory { .. } | Name { .. } | Mounted { .. }
        )
    }

    /// Whether numbers that are none keep results from being written, and not the place for them.
    pub fn is_of_numbers(&self) -> bool {
        match self {
            Self::Stresses(_) => true,
            Self::Write { source, .. } => source.get_ref().is_some_and(|why| why.is::<NotFinite>()),
            _ => false,
        }
    }

    pub(crate) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }

    /// This error as an [`io::Error`] of the same kind.
    pub(crate) fn into_io(self) -> io::Error {
        let kind = match &self {
            Self::Directory { source, .. } | Self::Write { source, .. } => source.kind(),
            Self::Misplaced { source, .. } => source.kind(),
            _ => io::ErrorKind::Other,
        };
        io::Error::new(kind, self)
    }
}

/// An error and its causes in one line, `what: why: why`.
///
/// A cause that the error already quotes is not repeated.
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
