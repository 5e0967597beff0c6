//! Messages name what is wrong and where.

use std::fs;

use nboom_study::Study;

use super::effects::{errors, refused};
use super::{SCENE, STUDY, place};

#[test]
fn a_release_that_a_fault_takes_away_cannot_be_late() {
    let late = "late_release = { hinge = \"boom\", by = 0.5 }";
    for key in ["missed_release", "stuck"] {
        let both = format!("{late}\n{key} = [\"boom\"]");
        refused(SCENE, late, &both, 37, &["hinge", "`boom`", key]);
    }
}

#[test]
fn a_fault_with_the_name_of_another_is_told_at_its_own_name() {
    refused(SCENE, "name = \"stuck\"", "name = \"late\"", 41, &["name", "`late`"]);
}

#[test]
fn requirements_are_of_results_in_the_table_and_have_bounds() {
    let study = |requirement: &str| format!("{STUDY}\n[[requirement]]\n{requirement}\n");
    let first = STUDY.lines().count() + 2;
    let boom = "result = 'lock_time of boom'\n";
    for (requirement, line, words) in [
        ("at_most = 1.0", first, ["result", "nothing"]),
        (
            "result = 'lock_time of bom'\nat_most = 1.0",
            first + 1,
            ["result", "`lock_time of boom`"],
        ),
        ("result = 'final omega_x'\nat_most = 1.0", first + 1, ["result", "`final omega_x`"]),
        (boom, first, ["requirement", "no bound"]),
        (&format!("{boom}at_least = 3.0\nat_most = 2.0"), first + 3, ["at_most", "from 3 on"]),
        (&format!("{boom}at_most = nan"), first + 2, ["at_most", "a number"]),
        (&format!("{boom}below = 1.0"), first, ["below", "at_least"]),
        (
            &format!("{boom}at_least = 1.0\n[[requirement]]\n{boom}at_most = 2.0"),
            first + 4,
            ["result", "a requirement before"],
        ),
    ] {
        let found = errors(SCENE, &study(requirement));
        let (at, told) = &found[0];
        assert_eq!(*at, line, "{requirement}: {found:#?}");
        assert!(
            words.iter().all(|word| found.iter().any(|(_, told)| told.contains(word))),
            "{told}"
        );
    }
    let place = place(&study("result = ' lock_time of boom '\nat_most = 2.5\nat_least = 1"));
    let read = Study::read(&place.path().join("study.toml")).expect("a study");
    let [requirement] = &read.requirements[..] else { panic!("one requirement") };
    assert_eq!((requirement.at_least, requirement.at_most), (Some(1.0), Some(2.5)));
    assert_eq!(requirement.bounds(), "at least 1 and at most 2.5");
}

#[test]
fn plans_that_are_none_say_what_was_found() {
    let points = |path: &str| {
        format!("[[vary]]\npath = '{path}'\nuniform = {{ from = 1, to = 2 }}\npoints = 1000000\n")
    };
    let grid = "scene = 'scene.toml'\nmethod = 'grid'\n".to_owned()
        + &points("parameters.k")
        + &points("main_body.mass");
    let [(2, told)] = &errors(SCENE, &grid)[..] else { panic!("one error") };
    assert!(told.contains(" method: found a grid of 1e12 points"), "{told}");
    let body = |i: usize| {
        format!(
            "[[body]]\nname = 'b{i}'\nmass = 1.0\nmass_centre = [1.0, 0.0, 0.0]\ninertia = [0.1, 1.0, 1.0]\n\
             [body.hinge]\nat = [0.0, 0.0, 0.0]\naxis = 'z'\n"
        )
    };
    let scene = (1..=101).map(body).fold(SCENE.to_owned(), |scene, body| scene + "\n" + &body);
    let mut sobol = "scene = 'scene.toml'\ndraws = 8\nmethod = 'sobol'\n".to_owned();
    for i in 1..=101 {
        sobol += &format!("[[vary]]\npath = 'body.b{i}.mass'\nuniform = {{ from = 1, to = 2 }}\n");
    }
    let [(3, told)] = &errors(&scene, &sobol)[..] else { panic!("{:#?}", errors(&scene, &sobol)) };
    assert!(told.contains(" method: found 101 variables, expected at most 100"), "{told}");
}

/// As `nboom run` refuses them.
#[test]
fn choices_of_code_that_others_leave_nothing_to_are_refused() {
    let integrator = "integrator = \"dop853\"";
    for (run, line, words) in [
        ("integrator = \"taylor\"\nformulation = \"report\"", 12, ["formulation", "taylor"]),
        ("integrator = \"taylor\"\npath = \"generated\"", 12, ["path", "power series"]),
        ("path = \"generated\"\nformulation = \"recursive\"", 11, ["path", "library code"]),
    ] {
        refused(SCENE, integrator, run, line, &words);
    }
    for run in ["integrator = \"taylor\"\npath = \"auto\"", "formulation = \"recursive\""] {
        assert_eq!(errors(SCENE, &STUDY.replace(integrator, run)), []);
    }
}

#[test]
fn options_of_pulses_are_refused_where_nothing_latches() {
    let scene = SCENE.replace("mass = 3.0", "mass = 3.0\npulse_constant = 0.01");
    let run = "samples = 10\nhinge_loads = true\namplification = 1.5";
    assert_eq!(errors(&scene, &STUDY.replace("samples = 10", run)), []);
    let unlatched = scene.replace("latch_deg = 0.0\n", "");
    let study = STUDY
        .replace("lock_time of boom", "final omega_x")
        .replace("failed_latch = [\"boom\"]\n", "")
        .replace("samples = 10", run);
    let [(14, told)] = &errors(&unlatched, &study)[..] else {
        panic!("{:#?}", errors(&unlatched, &study))
    };
    assert!(told.contains("amplification") && told.contains("no hinge latches"), "{told}");
}

#[test]
fn a_scene_that_is_no_file_is_told_once() {
    let wrong = STUDY.replace("\"scene.toml\"", "\"../.\"");
    let [(1, told)] = &errors(SCENE, &wrong)[..] else { panic!("one error") };
    assert_eq!(told.matches("found").count(), 1, "{told}");
    assert!(told.contains("a directory or a device"), "{told}");
}

#[test]
fn parameters_of_a_scene_that_is_written_out_are_gone() {
    let wrong = STUDY.replace("name = \"all of it\"", "name = \"it\"\nexpanded = true");
    let found = errors(SCENE, &wrong);
    let is_it = |(line, told): &(usize, String)| *line == 18 && told.contains("`expanded = true`");
    assert!(found.iter().any(is_it), "{found:#?}");
}

#[test]
fn bytes_that_are_not_utf_8_are_told_with_their_line() {
    let place = place(STUDY);
    let path = place.path().join("study.toml");
    let mut bytes = STUDY.replace("name = \"late\"", "name = \"cass").into_bytes();
    let at = bytes.windows(4).position(|bytes| bytes == b"cass").expect("it is there") + 4;
    bytes.splice(at..at, [0xe9, b'"']);
    fs::write(&path, bytes).expect("writable");
    let told = Study::read(&path).expect_err("Latin-1").to_string();
    assert!(told.contains("study.toml:36: found the byte 0xE9"), "{told}");
    assert!(told.contains("UTF-8"), "{told}");
}
