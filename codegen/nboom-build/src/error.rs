use std::error::Error;
use std::fmt;
use std::path::PathBuf;

use nboom_codegen::{CodegenError, Standing};
use nboom_io::InputError;
use nboom_model::TopologyError;

/// Why a build script has no routines.
///
/// `Debug` gives the message with all its causes: it is what a `main` that returns an error prints,
/// and so what cargo shows to whoever builds the program.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The name of a topology is not one.
    #[error("routine `{name}`")]
    Topology {
        /// The routine.
        name: String,
        /// What is wrong with the topology.
        source: TopologyError,
    },
    /// A file is not a scene.
    #[error(transparent)]
    Scene(#[from] InputError),
    /// Nothing can be generated.
    #[error(transparent)]
    Codegen(#[from] CodegenError),
    /// Two routines of a file would be types of one name.
    #[error("two routines are named `{name}`; they need files of their own, each in a module")]
    Twice {
        /// The name.
        name: String,
    },
    /// There is no directory for what a build script writes.
    #[error("OUT_DIR is not set, the environment that cargo gives to build scripts expected")]
    NoOutDir,
    /// What is overwritten unasked is no file of anybody else.
    #[error(
        "file `{file}` found, one in OUT_DIR expected, without `..` and not from the root; `write_to` writes elsewhere"
    )]
    NotInOutDir {
        /// The file.
        file: String,
    },
    /// A file cannot be read or written.
    #[error("{}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A file is not what would be generated.
    #[error("{}: {}", path.display(), explained(*.standing, build))]
    NotCurrent {
        /// The file.
        path: PathBuf,
        /// What it is instead; `None` where there is no file.
        standing: Option<Standing>,
        /// The build that writes it.
        build: &'static str,
    },
}

/// What is wrong, and what to do about it.
fn explained(standing: Option<Standing>, build: &str) -> String {
    match standing {
        None => format!("there is no such file; {build} writes it"),
        // Only files that are not current are explained.
        Some(Standing::Current | Standing::Stale) => format!(
            "generated from another scene or request, or by another version of the generator; \
             {build} writes it anew"
        ),
        Some(Standing::Edited) => format!(
            "changed by hand since it was generated; move what was added elsewhere and remove the \
             file, then {build} writes it anew"
        ),
        Some(Standing::Foreign) => {
            "not a generated file, so it is not overwritten; give another path or remove the file"
                .to_owned()
        }
    }
}

impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut causes = std::iter::successors(self.source(), |cause| (*cause).source());
        write!(f, "{self}")?;
        causes.try_for_each(|cause| write!(f, ": {cause}"))
    }
}
