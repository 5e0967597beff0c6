use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nboom_io::Format;
use nboom_results::write_file;

use crate::CliError;

/// Options of `nboom new`.
#[derive(Args, Debug)]
pub struct NewArgs {
    /// What the scene is of.
    #[arg(value_name = "KIND", value_enum)]
    pub kind: Kind,

    /// The file to write; by default KIND.toml.
    #[arg(short, long, value_name = "SCENE.toml")]
    pub output: Option<PathBuf>,
}

/// What a scene to start from is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// A spring swings a boom out, and a latch holds it.
    Boom,
    /// A solar wing of three panels unfolds, one panel after the other, on both sides.
    Wing,
    /// An antenna on a gimbal with two axes that cross.
    Gimbal,
    /// The satellite of the 1970 report: two booms in a chain, a paddle, sections and stresses.
    NBoom,
}

impl Kind {
    /// A name for the file, and its text.
    fn template(self) -> (&'static str, &'static str) {
        match self {
            Self::Boom => ("boom", include_str!("../../../examples/boom.toml")),
            Self::Wing => ("wing", include_str!("../../../examples/wing.toml")),
            Self::Gimbal => ("gimbal", include_str!("../../../examples/gimbal.toml")),
            Self::NBoom => ("n-boom", include_str!("../../../examples/n-boom.toml")),
        }
    }
}

/// Writes a scene to start from, and returns the text for standard output.
pub(crate) fn new(args: &NewArgs) -> Result<String, CliError> {
    let (name, text) = args.kind.template();
    let path = args.output.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    if Format::of(&path) != Some(Format::Toml) {
        return Err(CliError::NoToml { path });
    }
    if path.exists() {
        return Err(CliError::Exists { path });
    }
    write_file(&path, text)?;
    let path = path.display();
    Ok(format!("{path}: edit it, then nboom check {path} and nboom run {path}\n"))
}
