//! Tables for other programs.

use std::ffi::OsString;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use nboom_results::{HDF5_FILE, Kept, PARQUET_FILES, SUMMARY_FILE, make_file};
use nboom_tables::{Format, Run, TablesError};

use crate::{CliError, choice};

/// Options of `nboom tables`.
#[derive(Args, Debug)]
pub struct TablesArgs {
    /// A directory that nboom run has written.
    #[arg(value_name = "DIR")]
    pub directory: PathBuf,

    /// parquet, hdf5, or both with a comma between them.
    #[arg(long = "format", value_name = "FORMATS", value_delimiter = ',', required = true,
          value_parser = choice::table_format)]
    pub formats: Vec<Format>,

    /// Folder for the files, created if needed; by default DIR with -tables at its end.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,

    /// Replace files of these names if they are there.
    #[arg(long)]
    pub force: bool,
}

/// Writes the tables of a run, and returns the names of the files for standard output.
pub(crate) fn tables(args: &TablesArgs) -> Result<String, CliError> {
    args.formats.iter().try_for_each(|format| format.require())?;
    let run = Run::read(&args.directory)?;
    let folder = match &args.output {
        Some(folder) => folder.clone(),
        None => beside(&args.directory)?,
    };
    if folder.join(SUMMARY_FILE).exists() {
        return Err(CliError::AmongResults { path: folder });
    }
    let there = || names(&args.formats).map(|name| folder.join(name)).find(|path| path.exists());
    if let Some(path) = there().filter(|_| !args.force) {
        return Err(CliError::WouldReplace { path });
    }
    let mut names = String::new();
    for format in &args.formats {
        for output in run.outputs(*format)? {
            let path = folder.join(output.name);
            make_file(&path, |draft| output.write(draft).map_err(CliError::from))?;
            let _ = writeln!(names, "{}", path.display());
        }
    }
    Ok(names)
}

/// The folder for the tables of a directory.
fn beside(directory: &Path) -> Result<PathBuf, CliError> {
    let named = match directory.file_name() {
        Some(_) => directory.to_owned(),
        // `.` and `..` stand for directories that have names.
        None => fs::canonicalize(directory)
            .map_err(|source| TablesError::Read { path: directory.to_owned(), source })?,
    };
    let name = named.file_name().unwrap_or_default().to_owned();
    Ok(named.with_file_name([name, "-tables".into()].join(&OsString::new())))
}

/// Names of the files in these formats that a run may have.
pub(crate) fn names(formats: &[Format]) -> impl Iterator<Item = &'static str> {
    let all = Format::ALL.into_iter().filter(|format| formats.contains(format));
    all.flat_map(|format| match format {
        Format::Parquet => PARQUET_FILES.map(|(_, name)| name).to_vec(),
        Format::Hdf5 => vec![HDF5_FILE],
    })
}

/// Adds the tables in these formats to the results of a run, whether it is complete or not.
pub(crate) fn add(formats: &[Format], kept: &Kept) -> Result<(), CliError> {
    if formats.is_empty() {
        return Ok(());
    }
    let run = Run::read_so_far(&kept.directory)?;
    for format in formats {
        for output in run.outputs(*format)? {
            kept.add_made(output.name, |path| output.write(path).map_err(CliError::from))?;
        }
    }
    Ok(())
}
