use std::path::{Path, PathBuf};

use nboom_io::{SceneFile, read_scene, write_scene};
use nboom_model::{Dashpot, Hinge, HingeState, Release, SceneDescription, Spring};

use super::read;

pub fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let files = std::fs::read_dir(folder).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    paths.filter(|path| path.extension().is_some_and(|e| e == ending)).collect()
}

/// The description of a scene without what has no effect: releases of hinges that are not held, and
/// rest angles of laws without torque.
pub fn meaning(file: &SceneFile) -> SceneDescription {
    let mut scene = (*file.scene).clone();
    for Hinge { release, start, spring, dashpot, .. } in
        scene.bodies.iter_mut().map(|body| &mut body.hinge)
    {
        if start.state != HingeState::Unreleased {
            *release = Release::Never;
        }
        if [spring.quadratic, spring.linear] == [0.0; 2] {
            *spring = Spring::default();
        }
        let Dashpot { rate_quadratic, rate_linear, angle_quadratic, angle_linear, .. } = *dashpot;
        if [rate_quadratic, rate_linear, angle_quadratic, angle_linear] == [0.0; 4] {
            *dashpot = Dashpot::default();
        }
    }
    scene
}

/// What a written scene means is what was written, to the last bit.
fn survives(file: &SceneFile) {
    let text = write_scene(file);
    let again = read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    // Zeros may change their sign, which no comparison and no motion sees.
    assert!(*again.scene == meaning(file), "{text}");
    let stations = |file: &SceneFile| {
        let structure = file.structure.as_ref()?;
        let segments = structure.segments().iter();
        Some(segments.map(|s| (s.pulse_constant, s.stations.clone())).collect::<Vec<_>>())
    };
    assert_eq!(stations(&again), stations(file), "{text}");
    assert_eq!(again.settings.units, file.settings.units);
    assert_eq!(again.settings.samples, file.settings.samples);
    if file.structure.is_some() {
        assert_eq!(again.legacy.stress_interval, file.legacy.stress_interval);
    }
    // Once written, nothing changes any more.
    assert_eq!(write_scene(&again), text);
}

/// All decks of the clone.
pub fn decks() -> Vec<PathBuf> {
    let folders = ["examples", "tests/data/scenes", "benches/scenes"];
    let decks = folders.map(|folder| files(folder, "nml")).concat();
    assert!(decks.len() > 20, "{decks:?}");
    decks
}

#[test]
fn decks_become_scenes_of_the_same_numbers() {
    for deck in decks() {
        survives(&read_scene(&deck).unwrap_or_else(|error| panic!("{error}")));
    }
}

#[test]
fn scenes_become_scenes_that_stand_alone() {
    for scene in files("examples", "toml") {
        survives(&read_scene(&scene).unwrap_or_else(|error| panic!("{error}")));
    }
}
