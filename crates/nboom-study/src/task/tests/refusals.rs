use nboom_results::{Lock, ResultsError};

use super::*;

fn refused(fake: &Fake, directory: &Path) -> StudyError {
    let before = names(directory);
    let error = fake.run(directory, &Patient).expect_err("it is refused");
    assert!(error.is_refusal(), "{error}");
    assert_eq!(names(directory), before);
    error
}

#[test]
fn a_finished_sweep_is_not_repeated_and_another_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { resume: false, ..Fake::of(12) };
    fake.finish(place.path(), &[]);
    let tables_then = tables(place.path());
    let again = Fake { broken: 3, ..fake.clone() }.run(place.path(), &Patient);
    let again = again.expect("nothing is computed");
    assert_eq!((again.end, again.computed, again.done), (End::WasComplete, 0, 12));
    let error = refused(&Fake { seed: 2, ..fake.clone() }, place.path()).to_string();
    assert!(error.contains("seed 1 then, 2 now"), "{error}");
    let error = refused(&Fake::of(11), place.path()).to_string();
    assert!(error.contains("cases 12 then, 11 now"), "{error}");
    assert_eq!(tables(place.path()), tables_then);
}

#[test]
fn another_study_is_refused_with_the_line_that_differs() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { study: "draws = 1\nseed = 1\n", ..Fake::of(12) };
    fake.finish(place.path(), &[]);
    for (study, told) in [
        ("draws = 1\nseed = 2\n", "study.toml, line 2: `seed = 1` then, `seed = 2` now"),
        ("draws = 1\n", "study.toml, line 2: `seed = 1` then, no line now"),
    ] {
        let error = refused(&Fake { study, ..fake.clone() }, place.path()).to_string();
        assert!(error.contains("another text of the study") && error.contains(told), "{error}");
        assert!(!error.contains("scene.toml"), "{error}");
    }
}

#[test]
fn a_finished_sweep_without_its_table_is_told() {
    let table = if crate::tables::has_parquet() { CASES_FILE } else { CASES_CSV_FILE };
    for (gone, told) in
        [(&[CASES_FILE, CASES_CSV_FILE][..], table), (&[STATISTICS_FILE], STATISTICS_FILE)]
    {
        let place = tempfile::tempdir().expect("a directory");
        Fake::of(12).finish(place.path(), &[]);
        for path in gone.iter().map(|name| place.path().join(name)).filter(|path| path.exists()) {
            fs::remove_file(path).expect("it is there");
        }
        let error = refused(&Fake::of(12), place.path()).to_string();
        assert!(error.contains(told) && error.contains("sweep again"), "{error}");
    }
}

/// A table in Parquet that is gone or cut short, with that in CSV beside it, and one in CSV that is cut short.
#[test]
fn a_finished_sweep_whose_table_is_not_what_it_wrote_is_told() {
    let place = tempfile::tempdir().expect("a directory");
    Fake::of(12).finish(place.path(), &[]);
    let paths =
        [CASES_FILE, CASES_CSV_FILE, TRAJECTORIES_CSV_FILE].map(|name| place.path().join(name));
    for path in paths.iter().filter(|path| path.exists()) {
        let bytes = fs::read(path).expect("readable");
        fs::write(path, &bytes[..bytes.len() - 1]).expect("writable");
        let error = refused(&Fake::of(12), place.path());
        let told = format!("{}: {} bytes found", path.display(), bytes.len() - 1);
        assert!(error.to_string().contains(&told), "{error}");
        fs::write(path, &bytes).expect("writable");
    }
    if paths[0].exists() {
        fs::remove_file(&paths[0]).expect("it is there");
        let error = refused(&Fake::of(12), place.path());
        assert!(matches!(&error, StudyError::Missing { path } if *path == paths[0]), "{error}");
    }
}

#[test]
fn an_unfinished_sweep_is_continued_only_if_that_is_asked_for() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { jobs: 1, ..Fake::of(12) };
    let interrupted = fake.run(place.path(), &Impatient(AtomicI64::new(5)));
    let interrupted = interrupted.expect("it can be interrupted");
    assert_eq!((interrupted.end, interrupted.done), (End::Interrupted, 5));
    let error = refused(&Fake { resume: false, ..fake.clone() }, place.path());
    assert!(matches!(error, StudyError::Unfinished { done: 5, cases: 12, .. }), "{error}");
    let shard = Some("1/2".parse().expect("a shard"));
    let error = refused(&Fake { shard, ..fake.clone() }, place.path()).to_string();
    assert!(error.contains("shard all then, 1/2 now"), "{error}");
    let other = Fake { maker: "2", ..fake.clone() };
    let error = refused(&other, place.path()).to_string();
    assert!(error.contains("nboom 1") && error.contains("nboom 2"), "{error}");
    let accepted = Fake { accept_difference: true, ..other.clone() };
    let report = accepted.run(place.path(), &Patient).expect("it is accepted");
    assert_eq!(report.description.also_made_by, [other.description().made_by]);
    assert_eq!(tables(place.path()), expected(&fake));
}

