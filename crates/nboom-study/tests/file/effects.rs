//! What would have no effect is refused.

use nboom_io::InputError;

use super::{SCENE, STUDY, place};
use nboom_study::Study;
use std::fs;

/// Line and message of each error of this study of this scene.
pub(crate) fn errors(scene: &str, study: &str) -> Vec<(usize, String)> {
    let place = place(study);
    fs::write(place.path().join("scene.toml"), scene).expect("writable");
    match Study::read(&place.path().join("study.toml")) {
        Err(InputError::Content(errors)) => {
            errors.iter().map(|error| (error.line, error.to_string())).collect()
        }
        Err(other) => panic!("{other}"),
        Ok(_) => Vec::new(),
    }
}

/// Each change of the study is refused once, at its line, in these words.
pub(crate) fn refused(scene: &str, from: &str, to: &str, line: usize, words: &[&str]) {
    assert!(STUDY.contains(from), "{from}");
    let found = errors(scene, &STUDY.replacen(from, to, 1));
    let [(at, told)] = &found[..] else { panic!("{to}: {found:#?}") };
    assert_eq!(*at, line, "{told}");
    for word in words {
        assert!(told.contains(word), "{to}: {told}");
    }
}

#[test]
fn faults_that_break_nothing_or_one_thing_twice() {
    for (from, to, line, words) in [
        ("stuck = [\"1,2\"]", "stuck = []", 42, ["stuck", "an empty list"]),
        (
            "broken_spring = [\"boom\"]",
            "broken_spring = []",
            44,
            ["broken_spring", "an empty list"],
        ),
        (
            "change = [{ path = \"body.tip.mass\", offset = 0.1 }]",
            "change = []",
            38,
            ["change", "an empty"],
        ),
        (
            "late_release = { hinge = \"boom\", by = 0.5 }",
            "late_release = [{ hinge = \"boom\", by = 0.5 }, { hinge = \"1,1\", by = 0.5 }]",
            37,
            ["`1,1`", "each hinge once"],
        ),
        (
            "failed_latch = [\"boom\"]",
            "failed_latch = [\"boom\", \"1,1\"]",
            43,
            ["`1,1`", "each hinge once"],
        ),
    ] {
        refused(SCENE, from, to, line, &words);
    }
}

/// The scene with the boom locked from the start.
fn locked() -> String {
    SCENE
        .replace("release = { at = 1.0 }\n", "state = \"locked\"\n")
        .replace("start_deg = 90.0", "start_deg = 0.0")
}

#[test]
fn faults_of_hinges_that_never_move() {
    let held = SCENE.replace("release = { at = 1.0 }\n", "state = \"held\"\n");
    for scene in [held, locked()] {
        let faults: String = ["stuck", "failed_latch", "broken_spring"]
            .map(|key| format!("[[fault]]\nname = \"{key}\"\n{key} = [\"boom\"]\n"))
            .concat();
        let study = STUDY.split("[[fault]]").next().expect("text").to_owned() + &faults;
        let found =
            errors(&scene, &study.replace("results = [\"lock_time of boom\", ", "results = ["));
        let lines: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [37, 40, 43], "{found:#?}");
        for (_, told) in found {
            assert!(told.contains("held or locked all the time"), "{told}");
        }
    }
}

#[test]
fn a_release_that_several_hinges_do_not_have_is_told_once() {
    let free = SCENE
        .replace("release = { at = 1.0 }\n", "")
        .replace("release = { when = \"boom\", passes_deg = 45.0 }\n", "");
    let study = STUDY.split("[[fault]]").next().expect("text").to_owned();
    let fault = "[[fault]]\nname = \"missed\"\nmissed_release = [\"boom\", \"tip\"]\n";
    let found = errors(&free, &(study + fault));
    let [(37, told)] = &found[..] else { panic!("{found:#?}") };
    assert!(told.contains("hinges that start unreleased"), "{told}");
}

#[test]
fn the_lock_up_of_a_hinge_that_is_locked_is_no_result() {
    let study = STUDY.split("[[fault]]").next().expect("text");
    let found = errors(&locked(), study);
    let told: Vec<_> = found.iter().filter(|(line, _)| *line == 6).collect();
    assert!(
        matches!(&told[..], [(_, told)] if told.contains("not locked from the start")),
        "{told:?}"
    );
}

