//! A number for the text of everything that generated code is made by, so that a file from an
//! older generator is recognised.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders whose sources decide what is generated.
const SOURCES: [&str; 4] = [
    "src",
    "../../crates/nboom-expr/src",
    "../../crates/nboom-formulation/src",
    "../../crates/nboom-scalar/src",
];

fn main() {
    let mut files = Vec::new();
    for folder in SOURCES {
        println!("cargo::rerun-if-changed={folder}");
        collect(Path::new(folder), &mut files);
    }
    files.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for file in files {
        for byte in fs::read(&file).expect("the sources can be read") {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    println!("cargo::rustc-env=NBOOM_GENERATOR={hash:016x}");
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("the sources can be listed");
    for entry in entries {
        let path = entry.expect("the sources can be listed").path();
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}
