//! Where results go: one run at a time, nothing overwritten that is not a run's, no links followed,
//! full disks.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use super::files::{contents, rows_are_whole, summary};
use super::interrupts::SWINGING;
use super::place::{Place, REPORT_DECK};

/// A finished result in `run`.
fn finished(place: &Place) {
    place.write("deck.nml", SWINGING);
    let run = place.nboom(&["run", "deck.nml", "-o", "run", "--quiet"]);
    assert_eq!(run.code(), Some(0), "{}", run.stderr());
}

#[test]
fn a_second_run_into_a_directory_is_told_who_has_it() {
    let place = Place::new("two-runs");
    place.write("deck.nml", SWINGING);
    symlink(".", place.path("link")).expect("a unix system");
    let mut first = place.start(&["run", "deck.nml", "-o", "run", "--end-time", "1e6", "--quiet"]);
    first.wait_until(|| place.path("run.partial/states.csv").exists());
    let holder = format!("process {}", first.id());
    for directory in ["run", "./run/", "link/run"] {
        let second = place.nboom(&["run", "deck.nml", "-o", directory, "--quiet"]);
        second.refused(directory, 2, &["run is going on", &holder]);
    }
    first.signal("INT");
    first.end().refused("the first", 3, &["interrupted"]);
    rows_are_whole(&place.path("run"));
    // It is free again, and so it is after a kill, which nobody can tidy up after.
    let mut killed = place.start(&["run", "deck.nml", "-o", "run", "--end-time", "1e6", "--quiet"]);
    killed.wait_until(|| place.path("run.partial/states.csv").exists());
    killed.signal("KILL");
    killed.end();
    finished(&place);
    assert_eq!(summary(&place.path("run")).expect("a summary")["complete"], true);
    assert!(!place.path("run.partial").exists());
}

#[test]
fn runs_that_begin_in_one_instant_do_not_mix() {
    let place = Place::new("same-instant");
    place.write("deck.nml", SWINGING);
    for _ in 0..5 {
        let start = |samples: &&str| {
            place.start(&["run", "deck.nml", "-o", "run", "--samples", samples, "--quiet"])
        };
        let all: Vec<_> = ["1000", "1500", "2000"].iter().map(start).collect();
        let codes: Vec<_> = all.into_iter().map(|run| run.end().code()).collect();
        assert!(codes.contains(&Some(0)), "{codes:?}");
        assert!(codes.iter().all(|code| [Some(0), Some(2)].contains(code)), "{codes:?}");
        rows_are_whole(&place.path("run"));
        let summary = summary(&place.path("run")).expect("a summary");
        assert_eq!(summary["complete"], true);
        let rows = place.read("run/states.csv").lines().count();
        assert_eq!(summary["samples"], rows - 2);
        assert!(!place.path("run.partial").exists());
    }
}

/// What can be refused is refused before anything is touched.
#[test]
fn what_cannot_be_run_leaves_results_as_they_are() {
    let place = Place::new("refused-options");
    finished(&place);
    let old = contents(&place.path("run"));
    place.write("far.nml", SWINGING.replace("EMIK=3.0", "EMIK=-3.0"));
    for (deck, options) in [
        ("deck.nml", &["--formulation", "report", "--path", "generated"][..]),
        ("deck.nml", &["--formulation", "recursive", "--path", "generated"]),
        ("deck.nml", &["--end-time", "-1"]),
        ("deck.nml", &["--rtol", "2"]),
        ("deck.nml", &["--integrator", "euler"]),
        ("far.nml", &[]),
    ] {
        let told = format!("{deck} {options:?}");
        let refused = place.nboom(&[&["run", deck, "-o", "run"], options].concat());
        assert_eq!(refused.code(), Some(2), "{told}: {}", refused.stderr());
        assert_eq!(contents(&place.path("run")), old, "{told}");
        assert!(!place.path("run.partial").exists(), "{told}");
    }
}

/// Nothing that a run did not write is written to, waited for, followed or removed.
#[test]
fn what_is_not_a_run_s_is_refused_and_stays() {
    let place = Place::new("foreign");
    place.write("deck.nml", SWINGING);
    place.write("mine", "mine");
    type Make = fn(&Place, &str);
    let makes: [(&str, Make); 5] = [
        ("a file", |place, name| place.write(name, "mine")),
        ("a directory", |place, name| fs::create_dir(place.path(name)).expect("writable")),
        ("a link", |place, name| symlink("../mine", place.path(name)).expect("writable")),
        ("a link", |place, name| symlink("nowhere", place.path(name)).expect("writable")),
        ("a pipe", |place, name| {
            let made = Command::new("mkfifo").arg(place.path(name)).status();
            assert!(made.expect("there is mkfifo").success());
        }),
    ];
    for name in ["states.csv", "events.csv", "summary.json", "listing.txt"] {
        for (kind, make) in makes {
            let _ = fs::remove_dir_all(place.path("run"));
            fs::create_dir(place.path("run")).expect("writable");
            make(&place, &format!("run/{name}"));
            let refused = place.nboom(&["run", "deck.nml", "-o", "run", "--listing", "--quiet"]);
            refused.refused(kind, 2, &[&format!("run/{name}: found {kind}"), "no run has written"]);
            assert!(place.path("run").join(name).symlink_metadata().is_ok(), "{kind} {name}");
            assert!(!place.path("run.partial").exists());
        }
    }
    assert_eq!(place.read("mine"), "mine");

    // Neither is a link taken for a directory.
    let _ = fs::remove_dir_all(place.path("run"));
    fs::create_dir(place.path("elsewhere")).expect("writable");
    symlink("elsewhere", place.path("run")).expect("a unix system");
    let refused = place.nboom(&["run", "deck.nml", "-o", "run", "--quiet"]);
    refused.refused("a link", 2, &["run: found a link, expected a directory"]);
    assert_eq!(fs::read_dir(place.path("elsewhere")).expect("readable").count(), 0);
}

