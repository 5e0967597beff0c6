//! `nboom verify` and `nboom bench` as their users meet them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A main body with one boom.
const BOOM: &str = include_str!("decks/boom.nml");

/// The boom with four segments, all free from the start.
fn long_boom() -> String {
    let segments = "ELIK=4*2.0,EMIK=4*3.0,CNIK(1,2)=1.0,CNIK(2,2)=1.0,CNIK(3,2)=1.0,CNIK(4,2)=1.0,";
    let inertias = "HIIK=".to_owned() + &"1.1,3*0.0,0.05,3*0.0,1.1,".repeat(4);
    BOOM.replace("IXK=1", "IXK=4")
        .replace("NK=1", "NK=4")
        .replace("BETAIK=80.0,BSIK=0.0", "BETAIK=4*80.0,BSIK=4*1.0E30")
        .replace("ELIK=2.0,EMIK=3.0,HIIK=1.1,3*0.0,0.05,3*0.0,1.1,CNIK(1,2)=1.0,", segments)
        .replace(" EMM=100.0", &format!(" {inertias}\n EMM=100.0"))
        .replace("IREL=0,RELTB=0.25", "IREL=4*0,RELTB=4*0.0")
}

/// A scene of the benches: two booms of two segments, a chain and a paddle.
const S2_P: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/scenes/T1.nml");

