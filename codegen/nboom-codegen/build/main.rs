//! A number for the text of everything that generated code is made by, so that a file from an
//! older generator is recognised.

use std::path::Path;

mod sources;

/// The workspace, seen from this crate.
const ROOT: &str = "../..";

fn main() {
    println!("cargo::rerun-if-changed=build");
    let root = Path::new(ROOT);
    for folder in sources::folders(root) {
        for path in ["Cargo.toml", "src"] {
            println!("cargo::rerun-if-changed={}", root.join(&folder).join(path).display());
        }
    }
    println!("cargo::rustc-env=NBOOM_GENERATOR={:016x}", sources::hash(root));
}
