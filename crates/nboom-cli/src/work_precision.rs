//! Run time against error, as files and a table.

use std::fs;
use std::path::Path;

use nboom_model::Scene;
use nboom_results::ResultsError;
use nboom_verify::WorkPrecision;

use crate::{CliError, Routines};

/// Runs the scene in all ways, writes a table and a picture into `directory`, and returns the
/// account for standard output.
pub(crate) fn work_precision(
    scene: &Scene,
    routines: &Routines,
    seconds: f64,
    directory: &Path,
) -> Result<String, CliError> {
    let measured = WorkPrecision::measure(scene, routines.accelerations, seconds);
    let found = measured.map_err(|failure| CliError::Simulation {
        error: failure.error,
        directory: directory.to_owned(),
    })?;
    write(directory, "work-precision.csv", &found.csv())?;
    write(directory, "work-precision.svg", &found.picture())?;
    Ok(format!("{}files {}\n", found.table(), directory.display()))
}

fn write(directory: &Path, name: &str, text: &str) -> Result<(), CliError> {
    let path = directory.join(name);
    fs::create_dir_all(directory)
        .and_then(|()| fs::write(&path, text))
        .map_err(|source| CliError::Results(ResultsError::Write { path, source }))
}