#[test]
fn files_of_others_stay() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake::of(3);
    for name in [CASES_CSV_FILE, CASES_FILE, JOURNAL_FILE, crate::SWEPT_SCENE_FILE] {
        let path = place.path().join(name);
        fs::write(&path, "mine").expect("writable");
        let error = refused(&fake, place.path());
        assert!(
            matches!(&error, StudyError::Foreign { path: found, .. } if *found == path),
            "{error}"
        );
        assert!(error.to_string().contains("found a file that no sweep has written"), "{error}");
        assert_eq!(fs::read_to_string(&path).expect("readable"), "mine");
        fs::remove_file(path).expect("it is there");
    }
    for text in ["", "{}", "{\"complete\": true}"] {
        fs::write(place.path().join(STUDY_JSON_FILE), text).expect("writable");
        let error = refused(&fake, place.path());
        assert!(matches!(error, StudyError::NoSweep { .. }), "{error}");
    }
}

#[test]
fn one_process_at_a_time() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = place.path().join("sweep");
    let lock = Lock::acquire(&directory, &directory, "a sweep").expect("nobody has it");
    let error = refused(&Fake::of(3), &directory);
    assert!(matches!(error, StudyError::Results(ResultsError::InUse { .. })), "{error}");
    let told = format!("a sweep into {} is going on, by process", directory.display());
    assert!(error.to_string().starts_with(&told), "{error}");
    drop(lock);
    Fake::of(3).finish(&directory, &[]);
}

#[test]
fn more_than_the_disk_holds_is_refused_and_leaves_nothing() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = place.path().join("sweep");
    let error = Fake::of(1 << 50).run(&directory, &Patient).expect_err("there is no such disk");
    assert!(matches!(error, StudyError::Space { .. }), "{error}");
    assert!(!directory.exists());
}

#[cfg(target_os = "linux")]
#[test]
fn trajectories_that_memory_does_not_hold_are_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = place.path().join("sweep");
    let long = Fake { samples: 1 << 40, ..Fake::of(2) };
    let error = long.run(&directory, &Patient).expect_err("there is no such memory");
    assert!(matches!(error, StudyError::Memory { jobs: 2, .. }), "{error}");
    assert!(!directory.exists());
}

