//! The directory of a run as a whole: what is in it at each stage, and when the disk is full.

use std::fs;
use std::path::Path;

use nboom_model::{
    Appendage, Column, Hinge, HingeState, MassProperties, Material, Mount, Rotor, RotorSpeed,
    Scene, SceneDescription, SectionShape, Segment, SegmentStructure, Station, Structure,
    UnitSystem, WantedTable,
};
use nboom_results::{
    Outcome, ResultsError, RunDescription, RunDirectory, StressSigns, StressTables, WantedOutput,
};
use nboom_scalar::{Quaternion, Sym3, Vec3};
use nboom_sim::{
    Account, Choice, Conservation, Detail, Event, EventKind, HingeImpulse, HingeVerdict,
    Integration, Method, Options, Recorder, Selection, Snapshot, Summary, Totals, Verdict,
    simulate,
};
use nboom_strength::{Settings, StressAnalysis};

fn scene() -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
    let mut description = SceneDescription::at_rest("one boom", hub, 10.0);
    let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    Scene::new(description).expect("the bodies are physical")
}

fn create(path: &Path, listing: bool) -> Result<RunDirectory, ResultsError> {
    let scene = scene();
    let run = RunDescription::new(&scene, &Options::default(), UnitSystem::Si);
    let output = WantedOutput { listing, ..WantedOutput::default() };
    RunDirectory::create(path, &scene, RunDescription { output, ..run })
}

fn snapshot(time: f64) -> Snapshot {
    Snapshot {
        time,
        position_inertial: Vec3::zero(),
        velocity_inertial: Vec3::zero(),
        attitude: Quaternion::identity(),
        omega_body: Vec3::unit_x(),
        beta: vec![0.1],
        tau: vec![0.2],
        alpha: vec![0.1],
        sigma: vec![0.2],
        rotor_speeds: Vec::new(),
        hinges: vec![HingeState::Free],
        kinetic_energy: 1.0,
        linear_momentum_inertial: Vec3::zero(),
        angular_momentum_inertial: Vec3::unit_x(),
        nutation: 0.0,
        detail: Some(Detail {
            omega_dot_body: Vec3::zero(),
            origin_acceleration_body: Vec3::zero(),
            reaction: None,
            outside: Vec::new(),
            rotors: Vec::new(),
            motor_torques: Vec::new(),
            beta_ddot: vec![0.0],
            alpha_ddot: vec![0.0],
            hinge_torque: vec![0.0],
            lines: Vec::new(),
            mass_center_body: Vec3::zero(),
            mass_center_inertial: Vec3::zero(),
            mass_center_velocity_inertial: Vec3::zero(),
            mass_center_acceleration_inertial: Vec3::zero(),
        }),
        account: Some(Account::default()),
        steps: 3,
        next_step: 0.5,
    }
}

fn event(time: f64, kind: EventKind, hinge: Option<usize>) -> Event {
    let totals = Totals {
        kinetic_energy: 1.0,
        linear_momentum_inertial: Vec3::zero(),
        angular_momentum_inertial: Vec3::unit_x(),
    };
    Event { time, kind, hinge, impulse: None, before: totals, after: totals }
}

fn selection(since: f64, path: &'static str, formulation: &'static str, reason: &str) -> Selection {
    let evaluations = if path == "generated" { 72 } else { 24 };
    Selection { since, path, formulation, reason: reason.into(), evaluations }
}

fn integration(since: f64, method: Method) -> Integration {
    Integration { since, choice: Choice { method, reason: "it suits" } }
}

fn outcome(error: Option<&str>) -> Outcome {
    let conservation =
        Conservation { linear_momentum: Some(1e-15), angular_momentum: Some(2e-15), energy: 3e-13 };
    let hinge = HingeVerdict::new(HingeState::Locked, 0.25);
    let summary = Summary {
        end_time: 10.0,
        steps_accepted: 7,
        steps_rejected: 1,
        evaluations: 96,
        jacobians: 2,
        factorizations: 3,
        events: 2,
        conservation,
        has_angular_momentum: true,
        integrator: "auto",
        integrations: vec![integration(0.0, Method::Dop853), integration(5.0, Method::Radau5)],
        attitude_drift: 3e-12,
        selections: vec![
            selection(0.0, "generic", "recursive", "no routine"),
            selection(5.0, "generated", "articulated", "routine"),
        ],
        verdict: Verdict {
            hinges: vec![HingeVerdict { since: Some(5.0), closing_rate: Some(-0.5), ..hinge }],
            largest_impulse: Some(HingeImpulse { hinge: 0, time: 5.0, impulse: -1.5 }),
        },
        runaway: None,
    };
    let troubles = vec!["a part fails".to_owned()];
    Outcome { summary, wall_seconds: 0.25, error: error.map(str::to_owned), troubles }
}

