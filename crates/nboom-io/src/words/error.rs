use nboom_model::{DraftDefect, Errors, ModelError, StructureError};

use crate::deck::phrases;
use crate::diagnostic::quoted;
use crate::responsible::found_and_expected;

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
    #[error("{of}: found {}, expected {}", told(.defect).0, told(.defect).1)]
    Draft {
        /// The body.
        of: String,
        /// What is wrong.
        defect: DraftDefect,
    },
    /// What is found when the scene is put together.
    #[error("{of}: {key}: found {}, expected {}", found_and_expected(.error).0, found_and_expected(.error).1)]
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

/// What was found and what expected, in one line whatever names it has.
fn told(defect: &DraftDefect) -> (String, String) {
    phrases(&defect.to_string().replace(char::is_control, "\u{fffd}"))
}

/// The table of a body in messages.
pub(super) fn of_body(name: &str) -> String {
    format!("body {}", quoted(name))
}

/// That of a rotor in messages; `number` counts from 0.
pub(super) fn of_rotor(owner: &str, number: usize) -> String {
    format!("{owner}, rotor {}", number + 1)
}
