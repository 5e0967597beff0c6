//! The scene of a command: a file, or standard input.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use nboom_io::{Format, ReadOptions, SceneFile, read_scene_from, read_scene_with};

use crate::{CliError, choice};

/// Where a scene is read.
#[derive(Args, Clone, Debug)]
pub struct SceneArgs {
    /// A scene, a file NAME.toml, a legacy deck NAME.nml, or a robot NAME.urdf; - for standard input,
    /// of the format that --format says.
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,

    /// What standard input is: toml, a scene, nml, a legacy deck, or urdf, a robot. The scene's name is
    /// then stdin.
    #[arg(long, value_name = "NAME", value_parser = choice::scene_format)]
    pub format: Option<Format>,

    /// A value for a parameter of the scene; may be given for each one.
    #[arg(long, value_name = "NAME=VALUE", value_parser = choice::parameter)]
    pub set: Vec<(String, f64)>,

    /// Let the scene include files outside of its folder.
    #[arg(long)]
    pub include_anywhere: bool,

    /// Fix the main body of a robot to the ground; a scene says so itself.
    #[arg(long)]
    pub fixed_base: bool,
}

/// The argument for standard input.
pub(crate) const STANDARD_INPUT: &str = "-";

/// How the scene of a study is read.
pub(crate) fn read_options(includes_from_anywhere: bool) -> ReadOptions {
    ReadOptions { includes_from_anywhere, ..ReadOptions::default() }
}

impl SceneArgs {
    /// The scene, checked.
    ///
    /// # Errors
    /// When it cannot be read or is wrong, and when only one of `-` and `--format` is there.
    pub(crate) fn read(&self) -> Result<SceneFile, CliError> {
        let options = self.options();
        match (self.scene == Path::new(STANDARD_INPUT), self.format) {
            (false, None) => Ok(read_scene_with(&self.scene, &options)?),
            (true, Some(format)) => {
                Ok(read_scene_from(io::stdin().lock(), format, "stdin", &options)?)
            }
            (true, None) => Err(CliError::NoFormat),
            (false, Some(format)) => {
                Err(CliError::VainFormat { path: self.scene.clone(), format: format.name() })
            }
        }
    }

    /// The scene as a document, if it can be read again; standard input cannot.
    #[cfg(feature = "generator")]
    pub(crate) fn document(&self) -> Option<nboom_io::SceneDocument> {
        let is_file = self.scene != Path::new(STANDARD_INPUT);
        is_file.then(|| nboom_io::SceneDocument::read(&self.scene, &self.options()).ok()).flatten()
    }

    fn options(&self) -> ReadOptions {
        let (set, fixed_base) = (self.set.clone(), self.fixed_base);
        ReadOptions { set, fixed_base, ..read_options(self.include_anywhere) }
    }
}
