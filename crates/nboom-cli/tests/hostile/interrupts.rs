//! Ctrl-C and SIGTERM: exit code 3, marked files, whole rows, the time reached.

use super::files::{contents, rows_are_whole, summary};
use super::place::{Place, REPORT_DECK};

/// A boom that swings for as long as anybody waits.
pub const SWINGING: &str = include_str!("../decks/swinging.nml");

/// A run of minutes, after its first rows are on the disk.
fn running(place: &Place) -> super::place::Running {
    place.write("deck.nml", SWINGING);
    let span = ["--end-time", "1e6", "--samples", "100000", "--quiet"];
    let mut running = place.start(&[&["run", "deck.nml", "-o", "run"][..], &span].concat());
    let table = place.path("run.partial/states.csv");
    running.wait_until(|| std::fs::metadata(&table).is_ok_and(|table| table.len() > 0));
    running
}

#[test]
fn the_first_signal_ends_a_run_in_good_order() {
    for signal in ["INT", "TERM"] {
        let place = Place::new(&format!("interrupt-{signal}"));
        let running = running(&place);
        running.signal(signal);
        let finished = running.end();
        let words = ["interrupted at time ", "is in run, marked incomplete"];
        finished.refused(signal, 3, &words);
        assert!(!place.path("run.partial").exists());
        let summary = summary(&place.path("run")).expect("a summary");
        assert_eq!(summary["complete"], false);
        let reached = summary["end_time"].as_f64().expect("a time");
        assert!(reached > 0.0 && reached < 1e6, "{reached}");
        let told = format!("interrupted at time {reached}");
        assert!(finished.stderr().contains(&told), "no {told:?} in {}", finished.stderr());
        assert_eq!(summary["error"], told);
        rows_are_whole(&place.path("run"));
        let rows = place.read("run/states.csv");
        let last = rows.lines().last().and_then(|row| row.split(',').next()).expect("a row");
        let last: f64 = last.parse().expect("a time");
        // Output times are 10 apart; all of them up to the interrupt are there.
        assert!(last <= reached && reached - last <= 10.0, "{last} {reached}");
    }
}

#[test]
fn a_finished_result_outlives_an_interrupted_run() {
    let place = Place::new("interrupt-old");
    place.write("old.nml", SWINGING);
    let finished = place.nboom(&["run", "old.nml", "-o", "run", "--end-time", "3", "--quiet"]);
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    let old = contents(&place.path("run"));
    let running = running(&place);
    running.signal("INT");
    running.end().refused("interrupted", 3, &["is in run.partial, marked incomplete"]);
    assert_eq!(contents(&place.path("run")), old);
    assert_eq!(summary(&place.path("run.partial")).expect("a summary")["complete"], false);
    rows_are_whole(&place.path("run.partial"));
    // What was interrupted is in nobody's way.
    let finished = place.nboom(&["run", "old.nml", "-o", "run", "--end-time", "4", "--quiet"]);
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    assert_eq!(summary(&place.path("run")).expect("a summary")["end_time"], 4.0);
    assert!(!place.path("run.partial").exists());
}

/// The reference run of a certificate is interrupted too; the run itself is complete by then.
#[test]
fn an_interrupted_certificate_leaves_a_complete_run() {
    use std::time::Duration;
    let place = Place::new("interrupt-certify");
    place.write("deck.nml", SWINGING);
    let args = ["--end-time", "5000", "--rtol", "1e-8", "--certify", "--quiet"];
    let mut running = place.start(&[&["run", "deck.nml", "-o", "run"][..], &args].concat());
    running.wait_until(|| place.path("run/summary.json").exists());
    std::thread::sleep(Duration::from_millis(20));
    running.signal("INT");
    let words = ["the reference run: interrupted at time ", "complete", "results are in run"];
    running.end().refused("certificate", 3, &words);
    assert_eq!(summary(&place.path("run")).expect("a summary")["complete"], true);
    assert!(!place.path("run/certificate.json").exists());
    assert!(!place.path("run.partial").exists());
    assert!(place.path("run/report.html").exists(), "the page is of the run");
}

/// Output times and stresses are asked too: a step may have millions of output times.
#[test]
fn a_run_that_only_writes_is_interrupted() {
    let place = Place::new("interrupt-writing");
    place.write("deck.nml", REPORT_DECK);
    let args = ["run", "deck.nml", "-o", "run", "--samples", "10000000", "--listing", "--quiet"];
    let mut running = place.start(&args);
    let table = place.path("run.partial/stress.csv");
    running.wait_until(|| std::fs::metadata(&table).is_ok_and(|table| table.len() > 0));
    running.signal("INT");
    running.end().refused("writing", 3, &["interrupted at time "]);
    rows_are_whole(&place.path("run"));
    let last_time = |file: &str| -> f64 {
        let table = place.read(&format!("run/{file}"));
        let time = table.lines().last().and_then(|row| row.split(',').next());
        time.and_then(|text| text.parse().ok()).expect("a row")
    };
    let reached = summary(&place.path("run")).expect("a summary")["end_time"].as_f64();
    let reached = reached.expect("a time");
    // Output times are 1e-7 apart, and stresses are asked for at every third.
    assert!(last_time("states.csv") >= reached - 1.5e-7, "{reached}");
    assert!(last_time("stress.csv") >= reached - 3.5e-7, "{reached}");
}

/// A chain of a thousand hinges by an implicit method: one step is a matrix of 2000 rows and takes
/// seconds. It is broken off, also while the run is being prepared.
#[test]
fn a_long_step_is_broken_off() {
    let place = Place::new("interrupt-long");
    place.write("old.nml", SWINGING);
    let old = place.nboom(&["run", "old.nml", "-o", "run", "--quiet"]);
    assert_eq!(old.code(), Some(0), "{}", old.stderr());
    let old = contents(&place.path("run"));
    let inertia = vec!["1.1,3*0.0,0.05,3*0.0,1.1"; 1000].join(",\n ");
    let springs: Vec<String> = (1..=1000).map(|i| format!(" EKNIK({i},2)=-30.0,\n")).collect();
    let chain = format!(
        " &DIM\n NA=1,NP=0,IXK=1000,\n &END\n &NXPUT\n INSTR=0,BETAIK=1000*10.0,BSIK=1000*1.0E6,\n \
         OMEG=1.0,2.0,-1.0,NK=1000,DBK=0.0,0.5,0.1,FTSIK=0.0,90.0,0.0,\n \
         ELIK=1000*2.0,EMIK=1000*3.0,HIIK={inertia},\n EMM=100.0,HM=40.0,3*0.0,30.0,3*0.0,35.0,\n{}\
         \n &END\n &ROCK\n TF=1000.0,SEGSTT=1000*1.0,\n &END\n",
        springs.concat()
    );
    place.write("chain.nml", chain);
    for wait in [300, 3000] {
        let args = ["run", "chain.nml", "-o", "run", "--integrator", "radau5", "--quiet"];
        let running = place.start(&args);
        std::thread::sleep(std::time::Duration::from_millis(wait));
        running.signal("INT");
        let finished = running.end();
        let has_some = place.path("run.partial").exists();
        let told =
            if has_some { "is in run.partial, marked incomplete" } else { "no unfinished results" };
        finished.refused("a long step", 3, &["interrupted", told]);
        assert_eq!(contents(&place.path("run")), old);
        if let Some(summary) = summary(&place.path("run.partial")) {
            assert_eq!(summary["complete"], false);
        }
        // On a busy machine the next run may be interrupted before it has begun to write.
        if has_some {
            std::fs::remove_dir_all(place.path("run.partial")).expect("nobody holds it");
        }
    }
}
