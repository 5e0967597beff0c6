//! The number by which files of an older generator are recognised follows from all sources that
//! decide what is generated.

use std::fs;
use std::path::{Path, PathBuf};

#[path = "../build/sources.rs"]
mod sources;

/// The workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Crates whose equations are traced, or that trace them.
const TRACED: [&str; 8] = [
    "codegen/nboom-codegen",
    "crates/nboom-elements",
    "crates/nboom-expr",
    "crates/nboom-formulation",
    "crates/nboom-loads",
    "crates/nboom-model",
    "crates/nboom-scalar",
    "crates/nboom-sections",
];

fn copy(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::create_dir_all(to.parent().expect("inside")).expect("writable");
        fs::copy(from, to).expect("writable");
        return;
    }
    for entry in fs::read_dir(from).expect("readable") {
        let name = entry.expect("readable").file_name();
        copy(&from.join(&name), &to.join(&name));
    }
}

#[test]
fn the_number_is_of_all_that_is_traced() {
    let folders = sources::folders(&root());
    assert!(folders.iter().eq(TRACED.map(Path::new)), "{folders:?}");
    assert_eq!(format!("{:016x}", sources::hash(&root())), env!("NBOOM_GENERATOR"));
}

#[test]
fn a_change_of_any_of_the_sources_changes_it() {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("generator");
    let _ = fs::remove_dir_all(&place);
    copy(&root().join("Cargo.toml"), &place.join("Cargo.toml"));
    for folder in TRACED {
        for part in ["Cargo.toml", "src"] {
            copy(&root().join(folder).join(part), &place.join(folder).join(part));
        }
    }
    let before = sources::hash(&place);
    assert_eq!(before, sources::hash(&root()), "it depends on where the sources are");
    let mut seen = vec![before];
    for folder in TRACED {
        let path = place.join(folder).join("src/lib.rs");
        let text = fs::read_to_string(&path).expect("readable");
        fs::write(&path, text + "\n").expect("writable");
        let now = sources::hash(&place);
        assert!(!seen.contains(&now), "{folder}");
        seen.push(now);
    }
}
