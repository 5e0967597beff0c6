use std::process::Command;

use super::*;

/// A sweep with a journal of several batches, and the journal.
fn interrupted(fake: &Fake, directory: &Path) -> Vec<u8> {
    for patience in [2, 3] {
        fake.run(directory, &Impatient(AtomicI64::new(patience))).expect("it can be interrupted");
    }
    let journal = fs::read(directory.join(JOURNAL_FILE)).expect("it has begun");
    assert!(
        journal.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"batch")).count() > 3
    );
    journal
}

#[test]
fn a_journal_that_ends_anywhere_is_continued() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { jobs: 1, ..Fake::of(7) };
    let directory = place.path();
    let journal = interrupted(&fake, directory);
    let unfinished = fs::read(directory.join(STUDY_JSON_FILE)).expect("readable");
    let expected = expected(&fake);
    for end in 0..=journal.len() {
        fs::write(directory.join(JOURNAL_FILE), &journal[..end]).expect("writable");
        fs::write(directory.join(STUDY_JSON_FILE), &unfinished).expect("writable");
        let report = fake.run(directory, &Patient).expect("it is continued");
        assert_eq!(report.end, End::Complete);
        assert_eq!(tables(directory), expected, "cut at {end}");
    }
}

#[test]
fn a_damaged_byte_is_found() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { jobs: 1, ..Fake::of(7) };
    let journal = interrupted(&fake, place.path());
    let text = String::from_utf8(journal.clone()).expect("text");
    let last = text.rfind("\nbatch ").expect("several batches") + 1;
    for byte in 0..journal.len() {
        for flip in [1, 0x80, journal[byte]] {
            let mut damaged = journal.clone();
            damaged[byte] ^= flip;
            let path = place.path().join(JOURNAL_FILE);
            fs::write(&path, &damaged).expect("writable");
            match Journal::read(&path, 1..=7) {
                Err(StudyError::Journal { byte: found, .. }) => assert!(found <= byte as u64),
                Err(error) => panic!("{error}"),
                Ok(read) => {
                    // The last batch, or what ends the one before it, may be of a writer that was killed.
                    assert!(byte + 1 >= last, "byte {byte} of {last}");
                    read.require_whole().expect_err("it is damaged");
                }
            }
        }
    }
}

#[test]
fn a_kill_between_the_last_steps_is_put_right() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake::of(30);
    let directory = place.path();
    interrupted(&Fake { jobs: 1, ..fake.clone() }, directory);
    let unfinished = fs::read(directory.join(STUDY_JSON_FILE)).expect("readable");
    let journal = directory.join(JOURNAL_FILE);
    let kept = place.path().join("journal.kept");
    // All batches are there and no table.
    let journal_of_all = {
        let shard = Fake { shard: Some("1/1".parse().expect("a shard")), ..fake.clone() };
        let other = tempfile::tempdir().expect("a directory");
        shard.finish(other.path(), &[5]);
        fs::copy(other.path().join(JOURNAL_FILE), &kept).expect("writable");
        fs::read(&kept).expect("readable")
    };
    fs::write(&journal, &journal_of_all).expect("writable");
    fs::write(directory.join(".cases.csv.0.new"), "half a tab").expect("writable");
    let report = fake.run(directory, &Patient).expect("it is continued");
    assert_eq!((report.computed, report.end), (0, End::Complete));
    assert!(!directory.join(".cases.csv.0.new").exists());
    // A table is there, the description does not say complete.
    fs::write(&journal, &journal_of_all).expect("writable");
    fs::write(directory.join(STUDY_JSON_FILE), unfinished).expect("writable");
    let report = fake.run(directory, &Patient).expect("it is continued");
    assert_eq!((report.computed, report.end), (0, End::Complete));
    assert_eq!(tables(directory), expected(&fake));
    // The journal is still there.
    fs::write(&journal, "any").expect("writable");
    let report = Fake { resume: false, ..fake }.run(directory, &Patient).expect("it is complete");
    assert_eq!(report.end, End::WasComplete);
    assert!(!journal.exists());
}

#[test]
fn a_case_that_panics_is_named_and_others_are_kept() {
    let place = tempfile::tempdir().expect("a directory");
    let fake = Fake { jobs: 1, broken: 11, ..Fake::of(20) };
    let error = fake.run(place.path(), &Patient).expect_err("case 11 panics").to_string();
    assert!(error.contains("case 11") && error.contains("a fault of the case"), "{error}");
    let journal = Journal::read(&place.path().join(JOURNAL_FILE), 1..=20).expect("readable");
    journal.require_whole().expect("it is whole");
    assert_eq!(journal.done(), 10);
    let mended = Fake { broken: 0, jobs: 3, ..fake };
    let report = mended.run(place.path(), &Patient).expect("it is continued");
    assert_eq!(report.computed, 10);
    assert_eq!(tables(place.path()), expected(&mended));
}

/// Where a process with a limit for its files sweeps.
const LIMITED: &str = "NBOOM_TEST_LIMITED";

#[cfg(unix)]
#[test]
fn what_is_done_before_a_disk_is_full_is_kept() {
    let fake = Fake { jobs: 3, ..Fake::of(2000) };
    if let Some(directory) = std::env::var_os(LIMITED) {
        let error = fake.run(Path::new(&directory), &Patient).expect_err("there is no space");
        assert!(matches!(&error, StudyError::Results(_)), "{error}");
        assert!(error.to_string().contains(JOURNAL_FILE), "{error}");
        return;
    }
    let place = tempfile::tempdir().expect("a directory");
    let name = "task::tests::restarts::what_is_done_before_a_disk_is_full_is_kept";
    // Blocks of 512 bytes; without the trap the process would be killed.
    let script = format!("trap '' XFSZ; ulimit -f 20; exec \"$0\" --exact {name}");
    let mut child = Command::new("sh");
    child.args(["-c", &script]).arg(std::env::current_exe().expect("this test"));
    let output = child.env(LIMITED, place.path()).output().expect("there is a shell");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    let journal = Journal::read(&place.path().join(JOURNAL_FILE), 1..=2000).expect("readable");
    assert!((1..2000).contains(&journal.done()), "{}", journal.done());
    let report = fake.run(place.path(), &Patient).expect("now there is space");
    assert_eq!(report.computed, 2000 - journal.done());
    assert_eq!(tables(place.path()), expected(&fake));
}

/// Tables in CSV that a finished sweep lacks come from those in Parquet.
#[test]
fn tables_in_csv_can_be_asked_for_later() {
    let place = tempfile::tempdir().expect("a directory");
    let (fake, directory) = (Fake::of(40), place.path());
    fake.finish(directory, &[]);
    for name in [CASES_CSV_FILE, TRAJECTORIES_CSV_FILE] {
        if directory.join(CASES_FILE).exists() {
            fs::remove_file(directory.join(name)).expect("it was there");
        }
    }
    let report = fake.run(directory, &Patient).expect("it is finished");
    assert_eq!((report.end, report.computed), (End::WasComplete, 0));
    assert_eq!(tables(directory), expected(&fake));
    assert!(report.files.contains(&directory.join(CASES_CSV_FILE)));
}
