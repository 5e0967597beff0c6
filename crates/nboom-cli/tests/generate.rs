//! `nboom generate` and `nboom compile` as their users meet them: exit codes, messages, files.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

/// A main body with one boom of two segments.
const BOOM: &str = "
 &DIM
 NA=1,IXYZ=0,IAB=0,NP=0,NOPLT=1,IXK=2,
 &END
 &NXPUT
 INSTR=0,
 BETAIK=80.0,-60.0,BSIK=0.0,0.0,
 OMEG=1.0,2.0,-1.0,
 NK=2,DBK=0.0,0.5,0.1,FTSIK=0.0,90.0,0.0,
 ELIK=2*2.0,EMIK=2*3.0,HIIK=1.1,3*0.0,0.05,3*0.0,1.1,1.1,3*0.0,0.05,3*0.0,1.1,
 CNIK(1,2)=1.0,CNIK(2,2)=1.0,
 EMM=100.0,HM=40.0,3*0.0,30.0,3*0.0,35.0,
 &END
 &ROCK
 TF=4.0,SEGSTT=0.0,
 &END
";

fn place() -> TempDir {
    let place = tempfile::tempdir().expect("a directory");
    fs::write(place.path().join("boom.nml"), BOOM).expect("writable");
    place
}

fn command(place: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
    command.current_dir(place).args(args);
    command
}

fn nboom(place: &Path, args: &[&str]) -> Output {
    command(place, args).output().expect("the binary starts")
}

/// It ends with this code and says all these words: on standard output when it is done, on
/// standard error alone when it is not.
fn ends(output: &Output, code: i32, words: &[&str]) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
    let (out, error) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{out}{error}");
    let said = if code == 0 { &out } else { &error };
    words.iter().for_each(|word| assert!(said.contains(word), "no {word:?} in {said:?}"));
    assert!(code == 0 || out.is_empty(), "{out}");
    assert!(!error.contains("panicked"), "{error}");
}

#[test]
fn a_crate_is_written_once_checked_and_not_overwritten() {
    let place = place();
    let place = place.path();
    let generate = ["generate", "boom.nml", "-o", "crate"];
    let check = ["generate", "boom.nml", "-o", "crate", "--check"];
    ends(&nboom(place, &check), 1, &["crate/GENERATED", "is missing"]);
    ends(&nboom(place, &generate), 0, &["topology S2", "SatelliteS2", "deviation"]);
    ends(&nboom(place, &generate), 0, &["crate is up to date"]);
    ends(&nboom(place, &check), 0, &["crate is up to date"]);
    let baked = [&check[..], &["--baked"]].concat();
    ends(&nboom(place, &baked), 1, &["is out of date"]);

    let control = ["generate", "boom.nml", "-o", "control", "--inverse-dynamics"];
    ends(&nboom(place, &control), 0, &["SatelliteS2, SatelliteS2Inverse"]);

    let routines = place.join("crate/src/routines.rs");
    let edited = fs::read_to_string(&routines).expect("readable") + "// mine\n";
    fs::write(&routines, &edited).expect("writable");
    ends(&nboom(place, &generate), 2, &["crate/src/routines.rs", "was changed"]);
    ends(&nboom(place, &check), 1, &["crate/src/routines.rs", "was changed"]);
    assert_eq!(fs::read_to_string(&routines).ok(), Some(edited));
}

/// A boom of one link, and beside it one of two, which the topology S2_S1 counts first; a thruster.
const BOOMS: &str = r#"
[run]
end = 4.0

[main_body]
mass = 100.0
inertia = [40.0, 30.0, 35.0]

[[main_body.thruster]]
force = [0.0, 2.0, 0.0]
point = [0.5, 0.0, 0.0]
from = 1.0
until = 2.0

[[body]]
name = "probe"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]
hinge = { at = [0.0, 0.5, 0.0], axis = "x" }

[[body]]
name = "yoke"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]
hinge = { at = [0.0, -0.5, 0.0], axis = "x" }

[[body]]
name = "panel"
on = "yoke"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]
hinge = { at = [0.0, 2.0, 0.0], axis = "x" }
"#;

#[test]
fn links_of_code_have_the_names_of_the_scene_where_they_are_counted_otherwise() {
    let place = place();
    let place = place.path();
    fs::write(place.join("booms.toml"), BOOMS).expect("writable");
    let links = "links of generated code: 1,1 is hinge 2,1 (yoke); 1,2 is hinge 2,2 (panel); 2,1 is hinge 1,1 (probe)\n";
    ends(&nboom(place, &["check", "booms.toml"]), 0, &["topology: S2_S1\n", links]);
    let same = nboom(place, &["check", "boom.nml"]);
    ends(&same, 0, &["topology: S2\n"]);
    assert!(!String::from_utf8_lossy(&same.stdout).contains("links of generated code"));
}

