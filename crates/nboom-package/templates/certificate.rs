//! The compiled code gives what the certificate says, in plain code and in that of this processor.

use /*CRATE*/::nboom_scalar::InstructionSet;
use /*CRATE*/::{Kernel, /*NAMES*/, parameters};

/// The largest deviation.
const TOLERANCE: f64 = /*TOLERANCE*/;

const INSTRUCTION_SETS: [InstructionSet; 3] =
    [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512];

/// States, each with what is to come out, computed with 32 digits.
fn cases(table: &str, coordinates: usize) -> Vec<(Vec<f64>, Vec<f64>)> {
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let case = |line: &str| {
        let mut state: Vec<f64> = line.split(',').map(number).collect();
        let expected = state.split_off(coordinates);
        (state, expected)
    };
    table.lines().skip(1).map(case).collect()
}

fn evaluate(kernel: &Kernel, state: &[f64]) -> Vec<f64> {
    let mut constants = vec![0.0; kernel.constants];
    kernel.prepare(parameters(), &mut constants);
    let mut found = vec![0.0; kernel.outputs];
    kernel.evaluate(&constants, state, &mut found);
    found
}

#[test]
fn accelerations_are_as_certified() {
    for set in INSTRUCTION_SETS {
        let Some(kernel) = Kernel::with::</*WHOLE*/>(set) else { continue };
        assert!(kernel.accepts(parameters()));
        let cases = cases(include_str!("accelerations.csv"), kernel.coordinates);
        assert!(!cases.is_empty());
        for (i, (state, expected)) in cases.iter().enumerate() {
            let found = evaluate(&kernel, state);
            assert_eq!(found.len(), expected.len());
            let scale = expected.iter().fold(f64::MIN_POSITIVE, |most, e| most.max(e.abs()));
            for (found, expected) in found.iter().zip(expected) {
                let off = (found - expected).abs() / scale;
                assert!(off <= TOLERANCE, "state {}, {}: {off:e}", i + 1, kernel.instructions);
            }
        }
    }
}