fn summary(directory: &Path) -> serde_json::Value {
    let text = fs::read_to_string(directory.join("summary.json")).expect("a summary");
    serde_json::from_str(&text).expect("JSON")
}

fn lines(directory: &Path, file: &str) -> Vec<String> {
    let text = fs::read_to_string(directory.join(file)).expect("a table");
    text.lines().map(str::to_owned).collect()
}

/// Of a hub that does not turn about x, whose wheel about x does.
#[test]
fn a_table_of_rotors_has_their_speeds_and_the_torques_of_their_motors() {
    let (moment, inertia) = (40.0, 0.5);
    let mut description = (*scene()).clone();
    description.bodies.clear();
    let speed = RotorSpeed::Table(vec![[0.0, 1.0], [20.0, 41.0]]);
    description.rotors = vec![Rotor { body: None, axis: Vec3::unit_x(), inertia, speed }];
    let scene = Scene::new(description).expect("a body with a rotor");
    let named = |text| Column::named(text, &[], 1).expect("a column");
    let columns = [named("rotor_speed_1"), named("motor_torque")].concat();
    let table = Some(WantedTable { columns, in_degrees: false });
    let options = Options { samples: 1, ..Options::default() };
    let run = RunDescription::new(&scene, &options, UnitSystem::Si);
    let output = WantedOutput { table, ..WantedOutput::default() };
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("run");
    let description = RunDescription { output, ..run };
    let mut directory = RunDirectory::create(&path, &scene, description).expect("writable");
    let summary = simulate(&scene, &options, &mut directory).expect("it runs to its end");
    let outcome = Outcome { summary, wall_seconds: 0.25, error: None, troubles: Vec::new() };
    directory.finish(&outcome).written.expect("writable");
    let rows = lines(&path, "output.csv");
    assert_eq!(rows[0], "t,rotor_speed_1,motor_torque_1");
    for (row, expected) in rows[1..].iter().zip([1.0, 21.0]) {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
        assert!((cells[1] - expected).abs() < 1e-13, "{row}");
        let torque = inertia * moment / (moment + inertia) * 2.0;
        assert!((cells[2] - torque).abs() < 1e-13, "{row}");
    }
}

