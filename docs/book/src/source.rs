//! Files of the clone to which pages link, as pages of their own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::Result;

/// What the book needs from outside of `docs/`.
pub struct Sources {
    clone: PathBuf,
    /// What stands at each place of the book.
    files: BTreeMap<PathBuf, Vec<u8>>,
}

impl Sources {
    pub fn new(clone: &Path) -> Self {
        Self { clone: clone.to_owned(), files: BTreeMap::new() }
    }

    /// The address, from a page, of the copy of a file or the list of a folder.
    pub fn address(&mut self, page: &Path, place: &Path) -> Result<String> {
        let at = self.add(place)?;
        let depth = page.components().count() - 2;
        Ok(format!("{}{}", "../".repeat(depth), at.display()))
    }

    fn add(&mut self, place: &Path) -> Result<PathBuf> {
        let from = self.clone.join(place);
        let source = Path::new("source").join(place);
        if from.is_dir() {
            let at = source.join("index.html");
            if !self.files.contains_key(&at) {
                self.files.insert(at.clone(), Vec::new());
                let list = self.list(place)?;
                self.files.insert(at.clone(), list);
            }
            return Ok(at);
        }
        let bytes = fs::read(&from).map_err(|error| format!("{}: {error}", from.display()))?;
        let is_picture = ["svg", "png"].iter().any(|e| place.extension().is_some_and(|x| x == *e));
        if is_picture {
            self.files.insert(source.clone(), bytes);
            return Ok(source);
        }
        // mdBook would take a name with `.md` in it for a page of its own.
        let at = format!("{}.html", source.display()).replace(".md.", "-md.");
        let at = PathBuf::from(at);
        let text = format!("<pre>{}</pre>", escaped(&String::from_utf8_lossy(&bytes)));
        self.files.insert(at.clone(), framed(place, &text));
        Ok(at)
    }

    /// The files of a folder, each with a link.
    fn list(&mut self, place: &Path) -> Result<Vec<u8>> {
        let mut names = Vec::new();
        for entry in fs::read_dir(self.clone.join(place))? {
            let entry = entry?;
            if entry.file_type()?.is_file() {
                names.push(entry.file_name().to_string_lossy().into_owned());
            }
        }
        names.sort();
        let mut text = String::new();
        for name in names {
            let at = self.add(&place.join(&name))?;
            let to = at.file_name().expect("files have names").to_string_lossy().into_owned();
            text.push_str(&format!("<p><a href=\"{to}\">{name}</a></p>\n"));
        }
        Ok(framed(place, &text))
    }

    /// Writes all of them into the folder of the book.
    pub fn write(&self, book: &Path) -> Result<()> {
        for (at, bytes) in &self.files {
            let to = book.join(at);
            fs::create_dir_all(to.parent().expect("files are in folders"))?;
            fs::write(to, bytes)?;
        }
        Ok(())
    }
}

fn framed(place: &Path, text: &str) -> Vec<u8> {
    let name = escaped(&place.display().to_string());
    let head = "<meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
                <meta name=\"color-scheme\" content=\"light dark\">";
    format!("<!doctype html>{head}<title>{name}</title><h3>{name}</h3>\n{text}\n").into_bytes()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
