//! A run that repeats another from its record.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;
use nboom_io::{InputError, SceneFile, read_text, sha256};
use nboom_results::SCENE_FILE;

use crate::given::Given;
use crate::record::{LONGEST, Maker, Record};
use crate::scene_args::STANDARD_INPUT;
use crate::{Cli, CliError, Command, RunArgs, case, say};

/// The ending of a record.
const RECORD: &str = "json";

/// What stands behind the name of the directory that is repeated.
const REPEATED: &str = "-repeated";

/// Options that concern only where a scene is read.
const OF_THE_INPUT: [&str; 5] = ["set", "format", "include-anywhere", "fixed-base", "case"];

/// Whether a run is asked to repeat another.
pub(crate) fn is_record(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(RECORD))
}

/// The arguments and the scene of a run that repeats the one of the record `args.scene`, changed by the
/// options of `args`. Says what is not as it was.
///
/// # Errors
/// When the record is none or has options that this version does not, and when neither the input nor the
/// scene beside the record is what was read.
pub(crate) fn repeated(args: &RunArgs) -> Result<(RunArgs, SceneFile), CliError> {
    let path = &args.scene.scene;
    let record = Record::read(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let say = |what: &str| say("warning", &format!("{}: {what}", path.display()));
    for difference in record.made_by.differences(&Maker::current()) {
        say(&format!("{difference}; results may differ"));
    }
    let input = Path::new(&record.input.path);
    let original = arguments(args, record.options.clone(), input)?;
    let is_there = input != Path::new(STANDARD_INPUT);
    let is_as_it_was = || hash_of(input).as_ref() == Some(&record.input.sha256);
    let found = match is_there.then(|| input_of(original)) {
        // What is given now does not fit what was read then.
        Some(Err(error)) if is_as_it_was() => return Err(error),
        found => found.and_then(Result::ok),
    };
    let (again, file) = match found.filter(|(_, file)| file.sha256 == record.input.sha256) {
        Some(found) => found,
        None => {
            let scene = folder.join(SCENE_FILE);
            if hash_of(&scene).as_ref() != Some(&record.scene.sha256) {
                let (path, input) = (path.clone(), record.input.path);
                return Err(CliError::NothingToRepeat { path, input, scene });
            }
            let (path, hash) = (&record.input.path, &record.input.sha256);
            let how = match (is_there, input.exists()) {
                (false, _) => "standard input is not read again".to_owned(),
                (true, false) => format!("{path} is not there"),
                (true, true) => format!("{path} is not what was read then, SHA-256 {hash}"),
            };
            say(&format!("{how}; this is a run of {}", scene.display()));
            let again = arguments(args, record.options.without(&OF_THE_INPUT), &scene)?;
            let file = again.scene.read()?;
            (again, file)
        }
    };
    let output = args.output.clone().map_or_else(|| beside(folder), Ok)?;
    Ok((RunArgs { output: Some(output), ..again }, file))
}

/// The hash of a text, if it can be read.
fn hash_of(path: &Path) -> Option<String> {
    read_text(path, LONGEST).ok().map(|text| sha256(text.as_bytes()))
}

/// The arguments of a run, and its scene, or that of a case of its study.
fn input_of(args: RunArgs) -> Result<(RunArgs, SceneFile), CliError> {
    match args.case {
        Some(number) => case::case(&args, number),
        None => args.scene.read().map(|file| (args, file)),
    }
}

/// The arguments of a run of `scene` with `options`, changed by those that are given now.
fn arguments(args: &RunArgs, options: Given, scene: &Path) -> Result<RunArgs, CliError> {
    let mut words: Vec<OsString> = vec!["nboom".into(), "run".into()];
    words.extend(options.changed_by(&args.given).words().into_iter().map(OsString::from));
    words.extend(["--".into(), scene.into()]);
    let path = &args.scene.scene;
    let refused = |found: String| CliError::NoArguments { path: path.clone(), found };
    match Cli::try_parse_from(words).map(|cli| cli.command) {
        Ok(Command::Run(args)) => Ok(*args),
        Ok(_) => Err(refused("another command".to_owned())),
        Err(error) => {
            let text = error.to_string();
            let first = text.lines().next().unwrap_or_default();
            Err(refused(first.trim_start_matches("error: ").to_owned()))
        }
    }
}

/// The directory beside that of the run that is repeated.
fn beside(folder: &Path) -> Result<PathBuf, CliError> {
    let unknown = |source| {
        let path = folder.to_owned();
        CliError::Input(InputError::Io { path, source })
    };
    let named = match folder.file_name() {
        Some(_) => folder.to_owned(),
        None => fs::canonicalize(folder).map_err(unknown)?,
    };
    let mut name = named.file_name().unwrap_or_default().to_owned();
    name.push(REPEATED);
    Ok(named.with_file_name(name))
}
