use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use nboom_formulation::Formulation;
use nboom_io::SceneFile;
use nboom_package::{Build, Built, Level, PackageError, Progress, compile as build, library, load};

use crate::format::{count, seconds};
use crate::{CliError, Routines, SceneArgs, check, choice, say};

/// Options of `nboom compile`.
#[derive(Args, Debug)]
pub struct CompileArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The program to build; only a simulator that this command has built is replaced.
    #[arg(short, long, value_name = "BINARY")]
    pub output: PathBuf,

    /// Form of the equations of motion: report, relative, symmetric, articulated or momentum.
    #[arg(long, value_name = "NAME", default_value = "articulated",
          value_parser = choice::closed_form)]
    pub formulation: Formulation,

    /// How freely arithmetic may be rearranged: exact takes operations one by one as the closed
    /// form does, fast fuses products and sums.
    #[arg(long, value_name = "LEVEL", default_value = "fast", value_parser = choice::level)]
    pub level: Level,

    /// Folder to build in; by default nboom in $XDG_CACHE_HOME or in ~/.cache.
    #[arg(long, value_name = "DIR")]
    pub work: Option<PathBuf>,

    /// Build with the crates that cargo has already downloaded, without network.
    #[arg(long)]
    pub offline: bool,
}

/// Builds a simulator around the scene's routines, and returns the text for standard output.
pub(crate) fn compile(args: &CompileArgs) -> Result<String, CliError> {
    let started = Instant::now();
    let file = check::scene(&args.scene)?;
    let CompileArgs { formulation, level, offline, .. } = *args;
    let how = Build { formulation, level, work: args.work.clone(), offline };
    let shown = Shown::new();
    let built =
        build(&file.scene, file.structure.as_ref(), &how, &args.output, |step| shown.show(&step));
    shown.line.finish_and_clear();
    let Built { up_to_date, topology, routines, folder } = built.map_err(|error| match error {
        PackageError::NoFolder => CliError::NoWork,
        other => other.into(),
    })?;
    let (scene, program) = (&file.scene.name, args.output.display());
    let seconds = seconds(started.elapsed().as_secs_f64());
    if up_to_date {
        return Ok(format!("{scene}: {program} is up to date, {seconds} s\n"));
    }
    let sources = folder.display();
    Ok(format!(
        "{scene}: topology {topology}, {routines} routines, built {program} in {seconds} s\n\
         sources in {sources}\n"
    ))
}

/// These routines, and before them those of a scene if they are wanted: built as a library and loaded.
pub(crate) fn with_compiled(
    routines: &Routines,
    file: &SceneFile,
    wanted: bool,
) -> Result<Routines, CliError> {
    if !wanted {
        return Ok(*routines);
    }
    let shown = Shown::new();
    let built = library(&file.scene, file.structure.as_ref(), &Build::default(), |step| {
        shown.show(&step);
    });
    shown.line.finish_and_clear();
    let of_scene = load(&built?.path)?;
    // They are for this one command, which ends with the program.
    let for_runs = [of_scene.kernels, routines.for_runs].concat().leak();
    Ok(Routines { for_runs, ..*routines })
}

/// How far a build has come and how long it has taken: on a terminal a line that changes, elsewhere
/// a line for each step. The remaining time is unknown.
struct Shown {
    line: ProgressBar,
}

/// How often the line shows the time.
const TICK: Duration = Duration::from_millis(200);

impl Shown {
    fn new() -> Self {
        if !io::stderr().is_terminal() {
            return Self { line: ProgressBar::hidden() };
        }
        let style = ProgressStyle::with_template("{spinner} {wide_msg} {elapsed}");
        let style = style.expect("the template is well formed");
        let line = ProgressBar::new_spinner().with_style(style);
        line.enable_steady_tick(TICK);
        Self { line }
    }

    fn show(&self, step: &Progress) {
        let text = match step {
            Progress::Writing { routines } => {
                format!("writing {}", count(*routines, "routine", "routines"))
            }
            Progress::Building => "building with cargo, the first time for a minute or more".into(),
            Progress::Crate { count: done, name } => {
                format!("building, {} done, the last one {name}", count(*done, "crate", "crates"))
            }
        };
        if self.line.is_hidden() && !matches!(step, Progress::Crate { .. }) {
            say("compile", &text);
        }
        self.line.set_message(text);
    }
}
