use nboom_io::{SceneFile, read_scene};

use crate::{CheckArgs, CliError, print_scene, say};

/// Reads a scene and returns what it contains for standard output.
pub(crate) fn check(args: &CheckArgs) -> Result<String, CliError> {
    let file = read_scene(&args.scene)?;
    warnings(&file).iter().for_each(|warning| say("warning", warning));
    Ok(print_scene::text(&file.scene))
}

/// What reading the file and looking at the scene warn of.
pub(crate) fn warnings(file: &SceneFile) -> Vec<String> {
    let of_file = file.warnings.iter().map(ToString::to_string);
    let of_scene = file.scene.warnings();
    of_file.chain(of_scene.iter().map(ToString::to_string)).collect()
}
