//! `nboom run` on a deck that asks for stresses.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

/// Columns that scripts rely on.
const STRESS_HEADER: &str = "t,event,appendage,segment,station,point,xi,zeta,sigma_22,sigma_21,\
     sigma_23,principal_1,principal_2,von_mises,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const FILES: [&str; 5] = [
    "stress.csv",
    "stress_envelope.csv",
    "hinge_loads.csv",
    "latch_impulses.csv",
    "hinge_load_envelope.csv",
];

/// The sample deck, which has four segments with seven stations in all and INSTR = 3.
fn deck() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
    fs::read_to_string(path).expect("in the clone")
}

fn run(deck: &str, args: &[&str]) -> (Output, TempDir) {
    let place = tempfile::tempdir().expect("a directory");
    fs::write(place.path().join("deck.nml"), deck).expect("writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
    command.current_dir(place.path()).args(["run", "deck.nml", "-o", "out"]).args(args);
    (command.output().expect("the binary starts"), place)
}

fn rows(place: &TempDir, file: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(place.path().join("out").join(file)).expect("written");
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().expect("a number")
}

#[test]
fn a_check_says_where_stresses_are_computed() {
    let place = tempfile::tempdir().expect("a directory");
    fs::write(place.path().join("deck.nml"), deck()).expect("writable");
    let check = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
        let output = command.current_dir(place.path()).args(["check", "deck.nml"]).output();
        let output = output.expect("the binary starts");
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8(output.stdout).expect("text")
    };
    let said = check();
    for words in
        ["stresses: at 7 stations of 4 segments", "segment 1,1: at ", "material: Young's modulus"]
    {
        assert!(said.contains(words), "no {words:?} in {said}");
    }
    fs::write(place.path().join("deck.nml"), deck().replace("INSTR=3", "INSTR=0"))
        .expect("writable");
    assert!(check().contains("stresses: none"), "{}", check());
}

#[test]
fn stresses_come_at_every_third_output_and_at_every_lock_up() {
    let (output, place) = run(&deck(), &["--samples", "30"]);
    assert_eq!(output.status.code(), Some(0));
    let stresses = rows(&place, "stress.csv");
    assert_eq!(stresses[0].join(","), STRESS_HEADER);
    let of_motion = |row: &&Vec<String>| row[1].is_empty() && row[5] == "max";
    let mut times: Vec<f64> =
        stresses[1..].iter().filter(of_motion).map(|r| number(&r[0])).collect();
    times.dedup();
    let output_times: Vec<f64> =
        rows(&place, "states.csv")[1..].iter().map(|row| number(&row[0])).step_by(3).collect();
    assert_eq!(times, output_times);
    let peaks = stresses[1..].iter().filter(|row| row[1] == "lock_up" && row[5] == "max").count();
    assert_eq!(peaks, 4 * 7, "four lock-ups, seven stations");
    let hinge_rows = rows(&place, "hinge_loads.csv").len() - 1;
    assert_eq!(hinge_rows, 4 * (times.len() + 4));
}

#[test]
fn the_envelope_has_the_worst_of_each_station_and_the_account_the_worst_of_all() {
    let (output, place) = run(&deck(), &["--yield-stress", "4e5", "--safety-factor", "1.5"]);
    let stresses = rows(&place, "stress.csv");
    let envelope = rows(&place, "stress_envelope.csv");
    assert_eq!(envelope.len(), 1 + 7);
    for worst in &envelope[1..] {
        let station = |row: &&Vec<String>| row[2..5] == worst[0..3];
        let of_station = stresses[1..].iter().filter(station);
        let largest = of_station.map(|row| number(&row[13])).fold(0.0, f64::max);
        let found = number(&worst[12]);
        // By what the search of a step may miss.
        assert!(found >= largest * (1.0 - 1e-7), "{worst:?}: {largest}");
        let margin = 4e5 / (1.5 * found) - 1.0;
        // Written to the last digit; two roundings to get there.
        assert!((number(&worst[14]) - margin).abs() < 1e-14 * (1.0 + margin.abs()));
        // A hinge, and its share, where it is a lock-up; P and Q anyway.
        let is_lock_up = worst[4] == "lock_up";
        assert!([5, 6, 15].iter().all(|&column| worst[column].is_empty() != is_lock_up));
        assert!(worst[16..22].iter().any(|cell| number(cell) != 0.0), "{worst:?}");
    }
    // The end of segment 1,2 is loaded most just after the release of 1,1.
    let releases = rows(&place, "events.csv").into_iter().filter(|row| row[1] == "release");
    let released: Vec<f64> = releases.map(|row| number(&row[0])).collect();
    let at_release = |worst: &&Vec<String>| {
        worst[4].is_empty() && released.iter().any(|at| (at - number(&worst[3])).abs() < 1e-9)
    };
    assert!(envelope[1..].iter().any(|worst| at_release(&worst)), "{envelope:?} {released:?}");
    let told = String::from_utf8(output.stdout).expect("text");
    let line = told.lines().find(|line| line.starts_with("worst stress")).expect("told");
    assert!(line.contains(" F/L² in segment 2,1, station 2") && line.contains("margin"), "{line}");
}