#[test]
fn shards_that_are_not_the_whole_are_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake::of(20);
    let all = shards(&fake, 3, place.path());
    let out = place.path().join("out");
    let refused = |shards: &[&PathBuf]| {
        let shards: Vec<_> = shards.iter().map(|path| (*path).clone()).collect();
        let error = merge(&shards, &out, true, false).expect_err("it is refused");
        assert!(error.is_refusal() && !out.exists(), "{error}");
        error.to_string()
    };
    let error = refused(&[&all[0], &all[2]]);
    assert!(error.contains("2 of 3 shards given") && error.contains("missing: 2/3"), "{error}");
    let error = refused(&[&all[0], &all[1], &all[1], &all[2]]);
    assert!(error.contains("both the shard 2/3"), "{error}");
    refused(&[]);
    let file = place.path().join("file");
    fs::write(&file, "no directory").expect("writable");
    for path in [&file, &file.join("in it"), &place.path().join("nothing")] {
        assert!(refused(&[&all[0], path]).contains("no sweep found, a finished shard expected"));
    }
    let whole = place.path().join("whole");
    fake.finish(&whole, &[]);
    let error = refused(&[&all[0], &whole]);
    assert!(error.contains("a sweep of all cases found"), "{error}");
    let shard = |number: &str| Fake { shard: number.parse().ok(), jobs: 1, ..fake.clone() };
    let other = |name: &str, fake: &Fake| {
        let directory = place.path().join(name);
        fake.finish(&directory, &[]);
        directory
    };
    let seed = other("seed", &Fake { seed: 5, ..shard("3/3") });
    let error = refused(&[&all[0], &all[1], &seed]);
    assert!(error.contains("seed 1 then, 5 now") && error.contains("/seed"), "{error}");
    assert!(error.ends_with("; shards of one sweep expected"), "{error}");
    let maker = other("maker", &Fake { maker: "2", ..shard("3/3") });
    assert!(refused(&[&all[0], &all[1], &maker]).contains("--accept-difference"));
    let of_two = other("of two", &shard("2/2"));
    assert!(refused(&[&all[0], &all[1], &of_two]).contains("the shard 2/2"));
    let begun = place.path().join("begun");
    let watcher = Impatient(AtomicI64::new(4));
    shard("3/3").run(&begun, &watcher).expect("it can be interrupted");
    let error = refused(&[&all[0], &all[1], &begun]);
    assert!(error.contains("4 of 7 cases of the shard 3/3"), "{error}");
    let journal = all[1].join(JOURNAL_FILE);
    let bytes = fs::read(&journal).expect("readable");
    fs::write(&journal, &bytes[..bytes.len() - 1]).expect("writable");
    assert!(refused(&[&all[0], &all[1], &all[2]]).contains("no whole batch"));
    fs::write(&journal, &bytes).expect("writable");
    let with_other = [all[0].clone(), all[1].clone(), maker];
    merge(&with_other, &out, true, true).expect("it is accepted");
    assert_eq!(tables(&out), expected(&fake));
    let again = merge(&with_other, &out, true, true).expect("nothing is done");
    assert_eq!(again.end, End::WasComplete);
    let error = merge(&all, &whole_of_another(&place), true, false).expect_err("it is refused");
    let told = "; name another directory for this one, new or empty";
    assert!(error.to_string().ends_with(told), "{error}");
}

fn whole_of_another(place: &tempfile::TempDir) -> PathBuf {
    let directory = place.path().join("another");
    Fake { seed: 5, ..Fake::of(20) }.finish(&directory, &[]);
    directory
}

/// What is done to a file: another text, or none.
#[test]
fn a_study_or_scene_that_is_not_what_the_sweep_wrote_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake::of(12);
    let (whole, out) = (place.path().join("whole"), place.path().join("out"));
    fake.finish(&whole, &[]);
    let parts = shards(&fake, 2, place.path());
    let merged = |out: &Path| merge(&parts, out, true, false);
    for name in [crate::STUDY_FILE, crate::SWEPT_SCENE_FILE] {
        for (directory, again) in [
            (&whole, &(|| fake.run(&whole, &Patient)) as &dyn Fn() -> Result<Report, StudyError>),
            (&parts[0], &|| merged(&out)),
            (&parts[1], &|| merged(&out)),
        ] {
            let path = directory.join(name);
            let text = fs::read_to_string(&path).expect("it is there");
            let other = "other\n";
            fs::write(&path, other).expect("writable");
            let error = again().expect_err("it is another text");
            let told = error.to_string();
            for text in [&*text, other] {
                assert!(told.contains(&nboom_io::sha256(text.as_bytes())), "{told}");
            }
            assert!(error.is_refusal() && told.contains(&*path.to_string_lossy()), "{told}");
            fs::remove_file(&path).expect("it is there");
            let error = again().expect_err("it is not there");
            assert!(
                matches!(&error, StudyError::Missing { path: gone } if *gone == path),
                "{error}"
            );
            fs::write(&path, text).expect("writable");
            assert!(!out.exists());
        }
    }
    merged(&out).expect("all are as they were");
    SweepDirectory::read(&out).expect("readable").expect("a sweep");
    fs::write(out.join(crate::STUDY_FILE), "other").expect("writable");
    SweepDirectory::read(&out).expect_err("another study");
    merged(&out).expect_err("another study");
}

/// A sweep that was killed before it wrote its study and scene goes on; with other ones it does not.
#[test]
fn an_unfinished_sweep_writes_the_study_that_it_lacks() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake::of(12);
    fake.run(place.path(), &Impatient(AtomicI64::new(5))).expect("it can be interrupted");
    let path = place.path().join(crate::STUDY_FILE);
    fs::write(&path, "other").expect("writable");
    let error = refused(&fake, place.path());
    assert!(matches!(error, StudyError::Altered { .. }), "{error}");
    fs::remove_file(&path).expect("it is there");
    fake.finish(place.path(), &[]);
    assert_eq!(fs::read_to_string(&path).expect("it is there"), fake.study);
}
