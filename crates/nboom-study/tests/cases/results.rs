use nboom_model::HingeState;
use nboom_sim::{EventKind, Options, Snapshot};
use nboom_strength::{HingeQuantity, Loads};
use nboom_study::{Study, Value, Wanted};

use super::witness::{self, Witness};
use super::{cell, complete, example, row, study};

fn number(study: &Study, row: &nboom_study::Row, column: &str) -> f64 {
    match cell(study, row, column) {
        Value::Number(number) => *number,
        Value::Integer(number) => *number as f64,
        other => panic!("{column}: {other:?}"),
    }
}

fn last(witness: &Witness, kind: EventKind, hinge: usize) -> nboom_sim::Event {
    let is_it = |event: &&nboom_sim::Event| event.kind == kind && event.hinge == Some(hinge);
    *witness.events.iter().rfind(is_it).expect("it happens")
}

/// The largest of a number over output times and both sides of instants.
fn largest(witness: &Witness, of: fn(&Snapshot) -> f64) -> f64 {
    witness.samples.iter().chain(&witness.sides).map(of).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn results_of_the_motion_are_those_of_a_run_of_its_own() {
    let study = study(
        "motion",
        &example("cubesat.toml"),
        r#"results = ["lock_time of x panel 1", "release_time of y panel 2", "impulse of 2,1",
            "state of x panel 2", "final omega_z", "largest tau of x panel 1",
            "smallest tau_1_1", "final nutation", "largest state of y panel 1",
            "verdict.hinges[3].angle", "steps_accepted", "conservation.energy", "samples",
            "parameters.stiffness", "miss of x panel 1"]
        [[vary]]
        name = "spring"
        path = "parameters.stiffness"
        values = [0.02, 0.031]"#,
    );
    let row = complete(row(&study, 2));
    let slot = study.document.slot("parameters.stiffness").expect("a number");
    let file = study.document.scene(&[(&slot, 0.031)]).expect("right");
    let (witness, summary, _, _) = witness::run(&file, Options::default());
    let number = |column: &str| number(&study, &row, column);
    assert_eq!(number("spring"), 0.031);
    assert_eq!(number("lock_time_of_x_panel_1"), last(&witness, EventKind::LockUp, 0).time);
    assert_eq!(number("release_time_of_y_panel_2"), last(&witness, EventKind::Release, 3).time);
    let impulse = last(&witness, EventKind::LockUp, 1).impulse;
    assert_eq!(Some(number("impulse_of_2_1")), impulse);
    assert_eq!(number("state_of_x_panel_2"), 1.0);
    assert_eq!(summary.verdict.hinges[1].state, HingeState::Locked);
    let end = witness.samples.last().expect("an end");
    assert_eq!(
        (number("final_omega_z"), number("final_nutation")),
        (end.omega_body.z, end.nutation)
    );
    assert_eq!(number("largest_tau_of_x_panel_1"), largest(&witness, |s| s.tau[0]));
    assert_eq!(number("smallest_tau_1_1"), -largest(&witness, |s| -s.tau[0]));
    assert_eq!(number("largest_state_of_y_panel_1"), 1.0);
    assert_eq!(number("verdict_hinges_3_angle"), summary.verdict.hinges[2].angle);
    assert_eq!(number("steps_accepted"), summary.steps_accepted as f64);
    assert_eq!(number("conservation_energy"), summary.conservation.energy);
    assert_eq!((number("samples"), number("parameters_stiffness")), (500.0, 0.031));
    assert_eq!(number("miss_of_x_panel_1"), 0.0);
}

#[test]
fn a_hinge_that_turns_back_has_a_miss() {
    // Against its spring the boom comes to rest at the angle at which the spring has all of its energy.
    let scene = example("boom.toml");
    let study = study(
        "miss",
        &scene,
        r#"results = ["miss of 1,1", "verdict.hinges[1].miss", "verdict.hinges[1].miss_time", "state of 1,1"]
        [[vary]]
        name = "lock"
        path = "body.boom.hinge.latch_deg"
        values = [-200.0, 0.0]"#,
    );
    let row = complete(row(&study, 1));
    let slot = study.document.slot("body.boom.hinge.latch_deg").expect("a number");
    let file = study.document.scene(&[(&slot, -200.0)]).expect("right");
    let (witness, summary, _, _) = witness::run(&file, Options::default());
    let number = |column: &str| number(&study, &row, column);
    let nearest = largest(&witness, |s| -s.beta[0]);
    let miss = summary.verdict.hinges[0].miss.expect("it does not lock");
    assert_eq!(number("state_of_1_1"), 0.0);
    assert_eq!([number("miss_of_1_1"), number("verdict_hinges_1_miss")], [miss.by; 2]);
    assert_eq!(number("verdict_hinges_1_miss_time"), miss.time);
    // Of 500 output times the nearest is as near as the motion is flat.
    let lock = 200.0_f64.to_radians();
    assert!((miss.by - (lock - nearest)).abs() < 1e-3 && miss.by <= lock - nearest, "{miss:?}");
}