#[test]
fn a_finished_run_has_all_rows_and_every_key() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("out/run");
    let mut directory = create(&path, false).expect("writable");
    assert!(!directory.needs_detail());
    directory.sample(&snapshot(0.0)).expect("writable");
    directory.event(&event(5.0, EventKind::Release, Some(0)), &snapshot(5.0)).expect("writable");
    directory.event(&event(5.0, EventKind::LockUp, Some(0)), &snapshot(5.0)).expect("writable");
    directory.sample(&snapshot(10.0)).expect("writable");
    directory.event(&event(10.0, EventKind::End, None), &snapshot(10.0)).expect("writable");
    assert!(!path.exists());
    let kept = directory.finish(&outcome(None));
    kept.written.as_ref().expect("writable");
    assert_eq!(kept.directory, path);

    assert_eq!(lines(&path, "states.csv").len(), 3);
    let events = lines(&path, "events.csv");
    let kinds: Vec<&str> = events[1..].iter().filter_map(|row| row.split(',').nth(1)).collect();
    assert_eq!(kinds, ["lock_up", "release", "end"]);
    let expected = serde_json::json!({
        "scene": "one boom",
        "version": env!("CARGO_PKG_VERSION"),
        "input_sha256": null,
        "degrees_of_freedom": 7,
        "path": "mixed",
        "formulation": "articulated",
        "generated_share": 0.75,
        "selections": [
            {"since": 0.0, "path": "generic", "formulation": "recursive", "reason": "no routine",
             "evaluations": 24},
            {"since": 5.0, "path": "generated", "formulation": "articulated", "reason": "routine",
             "evaluations": 72},
        ],
        "integrator": "auto",
        "integrations": [
            {"since": 0.0, "integrator": "dop853", "reason": "it suits"},
            {"since": 5.0, "integrator": "radau5", "reason": "it suits"},
        ],
        "rtol": Options::default().rtol,
        "atol": Options::default().atol,
        "samples": 200,
        "units": "SI",
        "complete": true,
        "end_time": 10.0,
        "steps_accepted": 7, "steps_rejected": 1,
        "evaluations": 96,
        "jacobians": 2,
        "factorizations": 3,
        "events": 2,
        "verdict": {
            "hinges": [{"appendage": 1, "segment": 1, "state": 1, "time": 5.0, "angle": 0.25, "miss": null, "miss_time": null, "closing_rate": -0.5}],
            "largest_impulse": 1.5,
            "largest_impulse_at": {"appendage": 1, "segment": 1, "time": 5.0, "impulse": -1.5},
            "worst_load": null,
            "worst_load_at": null,
            "smallest_margin": null,
            "smallest_margin_at": null,
            "smallest_yield_margin": null,
            "smallest_yield_margin_at": null,
            "smallest_ultimate_margin": null,
            "smallest_ultimate_margin_at": null,
            "largest_hinge_force": null,
            "largest_hinge_force_at": null,
            "largest_hinge_moment": null,
            "largest_hinge_moment_at": null,
        },
        "wall_seconds": 0.25,
        "conservation": {"linear_momentum": 1e-15, "angular_momentum": 2e-15, "energy": 3e-13},
        "attitude_drift": 3e-12,
        "skipped": nboom_model::skipped(&scene()),
        "warnings": ["a part fails"],
        "troubles": ["a part fails"],
        "files": ["states.csv", "instants.csv", "ledger.csv", "events.csv", "datapackage.json", "summary.json"],
    });
    assert_eq!(summary(&path), expected);
    assert!(!path.join("listing.txt").exists());
    assert_eq!(fs::read_dir(&path).expect("readable").count(), 6);
    drop(kept);
    assert!(!place.path().join("out/run.partial").exists());
}

/// What was finished stays until something finished takes its place, whole.
#[test]
fn the_summary_expects_files_that_are_made_of_tables_there_are() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("run");
    let made = ["states.parquet", "stress.parquet", "output.parquet", "run.h5"];
    let directory = create(&path, false).expect("writable").expecting(made);
    let kept = directory.finish(&outcome(None));
    let files = summary(&path)["files"].clone();
    let is_expected = |name: &str| files.as_array().expect("a list").iter().any(|f| f == name);
    // It has no stresses and nobody asked for an output.
    assert_eq!(made.map(is_expected), [true, false, false, true], "{files}");
    let write = |draft: &Path| fs::write(draft, "made").map_err(|_| unreachable!("writable"));
    kept.add_made::<ResultsError>("run.h5", write).expect("writable");
    assert_eq!(fs::read_to_string(path.join("run.h5")).ok().as_deref(), Some("made"));
    drop(kept);
    // The next run knows it and takes it away.
    create(&path, false).expect("its own").finish(&outcome(None)).written.expect("writable");
    assert!(!path.join("run.h5").exists());
}

#[test]
fn an_earlier_result_stays_until_the_next_one_is_finished() {
    let place = tempfile::tempdir().expect("a directory");
    let (path, partial) = (place.path().join("run"), place.path().join("run.partial"));
    fs::create_dir(&path).expect("writable");
    fs::write(path.join("notes.txt"), "mine").expect("writable");
    create(&path, true).expect("writable").finish(&outcome(None)).written.expect("writable");
    let finished = |with_listing: bool| {
        assert_eq!(summary(&path)["complete"], true);
        assert_eq!(path.join("listing.txt").exists(), with_listing);
        assert_eq!(fs::read_to_string(path.join("notes.txt")).ok().as_deref(), Some("mine"));
    };
    finished(true);

    // Given up without a word, as by a panic.
    let abandoned = create(&path, false).expect("writable");
    assert_eq!(summary(&partial)["complete"], false);
    let error = summary(&partial)["error"].as_str().expect("a text").to_owned();
    assert!(error.contains("going on or was interrupted"), "{error}");
    drop(abandoned);
    assert_eq!(summary(&partial)["complete"], false);
    finished(true);

    let failed = create(&path, false).expect("writable").finish(&outcome(Some("too stiff")));
    assert_eq!(failed.directory, partial);
    drop(failed);
    assert_eq!(summary(&partial)["error"], "too stiff");
    finished(true);

    create(&path, false).expect("writable").finish(&outcome(None)).written.expect("writable");
    finished(false);
    assert!(!partial.exists());
}

