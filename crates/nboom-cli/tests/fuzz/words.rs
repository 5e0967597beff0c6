//! Command lines: what there is to say is taken from the command's own definition.

use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;

use clap::builder::StyledStr;
use clap::{Arg, Command, CommandFactory};
use fastrand::Rng;
use nboom_cli::Cli;
use nboom_sim::{Form, Method};

use super::input::{SCENES, SECTIONS};
use super::place::{FOREIGN, Odd};
use super::text::{self, one_of};

fn owned(words: &[&str]) -> Vec<OsString> {
    words.iter().map(OsString::from).collect()
}

/// The scene of a command line about which nothing is known.
const DECK: &str = SCENES[0];

/// A run of the scene as most are, now and then another command.
pub fn for_scene(rng: &mut Rng, scene: &str) -> Vec<OsString> {
    let run = ["run", scene, "--samples", "8", "--max-events", "300"];
    let formulation = rng.choice(Form::all().collect::<Vec<_>>()).map_or("", Form::name);
    let integrator = one_of(rng, &Method::ALL).name();
    let more: &[&str] = match rng.u32(..27) {
        0..10 => &[],
        10 => &["--listing"],
        11 => &["--certify"],
        12 => &["--path", "generic"],
        13 => &["--path", "generic", "--formulation", formulation],
        14 => &["--integrator", integrator],
        15 => &["--as-1970"],
        16 => &["--rtol", "1e-3", "--atol", "1e-6"],
        17 => &["--end-time", "0.01", "--rtol", "1e-13"],
        18 => return owned(&["check", scene]),
        19 => return owned(&["verify", scene, "--states", "2"]),
        20 => &["--quiet", "--max-step", "0.01"],
        21 => &["--yield-stress", "1e4", "--report-signs"],
        22 => &["--integrator", "rkam"],
        23 => return owned(&["convert", scene, "-o", "other.toml"]),
        24 => return owned(&["convert", scene, "-o", "other.nml"]),
        25 => return owned(&["check", scene, "--picture", "scene.svg"]),
        _ => return owned(&["generate", scene, "-o", "crate"]),
    };
    owned(&[&run[..], more].concat())
}

/// The sections to standard output or to a file.
pub fn for_sections(rng: &mut Rng) -> Vec<OsString> {
    if rng.bool() {
        owned(&["section", SECTIONS])
    } else {
        owned(&["section", SECTIONS, "-o", "answer.json"])
    }
}

/// A command with any options, in any order, with any values.
pub fn changed(rng: &mut Rng) -> Vec<OsString> {
    let mut program = Cli::command();
    program.build();
    let commands: Vec<&Command> = program.get_subcommands().collect();
    let often = ["run", "run", "run", "check", "section", "verify", "generate"];
    let command = match rng.u32(..10) {
        0 => commands[rng.usize(..commands.len())],
        _ => program.find_subcommand(one_of(rng, &often)).expect("known"),
    };
    let mut words = vec![OsString::from(command.get_name())];
    let args: Vec<&Arg> = command.get_arguments().collect();
    for arg in args.iter().filter(|arg| arg.is_positional() || arg.is_required_set()) {
        // Nearly always there is what has to be there.
        if rng.u32(..30) > 0 {
            words.extend(said(rng, arg, command.get_name()));
        }
    }
    for _ in 0..rng.usize(..4) {
        let Some(arg) = rng.choice(&args) else { break };
        // Whole runs at many tolerances take minutes.
        if arg.get_id() != "work_precision" || rng.u32(..20) == 0 {
            words.extend(said(rng, arg, command.get_name()));
        }
    }
    match rng.u32(..20) {
        0 => words.swap_remove(rng.usize(..words.len())).clear(),
        1 => words.insert(rng.usize(..=words.len()), strange(rng)),
        2 => words.push(words[rng.usize(..words.len())].clone()),
        _ => {}
    }
    words
}

/// An argument as it is written, with a value where it takes one.
fn said(rng: &mut Rng, arg: &Arg, command: &str) -> Vec<OsString> {
    let flag = match (arg.get_long(), arg.get_short()) {
        (Some(_), Some(short)) if rng.bool() => Some(format!("-{short}")),
        (Some(long), _) => Some(format!("--{long}")),
        (None, short) => short.map(|short| format!("-{short}")),
    };
    if !arg.get_action().takes_values() {
        return flag.into_iter().map(OsString::from).collect();
    }
    let value = value(rng, arg, command);
    match flag {
        None => vec![value],
        Some(flag) if arg.is_require_equals_set() => {
            let mut word = OsString::from(flag);
            if rng.u32(..3) > 0 {
                word.push("=");
                word.push(value);
            }
            vec![word]
        }
        Some(flag) => vec![flag.into(), value],
    }
}

/// A value of the kind that its name in the help tells.
fn value(rng: &mut Rng, arg: &Arg, command: &str) -> OsString {
    let name =
        arg.get_value_names().and_then(|names| names.first()).map_or("", |name| name.as_str());
    let choices = arg.get_possible_values();
    if let Some(choice) = rng.choice(&choices) {
        return choice.get_name().into();
    }
    if rng.u32(..25) == 0 {
        return strange(rng);
    }
    match name {
        "SCENE" => path_in(rng, DECK),
        "FILE" if command == "section" => path_in(rng, SECTIONS),
        "DIR" | "FILE" | "OUT" | "BINARY" => path_out(rng),
        "NAME" | "LEVEL" | "REFERENCE" | "SLIPS" => word_of(rng, arg.get_help()).into(),
        _ => {
            let mut number = one_of(rng, &["0.5", "1", "3"]).to_owned();
            if rng.bool() {
                text::change_number(rng, &mut number);
            }
            number.into()
        }
    }
}

/// One of the words of a help text, among which are the names that an option takes.
fn word_of(rng: &mut Rng, help: Option<&StyledStr>) -> String {
    let help = help.map(ToString::to_string).unwrap_or_default();
    let words = help.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    rng.choice(words).unwrap_or_default().to_owned()
}

/// Mostly the file itself.
fn path_in(rng: &mut Rng, file: &str) -> OsString {
    if rng.u32(..8) > 0 { file.into() } else { path_out(rng) }
}

/// A place for results: new ones, such as exist, and such as cannot be.
fn path_out(rng: &mut Rng) -> OsString {
    let new =
        ["new", "new/inner", "./new", "new/../other", "Ω", "-", "new folder/ ", "result.json"];
    let there = [DECK, SECTIONS, FOREIGN, "folder", "folder/inner", ".", "..", "", "out"];
    let odd = Odd::ALL.map(Odd::name);
    let inside = format!("{}/x", one_of(rng, &odd));
    let long = "x".repeat(rng.usize(200..5000));
    let names: [&[&str]; 4] = [&new, &there, &odd, &[&inside, &long]];
    let names = one_of(rng, &names);
    OsString::from(one_of(rng, names))
}

/// What nobody writes.
fn strange(rng: &mut Rng) -> OsString {
    let words: [&[u8]; 14] = [
        b"",
        b"-",
        b"--",
        b"---",
        b"-o",
        b"--help",
        b"--version",
        b"-x",
        b"\xff\xfe",
        b"\x1b[2J",
        b"=",
        b"--samples=",
        b"run",
        "\u{202e}Ω".as_bytes(),
    ];
    OsString::from_vec(one_of(rng, &words).to_vec())
}
