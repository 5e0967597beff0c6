use nboom_package::{Choices, Numbers, Written, generate as write, is_current};

use crate::{CliError, GenerateArgs, check};

/// Writes a crate with the scene's routines, or compares one, and returns the text for standard
/// output.
pub(crate) fn generate(args: &GenerateArgs) -> Result<String, CliError> {
    let file = check::scene(&args.scene)?;
    let GenerateArgs { formulation, level, equations, lock_states, .. } = *args;
    let stresses = match (args.stresses, &file.structure) {
        (true, None) => {
            let scene = file.scene.name.clone();
            return Err(CliError::NoStations { option: "--stresses", scene });
        }
        (asked, structure) => structure.as_ref().filter(|_| asked),
    };
    let numbers = if args.baked { Numbers::Baked } else { Numbers::RunTime };
    let choices = Choices { formulation, numbers, level, equations, lock_states, stresses };
    let (scene, directory) = (&file.scene, &args.output);
    let written = if args.check {
        is_current(scene, &choices, directory)?;
        Written::UpToDate
    } else {
        write(scene, &choices, directory)?
    };
    Ok(account(&written, &scene.name, &directory.display().to_string()))
}

fn account(written: &Written, scene: &str, directory: &str) -> String {
    match written {
        Written::UpToDate => format!("{scene}: {directory} is up to date\n"),
        Written::Anew { topology, routines, evaluation, certificate } => {
            let (states, routines) = (certificate.states, routines.join(", "));
            format!(
                "{scene}: topology {topology}, written to {directory}\n\
                 routines    {routines}\n\
                 evaluation  {evaluation}\n\
                 deviation   {:.1e} from the recursion, {:.1e} from double-double, {states} states\n",
                certificate.from_recursion, certificate.from_double_double
            )
        }
    }
}
