//! Directories with the files that figures are made from.

use std::fmt::Write;
use std::fs;

use nboom_plots::{Format, PlotFile, Plots};
use nboom_report::Run;
use tempfile::TempDir;

/// A finished run of a scene of this name, and a table of its motion.
pub fn directory(name: &str, states: &str) -> TempDir {
    let place = tempfile::tempdir().expect("a directory");
    write(
        &place,
        "summary.json",
        &format!("{{\"scene\": {name:?}, \"complete\": true, \"units\": \"SI\"}}"),
    );
    write(&place, "states.csv", states);
    place
}

pub fn write(place: &TempDir, name: &str, text: &str) {
    fs::write(place.path().join(name), text).expect("writable");
}

/// A table of these columns, from functions of time.
pub fn table(
    names: &str,
    times: impl Iterator<Item = f64>,
    row: impl Fn(f64) -> Vec<f64>,
) -> String {
    let mut text = format!("t,{names}\n");
    for time in times {
        let values: Vec<String> = row(time).iter().map(|value| format!("{value:?}")).collect();
        writeln!(text, "{time:?},{}", values.join(",")).expect("a string takes any text");
    }
    text
}

pub fn files(place: &TempDir, format: Format) -> Vec<PlotFile> {
    let run = Run::read(place.path()).expect("a run");
    Plots::of(&run).files(&[format])
}

/// The figure whose name ends so, as SVG.
pub fn svg(place: &TempDir, name: &str) -> String {
    let files = files(place, Format::Svg);
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let file = files.iter().find(|file| file.name.ends_with(name));
    let file = file.unwrap_or_else(|| panic!("no {name} among {names:?}"));
    String::from_utf8(file.bytes.clone()).expect("text")
}
