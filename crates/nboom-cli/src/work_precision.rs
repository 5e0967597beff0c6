//! Run time against error, as files and a table.

use std::path::Path;

use nboom_model::Scene;
use nboom_results::write_file;
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
    let measured =
        WorkPrecision::measure(scene, (routines.for_runs, routines.right_sides_of_eight), seconds);
    let failed = |error| CliError::Simulation { error, directory: None };
    let found = measured.map_err(|failure| failed(failure.error))?;
    write_file(&directory.join("work-precision.csv"), &found.csv())?;
    write_file(&directory.join("work-precision.svg"), &found.picture())?;
    Ok(format!("{}files {}\n", found.table(), directory.display()))
}
