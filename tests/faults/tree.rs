//! A copy of the working tree into which faults are put.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::fault::Fault;
use crate::results::Outcome;

/// A suite that has not ended after so long has no end.
const PATIENCE: Duration = Duration::from_secs(600);

/// The working tree.
pub fn root() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

pub struct Tree {
    /// Locked as long as faults are put in: two at once would be found by each other's tests.
    _alone: fs::File,
    /// Where results are.
    pub folder: PathBuf,
    /// The copy.
    root: PathBuf,
    /// Whether suites pass without a fault, as far as that is known.
    passes: RefCell<BTreeMap<String, bool>>,
}

/// How a suite went.
enum Said {
    Passed,
    /// With the first test that failed.
    Failed(String),
    NotBuilt,
}

impl Tree {
    /// The copy, brought up to date.
    pub fn new() -> Self {
        let folder = root().join("target/faults");
        let tree = folder.join("tree");
        fs::create_dir_all(&tree).expect("writable");
        let alone = fs::File::create(folder.join("lock")).expect("writable");
        alone.try_lock().expect("nobody else tries faults here");
        let files = files();
        for file in &files {
            bring_up_to_date(&root().join(file), &tree.join(file));
        }
        remove_others(&tree, &tree, &files);
        Self { _alone: alone, folder, root: tree, passes: RefCell::default() }
    }

    /// Puts a fault in, runs its suites until one notices, and takes it out; tells which test did.
    pub fn try_out(&self, fault: &Fault) -> (Outcome, String) {
        let [right, wrong] = match fault.put_into(&self.root) {
            Ok(texts) => texts,
            Err(error) => return (Outcome::Overtaken, error),
        };
        let path = self.root.join(&fault.file);
        for suite in &fault.suites {
            if !self.passes(suite) {
                return (Outcome::Unsound, suite.clone());
            }
            fs::write(&path, &wrong).expect("writable");
            let said = self.run(suite);
            fs::write(&path, &right).expect("writable");
            match said {
                Said::Passed => {}
                Said::Failed(test) => return (Outcome::Found, format!("{suite}: {test}")),
                Said::NotBuilt => return (Outcome::NoCode, suite.clone()),
            }
        }
        (Outcome::Missed, fault.suites.join(", "))
    }

    fn passes(&self, suite: &str) -> bool {
        if let Some(&known) = self.passes.borrow().get(suite) {
            return known;
        }
        let passes = matches!(self.run(suite), Said::Passed);
        self.passes.borrow_mut().insert(suite.to_owned(), passes);
        passes
    }

    fn run(&self, suite: &str) -> Said {
        let words: Vec<&str> = suite.split_whitespace().collect();
        let of_cargo = words.iter().position(|word| *word == "--").unwrap_or(words.len());
        let (built, log) = self.cargo(&[&words[..of_cargo], &["--no-run"]].concat());
        if !built {
            // A generator that gives up is a test that fails; code that is none is no fault.
            let gave_up = ["custom build command", "proc macro panicked", "proc-macro"];
            let gave_up = gave_up.iter().any(|words| log.contains(words));
            return if gave_up { Said::Failed("the build".to_owned()) } else { Said::NotBuilt };
        }
        let (passed, log) = self.cargo(&words);
        if passed {
            return Said::Passed;
        }
        let failed = |line: &str| {
            let name = line.strip_prefix("test ")?.split(" ... FAILED").next()?;
            line.contains("... FAILED").then(|| name.to_owned())
        };
        Said::Failed(log.lines().find_map(failed).unwrap_or_else(|| "no end".to_owned()))
    }

    /// Whether `cargo test` with these words ends well, and what it prints.
    fn cargo(&self, words: &[&str]) -> (bool, String) {
        let log = self.folder.join("log.txt");
        let output = fs::File::create(&log).expect("writable");
        let mut command = Command::new(env!("CARGO"));
        command.arg("test").args(words).current_dir(&self.root).stdin(Stdio::null());
        command.env("CARGO_TARGET_DIR", self.folder.join("target"));
        command.stderr(output.try_clone().expect("a second handle")).stdout(output);
        let mut child = in_group(&mut command).spawn().expect("cargo starts");
        let started = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().expect("it can be waited for") {
                break Some(status);
            }
            if started.elapsed() > PATIENCE {
                end_group(child.id());
                child.wait().expect("it can be waited for");
                break None;
            }
            std::thread::sleep(Duration::from_millis(200));
        };
        let text = String::from_utf8_lossy(&fs::read(log).expect("readable")).into_owned();
        (status.is_some_and(|status| status.success()), text)
    }
}

/// A process whose children can be ended with it.
fn in_group(command: &mut Command) -> &mut Command {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    command
}

fn end_group(leader: u32) {
    let _ = Command::new("kill").args(["--", &format!("-{leader}")]).status();
}

/// The files of the working tree that git knows or would.
fn files() -> BTreeSet<PathBuf> {
    let mut git = Command::new("git");
    git.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]);
    let output = git.current_dir(root()).output().expect("git starts");
    let names = String::from_utf8(output.stdout).expect("names are text");
    let names = names.split('\0').filter(|name| !name.is_empty()).map(PathBuf::from);
    names.filter(|name| root().join(name).is_file()).collect()
}

/// Copies a file. What is the same keeps its time stamp, and what was built of it; what is new has
/// that of the original.
fn bring_up_to_date(original: &Path, copy: &Path) {
    let bytes = fs::read(original).expect("readable");
    let before = fs::read(copy).ok();
    if before.as_ref() == Some(&bytes) {
        return;
    }
    fs::create_dir_all(copy.parent().expect("inside")).expect("writable");
    fs::write(copy, bytes).expect("writable");
    if before.is_none() {
        let stamp = fs::metadata(original).and_then(|file| file.modified()).expect("it has one");
        let file = fs::File::options().write(true).open(copy);
        file.and_then(|file| file.set_modified(stamp)).expect("writable");
    }
}

/// Removes what is in the copy and not in the tree.
fn remove_others(tree: &Path, folder: &Path, files: &BTreeSet<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        let inside = path.strip_prefix(tree).expect("inside");
        if path.is_dir() {
            remove_others(tree, &path, files);
        } else if !files.contains(inside) {
            fs::remove_file(&path).expect("writable");
        }
    }
}
