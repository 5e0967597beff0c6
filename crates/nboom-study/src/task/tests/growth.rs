use std::path::PathBuf;

use super::*;

/// The same sweep with this many cases, by a study that says so.
fn grown(fake: &Fake, cases: u64) -> Fake {
    Fake { cases, study: "draws = 2", ..fake.clone() }
}

/// All files of a sweep, by name.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(directory).expect("readable").map(|entry| entry.expect("readable"));
    let file = |entry: fs::DirEntry| {
        let content = fs::read(entry.path()).expect("readable");
        (entry.file_name().to_string_lossy().into_owned(), content)
    };
    entries.map(file).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn more_draws_end_with_the_bytes_of_one_sweep(
        cases in 0_u64..60,
        more in 1_u64..60,
        is_finished in any::<bool>(),
        patience in 0_i64..40,
        interruptions in proptest::collection::vec(0_i64..40, 0..4),
    ) {
        let place = tempfile::tempdir().expect("a directory");
        let [directory, alone] = ["grown", "alone"].map(|name| place.path().join(name));
        let few = Fake { jobs: 1, ..Fake::of(cases) };
        let done = if is_finished {
            few.finish(&directory, &[]).done
        } else {
            few.run(&directory, &Impatient(AtomicI64::new(patience))).expect("it can be interrupted").done
        };
        let many = grown(&few, cases + more);
        let refused = Fake { resume: false, ..many.clone() }.run(&directory, &Patient);
        let refused = refused.expect_err("it is not asked to go on").to_string();
        prop_assert!(refused.contains("--resume"), "{refused}");
        let report = many.finish(&directory, &interruptions);
        if interruptions.is_empty() {
            prop_assert_eq!(report.computed, cases + more - done);
        }
        prop_assert_eq!(tables(&directory), expected(&many));
        many.finish(&alone, &[]);
        prop_assert_eq!(files(&directory), files(&alone));
    }
}

/// Those of fewer draws would be wrong, and who has such tables goes on to read them.
#[test]
fn tables_in_csv_grow_too_though_they_are_not_asked_for_again() {
    let place = tempfile::tempdir().expect("a directory");
    let [directory, alone] = ["grown", "alone"].map(|name| place.path().join(name));
    let few = Fake { jobs: 1, ..Fake::of(20) };
    grown(&few, 50).finish(&alone, &[]);
    let many = Fake { csv: false, ..grown(&few, 50) };
    // Of the sweep of few draws and of that of many, whether it is interrupted.
    for (few_are_left, interruptions) in [(false, &[][..]), (false, &[5, 5]), (true, &[])] {
        if few_are_left {
            few.run(&directory, &Impatient(AtomicI64::new(5))).expect("it can be interrupted");
        } else {
            few.finish(&directory, &[]);
        }
        let report = many.finish(&directory, interruptions);
        assert!(report.description.complete);
        assert!(files(&directory) == files(&alone), "other bytes: {interruptions:?}");
        fs::remove_dir_all(&directory).expect("it is there");
    }
}

#[test]
fn a_refusal_for_want_of_room_leaves_the_finished_sweep() {
    let place = tempfile::tempdir().expect("a directory");
    let few = Fake::of(20);
    few.finish(place.path(), &[]);
    let before = files(place.path());
    let large = Fake { samples: 1 << 50, ..grown(&few, 50) };
    let error = large.run(place.path(), &Patient).expect_err("there is no room");
    assert!(error.is_refusal(), "{error}");
    assert_eq!(files(place.path()), before);
}

#[test]
fn tables_of_other_cases_are_refused() {
    let few = Fake::of(20);
    for name in [CASES_CSV_FILE, TRAJECTORIES_CSV_FILE] {
        let place = tempfile::tempdir().expect("a directory");
        let directory = place.path();
        few.finish(directory, &[]);
        let sweep = SweepDirectory::read(directory).expect("readable").expect("a sweep");
        let mut what = sweep.description;
        for (parquet, csv) in
            [(CASES_FILE, CASES_CSV_FILE), (crate::TRAJECTORIES_FILE, TRAJECTORIES_CSV_FILE)]
        {
            if what.tables.remove(parquet).is_some() {
                fs::remove_file(directory.join(parquet)).expect("it is there");
            }
            assert!(what.tables.contains_key(csv));
        }
        // As of a sweep before there were sums.
        what.sums.clear();
        fs::write(directory.join(STUDY_JSON_FILE), what.text()).expect("writable");
        // A row comes later than it should.
        let path = directory.join(name);
        let text = fs::read_to_string(&path).expect("readable");
        let row = text.lines().nth(2).expect("a row").to_owned() + "\n";
        fs::write(&path, text.replacen(&row, "", 1) + &row).expect("writable");
        let error = grown(&few, 30).run(directory, &Patient).expect_err("it is damaged");
        assert!(matches!(&error, StudyError::Altered { .. }), "{error}");
        assert!(path.exists(), "nothing is removed");
    }
}

/// The first table of a sweep that this build can read.
fn table(directory: &Path) -> PathBuf {
    let parquet = directory.join(CASES_FILE);
    if parquet.exists() { parquet } else { directory.join(CASES_CSV_FILE) }
}

