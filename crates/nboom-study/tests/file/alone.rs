//! A sweep's directory repeats by itself, whatever its scene includes.

use std::fs;

use nboom_io::ReadOptions;
use nboom_study::Study;

use super::{SCENE, STUDY};

#[test]
fn a_scene_that_includes_files_from_anywhere_stands_alone() {
    let place = tempfile::tempdir().expect("a directory");
    let write = |name: &str, text: &str| {
        let path = place.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
        fs::write(&path, text).expect("writable");
        path
    };
    write("parameters.toml", "[parameters]\nk = 2.0\n");
    let scene = SCENE.replace("[parameters]\nk = 2.0\n", "");
    write("in/scene.toml", &format!("include = [\"../parameters.toml\"]\n{scene}"));
    let masses = "name = \"spin\"\npath = \"main_body.mass\"\nvalues = [100.0, -1.0]";
    let text = STUDY
        .replace("name = \"spin\"\npath = \"main_body.mass\"\nvalues = [100.0, 110.0]", masses);
    let path = write("in/study.toml", &text);
    let refused = Study::read(&path).expect_err("the file lies elsewhere").to_string();
    assert!(refused.contains("--include-anywhere"), "{refused}");
    let anywhere = ReadOptions { includes_from_anywhere: true, ..ReadOptions::default() };
    let study = Study::read_with(&path, &anywhere).expect("right");

    let scene = study.document.text();
    write("out/scene.toml", &scene);
    let again = write("out/study.toml", &study.beside_its_scene());
    let again = Study::read(&again).expect("it stands alone");
    assert_eq!(
        (again.document.text(), again.beside_its_scene()),
        (scene.clone(), study.beside_its_scene())
    );
    let mut rejected = 0;
    for number in 1..=study.cases() {
        let of = |study: &Study| study.scene_of(&study.case(number)).map(|file| file.scene);
        match (of(&study), of(&again)) {
            (Ok(then), Ok(now)) => assert_eq!(then, now),
            (Err(then), Err(now)) => {
                assert_eq!(then, now);
                // The line that it names is that of the number.
                let told = then.to_string();
                let line = told.strip_prefix("scene.toml:").and_then(|told| told.split(':').next());
                let line: usize = line.and_then(|line| line.parse().ok()).expect("a line");
                let text = scene.lines().nth(line - 1).expect("it has that line");
                assert!(text.starts_with("mass = 100"), "{told}: {text}");
                rejected += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(rejected > 0);
}
