use super::*;

/// Derivatives by a crate's tree against those of its routine on dual numbers.
const PROGRAM: &str = r#"
use satellite_routines::nboom_scalar::jacobian;
use satellite_routines::{Routine, derivatives, kernels, parameters, FIRST as First};

#[test]
fn derivatives_are_those_of_dual_numbers() {
    let kernel = &kernels()[0];
    let mut constants = vec![0.0; kernel.constants];
    kernel.prepare(parameters(), &mut constants);
    let state: Vec<f64> = (0..First::COORDINATES).map(|i| (1.3 * i as f64 + 0.4).sin()).collect();
    let mut accelerations = vec![0.0; First::OUTPUTS];
    let mut found = vec![0.0; First::OUTPUTS * state.len()];
    let mut expected = found.clone();
    let all = 0..state.len();
    jacobian::<First>(&constants, &state, all.clone(), &mut accelerations, &mut expected);
    derivatives(parameters()).write(&state, &accelerations, all, &mut found);
    let largest = expected.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-12 * largest, "{found} {expected}");
    }
}
"#;

#[test]
fn a_crate_has_derivatives_without_compiling_them() {
    // The topology is S2_S1, so that hinges stand in another order than in the scene.
    let place = written(&satellite("routines", &[1, 2]), &Choices::default());
    let text = PROGRAM.replace("FIRST", "SatelliteS2S1");
    let program = place.path().join("tests/by_dual_numbers.rs");
    fs::write(&program, text).expect("writable");
    let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    for test in ["derivatives_are_those_of_dual_numbers", "derivatives_are_limits_of_differences"] {
        assert!(said.contains(&format!("{test} ... ok")), "{said}");
    }

    // A link whose inboard one is another.
    fs::remove_file(&program).expect("there");
    let code = place.path().join("src/lib.rs");
    let text = fs::read_to_string(&code).expect("readable");
    let wrong = text.replacen("inboard: Some(0), joint", "inboard: None, joint", 1);
    assert_ne!(wrong, text);
    fs::write(&code, wrong).expect("writable");
    let said = cargo_test(place.path()).expect_err("the tree is wrong");
    assert!(said.contains("derivatives_are_limits_of_differences ... FAILED"), "{said}");
}
