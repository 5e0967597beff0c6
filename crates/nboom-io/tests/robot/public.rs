//! Robots of other people, whose files are read as they are.

use std::fs;
use std::path::Path;

use nboom_io::parse_robot;
use nboom_model::Base;

#[test]
fn public_robots_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/robots");
    let files = fs::read_dir(folder).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    let robots: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|of| of == "urdf")).collect();
    assert!(robots.len() >= 8);
    for path in robots {
        let text = fs::read_to_string(&path).expect("readable");
        let read = parse_robot("robot.urdf", &text, "robot", Base::Free);
        assert!(read.is_ok(), "{}: {}", path.display(), read.unwrap_err());
    }
}
