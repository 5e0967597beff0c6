//! The files of a scene: its own, and those that it includes.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::ReadOptions;
use super::catalog::{PART, SCENE};
use super::keys::TableKind;
use super::sources::{Place, Sources};
use super::tree::{self, Entry, Node, Table, Value};
use crate::BadFile;
use crate::diagnostic::{Report, quoted};
use crate::source::{LARGEST, read_text};

/// Most files of a scene.
const MOST_FILES: usize = 100;

/// The trees of all files, the scene's own first, each included one after those before it in the text.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    tables: Vec<(Table, Place)>,
    /// Whole paths of the files that are included.
    pub included: Vec<PathBuf>,
}

impl Parts {
    /// Reads the file with this name and text, and the files that it includes; what is wrong is
    /// reported.
    pub fn read(
        (file, text): (&str, &str),
        folder: Option<&Path>,
        options: &ReadOptions,
        sources: &mut Sources,
        report: &mut Report<'_>,
    ) -> Self {
        let mut parts = Self { tables: Vec::new(), included: Vec::new() };
        let main = sources.add(file, text.to_owned());
        let mut folders = vec![folder.map(Path::to_owned)];
        let mut known: Vec<PathBuf> = folder
            .and_then(|folder| folder.join(file_name(file)).canonicalize().ok())
            .into_iter()
            .collect();
        parts.add(main, sources, report);
        if let (Some(entry), None) = (parts.root().get("scene"), parts.root().get("main_body")) {
            let expected = "a scene; nboom sweep runs a study, nboom run --case one case of it";
            report.error_at(sources, &entry.key_at, "scene", "a study", expected);
        }
        let mut next = 0;
        while next < parts.tables.len() && report.errors.is_empty() {
            let folder = folders[next].clone();
            for (path, at) in parts.includes(next, sources, report) {
                let Some(of_scene) = folders[0].clone() else {
                    let expected = "none in a scene that is not a file";
                    report.error_at(sources, &at, "include", "an include", expected);
                    continue;
                };
                let full = folder.as_ref().unwrap_or(&of_scene).join(&path);
                match admitted(&full, &of_scene, &known, options) {
                    Ok((canonical, text)) => {
                        folders.push(canonical.parent().map(Path::to_owned));
                        known.push(canonical.clone());
                        parts.included.push(canonical);
                        let file = sources.add(&full.display().to_string(), text);
                        parts.add(file, sources, report);
                    }
                    Err((found, expected)) => {
                        let found = format!("{}, {found}", quoted(&path));
                        report.error_at(sources, &at, "include", &found, &expected);
                    }
                }
            }
            next += 1;
        }
        parts
    }

    fn add(&mut self, file: usize, sources: &Sources, report: &mut Report<'_>) {
        let table = tree::parse(file, sources, report);
        self.tables.push((table, Place { file, bytes: 0..0 }));
    }

    /// The paths that a file includes.
    fn includes(
        &self,
        part: usize,
        sources: &Sources,
        report: &mut Report<'_>,
    ) -> Vec<(String, Place)> {
        let Some(Entry { node, .. }) = self.tables[part].0.get("include") else {
            return Vec::new();
        };
        let nodes = match &node.value {
            Value::List(nodes) => &nodes[..],
            Value::Text(_) => std::slice::from_ref(node),
            other => {
                report.error_at(sources, &node.at, "include", other.kind(), "a list of paths");
                return Vec::new();
            }
        };
        let mut paths = Vec::new();
        for Node { value, at } in nodes {
            match value {
                Value::Text(path) => paths.push((path.clone(), at.clone())),
                other => report.error_at(sources, at, "include", other.kind(), "a path in quotes"),
            }
        }
        paths
    }

    /// Kind, tree and place of each file.
    pub fn iter(&self) -> impl Iterator<Item = (&'static TableKind, &Table, &Place)> {
        let kind = |i| if i == 0 { &SCENE } else { &PART };
        self.tables.iter().enumerate().map(move |(i, (table, at))| (kind(i), table, at))
    }

    /// The entries of the table with this key in all files.
    pub fn entries(&self, key: &'static str) -> impl Iterator<Item = &Entry> {
        let tables = self.tables.iter().filter_map(move |(table, _)| table.get(key));
        tables.flat_map(|entry| match &entry.node.value {
            Value::Table(table) => &table.0[..],
            _ => &[],
        })
    }

    /// The tree of the scene's own file.
    pub fn root(&self) -> &Table {
        &self.tables[0].0
    }

    pub fn root_mut(&mut self) -> &mut Table {
        &mut self.tables[0].0
    }

    /// All files in one, which includes none.
    pub fn merged(self) -> Self {
        let mut tables = self.tables.into_iter();
        let mut all: Vec<_> = tables.by_ref().take(1).collect();
        let root = &mut all[0].0;
        let others = tables.flat_map(|(table, _)| Arc::unwrap_or_clone(table.0));
        others.for_each(|entry| root.absorb(entry));
        Arc::make_mut(&mut root.0).retain(|entry| entry.key != "include");
        Self { tables: all, included: self.included }
    }

    /// The texts of all files.
    pub fn all_text(&self, sources: &Sources) -> String {
        self.tables.iter().map(|(_, at)| sources.text(at.file)).collect()
    }
}

fn file_name(file: &str) -> &Path {
    Path::new(file).file_name().map_or(Path::new(file), Path::new)
}

/// The whole path of a file that may be included, and its text; else what was found and expected.
fn admitted(
    path: &Path,
    of_scene: &Path,
    known: &[PathBuf],
    options: &ReadOptions,
) -> Result<(PathBuf, String), (String, String)> {
    let found =
        |error: std::io::Error| (format!("which cannot be read: {error}"), "a file".to_owned());
    let canonical = fs::canonicalize(path).map_err(found)?;
    let home = fs::canonicalize(of_scene).map_err(found)?;
    if !canonical.starts_with(&home) && !options.includes_from_anywhere {
        let expected = "a file in the folder of the scene or below, or --include-anywhere";
        return Err(("which lies elsewhere".to_owned(), expected.to_owned()));
    }
    if known.contains(&canonical) {
        return Err(("which is part of the scene already".to_owned(), "each file once".to_owned()));
    }
    if known.len() >= MOST_FILES {
        return Err(("one more file".to_owned(), format!("at most {MOST_FILES} files")));
    }
    let text = read_text(&canonical, LARGEST).map_err(|error| {
        let (found, expected) = match error.bad_file() {
            Some(BadFile { place, found, expected }) => {
                (format!("{place}: found {found}"), expected)
            }
            None => (error.to_string(), "a text file"),
        };
        (format!("which cannot be read: {found}"), expected.to_owned())
    })?;
    Ok((canonical, text))
}
