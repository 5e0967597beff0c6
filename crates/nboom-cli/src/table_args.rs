//! What the command line says about tables: output times, columns, degrees, units.

use std::path::{Path, PathBuf};

use clap::Args;
use nboom_io::{SceneSettings, nearest, read_text};
use nboom_model::{Column, Scene, UnitSystem, WantedTable};
use nboom_results::{Headings, WantedOutput};
use nboom_sim::OutputTimes;
use nboom_tables::Format;

use crate::choice::{self, ChoiceError};
use crate::{CliError, RunArgs};

/// Options of `nboom run` that concern tables.
#[derive(Args, Clone, Debug)]
pub struct TableArgs {
    /// Output times, ascending: numbers with commas between them, or a file of numbers. The initial time
    /// and the end are always output times.
    #[arg(long, value_name = "TIMES", value_parser = times, conflicts_with = "samples",
          allow_hyphen_values = true)]
    pub times: Option<Times>,

    /// Columns of output.csv, a table of its own beside states.csv, with commas between them: omega,
    /// "beta of boom" or omega_x; instead of those that the scene asks for. By default all. A name that has
    /// commas itself stands alone: the option may be given several times.
    #[arg(long, value_name = "NAMES")]
    pub columns: Vec<String>,

    /// Write output.csv, with angles and rates in degrees; in all other tables they are in radians.
    #[arg(long)]
    pub degrees: bool,

    /// Write units behind the names in the headers of all tables, as `t [s]`; datapackage.json always has
    /// them.
    #[arg(long)]
    pub units_in_headers: bool,

    /// Also write all tables for other programs: parquet, hdf5 or both with a comma between them; programs of
    /// nboom compile have neither.
    #[arg(id = "tables", long, value_name = "FORMATS", value_delimiter = ',', value_parser = choice::table_format)]
    pub formats: Vec<Format>,
}

/// Output times on a command line.
#[derive(Clone, Debug, PartialEq)]
pub enum Times {
    /// These.
    List(Vec<f64>),
    /// Those in a file.
    File(PathBuf),
}

/// The longest file of output times that is read \[bytes\].
const LONGEST: u64 = 16 << 20;

/// What begins a remark in a file of output times.
const REMARK: char = '#';

fn times(text: &str) -> Result<Times, ChoiceError> {
    // No file has this name, so none is told.
    if text.trim().is_empty() {
        return Err(ChoiceError::NotANumber);
    }
    if !text.contains(',') && choice::finite(text) == Err(ChoiceError::NotANumber) {
        return Ok(Times::File(text.into()));
    }
    text.split(',')
        .map(|piece| choice::finite(piece.trim()))
        .collect::<Result<_, _>>()
        .map(Times::List)
}

impl Times {
    /// The times, in order, of a run over a span.
    fn read(&self, [start, end]: [f64; 2]) -> Result<Vec<f64>, CliError> {
        let (place, times) = match self {
            Self::List(times) => ("--times".to_owned(), times.clone()),
            Self::File(path) => (path.display().to_string(), of_file(path)?),
        };
        let outside = times.iter().find(|time| !(start..=end).contains(*time));
        let outside = outside.map(|time| {
            (time.to_string(), format!("a time from {start}, the start, to {end}, the end"))
        });
        let falls = times.windows(2).find(|pair| pair[1] <= pair[0]);
        let falls = falls
            .map(|pair| (format!("{} after {}", pair[1], pair[0]), "ascending times".to_owned()));
        let none = times.is_empty().then(|| ("no number".to_owned(), "output times".to_owned()));
        match outside.or(falls).or(none) {
            Some((found, expected)) => Err(CliError::Times { place, found, expected }),
            None => Ok(times),
        }
    }
}

/// The numbers of a file, with commas, blanks or ends of lines between them.
fn of_file(path: &Path) -> Result<Vec<f64>, CliError> {
    let text = read_text(path, LONGEST)?;
    let mut times = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let numbers = line.split(REMARK).next().unwrap_or_default();
        let pieces = numbers.split([',', ' ', '\t']).filter(|piece| !piece.is_empty());
        for piece in pieces {
            times.push(choice::finite(piece).map_err(|_| CliError::Times {
                place: format!("{}:{number}", path.display()),
                found: format!("`{}`", piece.chars().take(30).collect::<String>()),
                expected: "a finite number".to_owned(),
            })?);
        }
    }
    Ok(times)
}

