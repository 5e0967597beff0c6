use std::path::PathBuf;

use clap::Args;
use nboom_codegen::CodegenError;
use nboom_formulation::{Formulation, NoPlace};
use nboom_io::ScenePart;
use nboom_model::Scene;
use nboom_package::{
    Choices, Level, Numbers, PackageError, Written, generate as write, is_current,
};
use nboom_strength::Idle;

use crate::{CliError, SceneArgs, check, choice, print_scene};

/// Options of `nboom generate`.
#[derive(Args, Debug)]
pub struct GenerateArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// Directory of the crate, created if needed.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,

    /// Take the satellite's numbers from the scene; without it they are handed in, and only zeros
    /// of the scene are assumed.
    #[arg(long)]
    pub baked: bool,

    /// Form of the equations of motion: report, relative, symmetric, articulated or momentum.
    #[arg(long, value_name = "NAME", default_value = "articulated",
          value_parser = choice::closed_form)]
    pub formulation: Formulation,

    /// How freely arithmetic may be rearranged: exact takes operations one by one as the closed
    /// form does, fast fuses products and sums.
    #[arg(long, value_name = "LEVEL", default_value = "fast", value_parser = choice::level)]
    pub level: Level,

    /// Also generate the matrix and right side that the formulation solves; those of symmetric if it
    /// solves none.
    #[arg(long)]
    pub equations: bool,

    /// Also generate inverse dynamics: hinge torques, and the wrench on the main body, for given accelerations.
    #[arg(long)]
    pub inverse_dynamics: bool,

    /// Also generate the right side of the scene's differential equations, all hinges free: springs, dampers, kick-off
    /// springs, torque tables, couplings along a branch, rotors of the main body at constant speed, its thrusters.
    #[arg(long)]
    pub right_side: bool,

    /// Routines take a wrench on the main body also where nothing acts on it from outside.
    #[arg(long)]
    pub external_wrench: bool,

    /// Also generate states with held hinges: all topologies with up to 10 hinges; with more, those
    /// in which all appendages are held in step; at most 32.
    #[arg(long)]
    pub lock_states: bool,

    /// Also generate the loads and stresses of all stations, with all numbers of the scene built in.
    #[arg(long)]
    pub stresses: bool,

    /// Write nothing; exit with 1 if the crate differs from what would be written.
    #[arg(long)]
    pub check: bool,
}

/// Writes a crate with the scene's routines, or compares one, and returns the text for standard
/// output.
pub(crate) fn generate(args: &GenerateArgs) -> Result<String, CliError> {
    let file = check::scene(&args.scene)?;
    let GenerateArgs { formulation, level, equations, inverse_dynamics, .. } = *args;
    let GenerateArgs { right_side, external_wrench, lock_states, .. } = *args;
    let stresses = match (args.stresses, &file.structure) {
        (true, None) => return Err(CliError::idle("--stresses", Idle::NoStations)),
        (asked, structure) => structure.as_ref().filter(|_| asked),
    };
    let numbers = if args.baked { Numbers::Baked } else { Numbers::RunTime };
    let choices = Choices {
        formulation,
        numbers,
        level,
        equations,
        inverse_dynamics,
        right_side,
        external_wrench,
        lock_states,
        stresses,
    };
    let (scene, directory) = (&file.scene, &args.output);
    let written = if args.check {
        is_current(scene, &choices, directory).map(|()| Written::UpToDate)
    } else {
        write(scene, &choices, directory)
    };
    let written = written.map_err(|error| with_line(&args.scene, scene, error))?;
    let account = account(&written, &scene.name, &directory.display().to_string());
    let is_anew = matches!(written, Written::Anew { .. });
    let of_right_side = if is_anew && right_side { thrusts(scene) } else { String::new() };
    Ok(account + &of_right_side)
}

/// Adds the line of the scene that an error is about, where a file has it.
fn with_line(args: &SceneArgs, scene: &Scene, error: PackageError) -> CliError {
    let PackageError::Codegen(CodegenError::NoPlace { what, .. }) = error else {
        return error.into();
    };
    let part = match what {
        NoPlace::Coupling { hinges: [hinge, _] } => ScenePart::Couplings(hinge),
        NoPlace::Rotor { rotor } => ScenePart::Rotor(rotor),
        NoPlace::External { external } => ScenePart::External(external),
        NoPlace::Lines { hinge } | NoPlace::Withheld { hinge } => ScenePart::KickOff(hinge),
        NoPlace::Friction { hinge } => ScenePart::Friction(hinge),
    };
    let document = args.document();
    match document.as_ref().and_then(|document| document.line_of(scene, part)) {
        Some((file, line)) => CliError::PackageOfLine { file: file.to_owned(), line, error },
        None => error.into(),
    }
}

/// What acts from outside in the right side of a scene: all of the scene where one is made, but on a main body that is held.
fn thrusts(scene: &Scene) -> String {
    let acting = scene.externals.iter().map(|external| print_scene::outside(scene, external));
    let acting: Vec<String> = acting.collect();
    let acting = match acting.is_empty() {
        true => "no thruster".to_owned(),
        false if scene.base.is_held() => {
            format!("without {}: the main body is held", acting.join("; "))
        }
        false => acting.join("; "),
    };
    format!("right side  {acting}\n")
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
