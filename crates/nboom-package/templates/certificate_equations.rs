
#[test]
fn equations_are_as_certified() {
    for set in INSTRUCTION_SETS {
        let Some(kernel) = Kernel::with::</*EQUATIONS*/>(set) else { continue };
        for (state, unknowns) in cases(include_str!("equations.csv"), kernel.coordinates) {
            let found = evaluate(&kernel, &state);
            let (matrix, right) = found.split_at(unknowns.len() * unknowns.len());
            for (row, right) in matrix.chunks_exact(unknowns.len()).zip(right) {
                let (mut sum, mut scale) = (-right, right.abs());
                for (entry, unknown) in row.iter().zip(&unknowns) {
                    sum += entry * unknown;
                    scale += (entry * unknown).abs();
                }
                assert!(sum.abs() <= TOLERANCE * scale, "{}: {sum:e}", kernel.instructions);
            }
        }
    }
}
