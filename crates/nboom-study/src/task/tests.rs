use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicI64, Ordering};

use nboom_results::Maker;
use nboom_tables::{Column, Kind, TableWriter};
use proptest::prelude::*;

use super::*;
use crate::description::Source;
use crate::row::Status;
use crate::{
    CASES_CSV_FILE, CASES_FILE, JOURNAL_FILE, Method, Row, STUDY_JSON_FILE, Shard, SweepDirectory,
    TRAJECTORIES_CSV_FILE, Value, merge,
};

mod growth;
mod refusals;
mod restarts;

/// A sweep of cases that are quick.
#[derive(Clone, Debug)]
pub(crate) struct Fake {
    pub cases: u64,
    pub seed: u64,
    pub study: &'static str,
    pub method: Method,
    pub shard: Option<Shard>,
    pub samples: u64,
    pub jobs: usize,
    pub resume: bool,
    pub csv: bool,
    pub maker: &'static str,
    pub accept_difference: bool,
    /// A case that panics.
    pub broken: u64,
}

impl Fake {
    pub fn of(cases: u64) -> Self {
        Self {
            cases,
            seed: 1,
            study: "draws = 1",
            method: Method::MonteCarlo,
            shard: None,
            samples: 1,
            jobs: 2,
            resume: true,
            csv: true,
            maker: "1",
            accept_difference: false,
            broken: 0,
        }
    }

    pub fn run(&self, directory: &Path, watcher: &dyn Watcher) -> Result<Report, StudyError> {
        let worker = || -> Worker<'_> {
            Box::new(|cases| {
                while let Some(case) = cases.next() {
                    assert_ne!(case, self.broken, "a fault of the case");
                    cases.add(case, Some(row(self.seed, case)));
                }
            })
        };
        let task = Task {
            directory,
            description: self.description(),
            study: self.study,
            scene: "name = \"it\"",
            samples: self.samples,
            jobs: self.jobs,
            resume: self.resume,
            accept_difference: self.accept_difference,
        };
        task.run(&worker, watcher)
    }

    /// Runs it to its end, interrupted after each of these numbers of questions whether it is.
    pub fn finish(&self, directory: &Path, interruptions: &[i64]) -> Report {
        for patience in interruptions {
            let watcher = Impatient(AtomicI64::new(*patience));
            self.run(directory, &watcher).expect("it can be interrupted");
        }
        self.run(directory, &Patient).expect("it ends")
    }

    pub fn description(&self) -> Description {
        let source = |text: &str| Source { sha256: nboom_io::sha256(text.as_bytes()) };
        Description {
            version: Description::VERSION,
            name: "it".to_owned(),
            made_by: Maker { version: self.maker.to_owned(), ..Maker::current() },
            also_made_by: Vec::new(),
            study: source(self.study),
            study_but_draws: Some(source("draws = 0")),
            scene: source("name = \"it\""),
            seed: self.seed,
            method: self.method.name().to_owned(),
            draws: self.cases,
            cases: self.cases,
            shard: self.shard,
            rtol: 1e-9,
            columns: columns(),
            vary_together: Vec::new(),
            trajectory_columns: state_columns(),
            results: vec!["x".to_owned()],
            requirements: Vec::new(),
            complete: false,
            csv: self.csv,
            tables: BTreeMap::new(),
            sums: BTreeMap::new(),
            counts: None,
        }
    }
}

/// Interrupts after so many questions.
struct Impatient(AtomicI64);

impl Watcher for Impatient {
    fn interrupted(&self) -> bool {
        self.0.fetch_sub(1, Ordering::Relaxed) <= 0
    }
}

pub(crate) struct Patient;

impl Watcher for Patient {}

fn columns() -> Vec<Column> {
    vec![
        Column::new("case", Kind::Integer, "the case"),
        Column::new("x", Kind::Number, "any bits"),
        Column::new("fault", Kind::Text, "any words"),
        Column::new("status", Kind::Text, "what became of it"),
    ]
}

fn state_columns() -> Vec<Column> {
    let case = Column::new("case", Kind::Integer, "the case");
    let state = Column::new("state", Kind::Integer, "of a hinge");
    vec![case, Column::new("t", Kind::Number, "the time"), state]
}

/// Numbers of all sizes, none, and words of all kinds.
fn row(seed: u64, case: u64) -> Row {
    let bits = (seed + case).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let words = ["", "a,b", "\"quoted\"", "two\nlines", "é\u{1F680}", " blank ", "batch 1 2 3"];
    let status = match case % 5 {
        0 => Status::Rejected("it is too heavy".to_owned()),
        1 => Status::Failed("it is too stiff".to_owned()),
        _ => Status::Ok,
    };
    let word = words[usize::try_from(case).expect("small") % words.len()];
    let cells = vec![
        Value::Integer(case.cast_signed()),
        Value::Number(f64::from_bits(bits)),
        if word.is_empty() { Value::Empty } else { Value::Text(word.to_owned()) },
        Value::Text(status.to_string()),
    ];
    let state = |i: u64| vec![f64::from_bits(bits ^ i), if i == 0 { -1.0 } else { f64::NAN }];
    Row { cells, states: (0..case % 3).map(state).collect(), outcome: status.outcome() }
}

