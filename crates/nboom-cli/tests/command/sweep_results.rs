//! What a sweep says of its results.

use std::fs;

use serde_json::Value;

use crate::sweeps::{cases, run_shard, sweep};
use crate::{BOOM, Place, code, stderr, stdout};

/// Two panels on `+x` and `-x`, from rest.
const PANELS: &str = r#"
[run]
end = 3.0

[main_body]
mass = 10.0
inertia = [1.0, 1.0, 1.0]

[[body]]
name = "panel +x"
mass = 1.0
mass_centre = [0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1]
hinge = { at = [0.2, 0.0, 0.0], axis = "y", start_deg = 90.0, latch_deg = 0.0, spring = { stiffness = 0.5 } }

[[body]]
name = "panel -x"
mass = 1.0
mass_centre = [-0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1]
hinge = { at = [-0.2, 0.0, 0.0], axis = "-y", start_deg = 90.0, latch_deg = 0.0, spring = { stiffness = 0.5 } }
"#;

#[test]
fn names_that_differ_in_a_sign_have_columns_of_their_own_and_no_momentum_has_no_nutation() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let vary =
        "[[vary]]\nname = 'hub'\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    place.write("study.toml", &format!("scene = 'panels.toml'\ndraws = 9\n{vary}"));
    sweep(&place, &["--no-report"]);
    for case in cases(&place, "out/study") {
        let [first, second] = ["lock_time_of_1_1", "lock_time_of_2_1"].map(|name| &case[name]);
        assert!(!first.is_empty() && first == second, "they mirror each other: {case:?}");
        assert_eq!(case["final_nutation"], "", "rounding has no direction");
    }
}

