//! Sweeps and their shards, cases and pages.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use nboom_scalar::InstructionSet;

use crate::json_schema::JsonSchema;
use crate::{Place, code, refused, rows, stderr, stdout};

/// Springs of the boom that differ, and two faults.
pub(crate) const STUDY: &str = r#"
scene = "boom.nml"
name = "springs"
seed = 7
draws = 40
results = ["lock_time of 1,1", "impulse of 1,1", "final nutation", "conservation.energy"]

[run]
rtol = 1e-8
samples = 20

[[vary]]
name = "spring"
path = "body[1].hinge.spring.stiffness"
as = "factor"
normal = { mean = 1.0, deviation = 0.1, from = 0.5 }

[[vary]]
name = "spin"
path = "initial.rate_deg[1]"
uniform = { from = 50.0, to = 60.0 }

[[fault]]
name = "late"
late_release = { hinge = "1,1", by = 0.5 }

[[fault]]
name = "no latch"
failed_latch = ["1,1"]
"#;

fn place() -> Place {
    let place = Place::new();
    place.write("study.toml", STUDY);
    place
}

/// The table of a sweep in `directory`: each row by the names of its columns.
pub(crate) fn cases(place: &Place, directory: &str) -> Vec<BTreeMap<String, String>> {
    let rows = rows(&place.path(directory).join("cases.csv"));
    let names: Vec<&str> = rows[0].split(',').collect();
    let row = |row: &String| {
        // Only the status, which is the last, may have commas.
        let cells: Vec<&str> =
            row.splitn(names.len(), ',').map(|cell| cell.trim_matches('"')).collect();
        assert_eq!(cells.len(), names.len(), "{row}");
        names.iter().zip(cells).map(|(name, cell)| (name.to_string(), cell.to_owned())).collect()
    };
    rows[1..].iter().map(row).collect()
}

