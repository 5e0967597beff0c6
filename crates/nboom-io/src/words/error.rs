use nboom_model::{DraftDefect, Errors, Finding, ModelError, StructureError};

use crate::diagnostic::quoted;

/// Something wrong with the words of a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WordsError {
    /// A key that must be given is not.
    #[error("{of}: {key}: found none, expected a value")]
    Missing {
        /// The table, with the name of the body.
        of: String,
        /// The key.
        key: &'static str,
    },
    /// A value that no scene has.
    #[error("{of}: {key}: found {found}, expected {expected}")]
    Value {
        /// The table, with the name of the body.
        of: String,
        /// The key.
        key: &'static str,
        /// What it says.
        found: String,
        /// What would have been right.
        expected: &'static str,
    },
    /// A name, a reference or a repetition of a body.
    #[error("{of}: {}", in_one_line(&told(.defect.finding())))]
    Draft {
        /// The body.
        of: String,
        /// What is wrong.
        defect: DraftDefect,
    },
    /// What is found when the scene is put together.
    #[error("{of}: {key}: {}", told(.error.finding()))]
    Model {
        /// The table, with the name of the body.
        of: String,
        /// The key.
        key: &'static str,
        /// What is wrong.
        error: ModelError,
    },
    /// Stations or pulse constants.
    #[error(transparent)]
    Structure(#[from] StructureError),
}

/// Everything wrong with the words of a scene, a line each.
pub type WordsErrors = Errors<WordsError>;

fn told(Finding { found, expected }: Finding) -> String {
    format!("found {found}, expected {expected}")
}

/// In one line whatever names it has.
fn in_one_line(text: &str) -> String {
    text.replace(char::is_control, "\u{fffd}")
}

/// The table of a body in messages.
pub(super) fn of_body(name: &str) -> String {
    format!("body {}", quoted(name))
}

/// That of a rotor in messages; `number` counts from 0.
pub(super) fn of_rotor(owner: &str, number: usize) -> String {
    format!("{owner}, rotor {}", number + 1)
}
