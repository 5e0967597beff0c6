use std::path::{Path, PathBuf};

use clap::Args;
use nboom_io::{Format, SceneFile, write_deck, write_scene};

use crate::{CliError, SceneArgs, check, output, say};

/// Options of `nboom convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The file to write: a scene NAME.toml or a deck NAME.nml.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    /// Replace the file if it is there.
    #[arg(long)]
    pub force: bool,
}

/// Writes a scene in another format, and returns the text for standard output.
pub(crate) fn convert(args: &ConvertArgs) -> Result<String, CliError> {
    let ConvertArgs { scene, output, force } = args;
    let format = Format::of(output).filter(|&format| format != Format::Urdf);
    let format = format.ok_or_else(|| CliError::NoScene { path: output.clone() })?;
    output::check(output, &scene.scene)?;
    output::require_new(output, *force)?;
    let file = check::scene(scene)?;
    let (text, comment) =
        if format == Format::Nml { (as_deck(&file)?, '!') } else { (as_scene(&file), '#') };
    let text = format!("{comment} Made from {}.\n{text}", name(&scene.scene));
    output::write(output, &scene.scene, &text)?;
    Ok(format!("{}: {}\n", file.scene.name, output.display()))
}

fn as_scene(file: &SceneFile) -> String {
    if file.legacy.has_integrator_settings() {
        say("note", "left out: settings of the integrator of 1970, which only rkam reads");
    }
    write_scene(file)
}

fn as_deck(file: &SceneFile) -> Result<String, CliError> {
    let deck = write_deck(file).map_err(CliError::NoDeck)?;
    for what in &deck.left_out {
        say("note", &format!("left out: {what}"));
    }
    Ok(deck.text)
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.replace(char::is_control, "\u{fffd}")
}
