//! The binary as its users meet it: exit codes, messages and files.

mod certificate;
mod formats;
mod help;
#[path = "../../../../tests/support/json_schema.rs"]
mod json_schema;
mod more_draws;
mod outputs;
mod pictures;
mod plots;
mod repeat;
mod report;
mod scenes;
mod standard_input;
mod stops;
mod strengths;
mod sweep_account;
mod sweep_results;
mod sweeps;
mod tables;
mod told;
mod verdict;
mod what_1970_saw;

use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// A main body with one boom that is released, swings and latches.
const BOOM: &str = include_str!("../decks/boom.nml");

/// A directory of its own with `boom.nml` in it.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir().expect("a directory");
        fs::write(directory.path().join("boom.nml"), BOOM).expect("writable");
        Self { directory }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("writable");
    }

    fn command<A: AsRef<OsStr>>(&self, args: &[A]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
        command.current_dir(self.directory.path()).args(args);
        command
    }

    fn nboom(&self, args: &[&str]) -> Output {
        self.command(args).output().expect("the binary starts")
    }

    fn summary(&self, directory: &str) -> serde_json::Value {
        let text = fs::read_to_string(self.path(directory).join("summary.json"));
        serde_json::from_str(&text.expect("a summary")).expect("JSON")
    }
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

/// Refused with this exit code, and a message with all these words on standard error alone.
fn refused(output: &Output, exit_code: i32, words: &[&str]) {
    let message = stderr(output);
    assert_eq!(code(output), exit_code, "{message}");
    assert_eq!(stdout(output), "");
    for word in words {
        assert!(message.contains(word), "no {word:?} in {message:?}");
    }
    assert!(!message.contains("panicked"), "{message}");
}

fn rows(path: &Path) -> Vec<String> {
    fs::read_to_string(path).expect("a table").lines().map(str::to_owned).collect()
}