/// All of a table but the header, by the numbers in some columns.
fn numbers(place: &TempDir, file: &str, column: usize) -> Vec<f64> {
    rows(place, file)[1..].iter().map(|row| number(&row[column])).collect()
}

/// The largest stress of each station, then the largest force and moment of each hinge.
fn envelopes(place: &TempDir) -> Vec<f64> {
    let stresses = numbers(place, "stress_envelope.csv", 12);
    [stresses, numbers(place, "hinge_load_envelope.csv", 7)].concat()
}

#[test]
fn the_worst_depends_neither_on_outputs_nor_on_the_length_of_the_run() {
    let (_, usual) = run(&deck(), &[]);
    let expected = envelopes(&usual);
    assert_eq!(expected.len(), 7 + 2 * 4);
    for (deck, args) in [
        (deck(), &["--samples", "1"][..]),
        (deck(), &["--samples", "3000"]),
        (deck().replace("INSTR=3", "INSTR=1000"), &[]),
        // All hinges are locked by then, and the satellite goes on to spin as it does.
        (deck(), &["--end-time", "3"]),
    ] {
        let (output, place) = run(&deck, args);
        assert_eq!(output.status.code(), Some(0));
        for (found, expected) in envelopes(&place).iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{args:?}: {found} {expected}");
        }
    }
}

#[test]
fn all_at_once_is_no_less_than_half_sines() {
    let (_, sines) = run(&deck(), &[]);
    let (output, at_once) = run(&deck(), &["--pulses", "all-at-once"]);
    assert_eq!(output.status.code(), Some(0));
    let (sines, at_once) = (envelopes(&sines), envelopes(&at_once));
    let pairs = || sines.iter().zip(&at_once);
    assert!(pairs().all(|(sine, peak)| *peak >= sine * (1.0 - 1e-7)), "{sines:?} {at_once:?}");
    // The last two hinges lock within a pulse of each other.
    assert!(pairs().any(|(sine, peak)| *peak > 1.01 * sine), "{sines:?} {at_once:?}");
}