#[test]
fn results_of_loads_are_those_of_a_run_of_its_own() {
    let hinges = ["1,1", "1,2", "2,1", "2,2"];
    let words = ["peak_force", "peak_moment", "peak_stress"];
    let texts = words.iter().flat_map(|word| hinges.map(|hinge| format!("\"{word} of {hinge}\"")));
    let texts: Vec<String> = texts.chain(["\"verdict.worst_load\"".to_owned()]).collect();
    let text = format!("results = [{}]\nrun.end_time = 0.5", texts.join(", "));
    let study = study("loads", &example("n-boom-1970.nml"), &text);
    let row = complete(row(&study, 1));
    let deck = nboom_io::read_scene(example("n-boom-1970.nml").as_ref()).expect("a deck");
    let scene = deck.scene.ending_at(0.5).expect("a time");
    let file = nboom_io::SceneFile { scene, ..deck };
    let (_, _, worst, _) = witness::run(&file, Options::default());
    let number =
        |word: &str, [k, i]: [usize; 2]| number(&study, &row, &format!("{word}_of_{k}_{i}"));
    for label in file.scene.labels() {
        let magnitude = |quantity: HingeQuantity| {
            let mut of_hinge = worst.hinges.iter().filter(|w| w.hinge.numbers() == label.numbers());
            of_hinge.find(|worst| worst.quantity == quantity).expect("loads").magnitude()
        };
        let found = ["peak_force", "peak_moment"].map(|word| number(word, label.numbers()));
        assert_eq!(found, HingeQuantity::ALL.map(magnitude), "{label}");
        let stations = worst.stations.iter().filter(|w| w.segment.numbers() == label.numbers());
        let stress = stations.map(|w| w.max_von_mises.stress.von_mises()).fold(0.0, f64::max);
        assert_eq!(number("peak_stress", label.numbers()), stress, "{label}");
    }
    let largest = hinges.map(|hinge| {
        super::cell(&study, &row, &format!("peak_stress_of_{}", hinge.replace(',', "_"))).clone()
    });
    assert!(largest.contains(super::cell(&study, &row, "verdict_worst_load")), "{largest:?}");
}

/// The paths of all numbers in a JSON value.
fn numbers(value: &serde_json::Value, path: String, out: &mut Vec<(String, f64)>) {
    match value {
        serde_json::Value::Number(number) => {
            out.push((path, number.as_f64().expect("a double")));
        }
        serde_json::Value::Array(list) => {
            let inner = list.iter().zip(1..);
            inner.for_each(|(value, n)| numbers(value, format!("{path}[{n}]"), out));
        }
        serde_json::Value::Object(keys) => {
            let dot = if path.is_empty() { "" } else { "." };
            keys.iter().for_each(|(key, value)| numbers(value, format!("{path}{dot}{key}"), out));
        }
        _ => {}
    }
}

#[test]
fn every_number_of_the_summary_is_a_result() {
    // The wing has materials with yield stresses, the mast has slides.
    for scene in ["boom.toml", "n-boom-1970.nml", "mast.toml", "solar-array.toml"] {
        let file = nboom_io::SceneDocument::read(example(scene).as_ref(), &Default::default());
        let file = file.and_then(|document| document.scene(&[])).expect("an example");
        let (_, _, _, keys) = witness::run(&file, Options::default());
        let mut found = Vec::new();
        numbers(&keys, String::new(), &mut found);
        assert!(found.len() > 20);
        let (wall, found): (Vec<_>, Vec<_>) =
            found.into_iter().partition(|(path, _)| path == "wall_seconds");
        let loads = if file.structure.is_some() { Loads::Stations } else { Loads::None };
        let refused =
            Wanted::named(&wall[0].0, &file, loads).expect_err("it is no number of a table");
        assert!(refused.to_string().contains("the same each time"), "{refused}");
        let texts: Vec<String> = found.iter().map(|(path, _)| format!("\"{path}\"")).collect();
        let text = format!("results = [{}]", texts.join(", "));
        let study = study(&format!("summary-{scene}"), &example(scene), &text);
        let row = complete(row(&study, 1));
        for (wanted, (path, number)) in study.wanted.iter().zip(&found) {
            assert_eq!(
                self::number(&study, &row, &wanted.column().name),
                *number,
                "{scene} {path}"
            );
        }
    }
}

#[test]
fn margins_are_those_of_the_strengths_of_materials() {
    let scene = std::fs::read_to_string(example("solar-array.toml")).expect("an example");
    assert!(scene.contains("yield_stress"), "the example has strengths");
    let path = super::folder("margins").join("scene.toml");
    std::fs::write(&path, scene).expect("writable");
    let file = nboom_io::read_scene(&path).expect("right");
    let (_, _, worst, _) = witness::run(&file, Options::default());
    let (weakest, margin, _) = worst.weakest().expect("a margin");
    let name = weakest.segment.name.as_deref().expect("a name");
    let text = format!("results = [\"margin of {name}\", \"verdict.smallest_margin\"]");
    let study = study("margins", "scene.toml", &text);
    let row = complete(row(&study, 1));
    let results = &row.cells[row.cells.len() - 3..row.cells.len() - 1];
    assert_eq!(results, [Value::Number(margin), Value::Number(margin)]);
}

