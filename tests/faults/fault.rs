//! The list of faults.

use std::fs;
use std::path::{Path, PathBuf};

/// A piece of the code, and what is put in its place.
#[derive(Clone, Debug, Default, Hash)]
pub struct Fault {
    /// Crate and what goes wrong.
    pub name: String,
    /// From the root of the repository.
    pub file: PathBuf,
    /// What is there, once.
    pub right: String,
    pub wrong: String,
    /// What follows `cargo test` for the suites that ought to notice.
    pub suites: Vec<String>,
}

/// All of `tests/faults/list`: `= name`, `in file`, lines of code with `- ` or `+ ` before them,
/// `by` suite, for each.
pub fn faults() -> Vec<Fault> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/faults/list");
    let entries = fs::read_dir(folder).expect("the list is in the clone");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("readable").path()).collect();
    paths.sort();
    let text = |path: &PathBuf| fs::read_to_string(path).expect("readable");
    paths.iter().flat_map(|path| parse(&text(path))).collect()
}

fn parse(text: &str) -> Vec<Fault> {
    let mut found: Vec<Fault> = Vec::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (mark, rest) = line.split_once(' ').unwrap_or((line, ""));
        if mark == "=" {
            found.push(Fault { name: rest.to_owned(), ..Fault::default() });
            continue;
        }
        let fault = found.last_mut().unwrap_or_else(|| panic!("`{line}` before a name"));
        match mark {
            "in" => fault.file = rest.into(),
            "-" => add_line(&mut fault.right, rest),
            "+" => add_line(&mut fault.wrong, rest),
            "by" => fault.suites.push(rest.to_owned()),
            _ => panic!("`{line}` is no line of a fault"),
        }
    }
    for fault in &found {
        let is_whole = !fault.right.is_empty() && !fault.suites.is_empty();
        assert!(is_whole && fault.right != fault.wrong, "{fault:?} lacks something");
    }
    found
}

fn add_line(text: &mut String, line: &str) {
    if !text.is_empty() {
        text.push('\n');
    }
    text.push_str(line);
}

impl Fault {
    /// The text of its file in the tree at `root`, as it is and with the fault.
    ///
    /// # Errors
    /// When the code is not there once.
    pub fn put_into(&self, root: &Path) -> Result<[String; 2], String> {
        let Self { name, file, right, wrong, .. } = self;
        let text = fs::read_to_string(root.join(file));
        let text = text.map_err(|error| format!("{name}: {}: {error}", file.display()))?;
        match text.matches(right).count() {
            1 => Ok([text.clone(), text.replacen(right, wrong, 1)]),
            count => Err(format!("{name}: `{right}` is {count} times in {}", file.display())),
        }
    }
}