/// The tables of a sweep, written row by row without a journal.
fn expected(fake: &Fake) -> [String; 2] {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("table.csv");
    let mut cases = TableWriter::csv(&path, columns()).expect("writable");
    for case in 1..=fake.cases {
        let row = row(fake.seed, case);
        let cells: Vec<_> = row.cells.iter().map(Value::cell).collect();
        cases.row(&cells).expect("writable");
    }
    cases.finish().expect("writable");
    let mut states = "case,t,state\n".to_owned();
    for case in 1..=fake.cases {
        for state in row(fake.seed, case).states {
            let time = Value::Number(state[0]);
            let code = if state[1].is_finite() { "-1" } else { "" };
            states += &format!("{case},{},{code}\n", time.cell());
        }
    }
    [fs::read_to_string(path).expect("readable"), states]
}

fn tables(directory: &Path) -> [String; 2] {
    let read = |name| fs::read_to_string(directory.join(name)).expect("readable");
    [CASES_CSV_FILE, TRAJECTORIES_CSV_FILE].map(read)
}

/// Names of what is in a directory, in order.
fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).expect("readable");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
        .filter(|name| !name.ends_with(".parquet"))
        .collect();
    names.sort();
    names
}

/// The table of cases as others read it: that in Parquet, if there is one.
fn read_back(directory: &Path) -> String {
    let path = directory.join(CASES_FILE);
    if path.exists() {
        fs::remove_file(directory.join(CASES_CSV_FILE)).expect("it is there");
    }
    let sweep = SweepDirectory::read(directory).expect("readable").expect("a sweep");
    let copy = directory.with_extension("copy");
    let mut table = TableWriter::csv(&copy, columns()).expect("writable");
    sweep.each_case(|cells| Ok(table.row(cells)?)).expect("readable");
    table.finish().expect("writable");
    let text = fs::read_to_string(copy).expect("readable");
    if path.exists() {
        fs::write(directory.join(CASES_CSV_FILE), &text).expect("writable");
    }
    text
}

fn shards(fake: &Fake, of: u64, place: &Path) -> Vec<PathBuf> {
    let shard = |number| {
        let shard = format!("{number}/{of}").parse().expect("a shard");
        let directory = place.join(format!("shard {number}"));
        let report = Fake { shard: Some(shard), ..fake.clone() }.finish(&directory, &[2]);
        assert!(report.description.complete);
        assert_eq!(names(&directory), ["journal.txt", "scene.toml", "study.json", "study.toml"]);
        directory
    };
    (1..=of).map(shard).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tables_do_not_depend_on_interruptions_and_threads(
        cases in 0_u64..120,
        jobs in 1_usize..5,
        interruptions in proptest::collection::vec(0_i64..40, 0..6),
    ) {
        let place = tempfile::tempdir().expect("a directory");
        let directory = place.path().join("sweep");
        let fake = Fake { jobs, ..Fake::of(cases) };
        let report = fake.finish(&directory, &interruptions);
        prop_assert_eq!(report.done, cases);
        prop_assert_eq!(tables(&directory), expected(&fake));
        prop_assert_eq!(read_back(&directory), expected(&fake)[0].clone());
        let left = names(&directory);
        prop_assert_eq!(left.join(" "), "cases.csv scene.toml statistics.json study.json study.toml trajectories.csv");
        let counts = report.description.counts.expect("it is complete");
        prop_assert_eq!(counts.rejected, cases / 5);
        prop_assert_eq!(counts.failed, cases.div_ceil(5));
        prop_assert_eq!(counts.ok + counts.rejected + counts.failed, cases);
    }

    #[test]
    fn shards_together_are_the_whole(cases in 0_u64..60, of in 1_u64..7, turned in 0_usize..7) {
        let place = tempfile::tempdir().expect("a directory");
        let fake = Fake::of(cases);
        let mut shards = shards(&fake, of, place.path());
        let turned = turned % shards.len();
        shards.rotate_left(turned);
        let (merged, whole) = (place.path().join("merged"), place.path().join("whole"));
        let report = merge(&shards, &merged, true, false).expect("all are there");
        let of_whole = fake.finish(&whole, &[]);
        for path in of_whole.files {
            let same = merged.join(path.file_name().expect("a file"));
            if !path.ends_with(STUDY_JSON_FILE) {
                let read = |path: &Path| fs::read(path).expect("readable");
                prop_assert_eq!(read(&same), read(&path), "{}", same.display());
            }
        }
        prop_assert_eq!(report.description, of_whole.description);
        prop_assert_eq!(tables(&merged), expected(&fake));
    }
}
