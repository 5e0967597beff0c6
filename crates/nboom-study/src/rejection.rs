use nboom_io::{Diagnostic, InputError, TooManyTimes};
use nboom_model::{Errors, ModelError};
use nboom_strength::StrengthError;

use crate::fault::FaultError;

/// Why a case has no scene, in one line of the table of cases.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Rejection(String);

impl Rejection {
    /// Another number of hinged bodies than all cases have.
    pub(crate) fn of_count(found: usize, expected: usize) -> Self {
        Self(format!("found {found} hinged bodies, expected {expected} in all cases"))
    }
}

impl From<InputError> for Rejection {
    fn from(error: InputError) -> Self {
        match &error {
            InputError::Content(errors) if !errors.is_empty() => {
                let Diagnostic { file, line, symbol, found, expected, .. } = &errors[0];
                // A table is the same wherever its scene lies.
                let file = std::path::Path::new(file).file_name().unwrap_or_default().display();
                let text = format!("{file}:{line}: {symbol}: found {found}, expected {expected}");
                Self(in_one_line(&text))
            }
            other => Self(in_one_line(&other.to_string())),
        }
    }
}

impl From<Errors<ModelError>> for Rejection {
    fn from(errors: Errors<ModelError>) -> Self {
        Self(in_one_line(&errors.first().map_or_else(String::new, ToString::to_string)))
    }
}

impl From<FaultError> for Rejection {
    fn from(error: FaultError) -> Self {
        Self(error.to_string())
    }
}

impl From<TooManyTimes> for Rejection {
    fn from(error: TooManyTimes) -> Self {
        Self(error.to_string())
    }
}

impl From<StrengthError> for Rejection {
    fn from(error: StrengthError) -> Self {
        Self(in_one_line(&error.to_string()))
    }
}

pub(crate) fn in_one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}
