//! What tests of several formats share.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;

/// Compares what is told of each wrong file with the text beside it; `tests/FOLDER` has at least so many
/// of them. `NBOOM_BLESS=1` writes the texts.
pub fn told_of_wrong_files(
    folder: &str,
    ending: &str,
    at_least: usize,
    told: impl Fn(&str) -> String,
) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(folder);
    let files = fs::read_dir(&folder).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    let mut wrong: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|of| of == ending)).collect();
    wrong.sort();
    assert!(wrong.len() >= at_least);
    let bless = std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1");
    for path in wrong {
        let text = fs::read_to_string(&path).expect("readable");
        let (told, file) = (format!("{}\n", told(&text)), path.with_extension("txt"));
        if bless {
            fs::write(&file, told).expect("writable");
        } else {
            let expected = fs::read_to_string(&file).expect("a message");
            assert_eq!(told, expected, "NBOOM_BLESS=1 writes {}", file.display());
        }
    }
}

/// A change of a text: at a place, so many characters are replaced by a word or by nothing.
pub type Edit = (prop::sample::Index, usize, usize);

/// Some changes that put in one of so many words.
pub fn edits(words: usize) -> impl Strategy<Value = Vec<Edit>> {
    prop::collection::vec((any::<prop::sample::Index>(), 0..40_usize, 0..=words), 1..6)
}

/// The text after these changes.
pub fn edited(text: &str, edits: &[Edit], words: &[&str]) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    for (at, removed, word) in edits {
        let at = at.index(characters.len() + 1);
        let end = (at + removed).min(characters.len());
        characters.splice(at..end, words.get(*word).copied().unwrap_or_default().chars());
    }
    characters.into_iter().collect()
}
