use std::path::{Path, PathBuf};

use clap::Args;
use nboom_io::{Format, write_scene};

use crate::{CliError, SceneArgs, check, output, say};

/// Options of `nboom convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The file to write, NAME.toml.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// Writes a scene in another format, and returns the text for standard output.
pub(crate) fn convert(args: &ConvertArgs) -> Result<String, CliError> {
    let ConvertArgs { scene, output } = args;
    if Format::of(output) != Some(Format::Toml) {
        return Err(CliError::NoScene { path: output.clone() });
    }
    let file = check::scene(scene)?;
    if file.legacy.has_integrator_settings() {
        say("note", "left out: settings of the integrator of 1970, which only rkam reads");
    }
    let text = format!("# Made from {}.\n{}", name(&scene.scene), write_scene(&file));
    output::write(output, &scene.scene, &text)?;
    Ok(format!("{}: {}\n", file.scene.name, output.display()))
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.replace(char::is_control, "\u{fffd}")
}
