use std::io;
use std::path::{Path, PathBuf};

use nboom_codegen::{CodegenError, Standing};
use nboom_formulation::Formulation;
use nboom_scalar::ForeignError;
use nboom_verify::VerifyError;

/// Why a package was not written, is not what it should be, or was not built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackageError {
    /// There is no code for the scene.
    #[error(transparent)]
    Codegen(#[from] CodegenError),
    /// The code cannot be compared with the recursion.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// A routine for states with held hinges accepts none of them.
    #[error(
        "topology {topology} of states with held hinges: none of {tries} found that has the numbers which its \
         routine assumes, at least one expected"
    )]
    NotAccepted {
        /// The topology.
        topology: String,
        /// At how many sets of angles hinges were held.
        tries: usize,
    },
    /// The code is not what the recursion computes.
    #[error(
        "topology {topology}, formulation {formulation}: {quantity} deviate by {deviation:.1e}, at \
         most {tolerance:e} expected"
    )]
    Deviation {
        /// The scene's topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
        /// What deviates.
        quantity: &'static str,
        /// By how much.
        deviation: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// A file is not as it was written, or was not written here.
    #[error("{} {}; move or delete it to have it written", path.display(), not_ours(*.standing))]
    NotOurs {
        /// The file.
        path: PathBuf,
        /// `Edited` or `Foreign`.
        standing: Standing,
    },
    /// A crate is not what would be written now.
    #[error("{} {}", path.display(), outdated(*.standing))]
    Outdated {
        /// The first file that is not.
        path: PathBuf,
        /// How it stands; `None` when it is missing.
        standing: Option<Standing>,
    },
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// There is no folder to build in.
    #[error(
        "neither XDG_CACHE_HOME nor HOME found, one of them or `work`, a folder to build in, expected"
    )]
    NoFolder,
    /// Cargo cannot be started.
    #[error("cannot start {}, which builds generated code; it comes with Rust", program.display())]
    NoCargo {
        /// What was called.
        program: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Cargo has not built the package.
    #[error("cargo has failed in {}; its last lines:\n{last_lines}", directory.display())]
    Cargo {
        /// Where it ran.
        directory: PathBuf,
        /// What it said.
        last_lines: String,
    },
    /// A file is no library that can be loaded here.
    #[error("{} is no library that can be loaded", path.display())]
    NoLibrary {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: libloading::Error,
    },
    /// A library has no routines.
    #[error("{} is a library, but not one of routines", path.display())]
    NoRoutines {
        /// The library.
        path: PathBuf,
        /// What the system says.
        source: libloading::Error,
    },
    /// A library has routines in another layout than this program reads.
    #[error("{} was built by another version of nboom", path.display())]
    OtherVersion {
        /// The library.
        path: PathBuf,
        /// The versions.
        source: ForeignError,
    },
}

impl PackageError {
    pub(crate) fn reading(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Read { path, source }
    }

    pub(crate) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Write { path, source }
    }
}

fn not_ours(standing: Standing) -> &'static str {
    match standing {
        Standing::Edited => "was changed since it was written",
        _ => "was not written by this command",
    }
}

fn outdated(standing: Option<Standing>) -> &'static str {
    match standing {
        None => "is missing",
        Some(Standing::Stale) => "is out of date",
        Some(standing) => not_ours(standing),
    }
}