#[test]
fn run_writes_its_files_and_an_account() {
    let place = Place::new();
    let output = place.nboom(&["run", "boom.nml", "--samples", "8", "--units", "SI"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // Neither a warning nor, into a pipe, a progress bar.
    assert_eq!(stderr(&output), "");
    let account = stdout(&output);
    for words in [
        "boom: 2 bodies, 7 degrees of freedom; generated path, articulated formulation",
        "time [s]",
        "impulse [N m s]",
        "release",
        "lock up",
        "1,1",
        "conservation",
        "evaluations",
        "out/boom",
    ] {
        assert!(account.contains(words), "no {words:?} in {account}");
    }
    assert_eq!(rows(&place.path("out/boom/states.csv")).len(), 1 + 9);
    let events = rows(&place.path("out/boom/events.csv"));
    assert_eq!(events[0], "t,kind,appendage,segment,impulse,energy_before,energy_after");
    assert!(events.last().is_some_and(|row| row.contains(",end,,,,")), "{events:?}");
    let summary = place.summary("out/boom");
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["samples"], 8);
    assert!(!place.path("out/boom/listing.txt").exists());
}

#[test]
fn options_reach_the_run() {
    let place = Place::new();
    let output = place.nboom(&[
        "run",
        "boom.nml",
        "-o",
        "there",
        "--end-time",
        "0.5",
        "--samples",
        "2",
        "--rtol",
        "1e-8",
        "--atol",
        "1e-10",
        "--path",
        "generic",
        "--formulation",
        "recursive",
        "--integrator",
        "dop853",
        "--listing",
        "--no-report",
    ]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let summary = place.summary("there");
    assert_eq!(summary["rtol"], 1e-8);
    assert_eq!(summary["atol"], 1e-10);
    assert_eq!(summary["end_time"], 0.5);
    let states = rows(&place.path("there/states.csv"));
    assert!(states[3].starts_with("0.5,"), "{}", states[3]);
    let listing = fs::read_to_string(place.path("there/listing.txt")).expect("a listing");
    assert!(listing.contains("EVENT: RELEASE OF HINGE 1,1"), "{listing}");
}

#[test]
fn the_formulation_that_is_asked_for_runs() {
    let place = Place::new();
    for (path, formulation, path_used) in [
        ("generic", "report", "generic"),
        ("generic", "relative", "generic"),
        ("generic", "symmetric", "generic"),
        ("generic", "articulated", "generic"),
        ("generic", "momentum", "generic"),
        ("generic", "recursive", "generic"),
        ("auto", "recursive", "generic"),
        ("auto", "articulated", "generated"),
        ("generated", "articulated", "generated"),
    ] {
        let options = ["run", "boom.nml", "--samples", "2", "--path", path];
        let output = place.nboom(&[&options[..], &["--formulation", formulation]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let head = format!("{path_used} path, {formulation} formulation");
        assert!(stdout(&output).contains(&head), "no {head:?} in {}", stdout(&output));
        let summary = place.summary("out/boom");
        let selections = summary["selections"].as_array().expect("a list");
        for told in selections.iter().chain([&summary]) {
            assert_eq!(
                (&told["path"], &told["formulation"]),
                (&path_used.into(), &formulation.into())
            );
        }
        assert!(!selections.is_empty());
    }
}

/// A rotor that moves with its boom, and is at rest in the main body when that has latched.
#[test]
fn a_formulation_that_covers_only_some_modes_is_told() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    let boom = fs::read_to_string(place.path("boom.toml")).expect("a scene");
    let rotor = "\n[[body.rotor]]\naxis = \"z\"\ninertia = 0.01\nspeed_rad = 10.0\n";
    place.write("boom.toml", &(boom + rotor));
    let output = place.nboom(&["run", "boom.toml", "--formulation", "articulated"]);
    let why = "formulation articulated does not cover hinge 1,1 (boom), whose body has a rotor";
    let note = format!("note: ignored: --formulation articulated at time 1.0 ({why})");
    assert!(stderr(&output).contains(&note), "{}", stderr(&output));
    let output = place.nboom(&["run", "boom.toml", "--formulation", "symmetric"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn quiet_is_silent() {
    let place = Place::new();
    let output = place.nboom(&["run", "boom.nml", "--samples", "2", "--quiet"]);
    assert_eq!(
        (code(&output), stdout(&output), stderr(&output)),
        (0, String::new(), String::new())
    );
    assert_eq!(place.summary("out/boom")["complete"], true);
}

#[test]
fn check_says_what_the_scene_contains_and_computes_nothing() {
    let place = Place::new();
    let output = place.nboom(&["check", "boom.nml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in [
        "boom: 2 bodies, 7 degrees of freedom, total mass 103",
        "main body: mass 100, mass centre (0, 0, 0), principal moments of inertia 30, 35, 40",
        "appendage 1: regular, 1 segment",
        "hinge 1,1: unreleased at 80 deg, released at time 0.25, locks at 0 deg",
        // Axes turned by 90 degrees about y, the boom's angle by 80.
        "at the start: hinge at (0, 0.5, 0.1), axis (0, 0, -1), outer end at (1.96962, 0.847296, 0.1)",
        "locked: hinge at (0, 0.5, 0.1), axis (0, 0, -1), outer end at (0, 2.5, 0.1)",
        "spring: stiffness 30, rest",
        "gravity: none",
        "thrust: none",
        "span: 0 to 4",
        "not computed, since the scene lacks it: gravity; thrust",
        "topology: S1",
        "generated code assumes: no external wrench on the main body; O at the main body's mass centre; and ",
        " more, which --assumptions lists\n",
        // The only hinge is unreleased.
        "code at the start: generated articulated, routine for M",
    ] {
        assert!(text.contains(words), "no {words:?} in {text}");
    }
    assert!(!place.path("out").exists());
    // With all of them, a line for each, there are as many more as it said.
    let (_, rest) = text.split_once("; and ").expect("more");
    let more: usize = rest.split(' ').next().and_then(|count| count.parse().ok()).expect("a count");
    let all = stdout(&place.nboom(&["check", "boom.nml", "--assumptions"]));
    let (_, rest) = all.split_once("generated code assumes:\n").expect("a list");
    let listed: Vec<&str> = rest.lines().take_while(|line| line.starts_with("  ")).collect();
    assert_eq!(listed.len(), more + 2, "{all}");
    assert_eq!(listed[0], "  no external wrench on the main body");
    assert!(listed.iter().any(|line| line.contains("mass centre in the plane square")), "{all}");
}

#[test]
fn a_scene_that_cannot_be_read_is_refused() {
    let place = Place::new();
    fs::create_dir(place.path("folder.nml")).expect("writable");
    for verb in ["run", "check"] {
        refused(&place.nboom(&[verb, "missing.nml"]), 2, &["missing.nml", "No such file"]);
        refused(&place.nboom(&[verb, "folder.nml"]), 2, &["folder.nml"]);
    }
    assert!(!place.path("out").exists());
}

#[test]
fn a_body_whose_moments_overflow_is_wrong_input() {
    let place = Place::new();
    let far = BOOM.replace("EMIK=3.0", "EMIK=1.0E200").replace("CNIK(1,2)=1.0", "CNIK(1,2)=1.0E80");
    place.write("far.nml", &far);
    for verb in ["check", "run", "verify", "bench"] {
        refused(
            &place.nboom(&[verb, "far.nml"]),
            2,
            &["far.nml:10:", "HIIK(1,1,1)", "mass 1e200 with mass centre 1e80 away"],
        );
    }
}

#[test]
fn a_negative_seed_is_a_wrong_value_and_no_option() {
    let output = Place::new().nboom(&["verify", "boom.nml", "--seed", "-1"]);
    refused(&output, 2, &["invalid value '-1'", "--seed"]);
}

#[test]
fn every_error_of_a_deck_is_told_with_its_card() {
    let place = Place::new();
    let wrong = BOOM.replace("INSTR=0", "BOGUS=0").replace("EMM=100.0", "BAFFLE=1.0");
    place.write("wrong.nml", &wrong);
    let output = place.nboom(&["check", "wrong.nml"]);
    refused(&output, 2, &["wrong.nml:6:", "BOGUS", "BAFFLE"]);
    let told = stderr(&output);
    for (card, text) in [(5, " &NXPUT"), (6, "BOGUS=0"), (11, "BAFFLE=1.0")] {
        let error = format!("error: wrong.nml:{card}:");
        let at = told.find(&error).unwrap_or_else(|| panic!("no {error:?} in {told}"));
        assert!(told[at..].contains(text), "{text}: {told}");
    }
}

#[test]
fn a_wrong_command_line_is_refused() {
    let place = Place::new();
    let cases: [(&[&str], &[&str]); 22] = [
        (&[], &["Usage"]),
        (&["fly", "boom.nml"], &["fly"]),
        (&["run"], &["SCENE"]),
        (&["run", "boom.nml", "--fast"], &["--fast"]),
        (&["run", "boom.nml", "--rtol", "0"], &["--rtol", "from 1e-14 to below 1"]),
        (&["run", "boom.nml", "--rtol", "1e-18"], &["--rtol", "from 1e-14 to below 1"]),
        (&["run", "boom.nml", "--rtol", "1e-300"], &["--rtol", "from 1e-14 to below 1"]),
        (&["run", "boom.nml", "--rtol", "-1"], &["--rtol", "from 1e-14 to below 1"]),
        (&["run", "boom.nml", "--rtol", "10"], &["--rtol", "from 1e-14 to below 1"]),
        (&["run", "boom.nml", "--rtol", "inf"], &["--rtol", "finite"]),
        (&["run", "boom.nml", "--atol", "0"], &["--atol", "above zero"]),
        (&["run", "boom.nml", "--max-step", "0"], &["--max-step", "above zero"]),
        (&["run", "boom.nml", "--max-step", "nan"], &["--max-step", "finite"]),
        (&["run", "boom.nml", "--max-steps", "0"], &["--max-steps"]),
        (&["run", "boom.nml", "--max-events", "0"], &["--max-events"]),
        (&["run", "boom.nml", "--atol", "nan"], &["--atol", "finite"]),
        (&["run", "boom.nml", "--samples", "0"], &["--samples"]),
        (&["run", "boom.nml", "--formulation", "kane"], &["kane", "symmetric", "recursive"]),
        (&["run", "boom.nml", "--integrator", "euler"], &["euler", "dop853"]),
        (
            &["run", "boom.nml", "--path", "generated", "--formulation", "recursive"],
            &["--path has no effect", "recursive is library code, which path generic runs"],
        ),
        (&["run", "boom.nml", "--units", "cubits"], &["cubits", "ft-lbf-s"]),
        (&["run", "boom.nml", "--end-time", "-1"], &["--end-time", "initial time"]),
    ];
    for (args, words) in cases {
        refused(&place.nboom(args), 2, words);
    }
    assert!(!place.path("out").exists());
}

#[test]
fn an_output_directory_that_cannot_be_made_is_a_failure() {
    let place = Place::new();
    place.write("file", "");
    refused(&place.nboom(&["run", "boom.nml", "-o", "file/run"]), 3, &["file/run"]);
    // Here not even the superuser may write.
    refused(&place.nboom(&["run", "boom.nml", "-o", "/proc/nboom"]), 3, &["/proc/nboom"]);
}

#[test]
fn a_full_standard_output_is_a_failure() {
    let place = Place::new();
    let full = File::options().write(true).open("/dev/full").expect("a unix system");
    let mut command = place.command(&["check", "boom.nml"]);
    let output = command.stdout(full).output().expect("the binary starts");
    refused(&output, 3, &["standard output", "No space left"]);
}

#[test]
fn a_reader_who_leaves_is_no_error() {
    let place = Place::new();
    let mut command = place.command(&["run", "boom.nml", "--samples", "2"]);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the binary starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn help_names_every_option_of_the_contract() {
    let place = Place::new();
    let output = place.nboom(&["run", "--help"]);
    assert_eq!(code(&output), 0);
    let help = stdout(&output);
    for option in [
        "-o",
        "--samples",
        "--formulation",
        "--integrator",
        "--rtol",
        "--atol",
        "--path",
        "--end-time",
        "--units",
        "--listing",
        "--no-report",
        "--quiet",
    ] {
        assert!(help.contains(option), "no {option} in {help}");
    }
}