/// Runs the binary in a directory that has a scene `boom.nml` with this text.
fn nboom_in(directory: &Path, deck: &str, args: &[&str]) -> Output {
    fs::write(directory.join("boom.nml"), deck).expect("writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
    command.current_dir(directory).args(args).output().expect("the binary starts")
}

fn nboom_on(deck: &str, args: &[&str]) -> Output {
    let directory = tempfile::tempdir().expect("a directory");
    nboom_in(directory.path(), deck, args)
}

fn nboom(args: &[&str]) -> Output {
    nboom_on(BOOM, args)
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("text")
}

#[test]
fn verify_compares_all_code_that_covers_the_scene() {
    let output = nboom(&["verify", "boom.nml", "--states", "20"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let table = stdout(&output);
    assert!(
        table.starts_with("boom: largest deviations in 20 random states from seed 1970"),
        "{table}"
    );
    for form in ["recursive", "report", "relative", "symmetric", "articulated", "momentum"] {
        let row = format!("generic    {form}");
        assert!(table.lines().any(|line| line.starts_with(&row)), "no {form} in {table}");
    }
    assert!(table.contains("\ngenerated  articulated"), "{table}");
    for words in ["\naccelerations, ", "\nmass matrix, ", "\nforcing, ", " from double-double "] {
        assert!(table.contains(words), "no {words:?} in {table}");
    }
    assert!(!table.contains("not covered"), "{table}");
}

#[test]
fn verify_and_bench_know_the_routine_that_a_run_embeds_the_scene_in() {
    let run = nboom_on(&long_boom(), &["check", "boom.nml"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    let text = stdout(&run);
    let reason = text.lines().find(|line| line.starts_with("code at the start: ")).expect("a line");
    let embedded = reason.contains("routine for 4xS4, 12 of 16 links virtual");
    // Without wide registers the recursion is quicker.
    assert!(embedded || reason.contains("no routine for topology S4"), "{reason}");
    for args in
        [&["verify", "boom.nml", "--states", "4"], &["bench", "boom.nml", "--seconds", "1e-3"]]
    {
        let table = stdout(&nboom_on(&long_boom(), args));
        assert_eq!(table.contains("  in 4xS4, 12 virtual links"), embedded, "{table}");
        assert_eq!(table.contains("not covered"), !embedded, "{table}");
    }
    let lines =
        stdout(&nboom_on(&long_boom(), &["bench", "boom.nml", "--harness", "--seconds", "1e-3"]));
    assert_eq!(lines.matches("nboom_generated_articulated ").count(), usize::from(embedded));
}

#[test]
fn verify_holds_hinges_in_half_of_the_states() {
    let directory = tempfile::tempdir().expect("a directory");
    let output =
        nboom_in(directory.path(), BOOM, &["verify", S2_P, "--states", "9", "-o", "t1.json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let table = stdout(&output);
    for words in ["all hinges free, 5 states", "random hinges held at random angles, 4 states"] {
        assert_eq!(table.matches(words).count(), 3, "no {words:?} in {table}");
    }
    let file = json(&directory.path().join("t1.json"));
    assert_eq!((&file["states"], &file["held"]), (&9.into(), &4.into()));
    let rows = file["rows"].as_array().expect("rows");
    for row in rows.iter().filter(|row| row["path"] == "generic") {
        let states = if row["hinges"] == "held" { 4 } else { 5 };
        assert_eq!(row["states"], states, "{row}");
    }
}

/// The JSON in a file.
fn json(path: &Path) -> serde_json::Value {
    let text = fs::read_to_string(path).expect("the file is there");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn verify_writes_what_it_prints() {
    let directory = tempfile::tempdir().expect("a directory");
    let output = nboom_in(directory.path(), BOOM, &["verify", "boom.nml", "--states", "7"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let table = stdout(&output);
    assert!(table.ends_with("results in out/boom/verify.json\n"), "{table}");
    let file = json(&directory.path().join("out/boom/verify.json"));
    assert_eq!((&file["scene"], &file["topology"]), (&"boom".into(), &"S1".into()));
    assert_eq!((&file["states"], &file["seed"]), (&7.into(), &1970.into()));
    assert_eq!((&file["tolerance"], &file["passed"]), (&1e-11.into(), &true.into()));
    let rows = file["rows"].as_array().expect("rows");
    let printed = |line: &&str| line.starts_with("generic ") || line.starts_with("generated ");
    assert_eq!(rows.len(), table.lines().filter(printed).count());
    let has = |path: &str, formulation: &str, quantity: &str| {
        rows.iter().any(|row| {
            row["path"] == path && row["formulation"] == formulation && row["quantity"] == quantity
        })
    };
    assert!(has("generic", "recursive", "accelerations"), "{file}");
    assert!(has("generated", "articulated", "accelerations"), "{file}");
    for form in ["recursive", "report", "relative", "symmetric"] {
        assert!(has("generic", form, "mass_matrix") && has("generic", form, "forcing"), "{file}");
    }
    for row in rows {
        assert_eq!(row["from_recursion"].is_null(), row["formulation"] == "recursive", "{row}");
        assert!(row["from_double_double"].as_f64().is_some_and(|off| off < 1e-12), "{row}");
        assert!(row["state"].as_u64().is_some_and(|state| (1..=7).contains(&state)), "{row}");
    }
}

#[test]
fn verify_writes_where_it_is_told_to() {
    let directory = tempfile::tempdir().expect("a directory");
    let args = ["verify", "boom.nml", "--states", "2", "-o"];
    let output = nboom_in(directory.path(), BOOM, &[&args[..], &["new/found.json"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(json(&directory.path().join("new/found.json"))["states"], 2);
    assert!(!directory.path().join("out").exists());

    let output = nboom_in(directory.path(), BOOM, &[&args[..], &["boom.nml/found.json"]].concat());
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot write boom.nml/found.json"), "{}", stderr(&output));
}

#[test]
fn verify_gives_the_same_for_the_same_seed() {
    let of_seed = |seed| stdout(&nboom(&["verify", "boom.nml", "--states", "5", "--seed", seed]));
    assert_eq!(of_seed("7"), of_seed("7"));
    assert_ne!(of_seed("7"), of_seed("8"));
}

#[test]
fn verify_fails_above_the_tolerance() {
    let directory = tempfile::tempdir().expect("a directory");
    let output = nboom_in(directory.path(), BOOM, &["verify", "boom.nml", "--tol", "1e-20"]);
    assert_eq!(code(&output), 1);
    assert!(stdout(&output).contains("largest deviation"), "the table is printed all the same");
    let file = json(&directory.path().join("out/boom/verify.json"));
    assert_eq!((&file["passed"], &file["tolerance"]), (&false.into(), &1e-20.into()));
    let message = stderr(&output);
    for words in ["error: ", " of gener", "deviates by", "in state", "above the tolerance 1e-20"] {
        assert!(message.contains(words), "no {words:?} in {message}");
    }
}

#[test]
fn a_hinge_without_inertia_has_nothing_to_verify_or_to_time() {
    let point_on_the_axis = "HIIK=9*0.0,CNIK(1,2)=0.0";
    let deck = BOOM.replace("HIIK=1.1,3*0.0,0.05,3*0.0,1.1,CNIK(1,2)=1.0", point_on_the_axis);
    for args in [&["verify", "boom.nml"][..], &["bench", "boom.nml", "--seconds", "1e-3"]] {
        let output = nboom_on(&deck, args);
        assert_eq!(code(&output), 3, "{}{}", stdout(&output), stderr(&output));
        let told = stderr(&output);
        assert!(told.contains("nothing has inertia about hinge 1,1"), "{args:?}: {told}");
    }
}

#[test]
fn wrong_input_is_refused() {
    for args in [
        ["verify", "absent.nml", "--states", "1"],
        ["verify", "boom.nml", "--states", "0"],
        ["verify", "boom.nml", "--tol", "0"],
        ["verify", "boom.nml", "--seed", "-1"],
        ["bench", "absent.nml", "--seconds", "1e-3"],
        ["bench", "boom.nml", "--seconds", "0"],
        ["bench", "boom.nml", "--json", "--harness"],
    ] {
        let output = nboom(&args);
        assert_eq!(code(&output), 2, "{args:?}");
        assert_eq!(stdout(&output), "", "{args:?}");
    }
}

#[test]
fn bench_gives_json() {
    let output = nboom(&["bench", "boom.nml", "--json", "--seconds", "1e-3"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows: serde_json::Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    let rows = rows.as_array().expect("an array");
    let has = |path: &str, formulation: &str| {
        rows.iter().any(|row| row["path"] == path && row["formulation"] == formulation)
    };
    assert!(has("generic", "recursive") && has("generic", "report"), "{rows:?}");
    assert!(has("generated", "articulated"), "{rows:?}");
    assert_eq!(rows[0]["of_recursive"], 1.0);
    for row in rows {
        let number = |key: &str| row[key].as_f64().expect("a number");
        let ratio = number("ns_min") / rows[0]["ns_min"].as_f64().expect("a number");
        assert!((number("of_recursive") - ratio).abs() <= 1e-12 * ratio, "{row}");
        assert!(0.0 < number("ns_min") && number("ns_min") <= number("ns_median"), "{row}");
        assert!(row["assumptions"].is_string() && row["instructions"].is_string(), "{row}");
    }
}

#[test]
fn bench_gives_lines_of_words_and_numbers() {
    let output = nboom(&["bench", "boom.nml", "--harness", "--seconds", "1e-3"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.starts_with("nboom_generic_recursive boom ns_min "), "{text}");
    assert_eq!(text.matches("\nnboom_generated_articulated boom ns_min ").count(), 1, "{text}");
    let names: Vec<_> = text.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(names.iter().all(|name| !name.contains("general")), "{text}");
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [_, "boom", "ns_min", least, "ns_median", median] = words[..] else { panic!("{line}") };
        assert!(least.parse::<f64>().is_ok_and(|ns| ns > 0.0), "{line}");
        assert!(median.parse::<f64>().is_ok_and(|ns| ns > 0.0), "{line}");
    }
}

#[test]
fn bench_gives_a_table() {
    let output = nboom(&["bench", "boom.nml", "--seconds", "1e-3"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let table = stdout(&output);
    assert!(table.contains("of recursive") && table.contains(" 1.000\n"), "{table}");
}

#[test]
fn bench_times_eight_states_at_once_and_names_hold_no_blanks() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::copy(S2_P, directory.path().join("two booms.nml")).expect("writable");
    let args = ["bench", "two booms.nml", "--harness", "--seconds", "1e-3"];
    let lines = stdout(&nboom_in(directory.path(), BOOM, &args));
    let names: Vec<_> = lines.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(lines.lines().all(|line| line.split(' ').nth(1) == Some("two_booms")), "{lines}");
    for formulation in ["report", "relative", "symmetric", "articulated", "momentum"] {
        let name = format!("nboom_generated_{formulation}");
        assert_eq!(names.iter().filter(|other| **other == name).count(), 1, "{lines}");
    }
    let eight = names.iter().filter(|name| **name == "nboom_generated_articulated_lanes8");
    assert_eq!(eight.count(), 1, "{lines}");
}

#[test]
fn the_environment_keeps_code_from_larger_instructions() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("boom.nml"), BOOM).expect("writable");
    let bench = |instructions: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
        command.current_dir(directory.path()).env("NBOOM_INSTRUCTIONS", instructions);
        command.args(["bench", "boom.nml", "--seconds", "0.001"]);
        command.output().expect("the binary starts")
    };
    let portable = stdout(&bench("portable"));
    assert!(portable.contains(" portable ") && !portable.contains("avx"), "{portable}");
    assert!(!stdout(&bench("avx2")).contains("avx512"));
    let wrong = bench("avx3");
    assert_eq!(code(&wrong), 2);
    assert!(stderr(&wrong).contains("`avx3` found, portable, avx2 or avx512 expected"));
}