/// Files of other names in a directory for results are nobody's business.
#[test]
fn other_files_stay() {
    let place = Place::new("others");
    fs::create_dir_all(place.path("run/plots")).expect("writable");
    place.write("run/notes.txt", "mine");
    place.write("run/plots/a.svg", "mine");
    for _ in 0..2 {
        finished(&place);
        assert_eq!(place.read("run/notes.txt"), "mine");
        assert_eq!(place.read("run/plots/a.svg"), "mine");
        assert_eq!(summary(&place.path("run")).expect("a summary")["complete"], true);
    }
}

/// A directory is its shell's directory still when a run has taken its place.
#[test]
fn a_run_may_go_into_the_directory_that_one_is_in() {
    let place = Place::new("here");
    place.write("deck.nml", SWINGING);
    fs::create_dir(place.path("run")).expect("writable");
    let script = "cd run && \"$0\" run ../deck.nml -o . --quiet && test -s states.csv";
    let run = || {
        let mut shell = Command::new("sh");
        shell.args(["-c", script, env!("CARGO_BIN_EXE_nboom")]).current_dir(place.path("."));
        assert!(shell.status().expect("there is a shell").success());
    };
    run();
    run();
    assert!(!place.path("run.partial").exists());
}

#[test]
fn no_command_writes_over_its_input() {
    let place = Place::new("own-input");
    let sections = r#"{"cases": [{"id": "a", "kind": "circular", "R": 1.0, "t": 0.1}]}"#;
    place.write("s.json", sections);
    place.write("deck.nml", REPORT_DECK);
    symlink("s.json", place.path("link.json")).expect("a unix system");
    for output in ["s.json", "./s.json", "link.json"] {
        place.nboom(&["section", "s.json", "-o", output]).refused(output, 2, &[output]);
        assert_eq!(place.read("s.json"), sections);
    }
    // Another name of the same file is another file from then on.
    fs::hard_link(place.path("s.json"), place.path("same.json")).expect("writable");
    assert_eq!(place.nboom(&["section", "s.json", "-o", "same.json"]).code(), Some(0));
    assert_eq!(place.read("s.json"), sections);

    let refused = place.nboom(&["verify", "deck.nml", "--states", "2", "-o", "deck.nml"]);
    assert_eq!(refused.code(), Some(2), "{}", refused.stderr());
    assert!(refused.stderr().contains("error: deck.nml: found the input"), "{}", refused.stderr());
    assert_eq!(place.read("deck.nml"), REPORT_DECK);

    let made = Command::new("mkfifo").arg(place.path("pipe")).status();
    assert!(made.expect("there is mkfifo").success());
    place.nboom(&["section", "s.json", "-o", "pipe"]).refused("a pipe", 2, &["a pipe"]);
}

/// The last rows are written when the run is over; that they cannot be is no success.
#[test]
fn a_disk_that_is_full_at_the_very_end() {
    let place = Place::new("full-end");
    place.write("deck.nml", SWINGING);
    let args = ["run", "deck.nml", "-o", "run", "--samples", "60", "--quiet"];
    assert_eq!(place.nboom(&args).code(), Some(0));
    let length = place.read("run/states.csv").len();
    let old = contents(&place.path("run"));
    // All but the last rows, which wait in memory up to 8 KiB of them.
    let blocks = (length / 512) as u32;
    assert!(!length.is_multiple_of(512) && length > 8192 + 4096, "{length}");
    let finished = place.nboom_with_files_of(blocks, &args);
    finished.refused("the end", 3, &["cannot write run.partial/states.csv", "File too large"]);
    assert_eq!(contents(&place.path("run")), old);
    let summary = summary(&place.path("run.partial")).expect("a summary");
    assert_eq!(summary["complete"], false);
    let error = summary["error"].as_str().expect("a text");
    assert!(error.contains("states.csv") && error.contains("File too large"), "{error}");
    rows_are_whole(&place.path("run.partial"));
}

/// A small disk of its own, where one can be mounted: what fills it is told in the summary.
#[cfg(target_os = "linux")]
#[test]
fn a_small_disk_that_is_full() {
    let place = Place::new("small-disk");
    place.write("deck.nml", REPORT_DECK);
    fs::create_dir(place.path("disk")).expect("writable");
    let script = "mount -t tmpfs -o size=96k none disk || exit 77
        \"$0\" run deck.nml -o disk/run --samples 5000 $1 --quiet
        code=$?
        cp -r disk/run* . || exit 78
        exit $code";
    for option in ["--no-stresses", "--listing", ""] {
        let _ = fs::remove_dir_all(place.path("run"));
        let mut shell = Command::new("unshare");
        shell.args(["-rm", "sh", "-c", script, env!("CARGO_BIN_EXE_nboom"), option]);
        let output = shell.current_dir(place.path(".")).output().expect("there is unshare");
        let message = String::from_utf8_lossy(&output.stderr);
        if output.status.code().is_none_or(|code| ![0, 3, 78].contains(&code)) {
            eprintln!("no disk can be mounted here: {message}");
            return;
        }
        assert_eq!(output.status.code(), Some(3), "{message}");
        assert!(message.contains("No space left"), "{message}");
        let summary = summary(&place.path("run")).expect("a summary");
        assert_eq!(summary["complete"], false);
        let error = summary["error"].as_str().expect("a text");
        assert!(error.contains("No space left"), "{error}");
        assert!(summary["end_time"].as_f64().is_some(), "{summary}");
        rows_are_whole(&place.path("run"));
        assert!(place.read("run/states.csv").lines().count() > 2);
    }
}
