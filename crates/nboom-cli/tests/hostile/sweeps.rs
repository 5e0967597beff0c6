//! Sweeps that are killed, interrupted and out of space, and resumed.

use std::fs;
use std::thread::sleep;
use std::time::Instant;

use super::kills::{kills, random};
use super::place::{Place, REPORT_DECK};

/// Some seconds of work on two cores.
const STUDY: &str = r#"
scene = "deck.nml"
name = "killed"
draws = 1500

[run]
stresses = false
samples = 2

[[vary]]
name = "spin"
path = "initial.rate_deg[1]"
uniform = { from = 400.0, to = 600.0 }
"#;

fn place(name: &str) -> Place {
    let place = Place::new(name);
    place.write("deck.nml", REPORT_DECK);
    place.write("study.toml", STUDY);
    place
}

const SWEEP: [&str; 6] = ["sweep", "study.toml", "--csv", "--no-report", "--quiet", "--resume"];

/// Batches that the journal of a sweep has finished.
fn batches(place: &Place) -> Vec<String> {
    let journal = fs::read(place.path("swept/journal.txt")).unwrap_or_default();
    let text = String::from_utf8_lossy(&journal).into_owned();
    let mut found: Vec<String> =
        text.lines().filter(|line| line.starts_with("batch ")).map(str::to_owned).collect();
    // The last one may be torn.
    if !text.ends_with('\n') {
        found.pop();
    }
    found
}

#[test]
fn a_sweep_that_is_killed_again_and_again_ends_with_the_same_bytes() {
    let place = place("sweep-kills");
    let whole = [&SWEEP[..], &["-o", "whole"]].concat();
    let started = Instant::now();
    let finished = place.start(&whole).end();
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    let mut duration = started.elapsed();
    let table = fs::read(place.path("whole/cases.csv")).expect("a table");
    assert_eq!(table.iter().filter(|byte| **byte == b'\n').count(), 1501);
    let command = [&SWEEP[..], &["-o", "swept"]].concat();
    let (mut bits, mut came, mut ends) = (1970, 0, 0);
    while came < kills() / 4 + 1 {
        let before = batches(&place);
        let running = place.start(&command);
        let wait = duration.mul_f64(0.6 * random(&mut bits));
        sleep(wait);
        running.signal(["KILL", "TERM"][came % 2]);
        let code = running.end().code();
        assert!([None, Some(0), Some(3)].contains(&code), "{code:?}");
        if code == Some(0) {
            ends += 1;
            assert!(fs::read(place.path("swept/cases.csv")).expect("a table") == table);
            fs::remove_dir_all(place.path("swept")).expect("it is there");
            duration = duration.mul_f64(0.9);
            continue;
        }
        came += 1;
        let after = batches(&place);
        assert!(
            before.iter().all(|batch| after.contains(batch)) || after.is_empty(),
            "kill {came} after {wait:?}: {before:?} {after:?}"
        );
    }
    let last = place.start(&command).end();
    assert_eq!(last.code(), Some(0), "{}", last.stderr());
    assert!(fs::read(place.path("swept/cases.csv")).expect("a table") == table);
    println!("{came} kills, {ends} sweeps came to their ends in between");
}

#[test]
fn a_disk_that_is_full_keeps_finished_batches() {
    let place = place("sweep-disk");
    let args = [&SWEEP[..], &["-o", "swept"]].concat();
    let stopped = place.nboom_with_files_of(80, &args);
    stopped.refused("a full disk", 3, &["journal.txt", "File too large"]);
    let kept = batches(&place);
    assert!(!kept.is_empty());
    let resumed = place.start(&args).end();
    assert_eq!(resumed.code(), Some(0), "{}", resumed.stderr());
    let whole = place.start(&[&SWEEP[..], &["-o", "whole"]].concat()).end();
    assert_eq!(whole.code(), Some(0), "{}", whole.stderr());
    let of = |directory: &str| fs::read(place.path(directory).join("cases.csv")).expect("it");
    assert!(of("swept") == of("whole"));
}

#[test]
fn an_interrupted_sweep_says_how_to_go_on() {
    let place = place("sweep-interrupt");
    let command = ["sweep", "study.toml", "-o", "swept", "--csv", "--no-report", "--quiet"];
    let mut running = place.start(&command);
    running.wait_until(|| !batches(&place).is_empty());
    running.signal("INT");
    running.end().refused("Ctrl-C", 3, &["interrupted", "--resume"]);
    place.start(&command).end().refused("again", 2, &["swept", "--resume"]);
    let mut first = place.start(&[&command[..], &["--resume"]].concat());
    let before = batches(&place).len();
    first.wait_until(|| batches(&place).len() > before);
    let second = place.start(&[&command[..], &["--resume"]].concat()).end();
    second.refused("two at once", 2, &["swept"]);
    assert_eq!(first.end().code(), Some(0));
}

#[test]
fn more_threads_than_there_is_memory_for_are_an_error_and_nothing_is_lost() {
    let place = place("sweep-threads");
    let args = [&SWEEP[..], &["-o", "swept"]].concat();
    let stopped = place.nboom(&[&args[..], &["--jobs", "2000"]].concat());
    stopped.refused("2000 threads", 3, &["of 2000 cannot be started", "fewer jobs expected"]);
    let resumed = place.start(&args).end();
    assert_eq!(resumed.code(), Some(0), "{}", resumed.stderr());
}

#[test]
fn a_sweep_of_which_nothing_ran_is_not_well() {
    let place = place("sweep-none");
    let study = STUDY.replace("draws = 1500", "draws = 5");
    for (path, values, told) in [
        ("main_body.mass", "from = -2.0, to = -1.0", "5 rejected, 0 failed"),
        ("body[1].hinge.spring.stiffness", "from = -1e9, to = -9e8", "0 rejected, 5 failed"),
    ] {
        let study = study.replace("initial.rate_deg[1]", path);
        place.write("study.toml", study.replace("from = 400.0, to = 600.0", values));
        let finished = place.start(&[&SWEEP[..], &["-o", told]].concat()).end();
        assert_eq!(finished.code(), Some(3), "{path}");
        for words in ["none of 5 cases ran", told, "status"] {
            assert!(finished.stderr().contains(words), "{path}: {}", finished.stderr());
        }
        let table = place.read(&format!("{told}/cases.csv"));
        assert_eq!(table.lines().count(), 6, "the reasons are there");
    }
}

/// While the worst cases are run again for their pages a signal may come between two of these runs.
#[test]
fn an_interrupt_is_heard_while_pages_are_made() {
    let place = place("sweep-pages");
    place.write("few.toml", STUDY.replace("draws = 1500", "draws = 30"));
    let sweep = ["sweep", "few.toml", "-o", "swept", "--quiet", "--resume"];
    let mut running = place.start(&sweep);
    running.wait_until(|| place.path("swept/statistics.json").exists());
    running.signal("INT");
    let words = ["interrupted; all cases are done", "--resume makes them"];
    running.end().refused("between pages", 3, &words);
    assert!(!place.path("swept/report.html").exists());
    let finished = place.start(&sweep).end();
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    assert!(place.path("swept/report.html").exists());
}
