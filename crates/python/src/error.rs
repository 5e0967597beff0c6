//! Errors as exceptions of `nboom.errors`, with the messages of the command.

use nboom_cli::CliError;
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
