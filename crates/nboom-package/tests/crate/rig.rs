use nboom_model::{Base, Gravity};

use super::*;

/// Compares what the crate of a pendulum computes with closed forms: m = 3, l = 0.9, J = 4 + m l², about x at
/// (0.2, 0.5, 0) of a main body of mass 100, g = 9.81 along -z. Tolerances are thousands of roundings of the terms.
const CLOSED_FORMS: &str = "
use satellite_pendulum::{
    HINGES, Kernel, MAIN_BODY, equations, free_parameters, holding_wrench, inverse_dynamics, kernels,
    parameters,
};

const WEIGHT: f64 = 3.0 * 9.81;
const ARM: f64 = 0.9;
const INERTIA: f64 = 4.0 + 3.0 * ARM * ARM;
const ANGLE: f64 = 0.4;

fn found(kernel: &Kernel, parameters: &[f64], main: [f64; 6]) -> Vec<f64> {
    let mut constants = vec![0.0; kernel.constants];
    assert!(kernel.accepts(parameters));
    kernel.prepare(parameters, &mut constants);
    let mut state = vec![0.0; kernel.coordinates];
    state[3..9].copy_from_slice(&main);
    state[HINGES[0].angle] = ANGLE;
    let mut found = vec![0.0; kernel.outputs];
    kernel.evaluate(&constants, &state, &mut found);
    found
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), \"{found} {expected}\");
}

#[test]
fn it_swings_by_its_weight() {
    let found = found(&kernels()[0], parameters(), holding_wrench(MAIN_BODY));
    close(found[HINGES[0].acceleration], -WEIGHT * ARM * ANGLE.cos() / INERTIA);
    close(found[5], 9.81);
}

#[test]
fn its_mount_carries_the_weight() {
    let found = found(inverse_dynamics(), free_parameters(), MAIN_BODY);
    close(found[0], WEIGHT * (0.5 + ARM * ANGLE.cos()));
    close(found[1], -WEIGHT * 0.2);
    close(found[5], WEIGHT + 100.0 * 9.81);
    close(found[HINGES[0].acceleration], WEIGHT * ARM * ANGLE.cos());
}

#[test]
fn its_equation_of_motion_is_a_row() {
    let all = found(equations(), free_parameters(), [0.0; 6]);
    let (row, right) = (&all[42..49], all[49 + 6]);
    close(row[6], INERTIA);
    close(row[2] * MAIN_BODY[5] - right, WEIGHT * ARM * ANGLE.cos());
}
";

#[test]
fn a_crate_of_a_rig_swings_by_its_weight_and_knows_what_its_mount_carries() {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let boom = MassProperties::new(3.0, Vec3::unit_y() * 0.9, Sym3::diagonal(4.0, 0.1, 4.0));
    let segment = Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() };
    let mut description = SceneDescription::at_rest("pendulum", hub, 10.0);
    description.base = Base::Fixed;
    description.gravity = Some(Gravity { acceleration: 9.81, up: Vec3::unit_z() });
    let mount = Mount::at(Vec3::new(0.2, 0.5, 0.0));
    description.attach(&Appendage::Regular { mount, segments: vec![segment] });
    let scene = Scene::new(description).expect("the bodies are physical");
    for numbers in [Numbers::RunTime, Numbers::Baked] {
        let choices =
            Choices { numbers, equations: true, inverse_dynamics: true, ..Choices::default() };
        let place = written(&scene, &choices);
        fs::write(place.path().join("tests/closed_forms.rs"), CLOSED_FORMS).expect("writable");
        cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    }
}

/// A pendulum on the ground: nothing is known of its main body.
#[test]
fn a_crate_of_a_rig_needs_no_mass_of_its_main_body() {
    let boom = MassProperties::new(3.0, Vec3::unit_y() * 0.9, Sym3::diagonal(4.0, 0.1, 4.0));
    let segment = Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() };
    let mut description = SceneDescription::at_rest("ground", MassProperties::nothing(), 10.0);
    description.base = Base::Fixed;
    description
        .attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments: vec![segment; 2] });
    let scene = Scene::new(description).expect("the bodies are physical");
    let place = written(&scene, &Choices { right_side: true, ..Choices::default() });
    let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    assert!(said.contains("SatelliteS2RightSide, portable code"), "{said}");

    for choices in [
        Choices { equations: true, ..Choices::default() },
        Choices { inverse_dynamics: true, external_wrench: true, ..Choices::default() },
    ] {
        let refused = generate(&scene, &choices, &place.path().join("other")).expect_err("no mass");
        assert!(refused.to_string().contains("main body without mass found"), "{refused}");
    }
}
