use std::path::{Path, PathBuf};

use nboom_io::read_scene;
use nboom_model::{HingeState, Release};

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

#[test]
fn all_examples_are_right_and_say_nothing_suspicious() {
    let files = std::fs::read_dir(examples()).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    let scenes: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    assert!(scenes.len() >= 4, "{scenes:?}");
    for path in scenes {
        let file = read_scene(&path).unwrap_or_else(|error| panic!("{error}"));
        assert!(file.warnings.is_empty(), "{:?}", file.warnings);
        assert!(file.scene.warnings().is_empty(), "{:?}", file.scene.warnings());
    }
}

#[test]
fn a_wing_is_there_twice() {
    let scene = read_scene(&examples().join("wing.toml")).expect("an example").scene;
    let names: Vec<_> = (0..6).map(|i| scene.name_of(i).expect("a name")).collect();
    let expected = ["inner panel 1", "middle panel 1", "outer panel 1"];
    assert_eq!(names[..3], expected);
    assert_eq!(names[3..], expected.map(|name| name.replace('1', "2")));
    // Half a turn about z.
    let [one, two] = [0, 3].map(|i| scene.bodies[i].mount.point);
    assert_eq!((two.x, two.y, two.z), (-one.x, -one.y, one.z));
    for (i, body) in scene.bodies.iter().enumerate() {
        assert_eq!(body.hinge.start.state, HingeState::Unreleased);
        assert_eq!(body.inboard, (i % 3 > 0).then(|| i - 1));
        // Each one waits for the panel of its own wing.
        match body.hinge.release {
            Release::Angle { hinge, .. } => assert_eq!(hinge, i - 1),
            release => assert_eq!((i % 3, release), (0, Release::Time(1.0))),
        }
    }
}
