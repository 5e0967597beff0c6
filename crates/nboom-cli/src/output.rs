//! Files that a command writes one at a time.

use std::fs;
use std::path::Path;

use nboom_results::write_file;

use crate::CliError;

/// Refuses an output that is also the command's input.
pub(crate) fn check(output: &Path, input: &Path) -> Result<(), CliError> {
    let found = |path: &Path| fs::canonicalize(path).ok();
    match found(output) {
        Some(path) if Some(&path) == found(input).as_ref() => {
            Err(CliError::OutputIsInput { path: output.to_owned() })
        }
        _ => Ok(()),
    }
}

/// Refuses the place of a file that is there, unless `force` replaces it: it may be somebody else's, or edited.
pub(crate) fn require_new(output: &Path, force: bool) -> Result<(), CliError> {
    match output.exists() && !force {
        true => Err(CliError::WouldReplace { path: output.to_owned() }),
        false => Ok(()),
    }
}

/// Writes a file, unless it is also the command's input.
pub(crate) fn write(output: &Path, input: &Path, text: &str) -> Result<(), CliError> {
    check(output, input)?;
    Ok(write_file(output, text)?)
}