/// Impulses about the axes of hinges that lock are those of `events.csv`.
#[test]
fn any_scene_has_hinge_loads_on_request() {
    let without_stations = deck().replace("INSTR=3", "INSTR=0");
    let (output, place) = run(&without_stations, &["--hinge-loads", "--samples", "20"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let of_stresses = |file: &&str| file.starts_with("stress");
    assert!(
        FILES.into_iter().filter(of_stresses).all(|f| !place.path().join("out").join(f).exists())
    );
    let motion = rows(&place, "hinge_loads.csv");
    assert_eq!(motion.len() - 1, 4 * 21, "peaks need pulse constants");
    assert_eq!(rows(&place, "hinge_load_envelope.csv").len() - 1, 2 * 4);
    let impulses = rows(&place, "latch_impulses.csv");
    assert_eq!(impulses.len() - 1, 4 * 4, "four lock-ups, four hinges");
    let events = rows(&place, "events.csv");
    for event in events.iter().filter(|row| row[1] == "lock_up") {
        let is_own = |row: &&Vec<String>| {
            row[0] == event[0] && row[1..3] == event[2..4] && row[3..5] == event[2..4]
        };
        let own = impulses.iter().find(is_own).expect("a row for each hinge");
        let moment = own[8..11].iter().map(|cell| number(cell).powi(2)).sum::<f64>().sqrt();
        assert!(moment >= number(&event[4]).abs() * (1.0 - 1e-9), "{own:?} {event:?}");
    }
}

/// Without inertias of their own slices change what stations carry, and nothing of the motion.
#[test]
fn a_deck_may_have_stations_without_inertias_of_slices() {
    let (from, to) = (deck().find(" &DYNSTB").unwrap(), deck().find(" &ROCK").unwrap());
    let alone = format!("{}{}", &deck()[..from], &deck()[to..]);
    let (output, place) = run(&alone, &["--samples", "30"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(FILES.iter().all(|file| place.path().join("out").join(file).exists()));
    let (_, whole) = run(&deck(), &["--samples", "30"]);
    assert_eq!(rows(&place, "states.csv"), rows(&whole, "states.csv"));
    assert_eq!(rows(&place, "hinge_loads.csv"), rows(&whole, "hinge_loads.csv"));
}

#[test]
fn a_run_says_what_its_stresses_leave_out() {
    let (output, place) = run(&deck(), &[]);
    let told = String::from_utf8(output.stdout).expect("text");
    let line = told.lines().find(|line| line.starts_with("worst stress")).expect("told");
    assert!(line.contains("thin walls") && line.contains("corners and holes"), "{line}");
    let text = fs::read_to_string(place.path().join("out/summary.json")).expect("written");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let left_out = summary["stresses"]["left_out"].as_str().expect("told");
    assert!(left_out.contains("corners, holes"), "{left_out}");
    assert_eq!(summary["stresses"]["pulses"], "half-sine");
}

#[test]
fn a_run_says_by_what_its_margins_are_judged_that_the_scene_does_not_say() {
    let (output, place) = run(&deck(), &["--yield-stress", "4e5", "--safety-factor", "1.5"]);
    let told = String::from_utf8(output.stdout).expect("text");
    let by = "a yield stress of 4e5 for all materials, safety factor 1.5";
    assert!(told.contains(by), "{told}");
    let read = |file: &str| fs::read_to_string(place.path().join("out").join(file));
    let summary: serde_json::Value =
        serde_json::from_str(&read("summary.json").expect("written")).expect("JSON");
    assert_eq!(summary["judged_by"], by);
    let (output, place) = run(&deck(), &[]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("judged by"));
    let text = fs::read_to_string(place.path().join("out/summary.json")).expect("written");
    assert!(!text.contains("judged_by"));
}

/// The outer end of a segment whose outermost slice has no mass carries nothing.
#[test]
fn what_carries_nothing_says_so() {
    // Its kick-off spring pushes at the very end.
    let massless = deck().replace("DELM(1,2)=.001", "DELM(1,2)=0.0");
    let massless = massless.replace("4.0,-.5,.05,0.0,1.0", "4*0.0,1.0");
    assert_eq!(massless.len(), deck().len() - 11);
    let (output, place) = run(&massless, &["--yield-stress", "4e5"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let envelope = rows(&place, "stress_envelope.csv");
    let unloaded: Vec<_> = envelope.iter().filter(|row| row[13] == "unloaded").collect();
    let [row] = unloaded[..] else { panic!("{envelope:?}") };
    assert_eq!((row[0..3].join(","), &*row[14]), ("1,2,1".to_owned(), ""));
    let margins = envelope[1..].iter().filter(|row| row[13] != "unloaded");
    assert!(margins.clone().all(|row| number(&row[14]).is_finite()));
}

#[test]
fn what_is_not_asked_for_is_not_written() {
    for (deck, args) in
        [(deck(), &["--no-stresses"][..]), (deck().replace("INSTR=3", "INSTR=0"), &[])]
    {
        let (output, place) = run(&deck, args);
        assert_eq!(output.status.code(), Some(0));
        assert!(FILES.iter().all(|file| !place.path().join("out").join(file).exists()));
        assert!(!String::from_utf8_lossy(&output.stdout).contains("worst stress"));
    }
}

#[test]
fn files_of_an_earlier_run_do_not_stay() {
    let (_, place) = run(&deck(), &[]);
    let mut again = Command::new(env!("CARGO_BIN_EXE_nboom"));
    again.current_dir(place.path()).args(["run", "deck.nml", "-o", "out", "--no-stresses"]);
    assert_eq!(again.output().expect("the binary starts").status.code(), Some(0));
    assert!(FILES.iter().all(|file| !place.path().join("out").join(file).exists()));
}

#[test]
fn sections_and_factors_that_are_none_are_refused() {
    let thick = deck().replacen("R(1,1)=2.0", "R(1,1)=0.01", 1);
    let (output, _) = run(&thick, &[]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("deck.nml:54:5: T1(1,1): "), "{told}");
    for option in ["--yield-stress", "--safety-factor", "--amplification"] {
        for value in ["0", "-1", "NaN", "inf", "strong"] {
            let (output, _) = run(&deck(), &[option, value]);
            let told = String::from_utf8(output.stderr).expect("text");
            assert_eq!(output.status.code(), Some(2), "{option} {value}: {told}");
            assert!(told.contains(option), "{told}");
        }
    }
}

fn signs_told(place: &TempDir) -> String {
    let text = fs::read_to_string(place.path().join("out/summary.json")).expect("written");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary["stresses"]["signs"].as_str().expect("told").to_owned()
}

/// What files say in the cells of these columns: the same, the opposite, or the opposite of the
/// column beside.
fn reversed(rows: &[Vec<String>], opposite: &[usize], exchanged: [usize; 2]) -> Vec<Vec<String>> {
    let [a, b] = exchanged;
    let reverse = |row: &Vec<String>| {
        let mut row = row.clone();
        row.swap(a, b);
        for &column in opposite {
            let negative = row[column].strip_prefix('-').map(str::to_owned);
            row[column] = negative.unwrap_or_else(|| format!("-{}", row[column]));
        }
        row
    };
    let (header, rows) = rows.split_first().expect("a header");
    [header.clone()].into_iter().chain(rows.iter().map(reverse)).collect()
}

/// σ₂₂, σ₂₁, σ₂₃ and the principal stresses, of which the largest becomes the smallest.
#[test]
fn signs_of_the_report_reverse_all_stresses_and_nothing_else() {
    let args = ["--samples", "10"];
    let (_, ours) = run(&deck(), &args);
    let (output, reports) = run(&deck(), &[&args[..], &["--report-signs"]].concat());
    assert_eq!(output.status.code(), Some(0));
    let [stress, envelope, hinge_loads, ..] = FILES;
    let expected = reversed(&rows(&ours, stress), &[8, 9, 10, 11, 12], [11, 12]);
    assert_eq!(rows(&reports, stress), expected);
    assert_ne!(rows(&reports, stress), rows(&ours, stress));
    let expected = reversed(&rows(&ours, envelope), &[9, 10, 11], [0, 0]);
    assert_eq!(rows(&reports, envelope), expected);
    assert_eq!(rows(&reports, hinge_loads), rows(&ours, hinge_loads));
    assert_eq!(signs_told(&ours), "tension positive");
    assert_eq!(signs_told(&reports), "compression positive, as in the report");
}

/// Where the inner boom is held and spun, it is pulled: P_η on what is outboard is negative.
#[test]
fn tension_has_the_sign_that_is_told() {
    for (args, positive) in [(&[][..], true), (&["--report-signs"], false)] {
        let (_, place) = run(&deck(), args);
        let stresses = rows(&place, "stress.csv");
        let last = stresses.last().expect("rows");
        let pulled = |row: &&Vec<String>| row[0] == last[0] && row[5] != "max";
        let mean_of = |segment: [&str; 2]| -> (f64, f64) {
            let of = stresses.iter().filter(pulled).filter(|row| row[2..4] == segment);
            of.fold((0.0, 0.0), |(p, s), row| (p + number(&row[15]), s + number(&row[8])))
        };
        let (p_eta, sigma) = mean_of(["1", "1"]);
        assert!(p_eta < 0.0 && (sigma > 0.0) == positive, "{args:?}: {p_eta} {sigma}");
    }
}

/// Its loads contradict its motion, and it is told so beforehand.
#[test]
fn a_run_with_all_slips_of_1970_goes_to_its_end() {
    let (output, place) = run(&deck(), &["--as-1970", "--samples", "10"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{told}");
    let words = "wrong on purpose, as in 1970: chain-kick-off, ";
    assert!(told.contains(words), "{told}");
    let summary = fs::read_to_string(place.path().join("out/summary.json")).expect("a summary");
    let (_, troubles) = summary.split_once("\"troubles\"").expect("a key");
    assert!(troubles.contains(words), "{troubles}");
    let events = rows(&place, "events.csv");
    let last = events.iter().rfind(|row| row[1] == "lock_up").expect("lock-ups");
    // The emulation's time, which this tolerance meets within 1e-10; one slip alone is off by 1e-3.
    assert!((number(&last[0]) - 0.328173915).abs() < 1e-8, "{last:?}");
    assert!(place.path().join("out/stress.csv").exists());
}
