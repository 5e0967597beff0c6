use std::fmt::Write;
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use nboom_formulation::{Recognised, assumptions_in_a_word, symmetric};
use nboom_scalar::{Batch, Eight};
use nboom_verify::{ComparedCode, Label, TestCase};

#[cfg(feature = "generator")]
use crate::compile::with_compiled;
use crate::format::{code_columns, code_head, not_covered, routine_topology};
use crate::run::default_directory;
use crate::work_precision::work_precision;
use crate::{CliError, Routines, SceneArgs, check, choice};

/// Options of `nboom bench`.
#[derive(Args, Debug)]
pub struct BenchArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// Print an array of objects in JSON instead of a table.
    #[arg(long, conflicts_with = "harness")]
    pub json: bool,

    /// Print a line of words and numbers for each code instead of a table.
    #[arg(long)]
    pub harness: bool,

    /// Also time code with the scene's numbers built in, which is compiled first and kept. Needs cargo.
    #[cfg(feature = "generator")]
    #[arg(long)]
    pub compiled: bool,

    /// Instead, time whole runs against their error: every code that covers the scene with every
    /// integrator at relative tolerances from 1e-3 to 1e-14. Runs are of a prepared simulator; the table
    /// tells the time of preparing it by itself. Writes work-precision.csv and .svg.
    #[arg(long, conflicts_with_all = ["json", "harness"])]
    pub work_precision: bool,

    /// Directory for these files; by default out/ and the scene's name.
    #[arg(short, long, value_name = "DIR", requires = "work_precision")]
    pub output: Option<PathBuf>,

    /// Seconds for each code, with --work-precision for each code and integrator.
    #[arg(long, value_name = "S", default_value = "0.3", value_parser = choice::positive,
          allow_negative_numbers = true)]
    pub seconds: f64,
}

/// Different states, so that the processor cannot learn one.
const STATES: usize = 64;

/// The states are always these, so that figures can be compared.
const SEED: u64 = 1970;

/// Fewest samples, however long they take.
const FEWEST_SAMPLES: usize = 3;

/// Nanoseconds of an evaluation.
#[derive(Clone, Copy, Debug)]
struct Times {
    least: f64,
    median: f64,
}

/// States that a batch takes at once.
const LANES: usize = 8;

/// The measurements of one code.
#[derive(Clone, Copy, Debug)]
struct Row {
    label: Label,
    /// States that an evaluation takes; times are those of one.
    lanes: usize,
    times: Times,
    /// The shortest time over that of the recursion.
    of_recursive: f64,
}

/// Times all code that computes accelerations, and returns the text for standard output.
pub(crate) fn bench(args: &BenchArgs, routines: &Routines) -> Result<String, CliError> {
    let file = check::scene(&args.scene)?;
    #[cfg(feature = "generator")]
    let routines = &with_compiled(routines, &file, args.compiled)?;
    if args.work_precision {
        let directory = default_directory(&file.scene.name);
        let directory = args.output.as_ref().unwrap_or(&directory);
        return work_precision(&file.scene, routines, args.seconds, directory);
    }
    let test_case = TestCase::new(file.scene, STATES, SEED)?;
    test_case.check_regular()?;
    let rows = rows(&test_case, routines, args.seconds)?;
    Ok(match (args.json, args.harness) {
        (true, _) => json(&rows),
        (_, true) => harness(&test_case.scene().name, &rows),
        _ => table(&test_case, routines, &rows),
    })
}

/// The recursion first.
fn rows(test_case: &TestCase, routines: &Routines, seconds: f64) -> Result<Vec<Row>, CliError> {
    let codes = test_case.codes(routines.for_runs)?;
    let mut timed: Vec<(Label, usize, Times)> = Vec::new();
    for (label, mut code) in codes {
        timed.push((label, 1, time_of(&mut code, seconds)));
        if let ComparedCode::Routine { fit, states, .. } = &code {
            let batch = routines.batches.iter().find(|batch| is_of(batch, &label));
            let parameters: Vec<Eight> = fit.parameters.iter().map(|&p| Eight::splat(p)).collect();
            if let Some(batch) = batch.filter(|batch| batch.accepts(&parameters)) {
                timed.push((label, LANES, time_of_batch(batch, &parameters, states, seconds)));
            }
        }
    }
    let recursive = timed[0].2.least;
    let row = |(label, lanes, times): (Label, usize, Times)| Row {
        label,
        lanes,
        times,
        of_recursive: times.least / recursive,
    };
    Ok(timed.into_iter().map(row).collect())
}

/// Whether a batch is the same routine.
fn is_of(batch: &Batch, label: &Label) -> bool {
    (Some(batch.topology), batch.formulation, assumptions_in_a_word(batch))
        == (label.topology, label.formulation, label.assumptions)
}

