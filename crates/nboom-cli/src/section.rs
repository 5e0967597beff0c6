use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};

use crate::section_file::{Case, OF_FILE, SectionFile, read};
use crate::{CliError, output, say, section_answer};

/// Options of `nboom section`.
#[derive(Args, Debug)]
pub struct SectionArgs {
    /// JSON file of sections.
    #[arg(value_name = "FILE")]
    pub sections: PathBuf,

    /// File for the answer, in JSON, its folder created if needed; by default standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}

/// Computes the sections of a file and returns the answer, or its path, for standard output.
pub(crate) fn section(args: &SectionArgs) -> Result<String, CliError> {
    let file = read(&args.sections)?;
    warnings(&args.sections, &file);
    let SectionFile { cases, .. } = file;
    let count = cases.len();
    let answers: Vec<Value> = cases.into_iter().map(answer).collect();
    let document = json!({ "convention": section_answer::CONVENTION, "cases": answers });
    let text = format!("{document:#}\n");
    let Some(path) = &args.output else { return Ok(text) };
    output::write(path, &args.sections, &text)?;
    let sections = crate::format::count(count, "section", "sections");
    Ok(format!("{sections}, results in {}\n", path.display()))
}

fn warnings(path: &Path, file: &SectionFile) {
    let (path, expected) = (path.display(), OF_FILE.join(" or "));
    for key in &file.ignored {
        let found = format!("key {key} without meaning found, {expected} expected; it is ignored");
        say("warning", &format!("{path}: {found}"));
    }
    for case in &file.cases {
        for warning in case.section.warnings() {
            let id = case.given["id"].as_str().unwrap_or_default();
            say("warning", &format!("{path}: section {id}: {warning}"));
        }
    }
}

/// The section as given, and its results.
fn answer(case: Case) -> Value {
    let found = section_answer::of(&case.section, case.load.as_ref());
    let mut given = case.given;
    given.insert("expect".to_owned(), found);
    Value::Object(given)
}
