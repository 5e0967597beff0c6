//! What became of each fault.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::fault::Fault;

/// What the tests said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// One of them failed, or had no end.
    Found,
    /// All passed.
    Missed,
    /// The code is not what the list says.
    Overtaken,
    /// What is put in is not Rust.
    NoCode,
    /// The tests fail without the fault, too.
    Unsound,
}

impl Outcome {
    const ALL: [Self; 5] =
        [Self::Found, Self::Missed, Self::Overtaken, Self::NoCode, Self::Unsound];

    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::Missed => "missed",
            Self::Overtaken => "overtaken",
            Self::NoCode => "no code",
            Self::Unsound => "unsound",
        }
    }
}

/// Those of all faults tried so far, in a file with a line for each.
pub struct Results {
    path: PathBuf,
    outcomes: BTreeMap<String, Outcome>,
}

/// A fault that is written in another way is another one.
fn key(fault: &Fault) -> String {
    let mut hasher = DefaultHasher::new();
    fault.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

impl Results {
    pub fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_default();
        let row = |line: &str| {
            let mut cells = line.split('\t');
            let (key, name) = (cells.next()?, cells.next()?);
            let outcome = Outcome::ALL.into_iter().find(|outcome| outcome.name() == name)?;
            Some((key.to_owned(), outcome))
        };
        Self { path: path.to_owned(), outcomes: text.lines().filter_map(row).collect() }
    }

    pub fn of(&self, fault: &Fault) -> Option<Outcome> {
        self.outcomes.get(&key(fault)).copied()
    }

    pub fn add(&mut self, fault: &Fault, outcome: Outcome, by: &str) {
        let row = format!("{}\t{}\t{}\t{by}", key(fault), outcome.name(), fault.name);
        let file = OpenOptions::new().create(true).append(true).open(&self.path);
        writeln!(file.expect("writable"), "{row}").expect("writable");
        self.outcomes.insert(key(fault), outcome);
    }

    /// Counts for each crate, and the names of those that were not found.
    pub fn print(&self, faults: &[Fault]) {
        let mut rows: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
        for fault in faults {
            let outcome = self.of(fault).expect("it was tried");
            if let Outcome::Found | Outcome::Missed = outcome {
                let row = rows.entry(fault.name.split(':').next().unwrap_or_default());
                let [found, all] = row.or_default();
                *found += usize::from(outcome == Outcome::Found);
                *all += 1;
            }
            if outcome != Outcome::Found {
                println!("{}: {}", outcome.name(), fault.name);
            }
        }
        rows.insert("all", rows.values().fold([0; 2], |[f, a], row| [f + row[0], a + row[1]]));
        rows.iter().for_each(|(of, [found, all])| println!("| {of} | {all} | {found} |"));
    }
}
