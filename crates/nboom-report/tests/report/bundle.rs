use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("page")
}

fn hash(path: &Path) -> String {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() { sources(&path, found) } else { found.push(path) }
    }
}

#[test]
fn the_bundle_is_made_of_these_sources() {
    let folder = folder();
    let list = fs::read_to_string(folder.join("bundle/SHA256SUMS")).expect("a list of hashes");
    let listed: Vec<(&str, &str)> = list.lines().filter_map(|line| line.split_once("  ")).collect();
    for (expected, name) in &listed {
        let found = hash(&folder.join(name));
        assert_eq!(
            found,
            *expected,
            "{name} has changed: run npm run build in {}",
            folder.display()
        );
    }
    let mut all = Vec::new();
    sources(&folder.join("src"), &mut all);
    for path in all {
        let name =
            path.strip_prefix(&folder).expect("below it").to_string_lossy().replace('\\', "/");
        assert!(listed.iter().any(|(_, known)| *known == name), "{name} is not in the bundle");
    }
}

/// Pages replace in a browser what is replaced elsewhere, but tabs and the ends of lines.
#[test]
fn pages_show_what_is_shown_elsewhere() {
    let text = fs::read_to_string(folder().join("src/text.js")).expect("a source");
    let (_, rest) = text.split_once("DECEPTIVE = /[").expect("the set");
    let (set, _) = rest.split_once("]/g;").expect("its end");
    let ranges: Vec<[u32; 2]> = set.replace("-\\u", "-").split("\\u").skip(1).map(range).collect();
    for c in '\0'..=char::MAX {
        let is_replaced = ranges.iter().any(|[low, high]| (*low..=*high).contains(&u32::from(c)));
        let expected = nboom_model::steers(c) && !matches!(c, '\t' | '\n');
        assert_eq!(is_replaced, expected, "{}", c.escape_unicode());
    }
}

/// Two ends as `2028-202e`, or one character.
fn range(text: &str) -> [u32; 2] {
    let (low, high) = text.split_once('-').unwrap_or((text, text));
    [low, high].map(|end| u32::from_str_radix(end, 16).expect("hexadecimal"))
}

/// Runs know a page by its first bytes.
#[test]
fn a_page_begins_with_its_mark() {
    for name in ["page", "sweep"] {
        let page = folder().join(format!("bundle/{name}.html"));
        let page = fs::read_to_string(page).expect("the bundle");
        let start: String = page.chars().take(300).collect();
        assert!(start.contains(nboom_results::REPORT_MARK), "{start}");
        // The title comes before the data.
        let parts = ["@TITLE@", "@DATA@"].map(|mark| page.match_indices(mark).collect::<Vec<_>>());
        assert!(parts.iter().all(|found| found.len() == 1) && parts[0][0].0 < parts[1][0].0);
    }
}

#[test]
fn libraries_come_with_their_licences() {
    let page = fs::read_to_string(folder().join("bundle/page.html")).expect("the bundle");
    let licences = fs::read_to_string(folder().join("bundle/LICENSES.md")).expect("licences");
    for library in ["three 0.187.0, MIT", "uplot 1.6.32, MIT"] {
        assert!(page.contains(library) && licences.contains(library), "{library}");
    }
    assert!(page.contains("Permission is hereby granted"));
}