#[test]
fn a_table_with_another_byte_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let few = Fake { csv: false, ..Fake::of(20) };
    few.finish(place.path(), &[]);
    let path = table(place.path());
    let bytes = fs::read(&path).expect("readable");
    let mut other = bytes.clone();
    other[bytes.len() / 2] ^= 1;
    fs::write(&path, &other).expect("writable");
    let sums = [&other, &bytes].map(|bytes| nboom_io::sha256(bytes));
    let more = grown(&few, 30);
    let mut again = vec![&more];
    let with_csv = Fake { csv: true, ..few.clone() };
    // Where there is no Parquet tables are in CSV, and none is made of another.
    again.extend((path.ends_with(CASES_FILE)).then_some(&with_csv));
    for fake in again {
        let error = fake.run(place.path(), &Patient).expect_err("another table");
        let told = error.to_string();
        assert!(error.is_refusal() && sums.iter().all(|sum| told.contains(sum)), "{told}");
        assert!(told.contains(&*path.to_string_lossy()), "{told}");
        assert_eq!(fs::read(&path).expect("readable"), other);
    }
    fs::write(&path, bytes).expect("writable");
    more.finish(place.path(), &[]);
}

#[test]
fn a_table_that_was_cut_short_is_made_again() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = place.path();
    let fake = Fake::of(20);
    fake.finish(directory, &[]);
    let before = files(directory);
    if !directory.join(CASES_FILE).exists() {
        return;
    }
    // As by a process that was killed before it described what it wrote.
    let mut what = SweepDirectory::read(directory).expect("readable").expect("a sweep").description;
    for csv in [CASES_CSV_FILE, TRAJECTORIES_CSV_FILE] {
        assert!(what.tables.remove(csv).is_some() && what.sums.remove(csv).is_some());
    }
    fs::write(directory.join(STUDY_JSON_FILE), what.text()).expect("writable");
    fs::write(directory.join(CASES_CSV_FILE), "cut").expect("writable");
    fake.finish(directory, &[]);
    assert_eq!(files(directory), before);
}

/// A description from before it had them has the tolerance and what varies together once the sweep goes on.
#[test]
fn what_older_descriptions_lack_is_added() {
    let few = Fake::of(20);
    for then in [few.clone(), grown(&few, 30)] {
        let place = tempfile::tempdir().expect("a directory");
        few.run(place.path(), &Impatient(AtomicI64::new(5))).expect("it can be interrupted");
        let path = place.path().join(STUDY_JSON_FILE);
        let text = fs::read_to_string(&path).expect("readable");
        let older = text.lines().filter(|line| !line.contains("\"rtol\"")).collect::<Vec<_>>();
        assert!(older.len() < text.lines().count());
        fs::write(&path, older.join("\n")).expect("writable");
        let report = then.finish(place.path(), &[]);
        assert_eq!(report.description.rtol, 1e-9, "{then:?}");
    }
}

#[test]
fn a_kill_leaves_one_sweep_or_the_other() {
    let place = tempfile::tempdir().expect("a directory");
    let directory = place.path();
    let few = Fake { jobs: 1, ..Fake::of(30) };
    let many = grown(&few, 50);
    // Half of the journal is there.
    few.finish(directory, &[]);
    fs::write(directory.join(JOURNAL_FILE), "batch 1 30 7").expect("writable");
    let report = many.finish(directory, &[]);
    assert_eq!((report.computed, tables(directory)), (20, expected(&many)));
    // The journal is there, the sweep is open again, and has no study.
    let more = grown(&few, 60);
    fs::remove_dir_all(directory).expect("it is there");
    few.finish(directory, &[]);
    let place = Place::take(directory).expect("nobody holds it");
    let then = place.found.clone().expect("a sweep");
    crate::growth::continued(&place, then, &more.description()).expect("readable");
    drop(place);
    assert_eq!(names(directory), [JOURNAL_FILE, "scene.toml", STUDY_JSON_FILE]);
    assert!(!directory.join(CASES_FILE).exists());
    for fake in [few.clone(), more] {
        let copy = tempfile::tempdir().expect("a directory");
        for (name, content) in files(directory) {
            fs::write(copy.path().join(name), content).expect("writable");
        }
        let report = fake.finish(copy.path(), &[]);
        assert_eq!((report.computed, tables(copy.path())), (fake.cases - 30, expected(&fake)));
    }
}

#[test]
fn other_sweeps_are_not_continued() {
    let place = tempfile::tempdir().expect("a directory");
    let few = Fake::of(10);
    let refused = |now: Fake, words: &str| {
        let told = now.run(place.path(), &Patient).expect_err("another sweep").to_string();
        assert!(told.contains(words), "{told}");
    };
    let latin = Fake { method: Method::LatinHypercube, ..few.clone() };
    latin.finish(place.path(), &[]);
    refused(grown(&latin, 20), "draws 10 then, 20 now");
    fs::remove_dir_all(place.path()).expect("it is there");
    few.finish(place.path(), &[]);
    refused(Fake { seed: 2, ..grown(&few, 20) }, "seed 1 then, 2 now");
    refused(grown(&few, 5), "draws 10 then, 5 now");
    refused(Fake { shard: Some("1/2".parse().expect("a shard")), ..grown(&few, 20) }, "shard");
    refused(Fake { maker: "2", ..grown(&few, 20) }, "--accept-difference");
    let altered = table(place.path());
    fs::write(&altered, "cut").expect("writable");
    refused(grown(&few, 20), "3 bytes found");
    assert_eq!(fs::read(&altered).expect("readable"), b"cut");
}
