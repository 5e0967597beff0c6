//! Which files of a run a test finds, and whether they are whole.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

/// The contents of all files in a directory; nothing when it is not there.
pub fn contents(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let Ok(entries) = fs::read_dir(directory) else { return BTreeMap::new() };
    let content = |entry: fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, fs::read(entry.path()).expect("a file"))
    };
    entries.map(|entry| content(entry.expect("readable"))).collect()
}

/// The summary in a directory, if it has one.
pub fn summary(directory: &Path) -> Option<Value> {
    let text = fs::read(directory.join("summary.json")).ok()?;
    Some(serde_json::from_slice(&text).expect("a summary is JSON at all times"))
}

/// All tables in a directory consist of whole rows.
pub fn rows_are_whole(directory: &Path) {
    assert_eq!(half_rows(directory), 0, "a table ends with half a row");
}

/// How many tables in a directory end with half a row, which has no line end; all other rows are
/// whole.
pub fn half_rows(directory: &Path) -> usize {
    let mut found = 0;
    for (name, content) in contents(directory) {
        if !name.ends_with(".csv") {
            continue;
        }
        let text = String::from_utf8(content).expect("tables are text");
        let end = text.rfind('\n').map_or(0, |newline| newline + 1);
        found += usize::from(end < text.len());
        let columns = |row: &str| row.split(',').count();
        let head = text[..end].lines().next().map_or(0, columns);
        assert!(text[..end].lines().all(|row| columns(row) == head), "{name} has half a row");
    }
    found
}
