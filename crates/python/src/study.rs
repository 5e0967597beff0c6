//! Studies, and sweeps in threads of this process.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use nboom_cli::{
    Asked, SweepOutputs, finish_sweep, idle_formulation_of, warn_of_the_scene, words_of_settings,
};
use nboom_io::ReadOptions;
use nboom_study::{End, Maker, Report, Shard, Sweep, SweepDirectory, Watcher};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyString};

use crate::error::{About, of_input, of_study, raised, warn, warned, wrong_input};
use crate::gathering::Gathering;
use crate::patience::Signals;
use crate::scene::{Scene, stock};

/// Time between two calls that tell how far a sweep has come.
const TELL: Duration = Duration::from_millis(100);

/// Time between two looks whether a sweep has ended.
const LOOK: Duration = Duration::from_millis(5);

/// A study that was read and checked, with its scene.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Study {
    study: Arc<nboom_study::Study>,
}

/// An option by name.
type Choice = (String, Py<PyAny>);

/// How far a sweep has come, for threads that run it and the one that waits.
#[derive(Default)]
struct Progress {
    done: AtomicU64,
    total: AtomicU64,
    stop: AtomicBool,
}

impl Watcher for Progress {
    fn progress(&self, done: u64, total: u64) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    fn interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// What is the same for all ways to run a study.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct SweepOptions {
    directory: PathBuf,
    resume: bool,
    csv: bool,
    accept_difference: bool,
}

#[pymethods]
impl SweepOptions {
    #[new]
    fn new(directory: PathBuf, resume: bool, csv: bool, accept_difference: bool) -> Self {
        Self { directory, resume, csv, accept_difference }
    }
}

impl Study {
    fn sweep(&self, options: &SweepOptions, jobs: usize, shard: Option<Shard>) -> Sweep<'_> {
        let routines = stock();
        let SweepOptions { ref directory, resume, csv, accept_difference } = *options;
        Sweep {
            study: &self.study,
            directory: directory.clone(),
            jobs,
            resume,
            shard,
            csv,
            accept_difference,
            kernels: routines.for_runs,
            right_sides: routines.right_sides_of_eight,
        }
    }
}

#[pymethods]
impl Study {
    /// Reads a study `NAME.toml` and its scene.
    #[staticmethod]
    fn load(path: PathBuf, include_anywhere: bool) -> PyResult<Self> {
        let options =
            ReadOptions { includes_from_anywhere: include_anywhere, ..Default::default() };
        nboom_study::require_as_swept(&path).map_err(of_study)?;
        let study = nboom_study::Study::read_with(&path, &options).map_err(of_input)?;
        Ok(Self { study: Arc::new(study) })
    }

    /// Warns of what in its scene is probably a mistake.
    fn warn(&self, py: Python<'_>) -> PyResult<()> {
        warned(py, About::Scene, &[], || warn_of_the_scene(&self.study, false))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.study.name
    }

    #[getter]
    fn cases(&self) -> u64 {
        self.study.cases()
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.study.seed
    }

    #[getter]
    fn method(&self) -> &'static str {
        self.study.method.name()
    }

    /// The scene of a case, from 1 to the last one, and the options of its run by name.
    fn case(&self, number: u64) -> PyResult<(Scene, Vec<Choice>)> {
        let file = self.study.named_scene_of(&self.study.case(number));
        let file = file.map_err(|why| wrong_input(format!("case {number} is rejected: {why}")))?;
        let option = |word: String| {
            let word = word.trim_start_matches('-');
            let (name, value) =
                word.split_once('=').map_or((word, None), |(name, value)| (name, Some(value)));
            let value = Python::attach(|py| match value {
                Some(value) => PyString::new(py, value).into_any().unbind(),
                None => PyBool::new(py, true).to_owned().into_any().unbind(),
            });
            (name.replace('-', "_"), value)
        };
        let options = words_of_settings(&self.study.run, &file).into_iter().map(option).collect();
        Ok((Scene::of(file), options))
    }

    /// The text of the study as it stands beside its scene, and that of the scene, both as files of a sweep.
    fn texts(&self) -> (String, String) {
        (self.study.beside_its_scene(), self.study.document.text())
    }

    /// Runs all cases in threads of this process; `tell` hears how many of how many are done.
    #[pyo3(signature = (options, jobs, shard, tell))]
    fn run(
        &self,
        py: Python<'_>,
        options: &SweepOptions,
        jobs: Option<usize>,
        shard: Option<(u64, u64)>,
        tell: Option<Py<PyAny>>,
    ) -> PyResult<Ended> {
        let shard = shard.map(|(number, of)| {
            format!("{number}/{of}").parse().map_err(|error| wrong_input(format!("shard: {error}")))
        });
        let processors = || thread::available_parallelism().map_or(1, usize::from);
        let sweep = self.sweep(options, jobs.unwrap_or_else(processors), shard.transpose()?);
        let progress = Progress::default();
        let (report, interrupted) = py.detach(|| watched(&sweep, &progress, tell.as_ref()));
        let report = match (report, interrupted) {
            (_, Some(interrupted)) => return Err(interrupted),
            (report, None) => report.map_err(of_study)?,
        };
        let ignored = report.selected.as_ref().and_then(idle_formulation_of);
        warn(py, About::Scene, ignored, &[])?;
        Ok(Ended { report, directory: sweep.directory })
    }

    /// Begins a sweep whose cases run elsewhere.
    fn gather(&self, py: Python<'_>, options: &SweepOptions) -> PyResult<Gathering> {
        let sweep = self.sweep(options, 1, None);
        let gathering = py.detach(|| sweep.gather()).map_err(of_study)?;
        Ok(Gathering::of(gathering, options.directory.clone()))
    }

    /// Runs the cases from `first` to `last`, and returns a batch that a gathering takes.
    fn run_batch<'py>(
        &self,
        py: Python<'py>,
        first: u64,
        last: u64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let cases = self.study.cases();
        if !(1 <= first && first <= last && last <= cases) {
            return Err(wrong_input(format!(
                "cases {first} to {last} found, some of 1 to {cases} expected"
            )));
        }
        let (signals, routines) = (Signals::new(), stock());
        let (kernels, right_sides) = (routines.for_runs, routines.right_sides_of_eight);
        let batch = py.detach(|| {
            self.study.run_batch(first..=last, kernels, right_sides, &|| signals.came())
        });
        match (signals.taken(), batch) {
            (None, Some(batch)) => Ok(PyBytes::new(py, &batch)),
            (interrupt, _) => {
                Err(interrupt.unwrap_or_else(|| wrong_input("interrupted".to_owned())))
            }
        }
    }

    fn __repr__(&self) -> String {
        let nboom_study::Study { name, method, seed, .. } = &*self.study;
        let cases = self.study.cases();
        format!("<nboom.Study {name}: {cases} cases, {}, seed {seed}>", method.name())
    }
}

