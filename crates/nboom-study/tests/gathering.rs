//! Sweeps whose cases run elsewhere: the same bytes as in one process, whatever comes in between.

use std::fs;
use std::path::Path;

use nboom_study::{Gathering, Maker, Study, StudyError, Sweep, Watcher};

const STUDY: &str = "scene = \"EXAMPLES/cubesat.toml\"\nname = \"it\"\ndraws = 12\ntrajectories = true\n\
    results = [\"lock_time of y panel 1\", \"final nutation\"]\n\
    [run]\nrtol = 1e-6\nsamples = 3\n\
    [[vary]]\nname = \"k\"\npath = \"parameters.stiffness\"\nas = \"factor\"\nuniform = { from = 0.8, to = 1.2 }\n";

struct Nobody;
impl Watcher for Nobody {}

fn study(folder: &Path) -> Study {
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let path = folder.join("study.toml");
    fs::write(&path, STUDY.replace("EXAMPLES", examples)).expect("writable");
    Study::read(&path).expect("a study")
}

fn sweep<'s>(study: &'s Study, directory: &Path) -> Sweep<'s> {
    Sweep {
        study,
        directory: directory.to_owned(),
        jobs: 2,
        resume: true,
        shard: None,
        csv: true,
        accept_difference: false,
        kernels: &[],
        right_sides: &[],
    }
}

fn gather(study: &Study, directory: &Path) -> Gathering {
    sweep(study, directory).gather().expect("a directory")
}

/// The same study as it is read elsewhere.
fn elsewhere(study: &Study, folder: &Path) -> Study {
    fs::create_dir_all(folder).expect("writable");
    fs::write(folder.join("study.toml"), study.beside_its_scene()).expect("writable");
    fs::write(folder.join("scene.toml"), study.document.text()).expect("writable");
    Study::read(&folder.join("study.toml")).expect("the same study")
}

#[test]
fn batches_from_elsewhere_make_the_tables_of_one_process() {
    let place = tempfile::tempdir().expect("a directory");
    let (here, there) = (place.path().join("here"), place.path().join("there"));
    let study = study(place.path());
    sweep(&study, &here).run(&Nobody).expect("a sweep");
    let worker = elsewhere(&study, &place.path().join("worker"));
    let batch = |cases| worker.run_batch(cases, &[], &[], &|| false).expect("not interrupted");

    let mut first = gather(&study, &there);
    assert_eq!((first.missing(), first.done()), (vec![1..=12], [0, 12]));
    for cases in [9..=12, 1..=2] {
        first.add(&batch(cases), &Maker::current()).expect("a batch");
    }
    // A worker that was thought lost comes back with what another one has run.
    first.add(&batch(1..=2), &Maker::current()).expect("known");
    // One that is known in part would be lost with what is new in it.
    for cases in [2..=4, 1..=12] {
        let error = first.add(&batch(cases), &Maker::current()).expect_err("known in part");
        assert!(matches!(error, StudyError::NoBatch { .. }), "{error}");
    }
    drop(first);
    let mut second = gather(&study, &there);
    assert_eq!((second.missing(), second.done()), (vec![3..=8], [6, 12]));
    second.add(&batch(3..=8), &Maker::current()).expect("a batch");
    assert_eq!(second.finish().expect("all cases").computed, 6);
    for name in ["cases.csv", "trajectories.csv", "statistics.json", "study.json", "study.toml"] {
        let [here, there] = [&here, &there].map(|folder| fs::read(folder.join(name)).expect(name));
        assert!(here == there, "{name}");
    }
}

#[test]
fn what_is_no_batch_of_the_sweep_is_refused_and_nothing_is_lost() {
    let place = tempfile::tempdir().expect("a directory");
    let study = study(place.path());
    let batch = study.run_batch(1..=3, &[], &[], &|| false).expect("not interrupted");
    let mut gathering = gather(&study, &place.path().join("out"));
    let mut refused = |bytes: &[u8], by: &Maker| gathering.add(bytes, by).expect_err("refused");
    let mut damaged = batch.clone();
    *damaged.last_mut().expect("bytes") ^= 1;
    for bytes in [&damaged[..], &batch[..batch.len() - 1], b"", b"batch 1 1 0 0"] {
        assert!(matches!(refused(bytes, &Maker::current()), StudyError::NoBatch { .. }));
    }
    let larger = STUDY.replace("draws = 12", "draws = 99");
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let path = place.path().join("larger.toml");
    fs::write(&path, larger.replace("EXAMPLES", examples)).expect("writable");
    let larger = Study::read(&path).expect("a study");
    let beyond = larger.run_batch(12..=13, &[], &[], &|| false).expect("not interrupted");
    let said = refused(&beyond, &Maker::current()).to_string();
    assert!(said.starts_with("cases 12 to 13 of a sweep of 1 to 12 found"), "{said}");
    let stranger = Maker { instructions: "abacus".to_owned(), ..Maker::current() };
    let error = refused(&batch, &stranger);
    assert!(matches!(&error, StudyError::MadeElsewhere { .. }), "{error}");
    assert!(error.to_string().contains("abacus"), "{error}");
    assert_eq!(gathering.done(), [0, 12]);
    gathering.add(&batch, &Maker::current()).expect("a batch");
    assert_eq!(gathering.done(), [3, 12]);
    assert!(study.run_batch(1..=3, &[], &[], &|| true).is_none());
}

#[test]
fn a_stranger_that_is_accepted_is_named() {
    let place = tempfile::tempdir().expect("a directory");
    let (study, directory) = (study(place.path()), place.path().join("out"));
    let accepting = Sweep { accept_difference: true, ..sweep(&study, &directory) };
    let mut gathering = accepting.gather().expect("a directory");
    let batch = study.run_batch(1..=12, &[], &[], &|| false).expect("not interrupted");
    let stranger = Maker { instructions: "abacus".to_owned(), ..Maker::current() };
    gathering.add(&batch, &stranger).expect("accepted");
    let report = gathering.finish().expect("all cases");
    assert_eq!(report.description.also_made_by, [stranger]);
}
