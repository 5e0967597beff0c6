use std::fs;

use nboom_report::{Gap, ReportError, Run};
use tempfile::TempDir;

use crate::directory::Chain;

fn whole() -> TempDir {
    Chain { segments: 2, samples: 20, stations: 1 }.write()
}

/// The gaps of a run in which a file is another; without a text it is missing.
fn gaps_with(file: &str, text: Option<&str>) -> Vec<String> {
    let place = whole();
    let path = place.path().join(file);
    match text {
        Some(text) => fs::write(path, text).expect("writable"),
        None => fs::remove_file(path).expect("it is there"),
    }
    let run = Run::read(place.path()).expect("still a run");
    let told = run.gaps().iter().map(ToString::to_string).collect();
    // There is a page, and it names them.
    let page = nboom_report::page(vec![run]);
    assert!(page.contains("\"gaps\":["));
    told
}

#[test]
fn a_whole_run_has_no_gap() {
    let run = Run::read(whole().path()).expect("a run");
    assert!(run.gaps().is_empty(), "{:?}", run.gaps());
}

#[test]
fn missing_files_are_named_with_what_they_show() {
    for (file, shows) in [
        ("states.csv", "states.csv is missing, so there is no motion"),
        ("scene.toml", "scene.toml is missing, so there is no picture"),
        ("summary.json", "summary.json is missing, so there is no verdict"),
        ("events.csv", "events.csv is missing, so there is no table of events"),
        ("ledger.csv", "ledger.csv is missing, so there is no ledger of energy"),
    ] {
        assert_eq!(gaps_with(file, None), [shows]);
    }
    for optional in ["stress.csv", "hinge_loads.csv", "instants.csv"] {
        assert_eq!(gaps_with(optional, None), [""; 0], "{optional}");
    }
}

#[test]
fn tables_that_are_cut_off_are_shown_as_far_as_they_go() {
    for file in ["states.csv", "ledger.csv", "hinge_loads.csv", "stress.csv", "events.csv"] {
        let place = whole();
        let text = fs::read_to_string(place.path().join(file)).expect("a table");
        let cut = &text[..text.len() - 7];
        let told = gaps_with(file, Some(cut));
        let lines = text.lines().count();
        let expected = format!(
            "{file}, line {lines}: the line is cut off; this row and those after it are left out"
        );
        assert_eq!(told, [expected]);
    }
}

#[test]
fn what_is_no_table_and_no_json_is_named() {
    for (file, text, part) in [
        ("states.csv", "", "states.csv, line 1: the column t is missing"),
        ("states.csv", "a,b\n", "states.csv, line 1: the column t is missing"),
        ("states.csv", "t,beta_1_1\n0.0,1.0\n", "scene.toml has 2 joints and states.csv has 1"),
        ("summary.json", "{\"scene\": ", "summary.json is not what a run writes"),
        ("summary.json", "[]", "summary.json is not what a run writes: it has no keys"),
        ("scene.toml", "name = 7", "scene.toml cannot be read, so there is no picture"),
        ("events.csv", "t,kind\n", "events.csv, line 1: the column appendage is missing"),
        ("stress.csv", "t\n", "stress.csv, line 1: the column event is missing"),
    ] {
        let told = gaps_with(file, Some(text));
        assert!(told.iter().any(|gap| gap.contains(part)), "{file}: {told:?}");
    }
    let place = whole();
    fs::write(place.path().join("states.csv"), b"t,a\n\xff\xfe,1\n").expect("writable");
    let run = Run::read(place.path()).expect("a run");
    assert!(
        run.gaps().iter().any(|gap| matches!(gap, Gap::Row { line: 2, .. })),
        "{:?}",
        run.gaps()
    );
}

#[test]
fn runs_of_other_versions_are_shown_with_a_note() {
    let place = whole();
    let path = place.path().join("summary.json");
    let text = fs::read_to_string(&path).expect("a summary");
    fs::write(&path, text.replace(env!("CARGO_PKG_VERSION"), "0.0.1")).expect("writable");
    let run = Run::read(place.path()).expect("a run");
    assert!(matches!(run.gaps(), [Gap::Version { .. }]));
}

#[test]
fn what_is_no_directory_of_a_run_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let refused =
        Run::read(&place.path().join("nowhere")).map(|_| ()).expect_err("nothing is there");
    assert!(matches!(refused, ReportError::NoDirectory { .. }), "{refused}");
    let run = place.path().join("run");
    fs::create_dir(&run).expect("writable");
    let refused = Run::read(&run).map(|_| ()).expect_err("it is empty");
    assert!(matches!(refused, ReportError::NothingOfARun { has_partial: false, .. }), "{refused}");
    fs::create_dir(place.path().join("run.partial")).expect("writable");
    let refused = Run::read(&run).map(|_| ()).expect_err("it is empty").to_string();
    assert!(refused.contains("unfinished results are in"), "{refused}");
}

#[test]
fn of_very_many_loads_the_largest_are_shown() {
    let place = whole();
    let mut text =
        "t,event,appendage,segment,event_appendage,event_segment,quantity,magnitude\n".to_owned();
    // Loads grow along the boom, in newtons much more than in newton-metres.
    for segment in 1..=4000 {
        text += &format!(
            "1.0,,1,{segment},,,force,{segment}.0\n1.0,,1,{segment},,,moment,0.{segment:04}\n"
        );
    }
    fs::write(place.path().join("hinge_load_envelope.csv"), text).expect("writable");
    let run = Run::read(place.path()).expect("a run");
    let told: Vec<String> = run.gaps().iter().map(ToString::to_string).collect();
    let expected = "hinge_load_envelope.csv has more than 5000 rows; those with the smallest loads are left out";
    assert_eq!(told, [expected]);
    let rows = run.hinge_envelope();
    assert_eq!(rows.len(), 5000);
    assert!(rows.iter().all(|row| row.segment > 1500), "the upper 2500 of both kinds");
}

#[test]
fn files_that_the_summary_lists_and_that_are_gone_are_named() {
    let place = whole();
    let path = place.path().join("summary.json");
    let text = fs::read_to_string(&path).expect("a summary");
    let listed =
        r#""files": ["states.csv", "stress.csv", "ledger.csv", "../elsewhere.csv"], "complete""#;
    fs::write(&path, text.replacen("\"complete\"", listed, 1)).expect("writable");
    for file in ["stress.csv", "ledger.csv"] {
        fs::remove_file(place.path().join(file)).expect("it is there");
    }
    let run = Run::read(place.path()).expect("a run");
    let told: Vec<String> = run.gaps().iter().map(ToString::to_string).collect();
    let expected = [
        "ledger.csv is missing, so there is no ledger of energy",
        "stress.csv is missing, though summary.json has it among the files of the run",
    ];
    assert_eq!(told, expected);
}