/// Times a batch of eight states of this satellite at once; times are those of one state.
fn time_of_batch(batch: &Batch, parameters: &[Eight], states: &[Vec<f64>], seconds: f64) -> Times {
    let mut constants = vec![Eight::default(); batch.constants];
    batch.prepare(parameters, &mut constants);
    let side_by_side = |of_eight: &[Vec<f64>]| -> Vec<Eight> {
        let number = |i: usize| Eight(std::array::from_fn(|lane| of_eight[lane][i]));
        (0..batch.coordinates).map(number).collect()
    };
    let packs: Vec<Vec<Eight>> = states.chunks_exact(LANES).map(side_by_side).collect();
    let mut found = vec![Eight::default(); batch.outputs];
    time(seconds, |i| {
        if i.is_multiple_of(LANES) {
            let pack = black_box(&packs[i / LANES]);
            batch.evaluate(black_box(&constants), pack, black_box(&mut found));
        }
    })
}

/// Inputs that vary from call to call, and outputs, are hidden from the compiler.
fn time_of(code: &mut ComparedCode<'_>, seconds: f64) -> Times {
    match code {
        ComparedCode::Recursion { dynamics, states, found } => time(seconds, |i| {
            dynamics.accelerations(black_box(&states[i].motion()), black_box(found));
        }),
        ComparedCode::Dense { dense, states } => time(seconds, |i| {
            black_box(dense.accelerations(black_box(&states[i].motion())));
        }),
        ComparedCode::ClosedForm { formulation, recognised, states } => {
            let Recognised { topology, parameters, .. } = recognised;
            time(seconds, |i| {
                let (parameters, state) = (black_box(parameters), black_box(&states[i]));
                black_box(formulation.solve(topology, parameters, state));
            })
        }
        ComparedCode::Tree { tree, states } => time(seconds, |i| {
            black_box(symmetric::solve_tree(black_box(tree), black_box(&states[i])));
        }),
        ComparedCode::Routine { fit, constants, states, found, .. } => time(seconds, |i| {
            fit.kernel.evaluate(black_box(constants), black_box(&states[i]), black_box(found));
        }),
    }
}

/// Shortest and median time of a call, in samples of a call for each state.
fn time(seconds: f64, mut call: impl FnMut(usize)) -> Times {
    let mut sample = || {
        let start = Instant::now();
        (0..STATES).for_each(&mut call);
        start.elapsed().as_secs_f64() * 1e9 / STATES as f64
    };
    sample();
    let start = Instant::now();
    let mut samples = Vec::new();
    while samples.len() < FEWEST_SAMPLES || start.elapsed().as_secs_f64() < seconds {
        samples.push(sample());
    }
    samples.sort_by(f64::total_cmp);
    Times { least: samples[0], median: samples[samples.len() / 2] }
}

fn table(test_case: &TestCase, routines: &Routines, rows: &[Row]) -> String {
    let mut text = format!(
        "{}: ns per evaluation of the accelerations, all hinges free\n{} {:>5} {:>10} {:>10} {:>12}\n",
        test_case.scene().name,
        code_head(),
        "lanes",
        "ns min",
        "ns median",
        "of recursive",
    );
    let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
    for Row { label, lanes, times: Times { least, median }, of_recursive } in rows {
        let (columns, routine) = (code_columns(label), routine_topology(label));
        line(format!(
            "{columns} {lanes:>5} {least:>10.1} {median:>10.1} {of_recursive:>12.3}{routine}"
        ));
    }
    test_case.not_covered(routines.for_runs).iter().map(not_covered).for_each(line);
    text
}

fn json(rows: &[Row]) -> String {
    let object = |row: &Row| {
        let Row { label, lanes, times: Times { least, median }, of_recursive } = row;
        let Label { path, formulation, assumptions, instructions, topology, virtual_links } = label;
        let topology = topology.map_or("null".to_owned(), |topology| format!("\"{topology}\""));
        format!(
            "  {{\"path\": \"{path}\", \"formulation\": \"{formulation}\", \
             \"assumptions\": \"{assumptions}\", \"instructions\": \"{instructions}\", \
             \"topology\": {topology}, \"virtual_links\": {virtual_links}, \"lanes\": {lanes}, \
             \"ns_min\": {least:?}, \"ns_median\": {median:?}, \
             \"of_recursive\": {of_recursive:?}}}"
        )
    };
    format!("[\n{}\n]\n", rows.iter().map(object).collect::<Vec<_>>().join(",\n"))
}

/// A line for each name: of routines with one name, the one that a run takes.
fn harness(scene: &str, rows: &[Row]) -> String {
    let scene: String = scene.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
    let is_taken = |row: &&Row| {
        let same = rows.iter().filter(|other| name(other) == name(row));
        same.max_by_key(|row| precedence(&row.label)).is_some_and(|best| best.label == row.label)
    };
    let line = |row: &Row| {
        let Times { least, median } = row.times;
        format!("{} {scene} ns_min {least:.1} ns_median {median:.1}\n", name(row))
    };
    rows.iter().filter(is_taken).map(line).collect()
}

fn name(row: &Row) -> String {
    let Label { path, formulation, assumptions, .. } = row.label;
    let baked = if assumptions == "baked" { "_baked" } else { "" };
    let lanes = if row.lanes > 1 { format!("_lanes{}", row.lanes) } else { String::new() };
    format!("nboom_{path}_{formulation}{baked}{lanes}")
}

/// Larger for the routine that a run prefers: one of a larger topology, which is there only if a
/// run takes it, then the more specialised one.
fn precedence(label: &Label) -> (bool, bool) {
    (label.virtual_links > 0, label.assumptions != "general")
}
