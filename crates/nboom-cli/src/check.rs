use std::path::PathBuf;

use clap::Args;
use nboom_io::{Format, NEVER, Sampling, SceneFile};
use nboom_model::{Hinge, HingeState, Release, Scene};
use nboom_results::with_causes;
use nboom_sim::{Nobody, Options, simulate};

use crate::ignored::ignored;
use crate::{CliError, Routines, SceneArgs, output, picture, print_scene, print_structure, say};

/// Options of `nboom check`.
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// Also draw the scene, as it starts and with all hinges latched, with names, the axes of all bodies,
    /// the mass centre, kick-off springs, forces and torques from outside, couplings and stations.
    #[arg(long, value_name = "FILE.svg")]
    pub picture: Option<PathBuf>,

    /// Replace the file of the picture if it is there.
    #[arg(long, requires = "picture")]
    pub force: bool,

    /// Say all that code generated for the scene assumes, a line for each; without it only the first two.
    #[cfg(feature = "generator")]
    #[arg(long)]
    pub assumptions: bool,
}

/// What is said of code generated for the scene that assumes more than so many things, unless all is asked for.
#[cfg(feature = "generator")]
const SAID: usize = 2;

/// Reads a scene and returns what it contains for standard output.
pub(crate) fn check(args: &CheckArgs, routines: &Routines) -> Result<String, CliError> {
    let is_svg = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "svg");
    if let Some(path) = args.picture.as_ref().filter(|path| !is_svg(path)) {
        return Err(CliError::NoSvg { path: path.clone() });
    }
    if let Some(path) = &args.picture {
        output::check(path, &args.scene.scene)?;
        output::require_new(path, args.force)?;
    }
    let file = scene(&args.scene)?;
    let scene = &file.scene;
    #[cfg(feature = "generator")]
    let generated = generated_code(scene, args.assumptions);
    #[cfg(not(feature = "generator"))]
    let generated = "";
    let ignored = ignored(&file, None).map_or_else(String::new, |line| line + "\n");
    let (text, stresses) = (print_scene::text(scene), print_structure::text(&file));
    let code = code_at_start(scene, routines);
    if let Some(path) = &args.picture {
        let picture = picture::svg(&file);
        let picture = picture.ok_or_else(|| CliError::NoPicture { path: path.clone() })?;
        output::write(path, &args.scene.scene, &picture)?;
    }
    Ok(format!("{text}{stresses}{ignored}{generated}{code}\n"))
}

/// Reads a scene, checks all that a run would refuse, and prints its warnings. Every command begins
/// with this except `run`, which may be quiet.
pub(crate) fn scene(args: &SceneArgs) -> Result<SceneFile, CliError> {
    let file = args.read()?;
    warnings(&file, &file.scene).iter().for_each(|warning| say("warning", warning));
    Ok(file)
}

/// All warnings, of the file and of its scene as it is run, which may end at another time.
pub fn warnings(file: &SceneFile, scene: &Scene) -> Vec<String> {
    let of_file = file.warnings.iter().map(ToString::to_string);
    let of_scene = scene.warnings();
    let of_scene = of_scene.iter().map(ToString::to_string);
    of_file.chain(of_scene).chain(never_released(file, scene)).collect()
}

/// A warning if output times that are listed come after the end of the run.
pub(crate) fn late_times(sampling: &Sampling, scene: &Scene) -> Option<String> {
    let Sampling::At(times) = sampling else { return None };
    let late = &times[times.partition_point(|time| *time <= scene.end_time)..];
    let (count, all, end, first) = (late.len(), times.len(), scene.end_time, late.first()?);
    Some(format!(
        "output times: {count} of {all} after the end of the run at {end:?} found, from {first:?} on; they are left out"
    ))
}

/// A warning if the scene of a deck lasts longer than the deck says, and beyond release times that mean never; where the
/// deck itself does, its reader says so.
fn never_released(file: &SceneFile, scene: &Scene) -> Option<String> {
    let is_longer = scene.end_time > file.scene.end_time && scene.end_time >= NEVER;
    if file.format != Format::Nml || !is_longer {
        return None;
    }
    let waits = |hinge: &Hinge| {
        hinge.start.state == HingeState::Unreleased && hinge.release == Release::Never
    };
    let i = scene.bodies.iter().position(|body| waits(&body.hinge))?;
    Some(format!(
        "end time {}: hinge {} is never released, since a release time of {NEVER:e} and more in a deck means never",
        scene.end_time,
        scene.label(i)
    ))
}

/// The topology with all hinges free, the assumptions of code generated for the scene, the first or all, and its links if
/// they are counted otherwise than the scene's hinges.
#[cfg(feature = "generator")]
fn generated_code(scene: &Scene, says_all: bool) -> String {
    use nboom_codegen::{Level, Numbers, Request, links};
    let found = Request::of_scene(scene, Numbers::RunTime, Level::Fast);
    let (request, links) = match found.and_then(|request| Ok((request, links(scene)?))) {
        Ok(found) => found,
        Err(error) => return format!("generated code: none, {error}\n"),
    };
    let differ = links.iter().any(|[link, hinge]| link.numbers() != hinge.numbers());
    let links = links.iter().map(|[link, hinge]| format!("{link} is hinge {hinge}"));
    let links = match differ {
        true => format!("links of generated code: {}\n", links.collect::<Vec<_>>().join("; ")),
        false => String::new(),
    };
    let assumed = assumed(&request.assumptions_in_words(), says_all);
    format!("topology: {}\ngenerated code assumes:{assumed}\n{links}", request.topology)
}

/// What stands after the colon: phrases in its line, of many the first; where all are asked for, a line for each.
#[cfg(feature = "generator")]
fn assumed(phrases: &[String], says_all: bool) -> String {
    if says_all && !phrases.is_empty() {
        return phrases.iter().map(|phrase| format!("\n  {phrase}")).collect();
    }
    match phrases.len().saturating_sub(SAID) {
        _ if phrases.is_empty() => " nothing".to_owned(),
        0 => format!(" {}", phrases.join("; ")),
        more => {
            let first = phrases[..SAID].join("; ");
            format!(" {first}; and {more} more, which --assumptions lists")
        }
    }
}

/// The code that a run begins with, and why, found by a run that ends where it starts.
fn code_at_start(scene: &Scene, routines: &Routines) -> String {
    let options = Options { kernels: routines.for_runs, ..Options::default() };
    let instant = scene.ending_at(scene.initial.time);
    let instant = instant.expect("the initial time is not before itself");
    match simulate(&instant, &options, &mut Nobody) {
        Ok(summary) => summary.selections.last().map_or_else(String::new, |code| {
            format!("code at the start: {} {}, {}", code.path, code.formulation, code.reason)
        }),
        Err(failure) => format!("code at the start: none, {}", with_causes(&failure.error)),
    }
}
