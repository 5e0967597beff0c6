//! What one run of the program is given.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use fastrand::Rng;

use super::{deck, section, words};

/// The name of the deck in the program's folder.
pub const DECK: &str = "deck.nml";

/// The name of the file of sections.
pub const SECTIONS: &str = "sections.json";

/// What was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Deck,
    Sections,
    Words,
}

/// Two files and a command line.
#[derive(Debug)]
pub struct Input {
    pub kind: Kind,
    pub deck: Vec<u8>,
    pub sections: Vec<u8>,
    pub words: Vec<OsString>,
}

/// Decks and sections that are right.
pub struct Corpus {
    decks: Vec<String>,
    sections: Vec<serde_json::Value>,
}

impl Corpus {
    /// Everything of the kind that is in the clone.
    pub fn read() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let folders = ["tests/data/scenes", "examples", "benches/scenes"];
        let mut paths: Vec<PathBuf> =
            folders.iter().flat_map(|folder| files(&root.join(folder))).collect();
        paths.retain(|path| path.extension().is_some_and(|ending| ending == "nml"));
        paths.sort();
        let text = |path: &PathBuf| fs::read_to_string(path).expect("decks are text");
        let cases = fs::read_to_string(root.join("tests/data/section_cases.json"));
        let cases: serde_json::Value =
            serde_json::from_str(&cases.expect("it is in the clone")).expect("JSON");
        let sections = cases["cases"].as_array().expect("a list of sections").clone();
        let decks: Vec<String> = paths.iter().map(text).collect();
        assert!(decks.len() > 15 && sections.len() > 20, "{} {}", decks.len(), sections.len());
        Self { decks, sections }
    }

    /// The input of a number: the same on every machine for the same seed.
    pub fn input(&self, seed: u64, number: u64) -> Input {
        let mut rng = Rng::with_seed(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number);
        let rng = &mut rng;
        let kind = match rng.u32(..100) {
            0..60 => Kind::Deck,
            60..75 => Kind::Sections,
            _ => Kind::Words,
        };
        let deck = match kind {
            Kind::Deck => deck::changed(rng, &self.decks),
            _ => self.decks[rng.usize(..self.decks.len())].clone().into_bytes(),
        };
        let sections = match kind {
            Kind::Sections => section::changed(rng, &self.sections),
            _ => section::some(rng, &self.sections).to_string().into_bytes(),
        };
        let words = match kind {
            Kind::Deck => words::for_deck(rng),
            Kind::Sections => words::for_sections(rng),
            Kind::Words => words::changed(rng),
        };
        Input { kind, deck, sections, words }
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|_| panic!("no folder {}", folder.display()));
    entries.map(|entry| entry.expect("readable").path()).collect()
}