pub(crate) fn sweep(place: &Place, more: &[&str]) -> std::process::Output {
    let output = place.nboom(&[&["sweep", "study.toml", "--csv"], more].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    output
}

pub(crate) fn run_shard(place: &Place, directory: &str, shard: &str) {
    let words = ["sweep", "study.toml", "-o", directory, "--shard", shard, "--no-report"];
    let output = place.nboom(&words);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn a_sweep_leaves_a_row_for_each_case_and_an_account() {
    let place = place();
    let output = sweep(&place, &[]);
    let account = stdout(&output);
    for words in ["springs: 120 cases", "40 draws", "monte_carlo", "seed 7", "out/springs"] {
        assert!(account.contains(words), "no {words:?} in {account}");
    }
    assert_eq!(stderr(&output), "", "a pipe is shown no progress");
    let cases = cases(&place, "out/springs");
    assert_eq!(cases.len(), 120);
    for (i, case) in cases.iter().enumerate() {
        assert_eq!(case["case"], (i + 1).to_string());
        assert_eq!(case["status"], "ok");
        assert_eq!(case["fault"], ["", "late", "no latch"][i % 3]);
        assert_eq!(case["spring"], cases[i - i % 3]["spring"], "a fault has the draw's numbers");
        let lock = case["lock_time_of_1_1"].parse::<f64>();
        assert_eq!(lock.is_ok(), i % 3 != 2, "{case:?}");
        if i % 3 == 1 {
            // It is released half a second later, and turns as before until the spin of the main body tells.
            assert!(lock.expect("a time") > 0.75, "{case:?}");
        }
        assert!(case["conservation_energy"].parse::<f64>().expect("a number") < 1e-6);
    }
    let study: serde_json::Value = serde_json::from_str(
        &fs::read_to_string(place.path("out/springs/study.json")).expect("it"),
    )
    .expect("JSON");
    assert_eq!(study["complete"], true);
    assert_eq!((study["seed"].as_u64(), study["cases"].as_u64()), (Some(7), Some(120)));
    for name in ["study.toml", "scene.toml", "statistics.json", "report.html"] {
        assert!(place.path("out/springs").join(name).is_file(), "{name}");
    }
    assert!(!place.path("out/springs/journal.txt").exists());
    assert_eq!(cfg!(feature = "parquet"), place.path("out/springs/cases.parquet").exists());
    // A second time there is nothing to do.
    let again = sweep(&place, &[]);
    assert!(stdout(&again).contains("springs: 120 cases"), "{}", stdout(&again));
}

/// Stiffer springs close sooner: the closed form of a spring and one inertia says by how much, roughly.
#[test]
fn stiffer_springs_latch_sooner() {
    let place = place();
    sweep(&place, &["-o", "all"]);
    let cases = cases(&place, "all");
    let of = |case: &BTreeMap<String, String>, name: &str| case[name].parse::<f64>().expect(name);
    let mut nominal: Vec<(f64, f64)> = cases
        .iter()
        .filter(|case| case["fault"].is_empty())
        .map(|case| (of(case, "spring"), of(case, "lock_time_of_1_1") - 0.25))
        .collect();
    nominal.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (first, last) = (nominal[0], nominal[nominal.len() - 1]);
    let expected = (last.0 / first.0).sqrt();
    assert!((first.1 / last.1 / expected - 1.0).abs() < 0.05, "{first:?} {last:?}");
}

/// With lanes and without them products and sums are fused differently, so that steps of one method differ by rounding,
/// which latches and faults between carry on.
#[test]
fn cases_side_by_side_are_those_alone_but_for_rounding() {
    let place = Place::new();
    let tables = [true, false].map(|lanes| {
        let run = format!("[run]\nintegrator = \"dop853\"\nlanes = {lanes}");
        place.write("study.toml", &STUDY.replace("[run]", &run));
        let directory = format!("lanes-{lanes}");
        sweep(&place, &["-o", &directory, "--no-report"]);
        cases(&place, &directory)
    });
    let [beside, alone] = &tables;
    assert_eq!(beside.len(), 120);
    let mut differ = 0;
    for column in ["lock_time_of_1_1", "impulse_of_1_1", "final_nutation"] {
        let of = |case: &BTreeMap<String, String>| case[column].parse::<f64>().ok();
        let scale = alone.iter().filter_map(of).fold(0.0_f64, |most, x| most.max(x.abs()));
        for (beside, alone) in beside.iter().zip(alone) {
            let (Some(a), Some(b)) = (of(beside), of(alone)) else {
                assert_eq!(beside[column], alone[column]);
                continue;
            };
            assert!((a - b).abs() <= 1e-11 * scale, "{column}: {a} {b}");
            differ += usize::from(a != b);
        }
    }
    // The option does something, where there are vector registers.
    let registers = InstructionSet::of_this_processor() != InstructionSet::Portable;
    assert_eq!(differ > 0, registers, "{differ} numbers differ");
}

#[test]
fn threads_and_shards_do_not_change_a_byte() {
    let place = place();
    sweep(&place, &["-o", "one", "--jobs", "1", "--no-report"]);
    sweep(&place, &["-o", "three", "--jobs", "3", "--no-report"]);
    for shard in ["1/3", "2/3", "3/3"] {
        let directory = format!("shard-{}", &shard[..1]);
        run_shard(&place, &directory, shard);
        assert!(!place.path(&directory).join("cases.csv").exists());
    }
    let merge = ["merge", "shard-2", "shard-1", "shard-3", "-o", "merged"];
    // The second time a finished sweep is there, which lacks the table in CSV.
    for more in [&[][..], &["--csv"]] {
        let merged = place.nboom(&[&merge[..], more].concat());
        assert_eq!(code(&merged), 0, "{}", stderr(&merged));
    }
    let table = |directory: &str| fs::read(place.path(directory).join("cases.csv")).expect("it");
    for directory in ["three", "merged"] {
        assert!(table("one") == table(directory), "{directory}");
    }
    refused(&place.nboom(&["merge", "shard-1", "shard-3", "-o", "two"]), 2, &["2/3"]);
    let of_a_file = place.nboom(&["merge", "shard-1", "study.toml", "-o", "file"]);
    refused(&of_a_file, 2, &["study.toml: no sweep found, a finished shard expected"]);
    let tables = ["sweep", "study.toml", "--shard", "1/3", "--csv", "-o", "tables"];
    refused(&place.nboom(&tables), 2, &["CSV of the shard 1/3", "nboom merge --csv"]);
    assert!(!place.path("tables").exists());
    place.write("study.toml", &STUDY.replace("seed = 7", "seed = 8"));
    run_shard(&place, "other", "2/3");
    let mixed = ["merge", "shard-1", "other", "shard-3", "-o", "mixed"];
    refused(&place.nboom(&mixed), 2, &["other", "study"]);
}

/// The numbers of a run's summary at `path`.
fn summary(directory: &Path, path: &str) -> f64 {
    let text = fs::read_to_string(directory.join("summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary.pointer(path).and_then(serde_json::Value::as_f64).expect("a number")
}

#[test]
fn a_case_is_repeated_to_the_last_bit() {
    let place = place();
    sweep(&place, &["-o", "all"]);
    let cases = cases(&place, "all");
    for number in [1, 2, 58, 120] {
        let case = &cases[number - 1];
        let output = place.nboom(&["run", "study.toml", "--case", &number.to_string()]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let directory = place.path(&format!("out/springs-case-{number}"));
        let energy: f64 = case["conservation_energy"].parse().expect("a number");
        assert_eq!(summary(&directory, "/conservation/energy"), energy);
        let states = rows(&directory.join("states.csv"));
        assert_eq!(states.len(), 1 + 21, "the study has 20 samples");
        let nutation = states.last().and_then(|row| row.rsplit(',').next()).expect("a row");
        assert_eq!(nutation, case["final_nutation"]);
        let events = rows(&directory.join("events.csv"));
        let lock = events.iter().find(|row| row.contains(",lock_up,"));
        let time = lock.map_or("", |row| row.split(',').next().expect("a time"));
        assert_eq!(time, case["lock_time_of_1_1"]);
        assert!(directory.join("report.html").is_file());
    }
    // And by its record.
    let record = "out/springs-case-58/run.json";
    let again = place.nboom(&["run", record, "-o", "again"]);
    assert_eq!((code(&again), stderr(&again).as_str()), (0, ""));
    for name in ["states.csv", "events.csv"] {
        let of = |directory: &str| fs::read(place.path(directory).join(name)).expect("it");
        assert!(of("out/springs-case-58") == of("again"), "{name}");
    }
    refused(&place.nboom(&["run", "study.toml", "--case", "121"]), 2, &["121", "120"]);
    refused(&place.nboom(&["run", "study.toml", "--case", "1", "--set", "a=1"]), 2, &["--set"]);
}

#[test]
fn numbers_that_make_no_scene_are_rows_with_the_reason() {
    let place = place();
    let bad = STUDY
        .replace("normal = { mean = 1.0, deviation = 0.1, from = 0.5 }", "values = [1.0, 1.1]");
    let bad = bad
        .replace("body[1].hinge.spring.stiffness", "body[1].mass")
        .replace("values = [1.0, 1.1]", "values = [1.0, -1.0]");
    place.write("study.toml", &bad);
    let output = place.nboom(&["sweep", "study.toml", "--csv"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("rejected"), "{}", stderr(&output));
    let cases = cases(&place, "out/springs");
    let rejected: Vec<_> = cases.iter().filter(|case| case["spring"] == "-1.0").collect();
    assert!(rejected.len() > 20 && rejected.len() < 100, "{}", rejected.len());
    for case in &cases {
        let is_rejected =
            case["status"].starts_with("rejected: ") && case["status"].contains("mass");
        assert_eq!(is_rejected, case["spring"] == "-1.0", "{case:?}");
        assert_eq!(case["final_nutation"].is_empty(), is_rejected, "{case:?}");
    }
    let number = rejected[0]["case"].clone();
    refused(&place.nboom(&["run", "study.toml", "--case", &number]), 2, &["mass", &number]);
}

#[test]
fn wrong_studies_are_told_where() {
    let place = place();
    for (from, to, words) in [
        ("spring.stiffness", "spring.stifness", &["study.toml:14", "stiffness"][..]),
        ("draws = 40", "draw = 40", &["study.toml:5", "draws"]),
        ("deviation = 0.1", "deviation = -0.1", &["study.toml:16", "deviation"]),
        ("boom.nml", "broom.nml", &["study.toml:2", "broom.nml", "cannot be read"]),
        ("\"final nutation\"", "\"final nutatoin\"", &["study.toml:6", "nutation"]),
        ("\"final nutation\"", "\"wall_seconds\"", &["study.toml:6", "wall_seconds"]),
        ("hinge = \"1,1\"", "hinge = \"1,2\"", &["study.toml", "1,2"]),
    ] {
        place.write("study.toml", &STUDY.replace(from, to));
        refused(&place.nboom(&["sweep", "study.toml"]), 2, words);
        assert!(!place.path("out").exists());
    }
    place.write("study.toml", STUDY);
    refused(&place.nboom(&["run", "study.toml"]), 2, &["study.toml:2", "a study", "--case"]);
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    refused(&place.nboom(&["sweep", "wing.toml"]), 2, &["wing.toml", "nboom run runs a scene"]);
    refused(&place.nboom(&["sweep", "boom.nml"]), 2, &["boom.nml", "a study NAME.toml"]);
    refused(&place.nboom(&["sweep", "study.toml", "--shard", "3/2"]), 2, &["3/2"]);
    refused(&place.nboom(&["merge", "nowhere", "-o", "all"]), 2, &["nowhere"]);
}

#[test]
fn an_unfinished_sweep_is_not_overwritten() {
    let place = place();
    sweep(&place, &["-o", "all", "--no-report"]);
    place.write("study.toml", &STUDY.replace("seed = 7", "seed = 8"));
    refused(&place.nboom(&["sweep", "study.toml", "-o", "all"]), 2, &["all", "study"]);
    refused(&place.nboom(&["sweep", "study.toml", "-o", "all", "--resume"]), 2, &["all", "study"]);
    fs::create_dir(place.path("foreign")).expect("writable");
    place.write("foreign/cases.csv", "mine");
    refused(&place.nboom(&["sweep", "study.toml", "-o", "foreign"]), 2, &["cases.csv"]);
    assert_eq!(fs::read_to_string(place.path("foreign/cases.csv")).expect("it"), "mine");
}

#[test]
fn the_schema_of_studies_is_one() {
    let place = Place::new();
    let output = place.nboom(&["schema", "study"]);
    let schema = JsonSchema::new(&serde_json::from_str(&stdout(&output)).expect("JSON"));
    assert_eq!(schema.take(&toml::from_str(STUDY).expect("TOML")), Ok(()));
    let wrong = STUDY.replace("draws", "drawz");
    assert!(schema.take(&toml::from_str(&wrong).expect("TOML")).is_err());
}

/// What the scene includes lies elsewhere; the directory then repeats by itself.
#[test]
fn a_scene_may_include_files_from_anywhere_if_that_is_asked_for() {
    let place = place();
    assert_eq!(code(&place.nboom(&["convert", "boom.nml", "-o", "boom.toml"])), 0);
    let scene = fs::read_to_string(place.path("boom.toml")).expect("a scene");
    place.write("more.toml", "[parameters]\nk = 1.0\n");
    fs::create_dir(place.path("in")).expect("writable");
    place.write("in/boom.toml", &format!("include = [\"../more.toml\"]\n{scene}"));
    place.write("in/study.toml", &STUDY.replace("boom.nml", "boom.toml"));
    let sweep = ["sweep", "in/study.toml", "--csv", "--no-report", "-o", "all"];
    refused(&place.nboom(&sweep), 2, &["more.toml", "--include-anywhere"]);
    let run = ["run", "in/study.toml", "--case", "58", "-o", "there"];
    refused(&place.nboom(&run), 2, &["more.toml", "--include-anywhere"]);
    for words in [&sweep[..], &run] {
        let output = place.nboom(&[words, &["--include-anywhere"]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    let again = place.nboom(&["run", "all/study.toml", "--case", "58", "-o", "here"]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    let states = |directory: &str| rows(&place.path(directory).join("states.csv"));
    assert_eq!(states("here"), states("there"));
    let nutation = states("here").last().and_then(|row| row.rsplit(',').next()).map(str::to_owned);
    assert_eq!(nutation.as_ref(), Some(&cases(&place, "all")[57]["final_nutation"]));
}

#[test]
fn directories_that_runs_refuse_are_refused() {
    let place = place();
    for directory in ["/", "x.partial"] {
        for command in [&["sweep", "study.toml"][..], &["run", "boom.nml"]] {
            let output = place.nboom(&[command, &["-o", directory]].concat());
            refused(&output, 2, &[directory, ".partial"]);
        }
    }
    assert!(!place.path("x.partial").exists());
}

#[test]
fn pages_of_worst_cases_that_are_gone_are_made_again() {
    let place = place();
    place.write("study.toml", &STUDY.replace("draws = 40", "draws = 2"));
    sweep(&place, &["-o", "all"]);
    let pages = || fs::read_dir(place.path("all/worst")).map_or(0, Iterator::count);
    let before = pages();
    assert!(before > 0);
    fs::remove_dir_all(place.path("all/worst")).expect("it is there");
    sweep(&place, &["-o", "all"]);
    assert_eq!(pages(), before);
}

#[test]
fn what_was_changed_in_a_sweep_is_run_by_nobody() {
    let place = place();
    place.write("study.toml", &STUDY.replace("draws = 40", "draws = 2"));
    // A file of that name that no sweep has written is none of our business.
    place.write("study.json", "{}");
    sweep(&place, &["-o", "all", "--no-report"]);
    let run = ["run", "all/study.toml", "--case", "1", "-o", "one", "--no-report"];
    let swept = ["sweep", "all/study.toml", "-o", "other", "--no-report"];
    for (name, from, to) in
        [("scene.toml", "0.25", "0.5"), ("study.toml", "to = 60.0", "to = 61.0")]
    {
        let file = format!("all/{name}");
        let written = fs::read_to_string(place.path(&file)).expect("it");
        assert!(written.contains(from), "{written}");
        place.write(&file, &written.replace(from, to));
        for words in [&run[..], &swept] {
            refused(&place.nboom(words), 2, &[&file, "SHA-256", "as the sweep wrote it"]);
        }
        place.write(&file, &written);
    }
    for words in [&run[..], &swept] {
        let output = place.nboom(words);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
}

#[test]
fn shards_whose_study_was_changed_are_not_merged() {
    let place = place();
    for shard in ["1/2", "2/2"] {
        run_shard(&place, &shard[..1], shard);
    }
    place.write("2/study.toml", &STUDY.replace("to = 60.0", "to = 61.0"));
    refused(&place.nboom(&["merge", "1", "2", "-o", "all"]), 2, &["2/study.toml", "SHA-256"]);
    assert!(!place.path("all").exists());
}
