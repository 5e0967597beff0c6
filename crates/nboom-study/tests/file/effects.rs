//! What would have no effect is refused.

use nboom_io::InputError;

use super::{SCENE, STUDY, place};
use nboom_study::Study;
use std::fs;

/// Line and message of each error of this study of this scene.
pub(crate) fn errors(scene: &str, study: &str) -> Vec<(usize, String)> {
    let place = place(study);
    fs::write(place.path().join("scene.toml"), scene).expect("writable");
    match Study::read(&place.path().join("study.toml")) {
        Err(InputError::Content(errors)) => {
            errors.iter().map(|error| (error.line, error.to_string())).collect()
        }
        Err(other) => panic!("{other}"),
        Ok(_) => Vec::new(),
    }
}

/// Each change of the study is refused once, at its line, in these words.
pub(crate) fn refused(scene: &str, from: &str, to: &str, line: usize, words: &[&str]) {
    assert!(STUDY.contains(from), "{from}");
    let found = errors(scene, &STUDY.replacen(from, to, 1));
    let [(at, told)] = &found[..] else { panic!("{to}: {found:#?}") };
    assert_eq!(*at, line, "{told}");
    for word in words {
        assert!(told.contains(word), "{to}: {told}");
    }
}

#[test]
fn faults_that_break_nothing_or_one_thing_twice() {
    for (from, to, line, words) in [
        ("stuck = [\"1,2\"]", "stuck = []", 42, ["stuck", "an empty list"]),
        (
            "broken_spring = [\"boom\"]",
            "broken_spring = []",
            45,
            ["broken_spring", "an empty list"],
        ),
        (
            "change = [{ path = \"body.tip.mass\", offset = 0.1 }]",
            "change = []",
            38,
            ["change", "an empty"],
        ),
        (
            "late_release = { hinge = \"boom\", by = 0.5 }",
            "late_release = [{ hinge = \"boom\", by = 0.5 }, { hinge = \"1,1\", by = 0.5 }]",
            37,
            ["`1,1`", "each hinge once"],
        ),
        (
            "failed_latch = [\"boom\"]",
            "failed_latch = [\"boom\", \"1,1\"]",
            44,
            ["`1,1`", "each hinge once"],
        ),
    ] {
        refused(SCENE, from, to, line, &words);
    }
}

#[test]
fn variables_on_which_no_run_depends() {
    let scene = SCENE.replace("k = 2.0", "k = 2.0\nunused = 1.0\ndoubled = \"2 * $unused\"");
    let sampled = scene.replace("[parameters]", "[output]\nevery = 0.1\n\n[parameters]");
    let path = "path = \"main_body.mass\"";
    for (scene, path_now) in [
        (&scene, "path = \"parameters.unused\""),
        (&scene, "path = \"parameters.doubled\""),
        (&scene, "path = \"run.end\""),
        (&sampled, "path = \"output.every\""),
    ] {
        refused(scene, path, path_now, 27, &["without effect", "`spin`"]);
    }
    refused(
        &scene,
        "path = \"body.tip.mass\", offset",
        "path = \"parameters.unused\", offset",
        38,
        &["without effect"],
    );
    refused(
        SCENE,
        "paths = [\"body.tip.mass\", \"body.boom.mass\"]",
        "paths = [\"body.tip.mass\", \"body.boom.mass\", \"body[2].mass\"]\nname = \"body_tip_mass\"",
        22,
        &["each number once"],
    );
    // Without the settings that override them they have an effect.
    let study = STUDY.replace("samples = 10\nend_time = 5.0\n", "");
    for path_now in ["path = \"run.end\"", "path = \"output.every\""] {
        assert_eq!(errors(&sampled, &study.replace(path, path_now)), []);
    }
}
