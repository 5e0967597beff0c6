//! `run.json`: all that repeats a run.

use std::env;
use std::path::{Path, PathBuf};

use nboom_io::read_text;
use nboom_results::{Maker, SCENE_FILE};
use serde::{Deserialize, Serialize};

use crate::given::Given;
use crate::{CliError, RunArgs};

/// The longest record that is read \[bytes\].
pub(crate) const LONGEST: u64 = 64 << 20;

/// Why a run cannot be repeated from its record.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// A file is no record of a run.
    #[error("{}: found no record of a run, one that nboom run has written, run.json, expected", path.display())]
    NoRecord {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: serde_json::Error,
    },
    /// The options of a record are not those of this command.
    #[error("{}: options that this version has expected: {found}", path.display())]
    NoArguments {
        /// The record.
        path: PathBuf,
        /// Why they are refused.
        found: String,
    },
    /// An option is for the input of a run, of which there is only the scene that was kept.
    #[error("--{option}: found {} alone, expected the input that was read; {why}", scene.display())]
    InputHasChanged {
        /// The option.
        option: &'static str,
        /// The scene beside the record.
        scene: PathBuf,
        /// Why it is not the input.
        why: String,
    },
    /// Neither the input of a run nor the scene beside its record is as it was.
    #[error(
        "{}: found neither {input} nor {} as they were read, one of them expected", path.display(),
        scene.display()
    )]
    NothingToRepeat {
        /// The record.
        path: PathBuf,
        /// What the run was made from.
        input: String,
        /// The scene as it was read.
        scene: PathBuf,
    },
}

/// What a run was made by and from.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Record {
    /// Words of the command line.
    pub command: Vec<String>,
    pub made_by: Maker,
    pub input: Source,
    /// The scene as it was read, in the directory of the record.
    pub scene: Source,
    pub options: Given,
}

/// A file and its hash.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Source {
    pub path: String,
    /// In hexadecimal digits.
    pub sha256: String,
}

/// This program on this machine.
pub(crate) fn this_maker() -> Maker {
    let generator = cfg!(feature = "generator").then(|| "generator".to_owned());
    Maker { features: Some(generator.into_iter().collect()), ..Maker::current() }
}

impl Record {
    /// The record of a run of an input with this hash, which as a scene is `scene_text`; `times` are the
    /// output times of the command line.
    pub fn of(args: &RunArgs, sha256: String, scene_text: &str, times: Option<&[f64]>) -> Self {
        let input = args.scene.scene.to_string_lossy().into_owned();
        let hash_of_scene = nboom_io::sha256(scene_text.as_bytes());
        let scene = Source { path: SCENE_FILE.to_owned(), sha256: hash_of_scene };
        // A file of times may change.
        let list = |times: &[f64]| times.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let options = args.given.clone();
        Self {
            command: env::args_os().map(|word| word.to_string_lossy().into_owned()).collect(),
            made_by: this_maker(),
            input: Source { path: input, sha256 },
            scene,
            options: match times {
                Some(times) => options.with("times", list(times)),
                None => options,
            },
        }
    }

    /// # Errors
    /// When the file cannot be read or is no record.
    pub fn read(path: &Path) -> Result<Self, CliError> {
        let text = read_text(path, LONGEST)?;
        serde_json::from_str(&text)
            .map_err(|source| RecordError::NoRecord { path: path.to_owned(), source }.into())
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        serde_json::to_string_pretty(self).expect("the keys are texts") + "\n"
    }
}