/// What a scene and the command line ask a run to write. `times` are those of the command line.
pub(crate) fn output(
    args: &RunArgs,
    settings: &SceneSettings,
    scene: &Scene,
    units: &UnitSystem,
    times: Option<&[f64]>,
) -> Result<WantedOutput, CliError> {
    let times = match times {
        Some(times) => Some(OutputTimes::at(times.iter().copied())),
        None => {
            let sampling = settings.sampling_of_run(args.samples);
            sampling.map_or(Ok(None), |of| of.times(span(scene)))?.map(OutputTimes::at)
        }
    };
    let with_units = args.tables.units_in_headers;
    let headings = with_units.then(|| Headings::with_units(units.clone()));
    Ok(WantedOutput {
        times,
        table: args.tables.wanted(settings.table.as_ref(), scene)?,
        listing: args.listing || settings.listing,
        headings: headings.unwrap_or_default(),
    })
}

fn span(scene: &Scene) -> [f64; 2] {
    [scene.initial.time, scene.end_time]
}

impl TableArgs {
    /// The output times that are given, in order.
    pub(crate) fn times(&self, scene: &Scene) -> Result<Option<Vec<f64>>, CliError> {
        self.times.as_ref().map(|times| times.read(span(scene))).transpose()
    }

    /// The table that is asked for; what the command line leaves open is as the scene says.
    fn wanted(
        &self,
        of_scene: Option<&WantedTable>,
        scene: &Scene,
    ) -> Result<Option<WantedTable>, CliError> {
        if self.columns.is_empty() && !self.degrees {
            return Ok(of_scene.cloned());
        }
        let in_degrees = self.degrees || of_scene.is_some_and(|table| table.in_degrees);
        let mut table = WantedTable { columns: Vec::new(), in_degrees };
        if self.columns.is_empty() {
            let all = || Column::all(scene.bodies.len());
            table.columns = of_scene.map_or_else(all, |of_scene| of_scene.columns.clone());
        }
        let named = |name: &str| Column::named(name, scene.labels(), scene.rotors.len());
        for names in &self.columns {
            if let Ok(column) = named(names) {
                table.add(column);
                continue;
            }
            for name in names.split(',') {
                let column = named(name).or_else(|_| named(name.trim()));
                table.add(column.map_err(|unknown| {
                    let known = unknown.known.iter().map(String::as_str);
                    let meant = nearest(&unknown.found, known).map(str::to_owned);
                    CliError::Column { unknown, meant }
                })?);
            }
        }
        if table.is_of_held_body() && !scene.base.is_held() {
            return Err(CliError::NoReaction);
        }
        Ok(Some(table))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_a_list_or_a_file() {
        assert_eq!(times("0, 0.5,2e0"), Ok(Times::List(vec![0.0, 0.5, 2.0])));
        assert_eq!(times("-3"), Ok(Times::List(vec![-3.0])));
        assert_eq!(times("times.txt"), Ok(Times::File("times.txt".into())));
        for (text, error) in [
            ("0,,1", ChoiceError::NotANumber),
            ("0,x", ChoiceError::NotANumber),
            ("inf", ChoiceError::NotFinite),
            ("0,nan", ChoiceError::NotFinite),
        ] {
            assert_eq!(times(text), Err(error), "{text}");
        }
    }

    #[test]
    fn files_of_times_have_remarks_and_errors_have_lines() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("times");
        let read = |text: &str| {
            std::fs::write(&path, text).expect("writable");
            Times::File(path.clone()).read([0.0, 10.0]).map_err(|error| error.to_string())
        };
        assert_eq!(
            read("# from the test\n0.5, 1\t2\r\n\n3 # the last\n"),
            Ok(vec![0.5, 1.0, 2.0, 3.0])
        );
        for (text, told) in [
            ("1\n2 two\n", "times:2: found `two`, expected a finite number"),
            ("1 inf", "times:1: found `inf`, expected a finite number"),
            ("1 11", "times: found 11, expected a time from 0, the start, to 10, the end"),
            ("2 2", "times: found 2 after 2, expected ascending times"),
            ("# none", "times: found no number, expected output times"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.ends_with(told), "{told}: {error}");
        }
    }
}
