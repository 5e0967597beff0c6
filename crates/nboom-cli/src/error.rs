mod exit_code;

use std::fmt::Display;
use std::io;
use std::path::PathBuf;

use nboom_io::{DeckObstacle, InputError, TooManyTimes};
use nboom_model::{Errors, ModelError, UnknownColumn};
#[cfg(feature = "generator")]
use nboom_package::PackageError;
use nboom_report::ReportError;
use nboom_results::{ResultsError, with_causes};
use nboom_sim::SimError;
use nboom_strength::StrengthError;
use nboom_tables::TablesError;
use nboom_verify::VerifyError;

use crate::{CaseError, Left, RecordError, SectionFileError, SweepError};

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CliError {
    /// The scene cannot be read, or is wrong.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Standard input is the scene, but no format is given.
    #[error("-: --format toml, nml or urdf expected, which says what standard input is")]
    NoFormat,
    /// A format is given, but the scene is a file.
    #[error(
        "--format {format}: found the file {}, expected - for standard input; a file's format is its \
         name's ending", path.display()
    )]
    VainFormat {
        /// The file.
        path: PathBuf,
        /// The format.
        format: &'static str,
    },
    /// The environment names an instruction set that there is not.
    #[error("NBOOM_INSTRUCTIONS: `{found}` found, portable, avx2 or avx512 expected")]
    Instructions {
        /// What it says.
        found: String,
    },
    /// The scene is wrong with the end time of the command line.
    #[error("--end-time: {0}")]
    EndTime(Errors<ModelError>),
    /// An option would have no effect, because of other options or of the scene.
    #[error("{option} has no effect, since {why}")]
    Idle {
        /// The option.
        option: String,
        /// Why.
        why: String,
    },
    /// With --end-time there are too many output times.
    #[error(transparent)]
    OutputTimes(#[from] TooManyTimes),
    /// No run can begin with these options.
    #[error(transparent)]
    Start(SimError),
    /// The motion cannot be computed, or its results cannot be written.
    #[error("{error}")]
    Simulation {
        /// What stopped it.
        #[source]
        error: SimError,
        /// The directory of the results up to then, if there are any.
        directory: Option<PathBuf>,
    },
    /// The run that a certificate needs for comparison cannot be finished.
    #[error("the reference run: {error}")]
    Certificate {
        /// What stopped it.
        #[source]
        error: SimError,
        /// Where the results of the run are.
        directory: PathBuf,
    },
    /// Signals cannot be waited for.
    #[error("cannot wait for signals")]
    Signals(#[source] std::io::Error),
    /// A command was interrupted and did not come to an end in time.
    #[error("interrupted {left}")]
    BrokenOff {
        /// The results that there are.
        left: Left,
    },
    /// The output of a conversion is neither a scene nor a deck by its name.
    #[error(
        "{}: found a name without a known ending, expected a scene NAME.toml or a deck NAME.nml",
        path.display()
    )]
    NoScene {
        /// The file.
        path: PathBuf,
    },
    /// A new scene would have a name by which it is taken for something else.
    #[cfg(feature = "generator")]
    #[error("{}: found a name with another ending, expected a scene NAME.toml", path.display())]
    NoToml {
        /// The file.
        path: PathBuf,
    },
    /// No deck can say the scene.
    #[error("a scene that no deck can say")]
    NoDeck(Vec<DeckObstacle>),
    /// A file that would be made is there already.
    #[cfg(feature = "generator")]
    #[error("{}: found a file of this name, expected none; -o names another one", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A picture would have the ending of another format.
    #[error("{}: found a name with another ending, expected a picture NAME.svg", path.display())]
    NoSvg {
        /// The file of the picture.
        path: PathBuf,
    },
    /// The scene is too large or too small to be drawn.
    #[error("{}: found places too far from or too near to each other, expected some that can be drawn", path.display())]
    NoPicture {
        /// The file of the picture.
        path: PathBuf,
    },
    /// Tables would be among results of a run that know nothing of them.
    #[error(
        "{}: found results of a run, expected a folder without; nboom run --tables writes tables among its \
         results",
        path.display()
    )]
    AmongResults {
        /// The folder.
        path: PathBuf,
    },
    /// A file that may be somebody else's, or may have been edited, would be replaced.
    #[error("{}: found a file of this name, expected none; --force replaces it", path.display())]
    WouldReplace {
        /// The file.
        path: PathBuf,
    },
    /// A command would overwrite what it reads.
    #[error("{}: found the input, expected another file for the output", path.display())]
    OutputIsInput {
        /// The file.
        path: PathBuf,
    },
    /// The results cannot be written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// A case of a study cannot be run.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A sweep is refused, or could not be finished.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// There is nothing to make a page of.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The output of a report is no page by its name.
    #[error("{}: found another ending, expected a page NAME.html", path.display())]
    NoPage {
        /// The file.
        path: PathBuf,
    },
    /// A page would take the place of a file that nboom has not made.
    #[error("{}: found a file that nboom has not made, expected a page of its own or no file; -o names another one", path.display())]
    OtherPage {
        /// The file.
        path: PathBuf,
    },
    /// Figures of a sweep are asked for.
    #[error("--plots: found the sweep {}, expected runs; the page of a sweep has figures", path.display())]
    PlotsOfSweep {
        /// The sweep.
        path: PathBuf,
    },
    /// A sweep would share a page.
    #[error(
        "{}: found a sweep, expected a run; sweeps cannot be compared, each has a page of its own", path.display()
    )]
    SweepBesideOthers {
        /// The sweep.
        path: PathBuf,
    },
    /// Runs that would share axes are in different units.
    #[error(
        "{}: found units {units}, expected {expected} as in {}; runs share axes", path.display(), first.display()
    )]
    OtherUnits {
        /// The run.
        path: PathBuf,
        /// Its units of length, time and force.
        units: String,
        /// The first run.
        first: PathBuf,
        /// Its units.
        expected: String,
    },
    /// Tables cannot be written for other programs.
    #[error(transparent)]
    Tables(#[from] TablesError),
    /// Two codes for accelerations differ too much.
    #[error("{code} deviates by {deviation:.1e} in state {state}, above the tolerance {tol:e}")]
    Deviation {
        /// The code that deviates most from the recursion.
        code: String,
        /// By how much.
        deviation: f64,
        /// In which state, from 1.
        state: usize,
        /// The largest deviation allowed.
        tol: f64,
    },
    /// There is nothing to compare, or the outcome cannot be written.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// A crate or a simulator is out of date, or cannot be made.
    #[cfg(feature = "generator")]
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A crate cannot be made, for what a line of the scene says.
    #[cfg(feature = "generator")]
    #[error("{file}:{line}: {error}")]
    PackageOfLine {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// Why.
        error: PackageError,
    },
    /// There is no folder to build in.
    #[cfg(feature = "generator")]
    #[error(
        "neither XDG_CACHE_HOME nor HOME found, one of them or --work, a folder to build in, expected"
    )]
    NoWork,
    /// Sections cannot be computed.
    #[error(transparent)]
    Sections(#[from] SectionFileError),
    /// Stresses cannot be computed.
    #[error(transparent)]
    Stresses(#[from] StrengthError),
    /// Output times of the command line are wrong.
    #[error("{place}: found {found}, expected {expected}")]
    Times {
        /// The option, or the file and its line.
        place: String,
        /// What is there.
        found: String,
        /// What would have been right.
        expected: String,
    },
    /// A name of the command line names no column.
    #[error("--columns: {unknown}{}", .meant.as_ref().map_or(String::new(), |meant| format!("; did you mean `{meant}`?")))]
    Column {
        /// What is there.
        unknown: UnknownColumn,
        /// The known name that is nearest, if one is near.
        meant: Option<String>,
    },
    /// A column is asked for that a free main body does not have.
    #[error("--columns: a reaction found, columns of a main body that moves freely expected")]
    NoReaction,
    /// A run cannot be repeated.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Standard output cannot be written.
    #[error("cannot write to standard output")]
    Stdout(#[source] io::Error),
}

impl CliError {
    /// An option that would have no effect.
    pub(crate) fn idle(option: impl Into<String>, why: impl Display) -> Self {
        Self::Idle { option: option.into(), why: why.to_string() }
    }

    /// Whether a run stopped by what it is, and not since it was interrupted or could not be written.
    pub(crate) fn is_of_the_run(&self) -> bool {
        let Self::Simulation { error, .. } = self else { return false };
        match error {
            SimError::Interrupted { .. } => false,
            SimError::Record { source, .. } => {
                let why = source.get_ref().and_then(|why| why.downcast_ref::<ResultsError>());
                why.is_some_and(ResultsError::is_of_numbers)
            }
            _ => true,
        }
    }

    /// The message for the user, a piece for each error.
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::Input(error @ InputError::Content(_)) => error.messages(),
            Self::NoDeck(obstacles) => obstacles.iter().map(ToString::to_string).collect(),
            Self::Sections(error @ SectionFileError::Sections(_)) => {
                error.to_string().lines().map(str::to_owned).collect()
            }
            Self::Simulation { directory: Some(directory), .. } => {
                let (why, kept) = (with_causes(self), directory.display());
                vec![format!("{why}; what was computed before is in {kept}, marked incomplete")]
            }
            Self::Certificate { directory, .. } => {
                let (why, kept) = (with_causes(self), directory.display());
                vec![format!("{why}; the run itself is complete, its results are in {kept}")]
            }
            _ => vec![with_causes(self)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neither_an_interrupt_nor_a_full_disk_is_of_the_run() {
        let of = |error| CliError::Simulation { error, directory: None }.is_of_the_run();
        assert!(of(SimError::StepsUsedUp { time: 1.0, steps: 9, by: "max_steps" }));
        assert!(!of(SimError::Interrupted { time: 1.0 }));
        let unkept = |source| of(SimError::Record { time: 1.0, source });
        let no_loads = ResultsError::from(StrengthError::NotFinite { time: 1.0 });
        assert!(unkept(io::Error::other(no_loads)));
        // A disk may fail in a way that has no name.
        let path = PathBuf::from("states.csv");
        let failed = ResultsError::Write { path, source: io::Error::other("by its controller") };
        assert!(!unkept(io::Error::other(failed)));
        assert!(!unkept(io::ErrorKind::StorageFull.into()));
        assert!(!CliError::Signals(io::ErrorKind::Other.into()).is_of_the_run());
    }
}
