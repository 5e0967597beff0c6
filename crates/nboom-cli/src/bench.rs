use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

use nboom_formulation::{Recognised, symmetric};
use nboom_io::read_scene;
use nboom_verify::{Code, Label, Subject};

use crate::format::{code_columns, code_head, not_covered};
use crate::{BenchArgs, CliError, Routines, check, say};

/// Different states, so that nothing can be learnt from one.
const STATES: usize = 64;

/// The states are always the same ones, so that figures can be compared.
const SEED: u64 = 1970;

/// Samples taken however long they take.
const FEWEST_SAMPLES: usize = 3;

/// Nanoseconds of an evaluation.
#[derive(Clone, Copy, Debug)]
struct Times {
    least: f64,
    median: f64,
}

/// Times all code that computes accelerations and returns the account for standard output.
pub(crate) fn bench(args: &BenchArgs, routines: &Routines) -> Result<String, CliError> {
    let file = read_scene(&args.scene)?;
    check::warnings(&file).iter().for_each(|warning| say("warning", warning));
    let subject = Subject::new(file.scene, STATES, SEED)?;
    let codes = subject.codes(routines.accelerations)?.into_iter();
    let rows: Vec<_> =
        codes.map(|(label, mut code)| (label, time_of(&mut code, args.seconds))).collect();
    Ok(match (args.json, args.harness) {
        (true, _) => json(&rows),
        (_, true) => harness(&subject.scene().name, &rows),
        _ => table(&subject, routines, &rows),
    })
}

/// What varies from call to call and what comes out are hidden from the compiler.
fn time_of(code: &mut Code<'_>, seconds: f64) -> Times {
    match code {
        Code::Recursion { dynamics, states, found } => time(seconds, |i| {
            dynamics.accelerations(black_box(&states[i].motion()), black_box(found));
        }),
        Code::ClosedForm { formulation, recognised, states } => {
            let Recognised { topology, parameters, .. } = recognised;
            time(seconds, |i| {
                let (parameters, state) = (black_box(parameters), black_box(&states[i]));
                black_box(formulation.solve(topology, parameters, state));
            })
        }
        Code::Tree { tree, states } => time(seconds, |i| {
            black_box(symmetric::solve_tree(black_box(tree), black_box(&states[i])));
        }),
        Code::Routine { kernel, constants, states, found, .. } => time(seconds, |i| {
            kernel.evaluate(black_box(constants), black_box(&states[i]), black_box(found));
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

fn table(subject: &Subject, routines: &Routines, rows: &[(Label, Times)]) -> String {
    let mut text = format!(
        "{}: ns per evaluation of the accelerations, all hinges free\n{} {:>10} {:>10} {:>12}\n",
        subject.scene().name,
        code_head(),
        "ns min",
        "ns median",
        "of recursive",
    );
    let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
    let recursive = rows[0].1.least;
    for (label, Times { least, median }) in rows {
        let ratio = least / recursive;
        line(format!("{} {least:>10.1} {median:>10.1} {ratio:>12.3}", code_columns(label)));
    }
    subject.not_covered(routines.accelerations).iter().map(not_covered).for_each(line);
    text
}

fn json(rows: &[(Label, Times)]) -> String {
    let object = |(label, times): &(Label, Times)| {
        let Label { path, formulation, facts, instructions } = label;
        let Times { least, median } = times;
        format!(
            "  {{\"path\": \"{path}\", \"formulation\": \"{formulation}\", \
             \"facts\": \"{facts}\", \"instructions\": \"{instructions}\", \
             \"ns_min\": {least:?}, \"ns_median\": {median:?}}}"
        )
    };
    format!("[\n{}\n]\n", rows.iter().map(object).collect::<Vec<_>>().join(",\n"))
}

fn harness(scene: &str, rows: &[(Label, Times)]) -> String {
    let line = |(label, Times { least, median }): &(Label, Times)| {
        let Label { path, formulation, facts, .. } = label;
        // Code of the library has one form only, which takes any facts.
        let suffix = match (*path, *facts) {
            ("generated", "general") => "_general",
            ("generated", "baked") => "_baked",
            _ => "",
        };
        format!(
            "nboom_{path}_{formulation}{suffix} {scene} ns_min {least:.1} ns_median {median:.1}\n"
        )
    };
    rows.iter().map(line).collect()
}