#[test]
fn the_worst_margins_are_the_smallest() {
    let place = Place::new();
    let study = "scene = 'four.toml'\ndraws = 12\nresults = ['verdict.smallest_margin']\n";
    let vary = "[[vary]]\nname = 'root'\npath = 'parameters.damping'\nas = 'factor'\nuniform = { from = 0.05, to = 1.6 }\n";
    place.write("four.toml", include_str!("../../../../examples/solar-array.toml"));
    place.write("study.toml", &format!("{study}{vary}"));
    let output = place.nboom(&["sweep", "study.toml", "--csv"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let mut margins: Vec<(f64, String)> = cases(&place, "out/study")
        .iter()
        .map(|case| {
            (case["verdict_smallest_margin"].parse().expect("a margin"), case["case"].clone())
        })
        .collect();
    margins.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (margin, case) in &margins[..5] {
        let page = place.path("out/study/worst").join(format!("case-{case}/report.html"));
        assert!(page.is_file(), "{margin} of case {case} is among the worst: {margins:?}");
    }
    let is_told = stderr(&output).contains(&format!("in case {}", margins[0].1));
    assert_eq!(is_told, margins[0].0 < 0.0, "{}", stderr(&output));
}

/// A yield stress that no station stays below, in any case.
#[test]
fn warnings_of_runs_for_pages_name_their_cases() {
    let place = Place::new();
    let scene = include_str!("../../../../examples/solar-array.toml");
    let weak = scene.replace("yield_stress = 2.7e8", "yield_stress = 2.7e3");
    assert_ne!(weak, scene);
    place.write("four.toml", &weak);
    let study = "scene = 'four.toml'\ndraws = 4\nresults = ['verdict.smallest_margin']\n";
    let vary = "[[vary]]\nname = 'root'\npath = 'parameters.damping'\nas = 'factor'\nuniform = { from = 0.9, to = 1.1 }\n";
    place.write("study.toml", &format!("{study}{vary}"));
    let output = place.nboom(&["sweep", "study.toml"]);
    let told = stderr(&output);
    let of_margins: Vec<_> = told.lines().filter(|line| line.contains("margin")).collect();
    assert!(of_margins.len() > 1, "{told}");
    assert!(of_margins.iter().all(|line| line.contains("case ")), "{told}");
}

/// A pulse as short as that has a peak beyond all numbers, which rows of lock-up times do not see.
#[test]
fn a_case_whose_page_has_no_loads_is_told_and_the_sweep_goes_on() {
    let place = Place::new();
    let scene = include_str!("../../../../examples/solar-array.toml");
    let sharp: Vec<&str> = scene
        .lines()
        .map(
            |line| {
                if line.starts_with("pulse_constant") { "pulse_constant = 1e-310" } else { line }
            },
        )
        .collect();
    place.write("four.toml", &sharp.join("\n"));
    let study = "scene = 'four.toml'\ndraws = 2\nresults = ['lock_time of 1,1']\n";
    let vary = "[[vary]]\nname = 'root'\npath = 'parameters.damping'\nas = 'factor'\nuniform = { from = 0.9, to = 1.1 }\n";
    place.write("study.toml", &format!("{study}{vary}"));
    let output = place.nboom(&["sweep", "study.toml", "--csv"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for case in ["1", "2"] {
        let told = format!("warning: case {case} has no whole page: at time ");
        assert!(stderr(&output).contains(&told), "{}", stderr(&output));
    }
    assert!(cases(&place, "out/study").iter().all(|case| case["status"] == "ok"));
    assert!(place.path("out/study/report.html").is_file());
}

/// A case alone is judged by the factors of its study, too.
#[test]
fn a_case_has_the_margins_that_it_had_in_the_sweep() {
    let place = Place::new();
    place.write("four.toml", include_str!("../../../../examples/solar-array.toml"));
    let study = "scene = 'four.toml'\ndraws = 1\nresults = ['verdict.smallest_margin']\n\
                 [run]\nsafety_factor = 1.4\namplification = 1.7\npulses = 'all-at-once'\nyield_stress = 2e8\n";
    let vary = "[[vary]]\nname = 'root'\npath = 'parameters.damping'\nas = 'factor'\nuniform = { from = 0.9, to = 1.1 }\n";
    place.write("study.toml", &format!("{study}{vary}"));
    sweep(&place, &["--no-report"]);
    let margin = cases(&place, "out/study")[0]["verdict_smallest_margin"].clone();
    let output = place.nboom(&["run", "study.toml", "--case", "1", "-o", "alone", "--quiet"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let summary = fs::read_to_string(place.path("alone/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
    let alone = summary["verdict"]["smallest_margin"].as_f64().expect("a margin");
    assert_eq!(alone, margin.parse::<f64>().expect("a margin"));
    // Without stresses they act on nothing, and the study does not ask the user to leave them out.
    let bare = ["run", "study.toml", "--case", "1", "-o", "bare", "--quiet", "--no-stresses"];
    let output = place.nboom(&bare);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // Loads of hinges take what acts on pulses.
    let of_hinges = study.replace("[run]\n", "[run]\nhinge_loads = true\n");
    place.write("study.toml", &format!("{of_hinges}{vary}"));
    let output = place.nboom(&bare.map(|word| if word == "bare" { "hinges" } else { word }));
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let record = fs::read_to_string(place.path("hinges/run.json")).expect("a record");
    let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
    let options = &record["options"];
    assert_eq!(options["amplification"], "1.7");
    assert_eq!(options["pulses"], "all-at-once");
    assert_eq!(options["safety-factor"], serde_json::Value::Null);
    place.write(
        "study.toml",
        &format!("scene = 'four.toml'\ndraws = 1\n[run]\nstresses = false\n{vary}"),
    );
    let output = place.nboom(&["run", "study.toml", "--case", "1", "--yield-stress", "1e8"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("--yield-stress has no effect"), "{}", stderr(&output));
}

#[test]
fn warnings_of_the_scene_are_told_once() {
    let place = Place::new();
    let late = PANELS.replacen("axis = \"y\"", "axis = \"y\", release = { at = 9.0 }", 1);
    place.write("panels.toml", &late);
    let vary = "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    place.write("study.toml", &format!("scene = 'panels.toml'\ndraws = 9\n{vary}"));
    let told = stderr(&sweep(&place, &["--quiet", "--no-report"]));
    let expected = "released at 9.0, after the end of the run";
    assert_eq!(told.matches(expected).count(), 1, "{told}");
    // Of a deck also what the scene that is made of it does not say.
    let deck = BOOM.replace("&ROCK\n", "&ROCK\n HZO=0.01,EU1=1.0E-6,\n").replace("0.25", "9.0");
    place.write("boom.nml", &deck);
    place.write("study.toml", &format!("scene = 'boom.nml'\ndraws = 2\n{vary}"));
    let told = stderr(&sweep(&place, &["-o", "deck", "--no-report"]));
    for expected in [expected, "note: left out: HZO, EU1"] {
        assert_eq!(told.matches(expected).count(), 1, "{told}");
    }
}

#[test]
fn warnings_are_judged_by_the_end_that_the_runs_have() {
    let place = Place::new();
    let late = PANELS.replacen("axis = \"y\"", "axis = \"y\", release = { at = 0.5 }", 1);
    place.write("panels.toml", &late);
    let vary = "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    let fault = "[[fault]]\nname = 'late'\nlate_release = { hinge = '1,1', by = 0.25 }\n";
    for (end_time, as_it_stands, with_fault) in
        [("0.4", true, true), ("0.7", false, true), ("0.8", false, false)]
    {
        let run = format!("[run]\nend_time = {end_time}\n");
        let study = format!("scene = 'panels.toml'\ndraws = 2\n{run}{vary}{fault}");
        place.write("study.toml", &study);
        let told = stderr(&sweep(&place, &["--quiet", "--no-report", "-o", end_time]));
        let after =
            |release| format!("released at {release}, after the end of the run at {end_time}");
        let found = ["0.5", "0.75"].map(|release| told.contains(&after(release)));
        assert_eq!(found, [as_it_stands, with_fault], "{told}");
        let run = place.nboom(&["run", "panels.toml", "--end-time", end_time]);
        assert_eq!(stderr(&run).contains(&after("0.5")), as_it_stands, "{}", stderr(&run));
    }
}

#[test]
fn what_a_fault_makes_of_the_scene_and_loads_without_latches_are_told_before() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let vary = "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    let fault = "[[fault]]\nname = 'much too late'\nlate_release = { hinge = '1,1', by = 200.0 }\n";
    let loads = "results = ['peak_moment of 1,1']\n[run]\nhinge_loads = true\n";
    let late = PANELS.replacen("axis = \"y\"", "axis = \"y\", release = { at = 0.5 }", 1);
    place.write("late.toml", &late);
    for (scene, loads, fault, expected) in [
        ("late.toml", "", fault, "warning: with much too late: hinge 1,1"),
        (
            "panels.toml",
            loads,
            "",
            "warning: loads are without pulses of latches and stops, which need pulse_constant of each body they act on",
        ),
    ] {
        place.write("study.toml", &format!("scene = '{scene}'\ndraws = 2\n{loads}{vary}{fault}"));
        let told =
            stderr(&sweep(&place, &["--quiet", "--no-report", "-o", &format!("{scene} with")]));
        assert_eq!(told.matches(expected).count(), 1, "{told}");
        place.write("study.toml", &format!("scene = '{scene}'\ndraws = 2\n{vary}"));
        let told =
            stderr(&sweep(&place, &["--quiet", "--no-report", "-o", &format!("{scene} without")]));
        assert!(!told.contains(expected), "{told}");
    }
}

#[test]
fn a_pulse_constant_that_only_some_latches_have_is_told_once_with_its_place() {
    let place = Place::new();
    let some = PANELS.replacen("mass = 1.0", "mass = 1.0\npulse_constant = 0.001", 1);
    place.write("panels.toml", &some);
    let vary = "[[vary]]\npath = 'main_body.mass'\nuniform = { from = 9.0, to = 11.0 }\n";
    let loads = "results = ['peak_moment of 1,1']\n[run]\nhinge_loads = true\n";
    place.write("study.toml", &format!("scene = 'panels.toml'\ndraws = 2\n{loads}{vary}"));
    let told = stderr(&sweep(&place, &["--quiet", "--no-report"]));
    let found: Vec<&str> = told.lines().filter(|line| line.contains("pulse_constant")).collect();
    let second = some.lines().position(|line| line.contains("panel -x")).expect("a body");
    // The table of a body begins one line above its name; lines count from 1.
    let expected = format!("panels.toml:{second}:");
    assert!(found.len() == 1 && found[0].contains(&expected), "{told}");
}

#[test]
fn a_sweep_that_grows_keeps_its_tables() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let study = |draws| {
        format!(
            "scene = 'panels.toml'\ndraws = {draws}\n[[vary]]\npath = 'main_body.mass'\nuniform = {{ from = 9.0, to = 11.0 }}\n"
        )
    };
    place.write("study.toml", &study(4));
    sweep(&place, &["--no-report"]);
    place.write("study.toml", &study(6));
    let output = place.nboom(&["sweep", "study.toml", "--no-report", "--resume"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(cases(&place, "out/study").len(), 6);
}

#[test]
fn a_run_of_a_case_says_of_which_study_case_and_fault_it_is() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let vary = "[[vary]]\nname = 'k'\npath = 'body.panel +x.hinge.spring.stiffness'\nvalues = [0.3, 0.4]\n";
    let fault = "[[fault]]\nname = 'one spring out'\nbroken_spring = ['1,1']\n";
    let study = "scene = 'panels.toml'\ndraws = 1\nresults = ['lock_time of 1,1']\n";
    place.write("wings.toml", &format!("{study}{vary}{fault}"));
    for (case, name) in [("1", "wings, case 1"), ("2", "wings, case 2, one spring out")] {
        let output = place.nboom(&["run", "wings.toml", "--case", case, "-o", case]);
        let (told, page) =
            (stdout(&output), fs::read_to_string(place.path(case).join("report.html")));
        assert!(told.starts_with(&format!("{name}: ")), "{told}");
        assert!(page.expect("a page").contains(&format!("<title>{name}</title>")), "{name}");
    }
    // The page takes its heading from here.
    let summary = fs::read_to_string(place.path("2/summary.json")).expect("a file");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    assert_eq!(summary["scene"], "wings, case 2, one spring out");
}

/// A stiffer spring closes the latch sooner, so a bound on the time is one on the spring.
#[test]
fn requirements_are_counted_and_cases_that_break_them_have_pages() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let study = "scene = 'panels.toml'\ndraws = 20\nresults = ['lock_time of 1,1', 'final omega_x', 'impulse of 1,1']\n\
                 [[vary]]\nname = 'k'\npath = 'body.panel +x.hinge.spring.stiffness'\nuniform = { from = 0.3, to = 0.9 }\n\
                 [[requirement]]\nresult = 'lock_time of 1,1'\nat_most = TIME\n\
                 [[requirement]]\nresult = 'impulse of 1,1'\nat_least = -1e9\nat_most = 1e9\n";
    place.write("study.toml", &study.replace("TIME", "99.0"));
    sweep(&place, &["--no-report"]);
    let mut times: Vec<(f64, String)> = cases(&place, "out/study")
        .iter()
        .map(|case| (case["lock_time_of_1_1"].parse().expect("a time"), case["case"].clone()))
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(times[0].0 < times[19].0);
    place.write("study.toml", &study.replace("TIME", &times[13].0.to_string()));
    let output = place.nboom(&["sweep", "study.toml", "--csv", "-o", "bounded"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // Wilson's interval of 14 of 20.
    let line = format!(
        "lock_time of 1,1 [T] at most {} is met in 14 of 20 cases: 0.4810 to 0.8545",
        times[13].0
    );
    let told = stdout(&output);
    assert!(told.lines().any(|told| told == line), "{line}\n{told}");
    assert!(
        told.contains("all requirements are met in 14 of 20 cases: 0.4810 to 0.8545"),
        "{told}"
    );
    assert!(
        told.contains(
            "impulse of 1,1 [F L T] at least -1000000000 and at most 1000000000 is met in 20 of 20"
        ),
        "{told}"
    );
    for (_, case) in &times[16..] {
        let page = place.path("bounded/worst").join(format!("case-{case}/report.html"));
        assert!(page.is_file(), "the latest are the worst, also case {case}");
    }
}

#[test]
fn a_latch_that_does_not_close_in_half_of_the_cases_locks_never() {
    let place = Place::new();
    place.write("panels.toml", PANELS);
    let vary = "[[vary]]\nname = 'spring'\npath = 'body[1].hinge.spring.stiffness'\nvalues = [0.5, 1e-6]\n";
    let results = "results = ['lock_time of 1,1', 'lock_time of 2,1', 'impulse of 1,1']\n";
    place.write("study.toml", &format!("scene = 'panels.toml'\ndraws = 40\n{results}{vary}"));
    let told = stdout(&sweep(&place, &["--no-report"]));
    let row = |hinge: &str| {
        let start = format!("lock_time of {hinge} ");
        told.lines().find(|line| line.starts_with(&start)).expect("a row").to_owned()
    };
    assert!(row("1,1").contains("never"), "{told}");
    assert!(!row("2,1").contains("never"), "{told}");
    // An impulse that never comes is no number, and is told to be none.
    let line = |start: &str| told.lines().find(|line| line.starts_with(start)).expect("a line");
    let latched = line("1,1 latches in ").split(' ').nth(3).expect("a count");
    assert!(line("impulse of 1,1").contains(&format!(", {latched} of 40 cases  ")), "{told}");
    assert!(!row("1,1").contains("of 40 cases"), "{told}");
}

/// A table of forces that rises beyond its last point drives a slide out ever faster.
const RUNAWAY: &str = "[run]\nend = 3.0\n[parameters]\npush = 1.0\n[main_body]\nmass = 100.0\n\
    inertia = [40.0, 30.0, 20.0]\n[[body]]\nname = 'mast'\nmass = 2.0\nmass_centre = [0.0, 1.0, 0.0]\n\
    inertia = [1.0, 0.1, 1.0]\n[body.slide]\nat = [0.0, 1.0, 0.0]\naxis = 'y'\nstart = 0.1\n\
    force = [[0.0, 0.0], [0.1, '$push']]\n";

#[test]
fn cases_that_run_away_are_counted_and_told() {
    let place = Place::new();
    place.write("mast.toml", RUNAWAY);
    let vary = "[[vary]]\npath = 'parameters.push'\nvalues = [0.1, 5.0, 6.0]\n";
    place.write("study.toml", &format!("scene = 'mast.toml'\nmethod = 'grid'\n{vary}"));
    let output = sweep(&place, &["-o", "out", "--no-report", "--quiet"]);
    let told = "warning: the motion runs away in 2 of 3 cases that ran, first in case 2\n";
    assert!(stderr(&output).ends_with(told), "{}", stderr(&output));
    let found = cases(&place, "out");
    let statuses: Vec<_> = found.iter().map(|case| case["status"].as_str()).collect();
    assert_eq!(statuses, ["ok", "ok, runs away", "ok, runs away"]);
}

/// With such an absolute tolerance the laws of conservation are off by more than a thousandth.
const POOR: &str = "scene = 'cubesat.toml'\ndraws = 3\nresults = ['final omega_x']\n\
    [run]\nintegrator = 'taylor'\natol = 1e-3\n\
    [[vary]]\npath = 'main_body.mass'\nuniform = { from = 3.0, to = 5.0 }\n";

#[test]
fn cases_whose_conservation_is_poor_are_counted_and_told() {
    let place = Place::new();
    place.write("cubesat.toml", include_str!("../../../../examples/cubesat.toml"));
    place.write("study.toml", POOR);
    let told = "warning: poor conservation in 3 of 3 cases that ran, first in case 1; do not trust";
    let output = sweep(&place, &["-o", "whole", "--no-report", "--quiet"]);
    assert!(stderr(&output).starts_with(told), "{}", stderr(&output));
    for part in ["1/2", "2/2"] {
        run_shard(&place, &part[..1], part);
    }
    let merged = place.nboom(&["merge", "1", "2", "-o", "merged", "--csv", "--no-report"]);
    assert!(stderr(&merged).starts_with(told), "{}", stderr(&merged));
    for directory in ["whole", "merged"] {
        for case in cases(&place, directory) {
            assert_eq!(case["status"], "ok, poor conservation");
            assert!(!case["final_omega_x"].is_empty());
        }
        let text = fs::read_to_string(place.path(directory).join("statistics.json"));
        let found: serde_json::Value = serde_json::from_str(&text.expect("it")).expect("JSON");
        let counts = &found["counts"];
        assert_eq!([&counts["ok"], &counts["poor"], &counts["first_poor"]], [3, 3, 1]);
    }
    place.write("study.toml", &POOR.replace("atol", "rtol"));
    let output = sweep(&place, &["-o", "good", "--no-report"]);
    assert_eq!(stderr(&output), "");
}
