
/// Differences over four points, of which rounding and the fifth derivative leave 1e-9 or so.
const OF_DIFFERENCES: f64 = 1e-6;

#[test]
fn derivatives_are_limits_of_differences() {
    on_large_stack(|| {
        let kernel = Kernel::of::</*CRATE*/::/*NAME*/>();
        for case in cases(include_str!("/*NAME*/.csv"), &kernel).iter().take(3) {
            derivatives_in(&kernel, case);
        }
    });
}

fn derivatives_in(kernel: &Kernel, case: &Case) {
    let all = 0..case.state.len();
    let mut found = vec![0.0; kernel.outputs * all.len()];
    let accelerations = evaluate(kernel, &case.parameters, &case.state);
    let mut derivatives = /*CRATE*/::derivatives(&case.parameters);
    derivatives.write(&case.state, &accelerations, all.clone(), &mut found);
    let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
    // Rounding of the accelerations.
    let rounding = 1e-12 * largest(&accelerations).max(case.least);
    for column in all.clone().filter(|column| kernel.external || !(3..9).contains(column)) {
        let step = 1e-3 * case.state[column].abs().max(1.0);
        let shifted = |steps: f64| {
            let mut shifted = case.state.clone();
            shifted[column] += steps * step;
            evaluate(kernel, &case.parameters, &shifted)
        };
        let [back, behind, ahead, far] = [-2.0, -1.0, 1.0, 2.0].map(shifted);
        let difference = |row: usize| {
            (8.0 * (ahead[row] - behind[row]) - (far[row] - back[row])) / (12.0 * step)
        };
        let expected: Vec<f64> = (0..kernel.outputs).map(difference).collect();
        let allowed = OF_DIFFERENCES * largest(&expected) + rounding / step;
        for (row, expected) in expected.into_iter().enumerate() {
            let off = (found[row * all.len() + column] - expected).abs();
            assert!(off <= allowed, "row {row}, column {column}: {off:e}, {allowed:e} allowed");
        }
    }
}
