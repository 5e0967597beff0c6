use std::path::Path;

use crate::StudyError;
use crate::frame::Columns;

/// A cell of a typical row as text, with its comma \[bytes\].
const CELL: u64 = 20;

/// About how long the rows of a case are that has a trajectory of so many rows \[bytes\].
pub(crate) fn of_case(columns: &Columns<'_>, samples: u64) -> u64 {
    let row = CELL.saturating_mul(columns.cases.len() as u64);
    let state = CELL.saturating_mul(columns.states.len() as u64);
    row.saturating_add(state.saturating_mul(samples))
}

/// # Errors
/// When the disk of a directory has less than this free; nothing is refused where the system does not say.
pub(crate) fn require(directory: &Path, bytes: u64, cases: u64) -> Result<(), StudyError> {
    match fs4::available_space(directory) {
        Ok(free) if free < bytes => Err(StudyError::Space {
            directory: directory.to_owned(),
            free: free / 1_000_000,
            needed: bytes.div_ceil(1_000_000),
            cases,
        }),
        _ => Ok(()),
    }
}
