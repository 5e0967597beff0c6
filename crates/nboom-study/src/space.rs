//! Room on the disk and in memory.

use std::fs;
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

/// About how much memory so many threads take that run so many cases with trajectories of so many rows \[bytes\].
///
/// Each thread holds the numbers of a case and has its text; as many texts wait for the one that writes the journal,
/// which has another. Cases that are shorter than a batch need no more than a few tenths of a second of numbers.
fn in_memory(columns: &Columns<'_>, samples: u64, cases: u64, jobs: u64) -> u64 {
    let numbers = (columns.states.len() as u64).saturating_mul(8).saturating_mul(samples);
    let texts = jobs.saturating_mul(2).saturating_add(1).min(cases);
    let texts = of_case(columns, samples).saturating_mul(texts);
    numbers.saturating_mul(jobs.min(cases)).saturating_add(texts)
}

/// # Errors
/// When less memory is free than so many threads take that run so many cases with trajectories of so many rows; nothing
/// is refused where the system does not say.
pub(crate) fn require_memory(
    columns: &Columns<'_>,
    samples: u64,
    cases: u64,
    jobs: u64,
) -> Result<(), StudyError> {
    let needed = in_memory(columns, samples, cases, jobs);
    match free_memory() {
        Some(free) if free < needed => Err(StudyError::Memory {
            free: free / 1_000_000,
            needed: needed.div_ceil(1_000_000),
            rows: samples,
            jobs,
        }),
        _ => Ok(()),
    }
}

/// Memory that is free, where Linux says it \[bytes\].
fn free_memory() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let found = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = found.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kilobytes.checked_mul(1024)
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
