use std::path::{Path, PathBuf};

use nboom_io::{SceneFile, SceneSettings, read_scene, write_scene};
use nboom_model::{
    Dashpot, Hinge, HingeState, Release, SceneDescription, SegmentStructure, Spring,
};

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
        let of_segment = |s: &SegmentStructure| {
            let material = Some(s.material).filter(|_| !s.stations.is_empty());
            (s.pulse_constant, material, s.stations.clone())
        };
        Some(segments.map(of_segment).collect::<Vec<_>>())
    };
    assert_eq!(stations(&again), stations(file), "{text}");
    let shapes = |file: &SceneFile| {
        let of_bodies = (0..file.scene.bodies.len()).map(|i| file.scene.shapes().of(i).copied());
        (file.scene.shapes().main_body, of_bodies.collect::<Vec<_>>())
    };
    assert_eq!(shapes(&again), shapes(file), "{text}");
    // Numbers have taken the place of parameters.
    let settings =
        |file: &SceneFile| SceneSettings { parameters: Vec::new(), ..file.settings.clone() };
    assert_eq!(settings(&again), settings(file), "{text}");
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

#[test]
fn what_a_scene_says_beside_its_motion_survives() {
    let text = "
        [run]
        end = 10.0

        [output]
        every = 0.1
        columns = [\"omega\", \"beta of boom\"]
        angles = \"degrees\"
        files = \"listing\"
        stress_every = 3

        [main_body]
        mass = 100.0
        inertia = [40.0, 30.0, 20.0]
        shape = { cylinder = { radius = 1.0, length = 2.0, along = [1.0, 1.0, 0.0] } }

        [materials.steel]
        youngs_modulus = 2.0e11
        yield_stress = 2.5e8
        ultimate_stress = 4.0e8

        [[body]]
        name = \"boom\"
        mass = 3.0
        mass_centre = [0.0, 1.0, 0.0]
        inertia = [1.0, 0.01, 1.0]
        material = \"steel\"
        pulse_constant = 0.1
        shape = { box = [0.1, 2.0, 0.2], axes = { turn = { about = \"y\", by_deg = 30.0 } } }

        [body.hinge]
        at = [0.0, 0.5, 0.0]
        axis = \"x\"

        [[body.station]]
        at = 0.0
        mass = 3.0
        mass_centre = [0.0, 1.0, 0.0]
        inertia = [1.0, 0.01, 1.0]
        section = { tube = { radius = 0.05, thickness = 0.002 } }
    ";
    let file = read(text).unwrap_or_else(|error| panic!("{error}"));
    let material = file.structure.as_ref().map(|structure| structure.segments()[0].material);
    assert_eq!(material.and_then(|material| material.ultimate_stress), Some(4.0e8));
    survives(&file);
    let times = text.replace("every = 0.1", "times = [0.5, 1.0]");
    survives(&read(&times).unwrap_or_else(|error| panic!("{error}")));
}
