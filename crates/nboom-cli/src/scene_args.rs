//! The scene of a command: a file, or standard input.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use nboom_io::{SceneFile, read_scene, read_scene_from};

use crate::{CliError, choice};

/// Where a scene is read.
#[derive(Args, Clone, Debug)]
pub struct SceneArgs {
    /// Legacy deck, a file NAME.nml; - for standard input, of the format that --format says.
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,

    /// What standard input is: nml, a legacy deck. The scene's name is then stdin.
    #[arg(long, value_name = "NAME", value_parser = choice::scene_format)]
    pub format: Option<SceneFormat>,
}

/// What a scene is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneFormat {
    /// A legacy deck.
    Nml,
}

impl SceneFormat {
    /// Every format.
    pub const ALL: [Self; 1] = [Self::Nml];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nml => "nml",
        }
    }
}

/// The argument for standard input.
const STANDARD_INPUT: &str = "-";

impl SceneArgs {
    /// The scene, checked.
    ///
    /// # Errors
    /// When it cannot be read or is wrong, and when only one of `-` and `--format` is there.
    pub(crate) fn read(&self) -> Result<SceneFile, CliError> {
        match (self.scene == Path::new(STANDARD_INPUT), self.format) {
            (false, None) => Ok(read_scene(&self.scene)?),
            (true, Some(SceneFormat::Nml)) => Ok(read_scene_from(io::stdin().lock(), "stdin")?),
            (true, None) => Err(CliError::NoFormat),
            (false, Some(format)) => {
                Err(CliError::VainFormat { path: self.scene.clone(), format: format.name() })
            }
        }
    }
}
