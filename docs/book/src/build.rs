//! The book: the pages of `docs/`, prepared and handed to mdBook.

use std::fs;
use std::path::{Path, PathBuf};

use mdbook_core::config::Config;
use mdbook_driver::MDBook;

use crate::source::Sources;
use crate::{Result, links, page};

/// Writes the book of a clone into a folder, in place of what is there.
pub fn build(clone: &Path, folder: &Path) -> Result<()> {
    let clone = clone.canonicalize()?;
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder)?;
    let folder = folder.canonicalize()?;
    let (pages, book) = (folder.join("pages"), folder.join("html"));
    let mut sources = Sources::new(&clone);
    for path in files(&clone, Path::new("docs"))? {
        let to = pages.join(path.strip_prefix("docs")?);
        fs::create_dir_all(to.parent().expect("a page is in a folder"))?;
        if path.extension().is_some_and(|e| e == "md") {
            let text = fs::read_to_string(clone.join(&path))?;
            let text = page::for_the_book(&path, &text, &mut sources)
                .map_err(|error| format!("{}: {error}", path.display()))?;
            fs::write(to, text)?;
        } else {
            fs::copy(clone.join(&path), to)?;
        }
    }
    let here = clone.join("docs/book");
    fs::copy(here.join("book.css"), folder.join("book.css"))?;
    let mut config = Config::from_disk(here.join("book.toml"))?;
    config.book.src = pages;
    config.build.build_dir = book.clone();
    config.build.create_missing = false;
    MDBook::load_with_config(&folder, config)?.build()?;
    sources.write(&book)?;
    links::check(&book)
}

/// All files of the pages, from the clone; this crate is none of them.
fn files(clone: &Path, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(clone.join(folder))? {
        let path = folder.join(entry?.file_name());
        if path == Path::new("docs/book") {
            continue;
        }
        if clone.join(&path).is_dir() {
            found.extend(files(clone, &path)?);
        } else {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
