use super::*;
use crate::lock::LOCK_FILE;
use crate::{EVENTS_FILE, LISTING_FILE, STATES_FILE};

/// The files of a run into a directory, each of which tells which run it is of.
fn write(directory: &Path, run: &str, names: &[&str], complete: bool) {
    fs::create_dir_all(directory).expect("writable");
    for name in names {
        fs::write(directory.join(name), run).expect("writable");
    }
    let files: Vec<&str> = names.iter().copied().chain([SUMMARY_FILE]).collect();
    let keys = serde_json::json!({ "scene": run, "complete": complete, "files": files });
    fs::write(directory.join(SUMMARY_FILE), keys.to_string()).expect("writable");
}

/// The run whose files all are, and that they are exactly these.
fn whole(directory: &Path, names: &[&str]) -> Option<String> {
    let earlier = Earlier::in_directory(directory).expect("a summary").expect("there is one");
    let run = earlier.keys["scene"].as_str().expect("a name").to_owned();
    let is_of_run = |name: &&str| {
        let text = fs::read_to_string(directory.join(name)).ok();
        if names.contains(name) { text.as_ref() == Some(&run) } else { text.is_none() }
    };
    let tables = FILES.into_iter().filter(|name| *name != SUMMARY_FILE);
    let found: Vec<&str> = tables.filter(|name| !is_of_run(name)).collect();
    (found.is_empty() && earlier.complete).then_some(run)
}

const OLD: [&str; 3] = [STATES_FILE, EVENTS_FILE, LISTING_FILE];
const NEW: [&str; 2] = [STATES_FILE, EVENTS_FILE];

/// Killed after each of the steps in turn: what is in the place is whole, or says that it is not,
/// and the next run finds the new results there.
#[test]
fn a_kill_between_any_two_steps_loses_nothing() {
    for kept in 0..10 {
        let folder = tempfile::tempdir().expect("a directory");
        let finished = folder.path().join("run");
        write(&finished, "old", &OLD, true);
        fs::write(finished.join("notes.txt"), "mine").expect("writable");
        let place = Destination::take(&finished).expect("nobody has it");
        write(place.partial(), "new", &NEW, true);
        let new = Earlier::in_directory(place.partial()).expect("ours").expect("a summary");
        let old = check(&finished).expect("ours");
        let steps = steps(&new, old.as_ref());
        let count = steps.len();
        for step in steps.into_iter().take(kept) {
            place.take_step(&new, step).expect("writable");
        }
        // Nothing is tidied up by a process that is killed, but its lock is gone.
        let left = fs::read(place.partial().join(LOCK_FILE)).expect("a lock");
        let stays = place.partial().join("stays");
        fs::write(&stays, "").expect("writable");
        let partial = place.partial().to_owned();
        drop(place);
        fs::remove_file(stays).expect("it is there");
        fs::write(partial.join(LOCK_FILE), left).expect("writable");

        match kept {
            0 => assert_eq!(whole(&finished, &OLD).as_deref(), Some("old")),
            _ if kept >= count => assert_eq!(whole(&finished, &NEW).as_deref(), Some("new")),
            _ => {
                let marked = Earlier::in_directory(&finished).expect("ours").expect("a summary");
                assert!(!marked.complete, "after {kept} steps");
            }
        }
        let next = Destination::take(&finished).expect("nobody has it");
        assert_eq!(next.has_put_right, kept < count, "after {kept} steps");
        assert_eq!(whole(&finished, &NEW).as_deref(), Some("new"), "after {kept} steps");
        drop(next);
        assert!(!partial.exists(), "after {kept} steps");
        assert_eq!(fs::read_to_string(finished.join("notes.txt")).ok().as_deref(), Some("mine"));
    }
}

/// Where nothing finished is, incomplete results come; killed on the way they are marked.
#[test]
fn incomplete_results_are_marked_on_their_whole_way() {
    for kept in 0..5 {
        let folder = tempfile::tempdir().expect("a directory");
        let finished = folder.path().join("run");
        write(&finished, "old", &OLD, false);
        let place = Destination::take(&finished).expect("nobody has it");
        write(place.partial(), "new", &NEW, false);
        let new = Earlier::in_directory(place.partial()).expect("ours").expect("a summary");
        let old = check(&finished).expect("ours");
        for step in steps(&new, old.as_ref()).into_iter().take(kept) {
            place.take_step(&new, step).expect("writable");
        }
        let found = check(&finished).expect("all files are named").expect("a summary");
        assert!(!found.complete, "after {kept} steps");
    }
}