/// Runs a sweep in a thread, and meanwhile hears signals and tells how far it is.
fn watched(
    sweep: &Sweep<'_>,
    progress: &Progress,
    tell: Option<&Py<PyAny>>,
) -> (Result<Report, nboom_study::StudyError>, Option<PyErr>) {
    let signals = Signals::new();
    let mut interrupt = None;
    let told = || -> PyResult<()> {
        let Some(tell) = tell else { return Ok(()) };
        let [done, total] = [&progress.done, &progress.total].map(|x| x.load(Ordering::Relaxed));
        Python::attach(|py| tell.call1(py, (done, total)).map(|_| ()))
    };
    let report = thread::scope(|scope| {
        let running = scope.spawn(|| sweep.run(progress));
        let mut waited = Duration::ZERO;
        while !running.is_finished() {
            thread::sleep(LOOK);
            waited += LOOK;
            if interrupt.is_none() && signals.came() {
                interrupt = signals.taken();
            }
            if interrupt.is_none() && waited >= TELL {
                waited = Duration::ZERO;
                interrupt = told().err();
            }
            progress.stop.store(interrupt.is_some(), Ordering::Relaxed);
        }
        match running.join() {
            Ok(report) => report,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    if interrupt.is_none() {
        interrupt = told().err();
    }
    (report, interrupt)
}

/// A sweep that has ended.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Ended {
    report: Report,
    directory: PathBuf,
}

impl Ended {
    pub fn of(report: Report, directory: PathBuf) -> Self {
        Self { report, directory }
    }
}

#[pymethods]
impl Ended {
    /// Cases that were run now.
    #[getter]
    fn computed(&self) -> u64 {
        self.report.computed
    }

    /// Whether all cases are done.
    #[getter]
    fn complete(&self) -> bool {
        self.report.end != End::Interrupted
    }

    /// Makes the page, with runs of the worst cases, and warns of results; returns the account that the command prints.
    fn finish(&self, py: Python<'_>, with_report: bool) -> PyResult<String> {
        let outputs = SweepOutputs {
            csv: false,
            accept_difference: false,
            no_report: !with_report,
            quiet: false,
        };
        let signals = Signals::new();
        let finished = warned(py, About::Results, &[], || {
            let interrupts = || Ok(signals.interrupt());
            let asked = Asked { of_all: &signals.interrupt(), of_a_run: &interrupts };
            finish_sweep(&self.directory, &self.report, &outputs, &stock(), asked)
        })?;
        finished.map_err(|error| signals.taken().unwrap_or_else(|| raised(&error)))
    }
}

/// Version, vector instructions and platform of this program, on which the last digits of results depend.
#[pyfunction]
pub(crate) fn maker() -> (String, String, String) {
    let Maker { version, instructions, platform, .. } = Maker::current();
    (version, instructions, platform)
}

/// Puts the directories of all shards of a sweep together.
#[pyfunction]
pub(crate) fn merge(
    py: Python<'_>,
    shards: Vec<PathBuf>,
    directory: PathBuf,
    csv: bool,
    accept_difference: bool,
) -> PyResult<Ended> {
    let merged = py.detach(|| nboom_study::merge(&shards, &directory, csv, accept_difference));
    Ok(Ended { report: merged.map_err(of_study)?, directory })
}

/// Columns of the table of cases of a finished sweep: name, unit, meaning and numbers or texts.
#[pyfunction]
pub(crate) fn cases(py: Python<'_>, directory: PathBuf) -> PyResult<Vec<crate::table::CaseColumn>> {
    let sweep = SweepDirectory::read(&directory).map_err(of_study)?;
    let Some(sweep) = sweep else {
        return Err(wrong_input(format!("{}: no sweep found", directory.display())));
    };
    crate::table::read(py, &sweep)
}
