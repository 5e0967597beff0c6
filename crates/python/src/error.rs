//! Errors and warnings as those of `nboom.errors`, with the messages of the command.

use nboom_cli::{CliError, hear};
use nboom_io::InputError;
use nboom_study::StudyError;
use pyo3::prelude::*;
use pyo3::types::PyType;

/// The exception of a class of `nboom.errors`.
fn exception(class: &str, message: String) -> PyErr {
    Python::attach(|py| {
        let found = py.import("nboom.errors").and_then(|errors| errors.getattr(class));
        match found.and_then(|class| Ok(class.cast_into::<PyType>()?)) {
            Ok(class) => PyErr::from_type(class, message),
            Err(error) => error,
        }
    })
}

/// What a warning is about.
#[derive(Clone, Copy)]
pub(crate) enum About {
    /// A scene, which is probably wrong.
    Scene,
    /// Results, which are not to be trusted.
    Results,
}

/// Warns of each line that is not `known` yet.
///
/// # Errors
/// Where warnings are errors.
pub(crate) fn warn(
    py: Python<'_>,
    about: About,
    lines: impl IntoIterator<Item = String>,
    known: &[String],
) -> PyResult<()> {
    let errors = py.import("nboom.errors")?;
    let category = errors.getattr(match about {
        About::Scene => "SceneWarning",
        About::Results => "TrustWarning",
    })?;
    for line in lines.into_iter().filter(|line| !known.contains(line)) {
        errors.call_method1("warn", (line, &category))?;
    }
    Ok(())
}

/// Does work without Python's lock, and [warns](warn) of what the command would write to standard error.
///
/// # Errors
/// Where warnings are errors.
pub(crate) fn warned<T: Send>(
    py: Python<'_>,
    about: About,
    known: &[String],
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let (done, said) = py.detach(|| hear(work));
    warn(py, about, said, known)?;
    Ok(done)
}

/// A scene, a study or an option is wrong.
pub(crate) fn wrong_input(message: String) -> PyErr {
    exception("InputError", message)
}

/// What a command failed with.
pub(crate) fn raised(error: &CliError) -> PyErr {
    let class = match error.exit_code() {
        1 => "ComparisonFailed",
        2 => "InputError",
        _ => "SimulationError",
    };
    exception(class, error.lines().join("\n"))
}

/// What is wrong in a scene or a study.
pub(crate) fn of_input(error: InputError) -> PyErr {
    raised(&CliError::Input(error))
}

/// Why a sweep has no results.
pub(crate) fn of_study(error: StudyError) -> PyErr {
    raised(&CliError::Sweep(error.into()))
}
