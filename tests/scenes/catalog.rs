//! The reference scenes, as JSON and as decks, with what is expected of them.

use std::path::PathBuf;

use nboom::model::Scene;
use serde_json::Value;

use crate::support::json_scene;
use crate::support::{data, data_path, number};

/// Every scene of `tests/data/scenes`.
pub const NAMES: [&str; 11] = [
    "report_testcase",
    "s01_rigid_body",
    "s02_single_boom",
    "s03_chain3_general",
    "s04_paddle_general",
    "s06_gravity_thrust",
    "s07_quadratic_terms",
    "s08_kickoff_disengage",
    "s10_symmetric_lock",
    "s11_long_spin",
    "s13_initial_states",
];

/// In this one every body's mass centre is at rest until the booms swing out.
pub const AT_REST: &str = "s10_symmetric_lock";

/// A reference run.
pub struct Reference {
    pub name: &'static str,
    pub samples: Vec<Value>,
    pub events: Vec<Value>,
}

impl Reference {
    pub fn load(name: &'static str) -> Self {
        let file = data(&format!("scenes/{name}.expected.json"));
        let list = |key: &str| file[key].as_array().expect("a list").clone();
        Self { name, samples: list("samples"), events: list("events") }
    }

    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.into_iter().map(Self::load)
    }

    pub fn end_time(&self) -> f64 {
        number(self.samples.last().expect("samples"), "t")
    }

    pub fn time_span(&self) -> f64 {
        self.end_time() - number(&self.samples[0], "t")
    }

    pub fn intervals(&self) -> usize {
        self.samples.len() - 1
    }

    pub fn scene(&self) -> Scene {
        json_scene::scene(&data(&format!("scenes/{}.json", self.name)), self.end_time())
    }

    /// The scene read from its deck.
    pub fn deck(&self) -> Scene {
        let path = match self.name {
            "report_testcase" => {
                PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/n-boom-1970.nml")
            }
            name => data_path(&format!("scenes/{name}.nml")),
        };
        let file = nboom::io::read_scene(&path).expect("reference decks are valid");
        file.scene.ending_at(self.end_time()).expect("the end is after the start")
    }
}

#[test]
fn no_scene_is_left_out() {
    let folder = std::fs::read_dir(data_path("scenes")).expect("the data are in the clone");
    let names = folder.map(|entry| entry.expect("readable").file_name());
    let names = names.filter_map(|name| {
        let name = name.to_str()?;
        Some(name.strip_suffix(".expected.json")?.to_owned())
    });
    let mut names: Vec<String> = names.collect();
    names.sort();
    assert_eq!(names, NAMES);
}
