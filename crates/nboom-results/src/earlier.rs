use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde_json::Value;

use crate::kind::Kind;
use crate::{FILES, REPORT_FILE, ResultsError, SUMMARY_FILE};

/// The longest summary that is read \[bytes\]; a run with a million changes of code is shorter.
const LONGEST: u64 = 1 << 28;

/// The results of an earlier run in a directory, by its summary.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Earlier {
    /// The summary.
    pub keys: Value,
    /// Whether the run is complete.
    pub complete: bool,
    /// Which files are the run's.
    pub files: Vec<String>,
}

impl Earlier {
    /// Reads the summary in `directory`; `None` if there is none.
    ///
    /// # Errors
    /// [`ResultsError::Foreign`] where the file of that name is no summary of a run.
    pub fn in_directory(directory: &Path) -> Result<Option<Self>, ResultsError> {
        let path = directory.join(SUMMARY_FILE);
        let foreign = |found| ResultsError::Foreign { path: path.clone(), found };
        match Kind::of(&path).map_err(ResultsError::writing(&path))? {
            Kind::Nothing => return Ok(None),
            Kind::File => {}
            found => return Err(foreign(found)),
        }
        let mut bytes = Vec::new();
        let read = File::open(&path).and_then(|file| file.take(LONGEST).read_to_end(&mut bytes));
        read.map_err(ResultsError::writing(&path))?;
        Self::from_json(&bytes).map(Some).ok_or_else(|| foreign(Kind::File))
    }

    fn from_json(bytes: &[u8]) -> Option<Self> {
        let keys: Value = serde_json::from_slice(bytes).ok()?;
        let complete = keys.get("complete")?.as_bool()?;
        keys.get("scene")?.as_str()?;
        let named = |list: &Vec<Value>| {
            let names = list.iter().filter_map(Value::as_str).map(str::to_owned);
            names.collect::<Vec<_>>()
        };
        // Summaries of runs that were killed do not name the files.
        let all = || FILES.map(str::to_owned).to_vec();
        let files = keys.get("files").and_then(Value::as_array).map_or_else(all, named);
        Some(Self { keys, complete, files })
    }

    /// Whether a file of this name is the run's, or a page made from its files later.
    pub fn owns(&self, name: &str) -> bool {
        name == REPORT_FILE || self.files.iter().any(|file| file == name)
    }

    /// A summary that says that these results are about to be replaced by others, with `files`.
    pub fn as_mark(&self, files: &[String], from: &Path) -> Vec<u8> {
        let mut keys = self.keys.clone();
        let error = format!(
            "a finished run is taking this place; what is not here yet is in {}, and the next run \
             into this directory completes that",
            from.display()
        );
        keys["complete"] = false.into();
        keys["error"] = error.into();
        keys["files"] = files.into();
        let text = serde_json::to_vec_pretty(&keys).expect("what was read can be written");
        [text, b"\n".to_vec()].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summary_is_told_from_other_json() {
        let read = |text: &str| Earlier::from_json(text.as_bytes());
        let found = read(r#"{"scene": "a", "complete": true, "files": ["states.csv"]}"#);
        let found = found.expect("a summary");
        assert!(found.complete);
        assert_eq!(found.files, ["states.csv"]);
        let first_version = read(r#"{"scene": "a", "complete": false}"#).expect("a summary");
        assert_eq!(first_version.files, FILES);
        for other in
            ["", "{}", "[]", "7", r#"{"complete": true}"#, r#"{"scene": 1, "complete": 2}"#]
        {
            assert_eq!(read(other), None, "{other}");
        }
    }
}
