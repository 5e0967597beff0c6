//! Scenes in TOML: what they mean, how they are written, what is said of wrong ones.

#[path = "../support/mod.rs"]
mod support;

mod decks;
mod document;
mod examples;
mod externals;
mod idle;
mod messages;
mod outputs;
mod rigs;
mod robustness;
mod rules;
mod shapes;
mod stops;
mod values;
mod words;
mod written;
mod wrong;
mod wrong_words;

use nboom_io::{InputError, ReadOptions, SceneFile, parse_scene};

/// A main body and a run.
pub const BUS: &str = "
[run]
end = 10.0

[main_body]
mass = 100.0
inertia = [40.0, 30.0, 20.0]
";

/// A body with this hinge.
pub fn body(name: &str, more: &str, hinge: &str) -> String {
    format!(
        "\n[[body]]\nname = \"{name}\"\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\n\
         inertia = [1.0, 0.1, 1.0]\n{more}\n\n[body.hinge]\nat = [0.0, 2.0, 0.0]\naxis = \"x\"\n{hinge}\n"
    )
}

/// Reads a scene that is no file.
pub fn read(text: &str) -> Result<SceneFile, InputError> {
    parse_scene("a.toml", text, "a", None, &ReadOptions::default())
}

/// The scene of a right text.
pub fn right(text: &str) -> SceneFile {
    read(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Each error of a wrong text, in one line.
pub fn wrong(text: &str) -> Vec<String> {
    match read(text) {
        Err(InputError::Content(errors)) => errors.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}\n{text}"),
    }
}
