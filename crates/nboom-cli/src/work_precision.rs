//! Run time against error: all code that computes accelerations, with all integrators, at all
//! tolerances.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;

use nboom_formulation::Formulation;
use nboom_model::Scene;
use nboom_results::ResultsError;
use nboom_scalar::Kernel;
use nboom_sim::{
    Form, Method, Options, Path as CodePath, Snapshot, Witness, differences, simulate,
};

use crate::picture::{Curve, picture};
use crate::{CliError, Routines};

/// 1e-3 to 1e-13; below that the reference is no better.
const TOLERANCES: std::ops::RangeInclusive<i32> = 3..=13;

/// A run is given up that takes more steps.
const MOST_STEPS: usize = 200_000;

/// Runs of each kind, of which the shortest time counts; fewer when they take long.
const RUNS: usize = 20;
const SECONDS: f64 = 0.3;

/// One run.
struct Row {
    path: &'static str,
    formulation: &'static str,
    integrator: Method,
    rtol: f64,
    /// The largest relative difference of any quantity at the end from the reference.
    error: f64,
    microseconds: f64,
    evaluations: usize,
}

/// Runs the scene in all ways, writes a table and a picture into `directory`, and returns the
/// account for standard output.
pub(crate) fn work_precision(
    scene: &Scene,
    routines: &Routines,
    directory: &Path,
) -> Result<String, CliError> {
    let truth = reference(scene, directory)?;
    let mut rows = Vec::new();
    for (path, formulation) in codes(routines.accelerations) {
        for integrator in Method::ALL {
            for exponent in TOLERANCES {
                let options = Options {
                    path,
                    formulation: Some(formulation),
                    integrator,
                    rtol: 10.0_f64.powi(-exponent),
                    atol: 10.0_f64.powi(-exponent - 2),
                    samples: 1,
                    max_steps: MOST_STEPS,
                    kernels: routines.accelerations,
                    ..Options::default()
                };
                match row(scene, &options, formulation, &truth) {
                    Some(row) => rows.push(row),
                    // What does not cover the scene, or crawls, does so at smaller tolerances too.
                    None => break,
                }
            }
        }
    }
    write(directory, "work-precision.csv", &csv(&rows))?;
    write(directory, "work-precision.svg", &picture(&scene.name, &curves(&rows)))?;
    Ok(table(scene, &rows, directory))
}

/// Library code of each formulation, and generated code of those that there is some of.
fn codes(kernels: &[Kernel]) -> Vec<(CodePath, Form)> {
    let generated = |form: &Formulation| kernels.iter().any(|k| k.formulation == form.name());
    let all = Formulation::ALL.into_iter();
    let library = all.clone().map(|form| (CodePath::Generic, Form::Closed(form)));
    let generated = all.filter(generated).map(|form| (CodePath::Generated, Form::Closed(form)));
    let recursion = [(CodePath::Generic, Form::Recursive)];
    recursion.into_iter().chain(library).chain(generated).collect()
}

/// The end of a run by the recursion that is as good as `f64` allows.
fn reference(scene: &Scene, directory: &Path) -> Result<Snapshot, CliError> {
    let options = Options {
        path: CodePath::Generic,
        rtol: 1e-14,
        atol: 1e-16,
        samples: 1,
        ..Options::default()
    };
    let mut witness = Witness::new();
    simulate(scene, &options, &mut witness).map_err(|failure| CliError::Simulation {
        error: failure.error,
        directory: directory.to_owned(),
    })?;
    Ok(witness.end().expect("a run ends with an event").clone())
}

/// `None` where the run does not come to its end.
fn row(scene: &Scene, options: &Options, form: Form, truth: &Snapshot) -> Option<Row> {
    let mut shortest = f64::INFINITY;
    let mut spent = 0.0;
    let mut found = None;
    for _ in 0..RUNS {
        let mut witness = Witness::new();
        let started = Instant::now();
        let summary = simulate(scene, options, &mut witness).ok()?;
        let seconds = started.elapsed().as_secs_f64();
        shortest = shortest.min(seconds);
        spent += seconds;
        found = Some((summary.evaluations, witness));
        if spent > SECONDS {
            break;
        }
    }
    let (evaluations, witness) = found?;
    let off = differences(witness.end()?, truth);
    let error = off.iter().map(|digits| digits.difference).fold(0.0, f64::max);
    let path = if options.path == CodePath::Generic { "generic" } else { "generated" };
    Some(Row {
        path,
        formulation: form.name(),
        integrator: options.integrator,
        rtol: options.rtol,
        error,
        microseconds: shortest * 1e6,
        evaluations,
    })
}

fn csv(rows: &[Row]) -> String {
    let mut text = "path,formulation,integrator,rtol,error,microseconds,evaluations\n".to_owned();
    for row in rows {
        let Row { path, formulation, integrator, rtol, error, microseconds, evaluations } = row;
        writeln!(
            text,
            "{path},{formulation},{integrator},{rtol:e},{error:e},{microseconds:.1},{evaluations}"
        )
        .expect("a string takes any text");
    }
    text
}

/// A curve for each code and integrator.
fn curves(rows: &[Row]) -> Vec<Curve> {
    let same = |a: &Row, b: &Row| {
        (a.path, a.formulation, a.integrator) == (b.path, b.formulation, b.integrator)
    };
    let curve = |rows: &[Row]| Curve {
        name: format!("{} {} {}", rows[0].path, rows[0].formulation, rows[0].integrator),
        points: rows.iter().map(|row| (row.error, row.microseconds)).collect(),
    };
    rows.chunk_by(same).map(curve).collect()
}

/// The shortest time of each code and integrator that is as accurate as each decade.
fn table(scene: &Scene, rows: &[Row], directory: &Path) -> String {
    let mut text = format!(
        "{}: microseconds of a run, by its relative error at the end\n{:<36}",
        scene.name, "code and integrator"
    );
    let decades = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
    let mut cell = |cell: String| text.push_str(&cell);
    decades.iter().for_each(|decade| cell(format!(" {decade:>9e}")));
    for Curve { name, points } in curves(rows) {
        cell(format!("\n{name:<36}"));
        for decade in decades {
            let within = points.iter().filter(|(error, _)| *error <= decade);
            let shortest = within.map(|(_, time)| *time).fold(f64::INFINITY, f64::min);
            cell(if shortest.is_finite() {
                format!(" {shortest:>9.0}")
            } else {
                format!(" {:>9}", "-")
            });
        }
    }
    cell(format!("\nfiles {}\n", directory.display()));
    text
}

fn write(directory: &Path, name: &str, text: &str) -> Result<(), CliError> {
    let path = directory.join(name);
    fs::create_dir_all(directory)
        .and_then(|()| fs::write(&path, text))
        .map_err(|source| CliError::Results(ResultsError::Write { path, source }))
}
