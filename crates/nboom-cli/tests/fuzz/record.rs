//! What came of all inputs, and the inputs that failed.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::input::{Input, Kind};
use super::place::Ended;

pub struct Record {
    seed: u64,
    started: Instant,
    /// By what was changed and by exit code.
    ends: BTreeMap<(Kind, Option<i32>), u64>,
    interrupted: u64,
    /// The longest time from an interrupt to the end.
    latest: Duration,
    failed: Vec<String>,
}

impl Record {
    pub fn new(seed: u64) -> Self {
        let started = Instant::now();
        let (ends, failed) = (BTreeMap::new(), Vec::new());
        Self { seed, started, ends, interrupted: 0, latest: Duration::ZERO, failed }
    }

    pub fn failures(&self) -> usize {
        self.failed.len()
    }

    pub fn add(&mut self, number: u64, input: &Input, ended: &Ended, complaints: &[String]) {
        *self.ends.entry((input.kind, ended.code())).or_default() += 1;
        if let Some(time) = ended.after_interrupt {
            self.interrupted += 1;
            self.latest = self.latest.max(time);
        }
        if complaints.is_empty() {
            return;
        }
        let kept = keep(self.seed, number, input, ended);
        let failed = format!(
            "input {number} of seed {}: {}\n  nboom {:?}\n  kept in {}",
            self.seed,
            complaints.join("; "),
            input.words,
            kept.display()
        );
        eprintln!("{failed}");
        self.failed.push(failed);
    }

    /// How far it has come.
    pub fn line(&self) -> String {
        let (inputs, failed) = (self.ends.values().sum::<u64>(), self.failed.len());
        let (interrupted, seconds) = (self.interrupted, self.started.elapsed().as_secs());
        format!("{inputs} inputs, {failed} failed, {interrupted} interrupted, {seconds} s")
    }

    pub fn table(&self) -> String {
        let mut text = format!("seed {}: {}\n", self.seed, self.line());
        let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
        for ((kind, code), count) in &self.ends {
            let code = code.map_or("signal".to_owned(), |code| format!("exit {code}"));
            line(format!("{kind:?}: {code}: {count}"));
        }
        line(format!("longest time from an interrupt to the end: {:.2?}", self.latest));
        self.failed.iter().cloned().for_each(line);
        text
    }
}

/// Puts an input where it stays.
fn keep(seed: u64, number: u64, input: &Input, ended: &Ended) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz/{seed}-{number}"));
    fs::create_dir_all(&folder).expect("cargo's folder is writable");
    let words = format!("{:?}\n", input.words);
    let files = [
        (input.scene_name, &input.scene[..]),
        (super::input::SECTIONS, &input.sections),
        ("words.txt", words.as_bytes()),
        ("out.txt", ended.out.as_bytes()),
        ("error.txt", ended.error.as_bytes()),
    ];
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).expect("cargo's folder is writable");
    }
    folder
}
