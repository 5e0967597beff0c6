//! The shape of the workspace: which crate may use which (the table in `docs/architecture.md`
//! against the manifests as cargo reads them), the order of rooms in a crate, short files, unsafe code in
//! named files only, shared lints.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// The longest source file.
const MOST_LINES: usize = 400;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// All packages of the workspace.
fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs this test, so it can be run");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("metadata is JSON");
    metadata["packages"].as_array().expect("a list").clone()
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a string")
}

/// What each of our crates uses of ours when it is built; tests may use more.
fn arrows() -> BTreeMap<String, BTreeSet<String>> {
    let packages = packages();
    let ours: BTreeSet<&str> = packages.iter().map(|package| text(&package["name"])).collect();
    let uses = |package: &Value| {
        let all = package["dependencies"].as_array().expect("a list");
        let built = all.iter().filter(|dependency| dependency["kind"] != "dev");
        let names = built.map(|dependency| text(&dependency["name"]));
        names.filter(|name| ours.contains(name)).map(str::to_owned).collect()
    };
    packages.iter().map(|package| (text(&package["name"]).to_owned(), uses(package))).collect()
}

fn map_of_the_code() -> String {
    let path = root().join("docs/architecture.md");
    fs::read_to_string(path).expect("docs/architecture.md can be read")
}

/// The table of `docs/architecture.md`: what each crate may use.
fn allowed() -> BTreeMap<String, BTreeSet<String>> {
    let document = map_of_the_code();
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [name, _, uses] = cells[..] else { return None };
        let name = name.strip_prefix("`nboom-")?.strip_suffix('`')?;
        let names = uses.split(',').map(str::trim).filter(|used| !used.is_empty());
        let names = names.map(|used| format!("nboom-{}", used.trim_matches('`')));
        Some((format!("nboom-{name}"), names.collect()))
    };
    let table = document.lines().filter(|line| line.starts_with("| `nboom-"));
    table.filter_map(row).collect()
}

#[test]
fn crates_use_what_the_table_allows_and_no_others() {
    let (mut arrows, allowed) = (arrows(), allowed());
    assert!(arrows.len() > 8, "{arrows:?}");
    // The facade gathers all others but what writes programs, and what is behind a run.
    let facade = arrows.remove("nboom").expect("the root package is the facade");
    for generator in ["nboom-codegen", "nboom-build", "nboom-cli"] {
        assert!(!facade.contains(generator), "the facade uses {generator}");
    }
    for (name, uses) in &arrows {
        let may = allowed.get(name).unwrap_or_else(|| panic!("{name}: no row in the table"));
        let undue: Vec<_> = uses.difference(may).collect();
        assert!(undue.is_empty(), "{name} uses {undue:?}; the table does not allow it");
        let unused: Vec<_> = may.difference(uses).collect();
        assert!(unused.is_empty(), "{name} does not use {unused:?}; the table says so");
    }
    for name in allowed.keys() {
        assert!(arrows.contains_key(name), "{name} is in the table but not in the workspace");
    }
}

/// The two derivations of the equations of motion, and generators and what runs, are kept
/// apart whatever the table says.
#[test]
fn what_must_be_independent_is() {
    let arrows = arrows();
    let reaches = |from: &str, to: &str| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(name) = open.pop() {
            if seen.insert(name.clone()) {
                open.extend(arrows.get(&name).into_iter().flatten().cloned());
            }
        }
        seen.contains(to)
    };
    assert!(reaches("nboom-cli", "nboom-scalar"), "arrows are followed");
    for (from, to) in [
        ("nboom-dynamics", "nboom-formulation"),
        ("nboom-formulation", "nboom-dynamics"),
        ("nboom-sim", "nboom-codegen"),
        ("nboom-dynamics", "nboom-codegen"),
        ("nboom-codegen", "nboom-sim"),
        ("nboom-codegen", "nboom-ode"),
        ("nboom-codegen", "nboom-dynamics"),
        ("nboom-ode", "nboom-model"),
        ("nboom-series", "nboom-model"),
        ("nboom-sim", "nboom-io"),
        ("nboom-sim", "nboom-results"),
    ] {
        assert!(!reaches(from, to), "{from} reaches {to}");
    }
}

/// What generates code, and what it generates, builds quickly: it needs no library for large matrices.
#[test]
fn nothing_that_generates_depends_on_faer() {
    let tree = |package: &str| {
        let output = Command::new(env!("CARGO"))
            .args(["tree", "--offline", "--prefix", "none", "-e", "normal,build", "-p", package])
            .current_dir(root())
            .output()
            .expect("cargo runs this test, so it can be run");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("names of packages are text")
    };
    let has_faer = |package: &str| tree(package).lines().any(|line| line.starts_with("faer "));
    assert!(has_faer("nboom-ode"), "the tree is read");
    let packages = packages();
    let generators = packages.iter().filter(|package| {
        Path::new(text(&package["manifest_path"])).starts_with(root().join("codegen"))
    });
    let names: Vec<&str> = generators.map(|package| text(&package["name"])).collect();
    assert!(names.contains(&"nboom-codegen"), "{names:?}");
    for name in names {
        assert!(!has_faer(name), "{name}");
    }
}