#[test]
fn a_right_side_says_which_thrusters_it_has_and_which_it_has_no_place_for() {
    let place = place();
    let place = place.path();
    fs::write(place.join("booms.toml"), BOOMS).expect("writable");
    let inertial = BOOMS.replace("until = 2.0", "until = 2.0\naxes = \"inertial\"");
    fs::write(place.join("inertial.toml"), inertial).expect("writable");
    let of = |scene: &str| nboom(place, &["generate", scene, "-o", "crate", "--right-side"]);
    let refused = "thrust on the main body from 1.0 to 2.0: ";
    let at = BOOMS.lines().position(|line| line == "[[main_body.thruster]]").expect("it has one");
    let line = format!("error: inertial.toml:{}: scene ", at + 1);
    ends(&of("inertial.toml"), 2, &[&line, refused, "for which a right side has no place"]);
    let inertial = BOOMS.replace("until = 2.0", "axes = \"inertial\"");
    fs::write(place.join("inertial.toml"), inertial).expect("writable");
    ends(&of("inertial.toml"), 2, &["thrust on the main body from 1.0 on: "]);
    let rough = BOOMS.replacen("axis = \"x\" }", "axis = \"x\", friction = 0.1 }", 1);
    let line = rough.lines().position(|line| line.contains("friction")).expect("it has some");
    fs::write(place.join("rough.toml"), rough).expect("writable");
    let line = format!("error: rough.toml:{}: scene ", line + 1);
    ends(&of("rough.toml"), 2, &[&line, "friction of hinge "]);
    let thrust = "right side  thrust: (0, 2, 0) at (0.5, 0, 0), on from 1 to 2\n";
    ends(&of("booms.toml"), 0, &["SatelliteS2S1RightSide", thrust]);
    ends(
        &nboom(place, &["generate", "boom.nml", "-o", "bare", "--right-side"]),
        0,
        &["right side  no thruster\n"],
    );
}

#[test]
fn what_cannot_be_generated_is_said() {
    let place = place();
    let place = place.path();
    let with = |options: &[&str]| {
        nboom(place, &[&["generate", "boom.nml", "-o", "crate"], options].concat())
    };
    ends(&with(&["--formulation", "kane"]), 2, &["symmetric, articulated, momentum expected"]);
    ends(&with(&["--level", "best"]), 2, &["exact, fast expected"]);
    ends(
        &with(&["--stresses"]),
        2,
        &["--stresses", "no stations, which in a deck are stress groups"],
    );
    ends(&nboom(place, &["generate", "none.nml", "-o", "crate"]), 2, &["none.nml"]);
    assert!(!place.join("crate").exists());
    fs::write(place.join("file"), "").expect("writable");
    ends(&nboom(place, &["generate", "boom.nml", "-o", "file"]), 2, &["file"]);
    ends(&nboom(place, &["generate", "boom.nml", "-o", "file/crate"]), 2, &["file"]);
    fs::create_dir_all(place.join("crate/src/routines.rs")).expect("writable");
    ends(&with(&[]), 2, &["routines.rs"]);
}

#[test]
fn a_compiler_that_is_not_there_or_fails_is_said() {
    let place = place();
    let place = place.path();
    let compile = ["compile", "boom.nml", "-o", "boom", "--work", "work"];
    let without = command(place, &compile).env("CARGO", "no-such-cargo").output();
    ends(&without.expect("it starts"), 3, &["cannot start no-such-cargo"]);
    let failing = command(place, &compile).env("CARGO", "false").output();
    ends(&failing.expect("it starts"), 3, &["cargo has failed in", "work/nboom-simulator-"]);
    let nowhere =
        command(place, &compile[..4]).env_remove("HOME").env_remove("XDG_CACHE_HOME").output();
    ends(&nowhere.expect("it starts"), 2, &["XDG_CACHE_HOME", "HOME", "--work"]);
    assert!(!place.join("boom").exists());
    fs::write(place.join("file"), "").expect("writable");
    let in_file = ["compile", "boom.nml", "-o", "boom", "--work", "file"];
    ends(&nboom(place, &in_file), 2, &["file"]);
}

