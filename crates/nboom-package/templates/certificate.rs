//! How far the compiled code is from the truth, in plain code and in that of this processor.

use std::io::{self, Write};
use std::{panic, thread};

use /*CRATE*/::nboom_scalar::InstructionSet;
use /*CRATE*/::{Kernel, Routine};

const INSTRUCTION_SETS: [InstructionSet; 3] =
    [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512];

/// A satellite and a state of it, with what is to come out, computed with 32 digits.
struct Case {
    parameters: Vec<f64>,
    state: Vec<f64>,
    expected: Vec<f64>,
    /// What deviations are relative to where all of that cancels to nothing.
    least: f64,
}

fn cases(table: &str, kernel: &Kernel) -> Vec<Case> {
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let case = |line: &str| {
        let mut parameters: Vec<f64> = line.split(',').map(number).collect();
        let mut state = parameters.split_off(kernel.parameters);
        let mut expected = state.split_off(kernel.coordinates);
        let least = expected.pop().expect("a scale");
        Case { parameters, state, expected, least }
    };
    table.lines().skip(1).map(case).collect()
}

fn evaluate(kernel: &Kernel, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    assert!(kernel.accepts(parameters));
    let mut constants = vec![0.0; kernel.constants];
    kernel.prepare(parameters, &mut constants);
    let mut found = vec![0.0; kernel.outputs];
    kernel.evaluate(&constants, state, &mut found);
    found
}

/// Large enough for unoptimised code of large trees, which keeps every number in a place of its own.
const STACK: usize = 256 << 20;

/// Does `work`, which calls such code, on a stack of that size.
fn on_large_stack(work: impl FnOnce() + Send) {
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        if let Err(failure) = thread.expect("there is memory").join() {
            panic::resume_unwind(failure);
        }
    });
}

/// `off` tells how far numbers are from those expected, relative to no less than a scale.
fn compare<T: Routine>(
    name: &str,
    table: &str,
    tolerance: f64,
    off: fn(&[f64], &[f64], f64) -> f64,
) {
    for set in INSTRUCTION_SETS {
        let Some(kernel) = Kernel::with::<T>(set) else { continue };
        let cases = cases(table, &kernel);
        assert!(!cases.is_empty());
        let mut most = 0.0_f64;
        for case in &cases {
            let found = evaluate(&kernel, &case.parameters, &case.state);
            let off = off(&found, &case.expected, case.least);
            most = most.max(if off.is_nan() { f64::INFINITY } else { off });
        }
        // The test harness keeps what passing tests print, but not what they write.
        let (code, states) = (kernel.instructions, cases.len());
        writeln!(
            io::stdout(),
            "{name}, {code} code: largest deviation {most:.1e} in {states} states, at most \
             {tolerance:.1e} allowed"
        )
        .expect("standard output takes it");
        assert!(most <= tolerance, "{name}, {code} code: {most:e}");
    }
}
