//! How far the compiled code for loads and stresses is from the equations in 32 digits.

use /*CRATE*/::{Kernel, /*NAME*/, Routine};

/// Of the largest number of its kind: rounding in some hundred operations.
const TOLERANCE: f64 = 1e-12;

const HINGES: usize = /*HINGES*/;

#[test]
fn loads_and_stresses_are_those_of_the_equations() {
    let kernel = Kernel::of::</*NAME*/>();
    let parameters: Vec<f64> = /*NAME*/::ASSUMPTIONS.iter().map(|&(_, number)| number).collect();
    assert!(kernel.accepts(&parameters));
    let mut constants = vec![0.0; kernel.constants];
    kernel.prepare(&parameters, &mut constants);
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let rows = include_str!("/*NAME*/.csv").lines();
    let rows: Vec<Vec<f64>> = rows.map(|line| line.split(',').map(number).collect()).collect();
    // Forces, moments, halves of what describes stresses, and magnitudes of moments.
    let wrenches = (kernel.outputs + 5 * HINGES) / 2;
    let kind = |i: usize| (i < wrenches, i < kernel.outputs - HINGES, i % 6 < 3);
    let largest = |i: usize| {
        let of_kind = (0..kernel.outputs).filter(|&j| kind(j) == kind(i));
        let values = of_kind.flat_map(|j| rows.iter().map(move |row| row[kernel.coordinates + j]));
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let mut found = vec![0.0; kernel.outputs];
    for row in &rows {
        let (motion, expected) = row.split_at(kernel.coordinates);
        kernel.evaluate(&constants, motion, &mut found);
        assert_eq!(found.len(), expected.len());
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let scale = largest(i);
            assert!((found - expected).abs() <= TOLERANCE * scale, "number {i}: {found} {expected}");
        }
    }
}
