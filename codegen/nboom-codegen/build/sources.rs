//! The sources that decide what is generated: those of this crate and of all of ours that it uses.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../src/hash.rs"]
mod hash;

/// The crate that generates.
const GENERATOR: &str = "nboom-codegen";

/// Folders of these crates in the workspace at `root`, by what manifests say they use.
pub fn folders(root: &Path) -> BTreeSet<PathBuf> {
    let workspace = read(&root.join("Cargo.toml"));
    let mut found = BTreeSet::new();
    let mut waiting = vec![GENERATOR.to_owned()];
    while let Some(name) = waiting.pop() {
        let folder = folder(&workspace, &name);
        let manifest = read(&root.join(&folder).join("Cargo.toml"));
        if found.insert(folder) {
            waiting.extend(ours(&manifest).map(str::to_owned));
        }
    }
    found
}

/// A number for the texts of all files, in the order of their paths, and of the version, which code names.
pub fn hash(root: &Path) -> u64 {
    let mut files = Vec::new();
    for folder in folders(root) {
        collect(&root.join(folder).join("src"), &mut files);
    }
    files.sort();
    let bytes = files.into_iter().flat_map(|file| read(&file).into_bytes());
    let bytes = bytes.chain(env!("CARGO_PKG_VERSION").bytes());
    hash::hash(&bytes.collect::<Vec<u8>>())
}

/// Where the workspace's manifest says a crate is.
fn folder(workspace: &str, name: &str) -> PathBuf {
    let before = format!("{name} = {{ path = \"");
    let path = workspace.lines().find_map(|line| line.strip_prefix(&before)?.split('"').next());
    path.unwrap_or_else(|| panic!("the workspace has no path of {name}")).into()
}

/// The crates of ours that a manifest's crate uses when it is built.
fn ours(manifest: &str) -> impl Iterator<Item = &str> {
    let lines = manifest.lines().skip_while(|line| *line != "[dependencies]").skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let names = lines.filter_map(|line| line.strip_suffix(".workspace = true"));
    names.filter(|name| name.starts_with("nboom-"))
}

fn read(path: &Path) -> String {
    let text = fs::read_to_string(path);
    text.unwrap_or_else(|error| panic!("{} cannot be read: {error}", path.display()))
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the sources can be listed") {
        let path = entry.expect("the sources can be listed").path();
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}