/// In place of cargo: says that two crates are done, the second one the program, long after the first.
const SLOW_CARGO: &str = r#"#!/bin/sh
echo '{"reason":"compiler-artifact","target":{"name":"first-crate"},"executable":null}'
sleep 1
printf 'program' > program
echo '{"reason":"compiler-artifact","target":{"name":"last"},"executable":"'$PWD'/program"}'
"#;

#[cfg(unix)]
#[test]
fn a_build_says_how_far_it_is_and_how_long_it_took() {
    use std::os::unix::fs::PermissionsExt;
    let place = place();
    let place = place.path();
    let cargo = place.join("cargo");
    fs::write(&cargo, SLOW_CARGO).expect("writable");
    fs::set_permissions(&cargo, PermissionsExt::from_mode(0o755)).expect("it is ours");
    let compile = ["compile", "boom.nml", "-o", "boom", "--work", "work"];
    let built = command(place, &compile).env("CARGO", &cargo).output().expect("it starts");
    let out = String::from_utf8(built.stdout.clone()).expect("text");
    ends(&built, 0, &["topology S2", "built boom in "]);
    let seconds = out.split("built boom in ").nth(1).and_then(|rest| rest.split(' ').next());
    let seconds: f64 = seconds.and_then(|text| text.parse().ok()).expect("seconds");
    assert!(seconds >= 1.0, "cargo took a second, {seconds} s are told");
    let steps = String::from_utf8(built.stderr).expect("text");
    let at = |words: &str| steps.find(words).unwrap_or_else(|| panic!("no {words:?} in {steps}"));
    assert!(at("compile: writing ") < at("compile: building with cargo"), "{steps}");
}

#[test]
fn a_program_is_not_put_over_what_is_no_simulator() {
    let place = place();
    let place = place.path();
    let files = [("notes", &b"mine"[..]), ("program", b"\x7fELF\xff\0 of somebody else's")];
    files.iter().for_each(|(name, bytes)| fs::write(place.join(name), bytes).expect("writable"));
    fs::create_dir(place.join("directory")).expect("writable");
    let compile = |output: &str| {
        let mut command = command(place, &["compile", "boom.nml", "--work", "work", "-o", output]);
        // It is refused before cargo is called.
        command.env("CARGO", "no-such-cargo").output().expect("it starts")
    };
    for output in ["boom.nml", "notes", "program"] {
        ends(&compile(output), 2, &[output, "was not written by this command"]);
    }
    for output in ["directory", "new/", ".", "notes/program"] {
        ends(&compile(output), 2, &["cannot write", output]);
    }
    // Nobody can make files in these, not even root.
    #[cfg(target_os = "linux")]
    for output in ["/proc/program", "/proc/new/program"] {
        ends(&compile(output), 3, &["cannot write", output]);
    }
    ends(&compile(env!("CARGO_BIN_EXE_nboom")), 2, &["was not written by this command"]);
    for (name, bytes) in files {
        assert_eq!(fs::read(place.join(name)).ok().as_deref(), Some(bytes));
    }
    assert_eq!(fs::read_to_string(place.join("boom.nml")).ok().as_deref(), Some(BOOM));
    assert!(!place.join("work").exists());
}

#[test]
fn routines_in_the_working_folder_are_those_of_the_scene_whatever_became_of_them() {
    let place = place();
    let place = place.path();
    // What is compiled is written before cargo is called.
    let write = || {
        let compile = ["compile", "boom.nml", "-o", "boom", "--work", "work"];
        let output = command(place, &compile).env("CARGO", "false").output();
        ends(&output.expect("it starts"), 3, &["cargo has failed in"]);
    };
    write();
    let folders = fs::read_dir(place.join("work")).expect("it was made");
    let mut files = folders.map(|entry| entry.expect("readable").path().join("src/routines.rs"));
    let path = files.find(|path| path.exists()).expect("one folder is the simulator's");
    let ours = fs::read_to_string(&path).expect("readable");
    let edited = ours.replacen(" + ", " - ", 1);
    let of_others = "pub fn kernels() {}\n".to_owned();
    let cut_short = ours[..ours.len() / 2].to_owned();
    let stale = ours.replacen("Request ", "Request 0", 1);
    for other in [edited, of_others, cut_short, stale, String::new()] {
        assert_ne!(other, ours);
        fs::write(&path, &other).expect("writable");
        write();
        assert!(fs::read_to_string(&path).ok().as_ref() == Some(&ours), "{other:.200}");
    }
    fs::write(&path, [0xff, 0xfe]).expect("writable");
    write();
    assert!(fs::read_to_string(&path).ok() == Some(ours), "what is no text is kept");
}
