//! Each phase of the generator uses those before it and none after it.

use std::fs;
use std::path::{Path, PathBuf};

const PHASES: [&str; 3] = ["request", "trace", "emit"];

/// The files of a phase.
fn files(phase: &str) -> Vec<PathBuf> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = vec![src.join(phase).with_extension("rs")];
    let mut folders = vec![src.join(phase)];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(folder).expect("a phase is a folder");
        let paths = entries.map(|entry| entry.expect("readable").path());
        let (inside, of_folder): (Vec<_>, Vec<_>) = paths.partition(|path| path.is_dir());
        folders.extend(inside);
        files.extend(of_folder);
    }
    files
}

#[test]
fn phases_use_those_before_them_alone() {
    for (i, phase) in PHASES.iter().enumerate() {
        for file in files(phase) {
            let text = fs::read_to_string(&file).expect("readable");
            let later =
                PHASES[i + 1..].iter().find(|later| text.contains(&format!("crate::{later}")));
            assert_eq!(later, None, "{}", file.display());
        }
    }
}
