use std::io;
use std::path::PathBuf;

use nboom_io::InputError;
use nboom_model::{HingeLabel, ModelError};
use nboom_results::{ResultsError, with_causes};
use nboom_sim::SimError;

use crate::PathChoice;

/// Why a command did not do what it was asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CliError {
    /// The scene cannot be read, or is wrong.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The scene is wrong with the end time of the command line.
    #[error("--end-time: {}", .0.iter().map(ModelError::to_string).collect::<Vec<_>>().join("; "))]
    EndTime(Vec<ModelError>),
    /// The path has no code for the formulation.
    #[error(
        "--formulation {formulation} --path {path:?}: articulated is generated code and \
         recursive is library code in this build"
    )]
    PathOfFormulation {
        /// The path asked for.
        path: PathChoice,
        /// The formulation asked for.
        formulation: &'static str,
    },
    /// The motion cannot be computed, or its results not be kept.
    #[error("{error}")]
    Simulation {
        /// What stopped it.
        #[source]
        error: SimError,
        /// Where the results up to then are.
        directory: PathBuf,
    },
    /// The results cannot be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Two ways to the same accelerations differ too much.
    #[error("{code} deviates by {deviation:.1e} in state {state}, above the tolerance {tol:e}")]
    Deviation {
        /// What deviates most from the recursion.
        code: String,
        /// By how much.
        deviation: f64,
        /// In which state, from 1.
        state: usize,
        /// What is allowed.
        tol: f64,
    },
    /// A random state has no accelerations to compare.
    #[error("state {state} has no accelerations to compare: {}", no_reference(.hinge))]
    NoReference {
        /// The state, from 1.
        state: usize,
        /// The hinge about which nothing has inertia, where that is the reason.
        hinge: Option<HingeLabel>,
    },
    /// Standard output takes no more.
    #[error("cannot write to standard output")]
    Stdout(#[source] io::Error),
}

impl CliError {
    /// 1 when a comparison failed, 2 when the input or the command line is wrong, 3 when computing or writing failed.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Deviation { .. } => 1,
            Self::Input(_) | Self::EndTime(_) | Self::PathOfFormulation { .. } => 2,
            Self::Simulation { error: SimError::NoRoutine { .. }, .. } => 2,
            Self::Simulation { .. } | Self::NoReference { .. } => 3,
            Self::Results(_) | Self::Stdout(_) => 3,
        }
    }

    /// What to tell the user, a line for each thing that is wrong.
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::Input(error @ InputError::Deck(_)) => {
                error.to_string().lines().map(str::to_owned).collect()
            }
            Self::Simulation { directory, .. } => {
                let (why, kept) = (with_causes(self), directory.display());
                vec![format!("{why}; what was computed before is in {kept}, marked incomplete")]
            }
            _ => vec![with_causes(self)],
        }
    }
}

fn no_reference(hinge: &Option<HingeLabel>) -> String {
    match hinge {
        Some(hinge) => format!("nothing has inertia about hinge {hinge}"),
        None => "the mass matrix is singular or the forces are beyond all numbers".to_owned(),
    }
}
