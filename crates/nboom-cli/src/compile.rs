use nboom_package::{Build, Built, compile as build};

use crate::{CliError, CompileArgs, check};

/// Builds a simulator around the scene's routines and returns an account.
pub(crate) fn compile(args: &CompileArgs) -> Result<String, CliError> {
    let file = check::scene(&args.scene)?;
    let CompileArgs { formulation, level, offline, .. } = *args;
    let how = Build { formulation, level, work: args.work.clone(), offline };
    let Built { up_to_date, topology, routines, folder } =
        build(&file.scene, file.structure.as_ref(), &how, &args.output)?;
    let (scene, program) = (&file.scene.name, args.output.display());
    if up_to_date {
        return Ok(format!("{scene}: {program} is up to date\n"));
    }
    let sources = folder.display();
    Ok(format!(
        "{scene}: topology {topology}, {routines} routines, built {program}\nsources in {sources}\n"
    ))
}
