use std::path::PathBuf;
use std::time::Instant;

use nboom_io::read_scene;
use nboom_model::Scene;
use nboom_results::{Outcome, RunDescription, RunDirectory, with_causes};
use nboom_sim::{Form, Options, Path, simulate};

use crate::progress::Progress;
use crate::watch::Watch;
use crate::{CliError, PathChoice, Routines, RunArgs, check, print_run, say};

/// Simulates a scene, writes its files and returns the account of it for standard output.
pub(crate) fn run(args: &RunArgs, routines: &Routines) -> Result<String, CliError> {
    let file = read_scene(&args.scene)?;
    let warnings = check::warnings(&file);
    let scene = with_end_time(file.scene, args.end_time)?;
    if !args.quiet {
        warnings.iter().for_each(|warning| say("warning", warning));
    }
    let options = options(args, routines)?;
    let run = RunDescription {
        integrator: args.integrator,
        warnings,
        ..RunDescription::new(&scene, &options, args.units)
    };
    let account = simulate_into_files(&scene, &options, run, args)?;
    Ok(if args.quiet { String::new() } else { account })
}

fn with_end_time(scene: Scene, end_time: Option<f64>) -> Result<Scene, CliError> {
    match end_time {
        Some(end_time) => scene.ending_at(end_time).map_err(CliError::EndTime),
        None => Ok(scene),
    }
}

fn options(args: &RunArgs, routines: &Routines) -> Result<Options, CliError> {
    let RunArgs { samples, rtol, atol, formulation, .. } = *args;
    let path = match args.path {
        PathChoice::Generated if formulation == Some(Form::Recursive) => {
            return Err(CliError::GeneratedRecursion);
        }
        PathChoice::Auto => Path::Auto,
        PathChoice::Generated => Path::Generated,
        PathChoice::Generic => Path::Generic,
    };
    let kernels = routines.accelerations;
    Ok(Options { samples, rtol, atol, path, formulation, kernels, ..Options::default() })
}

fn simulate_into_files(
    scene: &Scene,
    options: &Options,
    run: RunDescription,
    args: &RunArgs,
) -> Result<String, CliError> {
    let directory = args.output.clone().unwrap_or_else(|| default_directory(&scene.name));
    let started = Instant::now();
    let mut watch = Watch {
        files: RunDirectory::create(&directory, scene, run.clone(), args.listing)?,
        progress: Progress::of(scene, args.quiet),
        events: Vec::new(),
        events_to_keep: print_run::EVENTS_SHOWN,
    };
    let result = simulate(scene, options, &mut watch);
    watch.progress.finish();
    let (summary, failed) = match result {
        Ok(summary) => (summary, None),
        Err(failure) => (*failure.summary, Some(failure.error)),
    };
    let error = failed.as_ref().map(|error| with_causes(error));
    let outcome = Outcome { summary, wall_seconds: started.elapsed().as_secs_f64(), error };
    let finished = watch.files.finish(&outcome);
    // What stopped the run says more than what then could not be written.
    if let Some(error) = failed {
        return Err(CliError::Simulation { error, directory });
    }
    finished?;
    let account = print_run::Account { scene, run: &run, outcome: &outcome, events: watch.events };
    Ok(account.text(&directory))
}

/// `out/` and the scene's name, with what a file name cannot hold replaced.
pub(crate) fn default_directory(scene: &str) -> PathBuf {
    let safe = |c: char| if c.is_control() || matches!(c, '/' | '\\') { '_' } else { c };
    let name: String = scene.trim().chars().map(safe).collect();
    let name = if name.trim_matches('.').is_empty() { "scene".to_owned() } else { name };
    PathBuf::from("out").join(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_scene_name_leads_out_of_the_output_directory() {
        for (name, path) in [
            ("boom", "out/boom"),
            ("../boom", "out/.._boom"),
            ("..", "out/scene"),
            ("", "out/scene"),
            ("/etc", "out/_etc"),
        ] {
            assert_eq!(default_directory(name), PathBuf::from(path));
        }
    }
}
