//! What is said in vain gives a warning.

use nboom_io::{ReadOptions, parse_scene};

use super::{BUS, body};

pub fn warnings(text: &str, set: &[&str]) -> Vec<String> {
    let set = set.iter().map(|name| ((*name).to_owned(), 3.0)).collect();
    let options = ReadOptions { set, ..ReadOptions::default() };
    let file = parse_scene("a.toml", text, "a", None, &options).expect("a right scene");
    file.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn a_parameter_that_is_set_and_that_nothing_uses_is_told() {
    for (parameters, mass, set, unused) in [
        ("m = 3.0", "mass = \"$m\"", &["m"][..], &[][..]),
        ("m = 3.0\nn = \"2 * $m\"", "mass = \"$n\"", &["m", "n"], &[]),
        ("m = 3.0", "mass = 3.0", &["m"], &["--set"]),
        ("m = 3.0\nn = \"2 * $m\"", "mass = \"$m\"", &["m", "n"], &["--set"]),
        // A scene that is not written to its end has parameters for later.
        ("m = 3.0", "mass = 3.0", &[], &[]),
    ] {
        let body = body("one", "", "").replace("mass = 3.0", mass);
        let told = warnings(&format!("[parameters]\n{parameters}\n{BUS}{body}"), set);
        assert_eq!(told.len(), unused.len(), "{told:?}");
        for (told, symbol) in told.iter().zip(unused) {
            let expected = format!("{symbol}: found a parameter that nothing uses");
            assert!(told.contains(&expected), "{told}");
        }
    }
}

#[test]
fn a_parameter_that_is_set_twice_is_told() {
    let body = body("one", "", "").replace("mass = 3.0", "mass = \"$m\"");
    let text = format!("[parameters]\nm = 3.0\n{BUS}{body}");
    let set = [("m".to_owned(), 5.0), ("m".to_owned(), 7.0)].to_vec();
    let options = ReadOptions { set, ..ReadOptions::default() };
    let file = parse_scene("a.toml", &text, "a", None, &options).expect("a right scene");
    let told: Vec<_> = file.warnings.iter().map(ToString::to_string).collect();
    let words = "--set: found values of `m`, of which the last one, 7, holds, expected one value";
    assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
    assert_eq!(file.scene.bodies[0].mass_properties.mass, 7.0);
}

#[test]
fn what_is_said_in_vain_is_told() {
    let alloy = "[materials.alloy]\nyoungs_modulus = 7e10\n";
    let force = "[[main_body.thruster]]\npoint = [0.0, 0.0, 0.0]\nforce = [0, 0.0, 0.0]\n";
    let thrust = "[thrust]\nforce = [0, 0.0, 0.0]\npoint = [0.0, 0.0, 0.0]\nfrom = 0\nuntil = 1\n";
    let torque = "[[main_body.torque]]\ntorque = [1, 0.0, 0.0]\nover_time = [[0, 0], [1, 0]]\n";
    let joint = |line: &str| body("one", "", line);
    for (text, words) in [
        (format!("{alloy}{}", joint("")), "alloy: found a material that nothing uses"),
        (joint("torque_deg = []"), "torque_deg: found an empty list"),
        (
            joint("damper = {}"),
            "damper: found a table that has no effect, expected at least one of",
        ),
        (joint("damper = { rest_deg = 10 }"), "damper: found a table that has no effect"),
        (format!("[output]\ncolumns = []\n{}", joint("")), "columns: found an empty list"),
        (format!("{force}{}", joint("")), "force: found a force of zero"),
        (format!("{thrust}{}", joint("")), "force: found a force of zero"),
        (format!("{torque}{}", joint("")), "over_time: found a table that is zero throughout"),
        (
            joint("torque_deg = [[0.0, 0.0], [90.0, 0]]"),
            "torque_deg: found a table that is zero throughout",
        ),
        (
            joint("damper = { damping = 1.0, rest_deg = 30 }"),
            "rest_deg: found a rest on which nothing depends, expected angle or angle_squared",
        ),
    ] {
        let told = warnings(&format!("{BUS}{text}"), &[]);
        assert!(told.len() == 1 && told[0].contains(words), "{words}: {told:?}");
    }
    let used = body("one", "material = \"alloy\"", "damper = { damping = 0.0 }");
    assert_eq!(warnings(&format!("{BUS}{alloy}{used}"), &[]), [""; 0]);
}

#[test]
fn pulse_constants_that_are_idle_or_no_short_times_are_told() {
    let told = |constant: &str, hinge: &str| {
        let copies =
            format!("repeat = {{ count = 3, about = \"z\" }}\npulse_constant = {constant}");
        warnings(&format!("{BUS}{}", body("one", &copies, hinge)), &[])
    };
    assert_eq!(told("0.02", "latch_deg = 90"), [""; 0]);
    let never = told("0.02", "");
    let words = "pulse_constant: found one of a body without latch and stops, expected a latch, stops, or none";
    assert!(never.len() == 1 && never[0].contains(words), "{never:?}");
    let long = told("20", "latch_deg = 90");
    let words = "pulse_constant: found pulse constant 20, expected one below the ";
    assert!(long.len() == 1 && long[0].contains(words), "{long:?}");
}
