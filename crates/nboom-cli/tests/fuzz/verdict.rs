//! Whether the program has ended as the contract says.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;

use super::input::{Input, SECTIONS};
use super::place::{Ended, FOREIGN, NOTES, Place};

/// A run ends within so long when it is interrupted.
const END_WITHIN: Duration = Duration::from_secs(1);

/// Tells whether a run is complete.
const SUMMARY: &str = "summary.json";

/// The number of the signal.
const INTERRUPT: i32 = 2;

/// Everything that is not as it should be.
pub fn of(input: &Input, place: &Place, ended: &Ended) -> Vec<String> {
    let mut complaints = Vec::new();
    let command = input.words.first().map(|word| word.to_string_lossy()).unwrap_or_default();
    let files = files(&place.around());
    let has_summary = files.iter().any(|path| path.ends_with(SUMMARY));
    match (ended.code(), ended.after_interrupt) {
        (Some(0..=3), _) => {}
        // Without results there is nothing to mark: the signal may do what it does to any program.
        (None, Some(_)) if !has_summary && ended.signal() == Some(INTERRUPT) => return complaints,
        _ => complaints.push(format!("ended by {:?}", ended.status)),
    }
    if ended.code() == Some(1) && !["verify", "generate"].contains(&&*command) {
        complaints.push("exit code 1, and nothing was compared".to_owned());
    }
    complaints.extend(of_messages(ended));
    complaints.extend(inputs_kept(input, place));
    if ended.code() == Some(0) {
        let named =
            |path: &&PathBuf| !path.ends_with(input.scene_name) && !path.ends_with(SECTIONS);
        complaints.extend(files.iter().filter(named).filter_map(|path| of_file(path)));
        // JSON has no such numbers, but names of sections may be like them.
        let is_json = serde_json::from_str::<Value>(&ended.out).is_ok();
        let of_printout = not_finite(&ended.out).filter(|_| !is_json);
        complaints.extend(of_printout.map(|word| format!("{word} in the printout")));
    }
    if command == "run" {
        complaints.extend(of_marks(ended, &files));
    }
    complaints
}

/// A run that had to be interrupted ends soon.
pub fn on_time(ended: &Ended) -> Option<String> {
    let late = ended.after_interrupt.filter(|&time| time > END_WITHIN)?;
    Some(format!("interrupted, it ended after {late:?}"))
}

fn of_messages(ended: &Ended) -> Vec<String> {
    let mut complaints = Vec::new();
    if ended.error.contains("panicked") {
        let line = ended.error.lines().find(|line| line.contains("panicked")).unwrap_or_default();
        complaints.push(line.to_owned());
    }
    for (name, text) in [("standard output", &ended.out), ("standard error", &ended.error)] {
        if text.chars().any(|c| c.is_control() && c != '\n') {
            complaints.push(format!("control characters on {name}"));
        }
    }
    if !matches!(ended.code(), Some(0)) && ended.error.is_empty() {
        complaints.push("no word on standard error".to_owned());
    }
    complaints
}

/// Neither the command's input is lost nor what lies in a folder of results. Any other file may be named
/// as the one to write.
fn inputs_kept(input: &Input, place: &Place) -> Vec<String> {
    let folder = place.folder();
    let read = match input.words.first().is_some_and(|word| word == "section") {
        true => (SECTIONS.to_owned(), &input.sections[..]),
        false => (input.scene_name.to_owned(), &input.scene[..]),
    };
    let held = [read, (format!("folder/{FOREIGN}"), NOTES.as_bytes())];
    let lost = |(name, bytes): &(String, &[u8])| {
        fs::read(folder.join(name)).ok().as_deref() != Some(*bytes)
    };
    held.iter()
        .filter(|held| lost(held))
        .map(|(name, _)| format!("{name} was overwritten"))
        .collect()
}

/// All files below a folder; links are not followed.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let kind = entry.file_type().expect("known");
        if kind.is_dir() {
            found.extend(files(&entry.path()));
        } else if kind.is_file() {
            found.push(entry.path());
        }
    }
    found
}

/// A number that is none in a file of results.
fn of_file(path: &Path) -> Option<String> {
    let ending = path.extension()?.to_str()?;
    if !["csv", "json", "txt", "svg"].contains(&ending) {
        return None;
    }
    let text = String::from_utf8_lossy(&fs::read(path).ok()?).into_owned();
    let name = path.file_name()?.to_string_lossy().into_owned();
    if text.contains('\0') {
        return Some(format!("a zero byte in {name}"));
    }
    match ending {
        "json" => {
            let error = serde_json::from_str::<Value>(&text).err()?;
            Some(format!("{name} is no JSON: {error}"))
        }
        _ => not_finite(&text).next().map(|word| format!("{word} in {name}")),
    }
}

/// Words that are numbers, but not finite ones.
fn not_finite(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"' | '(' | ')'));
    let is_no_number = |word: &&str| {
        let is_named = word.trim_start_matches(['-', '+']).starts_with(['i', 'I', 'n', 'N']);
        is_named && word.parse::<f64>().is_ok_and(|number| !number.is_finite())
    };
    words.filter(is_no_number)
}

/// Whether what a run has left says how far to trust it.
fn of_marks(ended: &Ended, files: &[PathBuf]) -> Option<String> {
    let summaries = files.iter().filter(|path| path.ends_with(SUMMARY));
    let complete: Vec<Option<bool>> = summaries
        .map(|path| {
            let summary: Value = serde_json::from_slice(&fs::read(path).ok()?).ok()?;
            summary["complete"].as_bool()
        })
        .collect();
    let has_help = ["--help", "-h", "--version"].iter().any(|word| ended.out.contains(word));
    match ended.code() {
        Some(0) if !has_help && complete != [Some(true)] => {
            Some(format!("done, with {complete:?} for complete"))
        }
        Some(2) if !complete.is_empty() => Some("refused, with results on disk".to_owned()),
        // A certificate is made after the run.
        Some(3) if ended.error.contains("the run itself is complete") => None,
        Some(3) if complete.iter().any(|complete| *complete != Some(false)) => {
            Some(format!("failed, with {complete:?} for complete"))
        }
        None if complete.iter().any(|complete| *complete != Some(false)) => {
            Some(format!("broken off, with {complete:?} for complete"))
        }
        _ => None,
    }
}
