//! `-` is standard input, for every command that takes a scene.

use std::fs::File;
use std::io::Write;
use std::process::{Output, Stdio};

use crate::{BOOM, Place, code, stderr, stdout};

/// Runs the program with a text on standard input.
fn fed(place: &Place, text: &str, args: &[&str]) -> Output {
    let mut command = place.command(args);
    // Cargo is not wanted here.
    command.env("CARGO", "false");
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary starts");
    // A program that refuses its arguments reads nothing.
    let _ = child.stdin.take().expect("a pipe").write_all(text.as_bytes());
    child.wait_with_output().expect("it ends")
}

#[test]
fn a_run_of_standard_input_is_that_of_the_file() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["run", "boom.nml"])), 0);
    let output = fed(&place, BOOM, &["run", "-", "--format", "nml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("out/stdin"), "{}", stdout(&output));
    for name in ["states.csv", "events.csv"] {
        let [of_file, of_stream] = ["boom", "stdin"]
            .map(|scene| std::fs::read(place.path("out").join(scene).join(name)).expect("written"));
        assert!(!of_file.is_empty() && of_file == of_stream, "{name}");
    }
    assert_eq!(place.summary("out/stdin")["scene"], "stdin");
}

#[test]
fn every_command_that_takes_a_scene_takes_standard_input() {
    let place = Place::new();
    let all: [(&[&str], i32, &str); 5] = [
        (&["check", "-", "--format", "nml"], 0, "stdin"),
        (&["verify", "-", "--format", "nml", "--states", "2"], 0, "out/stdin/verify.json"),
        (&["bench", "-", "--format", "nml", "--seconds", "1e-6"], 0, "stdin"),
        (&["generate", "-", "--format", "nml", "-o", "crate"], 0, "stdin: topology S1"),
        // The scene is read and its routines are written; what fails is the compiler.
        (&["compile", "-", "--format=nml", "-o", "x", "--work", "work"], 3, "cargo has failed"),
    ];
    for (words, expected, told) in all {
        let output = fed(&place, BOOM, words);
        let said = stdout(&output) + &stderr(&output);
        assert_eq!(code(&output), expected, "{words:?}: {said}");
        assert!(said.contains(told), "{words:?}: {said}");
    }
}

#[test]
fn what_is_wrong_in_standard_input_is_told_by_its_place() {
    let place = Place::new();
    let wrong = BOOM.replace("EMM=", "EMMM=");
    let output = fed(&place, &wrong, &["check", "-", "--format", "nml"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("error: stdin:"), "{}", stderr(&output));
    // A stream that does not end, and one that is no text.
    for (device, word) in [("/dev/zero", "16777216 bytes"), ("/dev/null", "&DIM")] {
        let mut command = place.command(&["run", "-", "--format", "nml"]);
        let output = command.stdin(File::open(device).expect("a unix system")).output();
        let output = output.expect("the binary starts");
        assert_eq!(code(&output), 2, "{device}");
        assert!(stderr(&output).contains(word), "{device}: {}", stderr(&output));
    }
}

#[test]
fn the_base_of_a_robot_can_be_fixed() {
    let place = Place::new();
    let robot = include_str!("../../../../tests/data/robots/ur5.urdf");
    for (fixed, is_fixed) in [(&["--fixed-base"][..], true), (&[], false)] {
        let read = &["-", "--format", "urdf"][..];
        let checked = fed(&place, robot, &[&["check"], read, fixed].concat());
        assert_eq!(stdout(&checked).contains("fixed to the ground"), is_fixed);
        assert_eq!(stderr(&checked).contains("`world` as the root"), !is_fixed);
        let output = fed(&place, robot, &[&["run"], read, fixed, &["-o", "out"]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let again = place.nboom(&["check", "out/scene.toml"]);
        assert_eq!(stdout(&again).contains("fixed to the ground"), is_fixed);
    }
}

#[test]
fn a_format_goes_with_standard_input_alone() {
    let place = Place::new();
    for (words, told) in [
        (&["run", "-"][..], "nml or urdf expected"),
        (&["run", "-", "--format", "toml"], "stdin:2:2: scene: found invalid unquoted key"),
        (&["check", "-", "--format", "urdf"], "stdin:2:2: robot: found text that is no XML"),
        (&["check", "-", "--format", "usd"], "unknown name, toml, nml, urdf expected"),
        (&["run", "boom.nml", "--format", "nml"], "expected - for standard input"),
        (&["check", "-", "--format", "nml", "--fixed-base"], "stdin: --fixed-base found"),
    ] {
        let output = fed(&place, BOOM, words);
        assert_eq!(code(&output), 2, "{words:?}");
        assert!(stderr(&output).contains(told), "{words:?}: {}", stderr(&output));
    }
    assert!(!place.path("out").exists());
}