/// 270 MPa are the yield stress of the example's one material.
#[test]
fn margins_are_judged_as_the_study_says() {
    let scene = std::fs::read_to_string(example("solar-array.toml")).expect("an example");
    assert!(scene.matches("yield_stress").count() == 1 && scene.contains("yield_stress = 2.7e8"));
    let path = super::folder("judged").join("scene.toml");
    std::fs::write(&path, &scene).expect("writable");
    let margin = |run: &str| {
        let text = format!("results = [\"verdict.smallest_margin\"]\n{run}");
        let study = study("judged", "scene.toml", &text);
        number(&study, &complete(row(&study, 1)), "verdict_smallest_margin")
    };
    let plain = margin("");
    for (run, share) in [
        ("[run]\nsafety_factor = 1.5", 1.0 / 1.5),
        ("[run]\nyield_stress = 1e8", 1e8 / 2.7e8),
        ("[run]\nyield_stress = 1e8\nsafety_factor = 1.5", 1e8 / 2.7e8 / 1.5),
    ] {
        let expected = share * (plain + 1.0) - 1.0;
        assert!((margin(run) - expected).abs() < 1e-14, "{run}: {} {expected}", margin(run));
    }
    // A strength that the scene does not have.
    let bare = scene.replace("yield_stress = 2.7e8", "");
    std::fs::write(&path, bare).expect("writable");
    assert_eq!(margin("[run]\nyield_stress = 2.7e8"), plain);
    std::fs::write(&path, scene).expect("writable");
    // Peaks of latches are taller.
    assert!(margin("[run]\namplification = 1.7") < plain);
}

#[test]
fn results_are_the_same_whether_loads_are_found_beside_them_or_not() {
    let results = "'lock_time of 1,1', 'impulse of 2,2', 'steps_accepted', 'final nutation', \
                   'conservation.energy', 'miss of 2,1', 'largest omega_x'";
    let row_of = |more: &str| {
        let text = format!("results = [{results}{more}]");
        complete(row(&study("beside-loads", &example("n-boom-1970.nml"), &text), 1))
    };
    let [without, with] = ["", ", 'verdict.worst_load', 'evaluations'"].map(row_of);
    let (status, found) = without.cells.split_last().expect("a status");
    assert_eq!(found, &with.cells[..found.len()]);
    assert_eq!(Some(status), with.cells.last());
}

#[test]
fn the_largest_impulse_has_the_unit_of_those_of_the_hinges() {
    for scene in ["mast.toml", "wing.toml"] {
        let text = "results = ['impulse of 1,1', 'verdict.largest_impulse', \
                    'verdict.largest_impulse_at.impulse']";
        let study = study("unit-of-impulse", &example(scene), text);
        let units: Vec<_> = study.wanted.iter().map(|wanted| &wanted.column().unit).collect();
        assert!(units[0].is_some() && units.iter().all(|unit| *unit == units[0]), "{units:?}");
    }
}

#[test]
fn impulses_of_hinges_and_slides_have_no_common_column() {
    let body = |name: &str, joint: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 3.0\nmass_centre = [1.0, 0.0, 0.0]\n\
             inertia = [0.1, 1.0, 1.0]\n{joint}\n"
        )
    };
    let hinge = "hinge = { at = [0.5, 0.0, 0.0], axis = \"z\", start_deg = 90.0, latch_deg = 0.0 }";
    let slide = |latch: &str| format!("slide = {{ at = [0.0, 0.0, 0.5], axis = \"z\", {latch} }}");
    let named = |latch: &str, text: &str| {
        let text_of_scene = format!(
            "[run]\nend = 1.0\n[main_body]\nmass = 100.0\ninertia = [40.0, 30.0, 20.0]\n{}{}",
            body("boom", hinge),
            body("mast", &slide(latch))
        );
        let file = nboom_io::parse_scene("s.toml", &text_of_scene, "s", None, &Default::default());
        Wanted::named(text, &file.expect("right"), Loads::None)
    };
    for text in ["verdict.largest_impulse", "verdict.largest_impulse_at.impulse"] {
        let refused = named("latch = 0.5", text).expect_err("two units").to_string();
        assert!(refused.contains("`impulse of HINGE`"), "{refused}");
        let refused = named("stops = [0.0, 1.0]", text).expect_err("two units").to_string();
        assert!(refused.contains("latches or stops"), "{refused}");
        // A slide that never latches has no impulse.
        let unit = named("start = 0.1", text).expect("of the boom").column().unit.clone();
        assert_eq!(unit.as_deref(), Some("F L T"));
    }
    named("latch = 0.5", "verdict.largest_impulse_at.time").expect("a time is a time");
}