#[test]
fn a_failed_run_keeps_what_was_computed_and_says_why() {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("run");
    let mut directory = create(&path, true).expect("writable");
    assert!(directory.needs_detail());
    directory.sample(&snapshot(0.0)).expect("writable");
    directory.event(&event(1.0, EventKind::Release, Some(0)), &snapshot(1.0)).expect("writable");
    // Nothing is there that is finished.
    assert_eq!(directory.finish(&outcome(Some("step too small at 1.5"))).directory, path);

    assert_eq!(lines(&path, "states.csv").len(), 2);
    assert_eq!(lines(&path, "events.csv").len(), 2);
    let listing = lines(&path, "listing.txt").join("\n");
    assert_eq!(listing.matches("SYSTEM MOTION").count(), 2);
    let summary = summary(&path);
    assert_eq!(summary["complete"], false);
    assert_eq!(summary["error"], "step too small at 1.5");
    assert_eq!(summary["steps_accepted"], 7);
}

#[test]
fn rows_do_not_wait_in_memory_for_a_printout_to_fill_the_disk() {
    let place = tempfile::tempdir().expect("a directory");
    let mut directory = create(&place.path().join("run"), true).expect("writable");
    directory.sample(&snapshot(0.0)).expect("writable");
    assert_eq!(lines(&place.path().join("run.partial"), "states.csv").len(), 2);
}

#[test]
fn a_directory_that_is_removed_during_a_run_is_an_error_that_names_it() {
    let place = tempfile::tempdir().expect("a directory");
    let mut directory = create(&place.path().join("run"), true).expect("writable");
    directory.sample(&snapshot(0.0)).expect("writable");
    fs::remove_dir_all(place.path().join("run.partial")).expect("it is there");
    let kept = directory.finish(&outcome(None));
    let error = kept.written.expect_err("the files are gone");
    assert!(error.to_string().contains("run.partial/datapackage.json"), "{error}");
    assert!(!error.is_refusal(), "the run has begun");
    assert!(!place.path().join("run").exists());
}

/// Stresses of the boom, whose one station is at its hinge.
fn analysis() -> StressAnalysis {
    let scene = scene();
    let station = Station {
        distance_from_hinge: 0.0,
        slice: scene.bodies[0].mass_properties,
        section: SectionShape::Tube { radius: 0.1, thickness: 0.01 },
    };
    let segment = SegmentStructure {
        pulse_constant: 0.1,
        material: Material::elastic(7e10, 0.3),
        stations: vec![station],
    };
    let structure = Structure::new(&scene, vec![segment]).expect("the slice is the boom");
    StressAnalysis::new(&scene, &structure, Settings::default()).expect("a tube is a section")
}

/// Long tables must not fill the disk before rows of states that wait in memory are on it.
#[test]
fn no_row_of_stresses_is_on_the_disk_before_the_states_of_its_time() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = create(&place.path().join("run"), false).expect("writable");
    let mut directory = directory
        .with_stresses(&scene(), analysis(), StressTables { every: 1, signs: StressSigns::Tension })
        .expect("writable");
    let rows_on_disk = |file: &str| {
        let text =
            fs::read_to_string(place.path().join("run.partial").join(file)).expect("a table");
        text.matches('\n').count().saturating_sub(1)
    };
    let (mut writes, mut seen) = (0, 0);
    for i in 0..700 {
        // At rest, so that loads agree with the hinge's torque, which is none.
        let at_rest =
            Snapshot { omega_body: Vec3::zero(), tau: vec![0.0], ..snapshot(f64::from(i)) };
        directory.sample(&at_rest).expect("writable");
        let stresses = rows_on_disk("stress.csv");
        // Four axis points and the maximum at each time.
        assert!(rows_on_disk("states.csv") >= stresses / 5, "after sample {i}");
        writes += usize::from(stresses > seen);
        seen = stresses;
    }
    assert!(writes > 1 && writes < 30, "{writes} for 700 times");
}

#[test]
fn a_directory_that_cannot_be_made_is_named() {
    let place = tempfile::tempdir().expect("a directory");
    let file = place.path().join("file");
    fs::write(&file, "").expect("writable");
    let refused = create(&file.join("run"), false).expect_err("a file is no directory");
    assert!(matches!(refused, ResultsError::Directory { .. }));
    assert!(refused.to_string().contains("file/run"), "{refused}");
}
