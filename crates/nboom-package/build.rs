//! Gathers the sources that go into written packages: those of the command without what
//! generates code, with manifests that need no workspace.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

// The generator's, so that there is one.
#[path = "../../codegen/nboom-codegen/src/hash.rs"]
mod hash;

/// The workspace, seen from this crate.
const ROOT: &str = "../..";

/// The crate whose sources, with those of all that it uses, a simulator is made of.
const COMMAND: &str = "nboom-cli";

/// What lies beside the sources and goes with them.
const BESIDE: [&str; 3] = ["Cargo.lock", "LICENSE-APACHE", "LICENSE-MIT"];

/// What there is of a crate: its code, and the page or the font that the code of one includes.
const PARTS: [&str; 3] = ["src", "page/bundle", "font"];

/// Lines of a manifest under each heading.
type Sections = BTreeMap<String, Vec<String>>;

fn main() {
    let workspace = sections(&read(&Path::new(ROOT).join("Cargo.toml")));
    println!("cargo::rerun-if-changed={ROOT}/Cargo.toml");
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    let mut waiting = vec![COMMAND.to_owned()];
    let mut seen = BTreeSet::new();
    while let Some(name) = waiting.pop() {
        if !seen.insert(name.clone()) {
            continue;
        }
        let folder = Path::new(ROOT).join("crates").join(&name);
        println!("cargo::rerun-if-changed={}", folder.display());
        let (manifest, uses) = stand_alone(&read(&folder.join("Cargo.toml")), &workspace);
        files.insert(format!("{name}/Cargo.toml"), manifest);
        for part in PARTS.map(|part| folder.join(part)).iter().filter(|part| part.is_dir()) {
            collect(&folder, part, &name, &mut files);
        }
        waiting.extend(uses);
    }
    for name in BESIDE {
        let path = Path::new(ROOT).join(name);
        println!("cargo::rerun-if-changed={}", path.display());
        files.insert(name.to_owned(), read(&path));
    }
    write(&files);
}

/// Puts the files where the crate includes them from, and a number for all that it writes.
fn write(files: &BTreeMap<String, String>) {
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo runs build scripts"));
    let mut list = String::from("&[\n");
    let mut all = String::new();
    for (number, (path, text)) in files.iter().enumerate() {
        let name = format!("source-{number}");
        fs::write(out.join(&name), text).expect("the output directory can be written");
        writeln!(list, "    ({path:?}, include_str!({name:?})),").expect("a string takes any text");
        all.push_str(path);
        all.push_str(text);
    }
    list.push_str("]\n");
    fs::write(out.join("sources.rs"), list).expect("the output directory can be written");
    let mut own = BTreeMap::new();
    for folder in ["src", "templates"] {
        println!("cargo::rerun-if-changed={folder}");
        collect(Path::new("."), Path::new(folder), "", &mut own);
    }
    all.extend(own.into_values());
    println!("cargo::rustc-env=NBOOM_PACKAGE={:016x}", hash::hash(all.as_bytes()));
}

fn read(path: &Path) -> String {
    let text = fs::read_to_string(path);
    text.unwrap_or_else(|error| panic!("{} cannot be read: {error}", path.display()))
}

fn collect(base: &Path, folder: &Path, name: &str, files: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).expect("the sources can be listed") {
        let path = entry.expect("the sources can be listed").path();
        if path.is_dir() {
            collect(base, &path, name, files);
        } else {
            let inside = path.strip_prefix(base).unwrap_or(&path).display().to_string();
            files.insert(format!("{name}/{}", inside.replace('\\', "/")), read(&path));
        }
    }
}

fn sections(manifest: &str) -> Sections {
    let mut all = Sections::new();
    let mut heading = String::new();
    for line in manifest.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if line.starts_with('[') {
            heading = line.to_owned();
        } else {
            all.entry(heading.clone()).or_default().push(line.to_owned());
        }
    }
    all
}

/// The value of a key in a section of the workspace's manifest.
fn value<'a>(workspace: &'a Sections, heading: &str, key: &str) -> &'a str {
    let lines = workspace.get(heading).map(Vec::as_slice).unwrap_or_default();
    let found = lines.iter().filter_map(|line| line.split_once(" = ")).find(|(k, _)| *k == key);
    found.unwrap_or_else(|| panic!("{heading} of the workspace has no {key}")).1
}

/// A manifest with what it inherits written out, without tests and what features switch on, and
/// the crates of ours that it uses.
fn stand_alone(manifest: &str, workspace: &Sections) -> (String, Vec<String>) {
    let sections = sections(manifest);
    let lines = |heading: &str| sections.get(heading).map(Vec::as_slice).unwrap_or_default();
    let mut text = String::from("[package]\n");
    for line in lines("[package]") {
        match line.strip_suffix(".workspace = true") {
            Some(key) => {
                let value = value(workspace, "[workspace.package]", key);
                writeln!(text, "{key} = {value}").expect("a string takes any text");
            }
            None => writeln!(text, "{line}").expect("a string takes any text"),
        }
    }
    text.push_str("\n[dependencies]\n");
    let mut uses = Vec::new();
    for line in lines("[dependencies]").iter().filter(|line| !line.contains("optional = true")) {
        let name = line.strip_suffix(".workspace = true");
        let name = name.unwrap_or_else(|| panic!("`{line}`: NAME.workspace = true expected"));
        let value = value(workspace, "[workspace.dependencies]", name);
        if value.contains("path = ") {
            uses.push(name.to_owned());
            writeln!(text, "{name} = {{ path = \"../{name}\" }}").expect("a string takes any text");
        } else {
            writeln!(text, "{name} = {value}").expect("a string takes any text");
        }
    }
    for line in lines("[features]") {
        let name = line.split(" = ").next().unwrap_or_default();
        let heading = if text.contains("[features]") { "" } else { "\n[features]\n" };
        writeln!(text, "{heading}{name} = []").expect("a string takes any text");
    }
    (text, uses)
}
