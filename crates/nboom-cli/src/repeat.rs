//! A run that repeats another from its record.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;
use nboom_io::{Format, InputError, SceneFile, read_text, sha256};
use nboom_results::SCENE_FILE;

use crate::given::Given;
use crate::record::{LONGEST, Record, RecordError, Source, this_maker};
use crate::scene_args::STANDARD_INPUT;
use crate::{Cli, CliError, Command, RunArgs, case, say};

/// The ending of a record.
const RECORD: &str = "json";

/// What stands behind the name of the directory that is repeated.
const REPEATED: &str = "-repeated";

/// Options that concern only where a scene is read.
const OF_THE_INPUT: [&str; 5] = ["set", "format", "include-anywhere", "fixed-base", "case"];

/// Options of the input that the scene beside a record has no place for.
const NOT_OF_THE_KEPT: [&str; 2] = ["set", "case"];

/// Whether a run is asked to repeat another.
pub(crate) fn is_record(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(RECORD))
}

/// The arguments and the scene of a run that repeats the one of the record `args.scene`, changed by the
/// options of `args`. Says what is not as it was.
///
/// # Errors
/// When the record is none or has options that this version does not, when what is given now does not fit, and when
/// neither the input nor the scene beside the record is what was read.
pub(crate) fn repeated(args: &RunArgs) -> Result<(RunArgs, SceneFile), CliError> {
    let path = &args.scene.scene;
    let record = Record::read(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let say = |what: &str| say("warning", &format!("{}: {what}", path.display()));
    for difference in record.made_by.differences(&this_maker()) {
        say(&format!("{difference}; results may differ"));
    }
    let input = Path::new(&record.input.path);
    let is_there = input != Path::new(STANDARD_INPUT);
    let as_recorded = arguments(path, record.options.clone(), input)?;
    let is_case = as_recorded.case.is_some();
    let read = is_there.then(|| input_of(as_recorded).ok()).flatten();
    let is_as_it_was = read.is_some_and(|(_, file)| file.sha256 == record.input.sha256);
    let (again, file) = if is_as_it_was {
        input_of(arguments(path, record.options.changed_by(&args.given), input)?)?
    } else {
        let scene = folder.join(SCENE_FILE);
        if hash_of(&scene).as_ref() != Some(&record.scene.sha256) {
            let (path, input) = (path.clone(), record.input.path);
            return Err(RecordError::NothingToRepeat { path, input, scene }.into());
        }
        let why = what_changed(&record.input, is_case);
        if let Some(option) = args.given.first_by_hand(&NOT_OF_THE_KEPT) {
            return Err(RecordError::InputHasChanged { option, scene, why }.into());
        }
        say(&format!("{why}; this is a run of {}", scene.display()));
        let options = record.options.without(&OF_THE_INPUT).changed_by(&args.given);
        let again = arguments(path, options, &scene)?;
        let file = again.scene.read()?;
        (again, file)
    };
    let output = args.output.clone().map_or_else(|| beside(folder), Ok)?;
    Ok((RunArgs { output: Some(output), ..again }, file))
}

/// The hash of a text, if it can be read.
fn hash_of(path: &Path) -> Option<String> {
    read_text(path, LONGEST).ok().map(|text| sha256(text.as_bytes()))
}

/// Why the input of a run, maybe of a case of a study, is not what was read then.
fn what_changed(Source { path, sha256 }: &Source, is_case: bool) -> String {
    let input = Path::new(path);
    let with_others = match Format::of(input) {
        _ if input == Path::new(STANDARD_INPUT) => {
            return "standard input is not read again".to_owned();
        }
        _ if !input.exists() => return format!("{path} is not there"),
        _ if is_case => format!("the study {path} or its scene"),
        Some(Format::Toml) => format!("{path} or what it includes"),
        _ => path.clone(),
    };
    format!("{with_others} is not what was read then, SHA-256 {sha256}")
}

/// The arguments of a run, and its scene, or that of a case of its study.
fn input_of(args: RunArgs) -> Result<(RunArgs, SceneFile), CliError> {
    match args.case {
        Some(number) => case::case(&args, number),
        None => args.scene.read().map(|file| (args, file)),
    }
}

/// The arguments of a run of `scene` with the options of the record at `path`, or with others.
fn arguments(path: &Path, options: Given, scene: &Path) -> Result<RunArgs, CliError> {
    let mut words: Vec<OsString> = vec!["nboom".into(), "run".into()];
    words.extend(options.words().into_iter().map(OsString::from));
    words.extend(["--".into(), scene.into()]);
    let refused =
        |found: String| CliError::from(RecordError::NoArguments { path: path.to_owned(), found });
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