#[test]
fn a_hinge_without_a_latch_never_locks_and_one_that_is_free_is_never_released() {
    let study = STUDY.split("[[fault]]").next().expect("text");
    let unlatched = SCENE.replace("latch_deg = 0.0\n", "");
    assert_ne!(unlatched, SCENE);
    for result in ["lock_time", "impulse", "closing_rate", "miss"] {
        let study = study.replace("lock_time of boom", &format!("{result} of boom"));
        let found = errors(&unlatched, &study);
        let told = found.iter().find(|(line, _)| *line == 6);
        assert!(told.is_some_and(|(_, told)| told.contains("has a lock angle")), "{found:?}");
    }
    let free = SCENE.replace("release = { at = 1.0 }\n", "");
    let found = errors(&free, &study.replace("lock_time of boom", "release_time of boom"));
    let told = found.iter().find(|(line, _)| *line == 6);
    assert!(told.is_some_and(|(_, told)| told.contains("held at the start")), "{found:?}");
}

#[test]
fn changes_of_faults_that_a_variable_undoes_or_that_are_none() {
    let change = "{ path = \"body.tip.mass\", offset = 0.1 }";
    let varied = "path = \"parameters.k\"";
    // The stiffness follows from the parameter, and the variable sets it.
    let stiffness = STUDY.replace(varied, "path = \"body.boom.hinge.spring.stiffness\"");
    let of_parameter = "{ path = \"parameters.k\", factor = 0.5 }";
    let found = errors(SCENE, &stiffness.replace(change, of_parameter));
    assert!(
        matches!(&found[..], [(38, told)] if told.contains("`k` takes no notice of")),
        "{found:?}"
    );
    // What follows from a parameter that is varied may be changed, and so may the parameter itself.
    let of_stiffness = "{ path = \"body.boom.hinge.spring.stiffness\", factor = 0.5 }";
    for right in [of_stiffness, of_parameter] {
        assert_eq!(errors(SCENE, &STUDY.replace(change, right)), []);
    }
    for neutral in ["factor = 1.0", "offset = 0.0"] {
        let none = change.replace("offset = 0.1", neutral);
        refused(SCENE, change, &none, 38, &["a number that stays as it is"]);
    }
    let boom = "{ path = \"body.boom.hinge.start_deg\", value = 90.0 }";
    refused(SCENE, change, boom, 38, &["a number that stays as it is"]);
    // The scene's own numbers, but others are drawn in their place.
    let own = ["body.tip.mass\", value = 1.0", "body.boom.hinge.spring.stiffness\", value = 2.0"];
    for own in own.map(|own| format!("{{ path = \"{own} }}")) {
        assert_eq!(errors(SCENE, &STUDY.replace(change, &own)), [], "{own}");
    }
}

#[test]
fn a_factor_of_zero_has_no_effect_unless_another_variable_moves_it() {
    let scene = SCENE.replace("k = 2.0", "k = 2.0\namp = 0.0\ndir = 1.0");
    let scene = scene.replace("\"$k\"", "\"$k + $amp * $dir\"");
    let varied = "path = \"parameters.k\"\nas = \"factor\"";
    let factor = "path = \"parameters.amp\"\nas = \"factor\"";
    refused(&scene, varied, factor, 17, &["a number without effect"]);
    // Only together with the amplitude has the direction an effect.
    let spin = "path = \"main_body.mass\"\nvalues = [100.0, 110.0]";
    let study = STUDY
        .replace("path = \"parameters.k\"\nas = \"factor\"", "path = \"parameters.amp\"")
        .replace(spin, "path = \"parameters.dir\"\nvalues = [-1.0, 1.0]");
    assert_eq!(errors(&scene, &study), []);
}