/// Every file of ours under `folder` that ends with `ending`.
fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries {
        let path = entry.expect("folders of the clone can be listed").path();
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.to_string_lossy().ends_with(ending) {
            found.push(path);
        }
    }
}

fn sources(folders: &[&str]) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for folder in folders {
        files(&root().join(folder), ".rs", &mut found);
    }
    let read = |path: PathBuf| {
        let source = fs::read_to_string(&path).expect("sources are text");
        (path, source)
    };
    found.into_iter().map(read).collect()
}

#[test]
fn no_source_file_is_long() {
    let sources = sources(&["crates", "codegen", "tests"]);
    assert!(sources.len() > 50, "{} files", sources.len());
    // Generated routines and reference output are for the compiler, not for a reader.
    let written = |path: &Path| {
        !path.components().any(|c| matches!(c.as_os_str().to_str(), Some("generated" | "golden")))
    };
    for (path, source) in sources.iter().filter(|(path, _)| written(path)) {
        let lines = source.lines().count();
        assert!(lines <= MOST_LINES, "{}: {lines} lines", path.display());
    }
}

/// The rooms of `nboom-sim`, each of which may use those before it.
fn rooms() -> Vec<String> {
    let document = map_of_the_code();
    let (_, rest) = document.split_once("## Rooms of nboom-sim").expect("a section");
    let (section, _) = rest.split_once("\n## ").expect("another follows");
    let name = |line: &str| Some(line.strip_prefix("| `")?.split_once('`')?.0.to_owned());
    section.lines().filter_map(name).collect()
}

#[test]
fn rooms_of_the_simulator_use_those_above_them() {
    let rooms = rooms();
    let place = |name: &str| rooms.iter().position(|room| room == name);
    let folder = root().join("crates/nboom-sim/src");
    let mut found = BTreeSet::new();
    for (path, source) in sources(&["crates/nboom-sim/src"]) {
        let within = path.strip_prefix(&folder).expect("it was found there").with_extension("");
        let room = within.iter().next().and_then(|part| part.to_str()).expect("a name");
        if room == "lib" {
            continue;
        }
        let own = place(room).unwrap_or_else(|| panic!("{room} is not in the table"));
        found.insert(room.to_owned());
        let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
        for used in code.flat_map(|line| line.split("crate::").skip(1)) {
            let name = used.split(|c: char| !(c.is_alphanumeric() || c == '_')).next();
            let its = name.and_then(place);
            assert!(its.is_some_and(|its| its <= own), "{}: crate::{used}", path.display());
        }
    }
    assert!(found.into_iter().eq(rooms.iter().cloned().collect::<BTreeSet<_>>()), "{rooms:?}");
}

/// Files that may have unsafe code: the first three for a reason that a benchmark has shown to pay, the others
/// because code of another compiler is called, which is never safe (decision 9).
const UNSAFE: [&str; 7] = [
    "crates/nboom-scalar/src/compiled.rs",
    "crates/nboom-scalar/src/wide.rs",
    "crates/nboom-scalar/src/wide/two_registers.rs",
    "crates/nboom-scalar/src/code.rs",
    "crates/nboom-scalar/src/foreign.rs",
    "crates/nboom-package/src/load.rs",
    "crates/nboom-package/templates/shared.rs",
];

#[test]
fn unsafe_code_stands_only_where_it_pays_or_has_to_be() {
    let safe = |path: &Path| !UNSAFE.iter().any(|allowed| path.ends_with(allowed));
    for (path, source) in sources(&["crates", "codegen"]) {
        if !safe(&path) {
            continue;
        }
        let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
        for (i, line) in code.enumerate() {
            let words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let is_unsafe = words.into_iter().any(|word| word == "unsafe");
            assert!(!is_unsafe, "{}:{}: {line}", path.display(), i + 1);
            assert!(!line.contains("allow(unsafe_code"), "{}:{}", path.display(), i + 1);
        }
    }
}

/// Whoever simulates does not build the generator.
#[test]
fn the_facade_has_the_macros_on_request_only() {
    let packages = packages();
    let facade = packages.iter().find(|package| package["name"] == "nboom").expect("the root");
    let all = facade["dependencies"].as_array().expect("a list");
    let macros = all.iter().find(|uses| uses["name"] == "nboom-macros").expect("a feature");
    assert_eq!(macros["optional"], true);
    assert!(facade["features"].get("default").is_none(), "{}", facade["features"]);
}

#[test]
fn every_crate_has_the_lints_of_the_workspace() {
    let packages = packages();
    for package in &packages {
        let path = text(&package["manifest_path"]);
        let manifest = fs::read_to_string(path).expect("a manifest is text");
        let lints = manifest.split("\n[lints]\n").nth(1).unwrap_or_default();
        assert!(lints.trim_start().starts_with("workspace = true"), "{path}");
    }
    let workspace = fs::read_to_string(root().join("Cargo.toml")).expect("a manifest is text");
    for lint in ["unsafe_code", "undocumented_unsafe_blocks"] {
        assert!(workspace.contains(&format!("{lint} = \"deny\"")), "{lint}");
    }
}