#[test]
fn incomplete_results_never_take_the_place_of_finished_ones() {
    let folder = tempfile::tempdir().expect("a directory");
    let finished = folder.path().join("run");
    write(&finished, "old", &OLD, true);
    let place = Destination::take(&finished).expect("nobody has it");
    write(place.partial(), "new", &NEW, false);
    assert_eq!(place.settle().expect("writable"), folder.path().join("run.partial"));
    drop(place);
    assert_eq!(whole(&finished, &OLD).as_deref(), Some("old"));
    assert!(folder.path().join("run.partial").join(STATES_FILE).exists());
}

#[test]
fn a_directory_is_one_by_whatever_path_it_is_named() {
    let folder = tempfile::tempdir().expect("a directory");
    let path = folder.path();
    fs::create_dir_all(path.join("a/run")).expect("writable");
    #[cfg(unix)]
    std::os::unix::fs::symlink(path.join("a"), path.join("b")).expect("a unix system");
    let held = Destination::take(&path.join("a/run")).expect("nobody has it");
    for other in ["a/run/", "a/run/.", "a/../a/run", "b/run", "b/run/"] {
        let refused = Destination::take(&path.join(other)).expect_err("it is held");
        assert!(matches!(refused, ResultsError::InUse { .. }), "{other}: {refused}");
    }
    drop(held);
    for wrong in ["/", "a/run.partial", "a/run.partial/"] {
        let refused = Destination::take(&path.join(wrong)).expect_err("it has no such name");
        assert!(matches!(refused, ResultsError::Name { .. }), "{wrong}: {refused}");
    }
}

/// Whatever has the name of a file of a run and is not one is refused, and everything stays.
#[cfg(unix)]
#[test]
fn what_no_run_wrote_is_refused_and_stays() {
    let folder = tempfile::tempdir().expect("a directory");
    let finished = folder.path().join("run");
    for name in FILES {
        for with_run in [false, true] {
            let make: [&dyn Fn(&Path); 3] = [
                &|path| fs::write(path, "mine").expect("writable"),
                &|path| fs::create_dir(path).expect("writable"),
                &|path| std::os::unix::fs::symlink("/dev/full", path).expect("writable"),
            ];
            for make in make {
                let _ = fs::remove_dir_all(&finished);
                fs::create_dir(&finished).expect("writable");
                if with_run {
                    write(&finished, "old", &[], true);
                    let _ = fs::remove_file(finished.join(name));
                }
                make(&finished.join(name));
                let before = Kind::of(&finished.join(name)).expect("there");
                let refused = Destination::take(&finished).expect_err("it is not ours");
                assert!(matches!(&refused, ResultsError::Foreign { .. }), "{name}: {refused}");
                assert!(refused.to_string().contains(name), "{refused}");
                assert_eq!(Kind::of(&finished.join(name)).expect("there"), before);
                assert!(!folder.path().join("run.partial").exists());
            }
        }
    }
}

#[cfg(unix)]
#[test]
fn a_link_is_no_directory_for_results() {
    let folder = tempfile::tempdir().expect("a directory");
    let target = folder.path().join("target");
    fs::create_dir(&target).expect("writable");
    for link in ["run", "other.partial"] {
        std::os::unix::fs::symlink(&target, folder.path().join(link)).expect("a unix system");
    }
    for path in ["run", "run/", "other"] {
        let refused = Destination::take(&folder.path().join(path)).expect_err("it is a link");
        assert!(matches!(refused, ResultsError::NotADirectory { .. }), "{path}: {refused}");
    }
    assert_eq!(fs::read_dir(&target).expect("readable").count(), 0);
}

#[test]
fn of_many_files_the_one_that_is_missing_is_named() {
    let place = tempfile::tempdir().expect("a directory");
    let paths: Vec<PathBuf> = (0..20).map(|i| place.path().join(format!("table-{i}"))).collect();
    paths.iter().for_each(|path| fs::write(path, "1\n").expect("writable"));
    sync_all(paths.clone().into_iter()).expect("all are there");
    fs::remove_file(&paths[13]).expect("it was there");
    let missing = sync_all(paths.into_iter()).expect_err("one is missing");
    assert!(missing.to_string().contains("table-13"), "{missing}");
}