#[test]
fn variables_on_which_no_run_depends() {
    let scene = SCENE.replace("k = 2.0", "k = 2.0\nunused = 1.0\ndoubled = \"2 * $unused\"");
    let sampled = scene.replace("[parameters]", "[output]\nevery = 0.1\n\n[parameters]");
    let path = "path = \"main_body.mass\"";
    for (scene, path_now) in [
        (&scene, "path = \"parameters.unused\""),
        (&scene, "path = \"parameters.doubled\""),
        (&scene, "path = \"run.end\""),
        (&sampled, "path = \"output.every\""),
    ] {
        refused(scene, path, path_now, 27, &["without effect", "`spin`"]);
    }
    refused(
        &scene,
        "path = \"body.tip.mass\", offset",
        "path = \"parameters.unused\", offset",
        38,
        &["without effect"],
    );
    refused(
        SCENE,
        "paths = [\"body.tip.mass\", \"body.boom.mass\"]",
        "paths = [\"body.tip.mass\", \"body.boom.mass\", \"body[2].mass\"]\nname = \"body_tip_mass\"",
        22,
        &["each number once"],
    );
    // Without the settings that override them they have an effect.
    let study = STUDY.replace("samples = 10\nend_time = 5.0\n", "");
    for path_now in ["path = \"run.end\"", "path = \"output.every\""] {
        assert_eq!(errors(&sampled, &study.replace(path, path_now)), []);
    }
}

/// A yield stress of the runs takes the place of those of materials.
#[test]
fn strengths_of_materials_beside_one_of_the_runs() {
    let scene = include_str!("../../../../examples/solar-array.toml");
    let study = |run: &str| {
        format!(
            "scene = 'scene.toml'\ndraws = 2\n{run}[[vary]]\nname = 'strength'\n\
             path = 'materials.aluminium.yield_stress'\nuniform = {{ from = 1e8, to = 2e8 }}\n"
        )
    };
    assert_eq!(errors(scene, &study("")), []);
    let found = errors(scene, &study("[run]\nyield_stress = 1e8\n"));
    let [(7, told)] = &found[..] else { panic!("{found:#?}") };
    assert!(told.contains("without effect"), "{told}");
}

/// Stops act where their hinge turns, and a restitution where there are stops.
#[test]
fn stops_and_restitutions_that_nothing_comes_to() {
    let path = "path = \"main_body.mass\"\nvalues = [100.0, 110.0]\nweights = [3, 1]";
    let varied = |of: &str, to: f64| {
        let of = format!("path = \"body.tip.hinge.{of}\"");
        let study = STUDY.split("[[fault]]").next().expect("text");
        study.replace(path, &format!("{of}\nuniform = {{ from = 0.0, to = {to} }}"))
    };
    let with = |release: &str, lines: &str| {
        let released = "release = { when = \"boom\", passes_deg = 45.0 }\n";
        SCENE.replace(released, &format!("{release}\n{lines}\n"))
    };
    let (free, held) = ("state = \"free\"", "state = \"held\"");
    let both = "stops_deg = [-5.0, 10.0]\nrestitution = 0.1";
    let is_idle = |scene: &str, study: &str| {
        let found = errors(scene, study);
        found.iter().any(|(line, told)| *line == 27 && told.contains("without effect"))
    };
    for (of, to) in [("stops_deg[2]", 30.0), ("restitution", 0.9)] {
        assert!(!is_idle(&with(free, both), &varied(of, to)), "{of}");
        let found = errors(&with(held, both), &varied(of, to));
        assert!(is_idle(&with(held, both), &varied(of, to)), "{of}: {found:#?}");
    }
    assert!(is_idle(&with(free, "restitution = 0.1"), &varied("restitution", 0.9)));
    let upper = "stops_deg = [-inf, 10.0]\nrestitution = 0.1";
    assert!(!is_idle(&with(free, upper), &varied("restitution", 0.9)));
}

