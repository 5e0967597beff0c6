//! What one run of the program is given.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use fastrand::Rng;

use super::{deck, scene, section, words};

/// The names of decks, scenes in TOML and robots in the program's folder, which has one of them.
pub const SCENES: [&str; 3] = ["deck.nml", "scene.toml", "robot.urdf"];

/// The name of the file of sections.
pub const SECTIONS: &str = "sections.json";

/// What was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Deck,
    Scene,
    Robot,
    Sections,
    Words,
}

/// Two files and a command line.
#[derive(Debug)]
pub struct Input {
    pub kind: Kind,
    /// Which of [`SCENES`] there is.
    pub scene_name: &'static str,
    pub scene: Vec<u8>,
    pub sections: Vec<u8>,
    pub words: Vec<OsString>,
}

/// Decks, scenes, robots and sections that are right.
pub struct Corpus {
    decks: Vec<String>,
    scenes: Vec<String>,
    robots: Vec<String>,
    sections: Vec<serde_json::Value>,
}

impl Corpus {
    /// Everything of the kind that is in the clone.
    pub fn read() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let folders = ["tests/data/scenes", "tests/data/robots", "examples", "benches/scenes"];
        let mut paths: Vec<PathBuf> =
            folders.iter().flat_map(|folder| files(&root.join(folder))).collect();
        paths.sort();
        let texts = |ending: &str| -> Vec<String> {
            let ends = |path: &&PathBuf| path.extension().is_some_and(|of| of == ending);
            let text = |path: &PathBuf| fs::read_to_string(path).expect("scenes are text");
            paths.iter().filter(ends).map(text).collect()
        };
        let cases = fs::read_to_string(root.join("tests/data/section_cases.json"));
        let cases: serde_json::Value =
            serde_json::from_str(&cases.expect("it is in the clone")).expect("JSON");
        let sections = cases["cases"].as_array().expect("a list of sections").clone();
        let [decks, scenes, robots] = ["nml", "toml", "urdf"].map(texts);
        assert!(decks.len() > 15 && sections.len() > 20, "{} {}", decks.len(), sections.len());
        assert!(scenes.len() > 3 && robots.len() > 6, "{} {}", scenes.len(), robots.len());
        Self { decks, scenes, robots, sections }
    }

    /// The input of a number: the same on every machine for the same seed.
    pub fn input(&self, seed: u64, number: u64) -> Input {
        let mut rng = Rng::with_seed(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number);
        let rng = &mut rng;
        let kind = match rng.u32(..100) {
            0..36 => Kind::Deck,
            36..54 => Kind::Scene,
            54..60 => Kind::Robot,
            60..75 => Kind::Sections,
            _ => Kind::Words,
        };
        let [deck_name, toml_name, robot_name] = SCENES;
        let (scene_name, scene) = match kind {
            Kind::Deck => (deck_name, deck::changed(rng, &self.decks)),
            Kind::Scene => (toml_name, scene::changed(rng, &self.scenes)),
            Kind::Robot => (robot_name, scene::changed(rng, &self.robots)),
            Kind::Sections | Kind::Words => {
                (deck_name, self.decks[rng.usize(..self.decks.len())].clone().into_bytes())
            }
        };
        let sections = match kind {
            Kind::Sections => section::changed(rng, &self.sections),
            _ => section::some(rng, &self.sections).to_string().into_bytes(),
        };
        let words = match kind {
            Kind::Deck | Kind::Scene | Kind::Robot => words::for_scene(rng, scene_name),
            Kind::Sections => words::for_sections(rng),
            Kind::Words => words::changed(rng),
        };
        Input { kind, scene_name, scene, sections, words }
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|_| panic!("no folder {}", folder.display()));
    entries.map(|entry| entry.expect("readable").path()).collect()
}
