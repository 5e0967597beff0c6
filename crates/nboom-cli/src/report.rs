use std::path::{Path, PathBuf};

use clap::Args;
use nboom_report::{Run, page};
use nboom_results::{REPORT_FILE, is_page, write_file};

use crate::{CliError, PlotArgs, say, sweep};

/// Options of `nboom report`.
#[derive(Args, Debug)]
pub struct ReportArgs {
    /// Directories that nboom run has written, of several the page shows each run beside the others; or one of
    /// nboom sweep.
    #[arg(value_name = "DIR", required = true)]
    pub directories: Vec<PathBuf>,

    /// The page; by default report.html in the directory, of several runs comparison.html.
    #[arg(short, long, value_name = "FILE.html")]
    pub output: Option<PathBuf>,

    /// Figures for documents, of each run.
    #[command(flatten)]
    pub plots: PlotArgs,
}

/// The page of several runs where no name is given.
const COMPARISON: &str = "comparison.html";

impl ReportArgs {
    /// Where the page is written, over nothing but a page of ours.
    fn page(&self) -> Result<PathBuf, CliError> {
        let output = match (&self.output, &self.directories[..]) {
            (Some(output), _) => output.clone(),
            (None, [directory]) => directory.join(REPORT_FILE),
            (None, _) => Path::new(COMPARISON).to_owned(),
        };
        if output.extension().is_none_or(|ending| ending != "html") {
            return Err(CliError::NoPage { path: output });
        }
        require_replaceable(&output)?;
        Ok(output)
    }
}

/// Makes the page of runs, and returns the text for standard output.
pub(crate) fn report(args: &ReportArgs) -> Result<String, CliError> {
    if let [directory] = &args.directories[..]
        && directory.is_dir()
        && let Some(sweep) = sweep::finished(directory)?
    {
        if args.plots.are_wanted() {
            return Err(CliError::PlotsOfSweep { path: directory.clone() });
        }
        let page = args.page()?;
        sweep::write_page(&sweep, directory, &page)?;
        return Ok(format!("{}\n", page.display()));
    }
    let several = args.directories.len() > 1;
    for directory in args.directories.iter().filter(|_| several) {
        if directory.is_dir() && sweep::finished(directory)?.is_some() {
            return Err(CliError::SweepBesideOthers { path: directory.clone() });
        }
    }
    let read = |directory: &PathBuf| {
        let run = Run::read(directory)?;
        run.gaps().iter().for_each(|gap| say("note", &format!("{}: {gap}", directory.display())));
        Ok(if several { run.named_by(directory) } else { run })
    };
    let runs: Result<Vec<Run>, CliError> = args.directories.iter().map(read).collect();
    let output = args.page()?;
    let runs = runs?;
    require_same_units(&runs, &args.directories)?;
    let mut written = Vec::new();
    for (run, directory) in runs.iter().zip(&args.directories) {
        written.extend(args.plots.draw(run, directory)?);
    }
    write_file(&output, &page(runs))?;
    written.insert(0, output);
    Ok(written.iter().map(|path| format!("{}\n", path.display())).collect())
}

/// Refuses the place of a file that nboom has not made.
fn require_replaceable(path: &Path) -> Result<(), CliError> {
    if path.is_file() && !is_page(path) {
        return Err(CliError::OtherPage { path: path.to_owned() });
    }
    Ok(())
}

fn require_same_units(runs: &[Run], directories: &[PathBuf]) -> Result<(), CliError> {
    let all = || runs.iter().zip(directories);
    let Some((first, of_first)) = all().next() else { return Ok(()) };
    match all().find(|(run, _)| run.units() != first.units()) {
        None => Ok(()),
        Some((run, path)) => {
            let label = |run: &Run| run.units().label("L, T, F");
            let (path, first_path) = (path.clone(), of_first.clone());
            let (units, expected) = (label(run), label(first));
            Err(CliError::OtherUnits { path, units, first: first_path, expected })
        }
    }
}