/// What is only drawn, what stands for a law that is not there, and what moves nothing.
#[test]
fn numbers_that_move_nothing() {
    let scene = SCENE
        .replace("[parameters]", "[output]\nstress_every = 2\n\n[parameters]")
        .replace(
            "mass = 100.0",
            "mass = 100.0\nbase = \"fixed\"\nshape = { box = [1.0, 1.0, 1.0] }",
        )
        .replace("mass = 3.0", "mass = 3.0\ntip = [2.0, 0.0, 0.0]\npulse_constant = 0.01")
        .replace("mass = 1.0\n", "mass = 1.0\npulse_constant = 0.01\n")
        .replace(
            "rest_deg = -10.0 }",
            "rest_deg = -10.0 }\ndamper = { damping = 1.0, rest_deg = 5.0 }",
        );
    let path = "path = \"main_body.mass\"\nvalues = [100.0, 110.0]\nweights = [3, 1]";
    for of in [
        "main_body.shape.box[1]",
        "main_body.inertia[1]",
        "body.boom.tip[1]",
        "body.tip.pulse_constant",
        "body.boom.hinge.damper.rest_deg",
        "output.stress_every",
    ] {
        let varied = format!("path = \"{of}\"\nuniform = {{ from = 30.0, to = 40.0 }}");
        refused(&scene, path, &varied, 27, &["without effect", "`spin`"]);
        let changed = format!("path = \"{of}\", offset");
        refused(&scene, "path = \"body.tip.mass\", offset", &changed, 38, &["without effect"]);
    }
    // They have an effect where the law is there, the main body moves and the hinge latches.
    let free = scene.replace("base = \"fixed\"\n", "").replace("damping = 1.0", "angle = -0.1");
    for of in
        ["main_body.inertia[1]", "body.boom.pulse_constant", "body.boom.hinge.damper.rest_deg"]
    {
        let varied = format!("path = \"{of}\"\nuniform = {{ from = 30.0, to = 40.0 }}");
        assert_eq!(errors(&free, &STUDY.replace(path, &varied)), [], "{of}");
    }
}

#[test]
fn elasticity_of_materials_and_strengths_of_bodies_without_stations() {
    let scene = include_str!("../../../../examples/solar-array.toml");
    let idle = "\n[materials.idle]\nyoungs_modulus = 1e10\nyield_stress = 1e8\n";
    let scene = scene.replacen("on = \"yoke\"", "on = \"yoke\"\nmaterial = \"idle\"", 1) + idle;
    for (path, is_refused) in [
        ("materials.aluminium.youngs_modulus", true),
        ("materials.idle.yield_stress", true),
        ("materials.aluminium.yield_stress", false),
    ] {
        let study = format!(
            "scene = 'scene.toml'\ndraws = 2\n[[vary]]\npath = '{path}'\nuniform = {{ from = 1e8, to = 2e8 }}\n"
        );
        let lines: Vec<usize> = errors(&scene, &study).iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, if is_refused { vec![4] } else { vec![] }, "{path}");
    }
}

/// Each part of a fault breaks something that the rest of it leaves whole.
#[test]
fn parts_of_faults_of_which_others_leave_nothing() {
    let faults = |fault: &str| {
        let study = STUDY.split("[[fault]]").next().expect("text");
        errors(SCENE, &format!("{study}[[fault]]\nname = 'it'\n{fault}\n"))
    };
    let change =
        |path: &str| format!("change = [{{ path = 'body.boom.hinge.{path}', offset = -5.0 }}]");
    let [stiffness, rest, latch] = ["spring.stiffness", "spring.rest_deg", "latch_deg"].map(change);
    for (fault, lines) in [
        (format!("{stiffness}\nbroken_spring = ['boom']"), &[37][..]),
        (format!("{rest}\nbroken_spring = ['boom']"), &[37]),
        (format!("{rest}\nbroken_spring = ['boom']\nfailed_latch = ['boom']"), &[37]),
        (format!("{latch}\nfailed_latch = ['boom']"), &[37]),
        (format!("{latch}\nbroken_spring = ['boom']"), &[]),
        (format!("{latch}\nstuck = ['boom']"), &[37]),
        ("stuck = ['boom']\nmissed_release = ['boom']".to_owned(), &[38]),
        (
            "stuck = ['boom']\nbroken_spring = ['boom']\nfailed_latch = ['boom']".to_owned(),
            &[38, 39],
        ),
        ("missed_release = ['boom', 'tip']\nbroken_spring = ['boom']".to_owned(), &[38]),
        (format!("{}\nstuck = ['boom']", change("start_deg")), &[]),
        (format!("{}\nmissed_release = ['boom']", change("release.at")), &[37]),
    ] {
        let found = faults(&fault);
        let at: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
        assert_eq!(at, lines, "{fault}: {found:#?}");
    }
    let [(_, told)] = &faults("stuck = ['boom']\nbroken_spring = ['boom']")[..] else {
        panic!("one")
    };
    assert!(told.contains("`boom`, of which the rest of the fault"), "{told}");
}
