//! What people are told about robots that are nearly right, whole messages.

use std::fs;
use std::path::{Path, PathBuf};

use nboom_io::parse_robot;

#[test]
fn nearly_right_robots_are_told_what_to_change() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/robot/wrong");
    let files = fs::read_dir(&folder).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    let mut robots: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "urdf")).collect();
    robots.sort();
    assert!(robots.len() >= 8);
    let bless = std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1");
    for path in robots {
        let text = fs::read_to_string(&path).expect("readable");
        let error = parse_robot("arm.urdf", &text, "arm").expect_err("wrong");
        let (told, file) = (format!("{error}\n"), path.with_extension("txt"));
        if bless {
            fs::write(&file, told).expect("writable");
        } else {
            let expected = fs::read_to_string(&file).expect("a message");
            assert_eq!(told, expected, "NBOOM_BLESS=1 writes {}", file.display());
        }
    }
}
