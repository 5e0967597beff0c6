//! Run time against error: all code that computes accelerations, with all integrators, at all
//! tolerances.

use std::fmt::Write;
use std::ops::RangeInclusive;
use std::time::Instant;

use nboom_formulation::Formulation;
use nboom_model::Scene;
use nboom_scalar::{Batch, Kernel};
use nboom_sim::{
    Failure, Form, Method, Options, Path, Scales, Simulator, Snapshot, Witness, differences,
    simulate,
};

use crate::plot::{Curve, plot};

/// 1e-3 to 1e-14, the smallest that a run takes.
const TOLERANCES: RangeInclusive<i32> = 3..=14;

/// The tolerances of the references.
const TIGHTEST: (f64, f64) = (1e-14, 1e-16);

/// A run is given up that takes more steps.
const MOST_STEPS: usize = 100_000;

/// A curve ends with a run that takes longer \[s\]: those at smaller tolerances would, too.
const LONGEST: f64 = 0.25;

/// No curve begins where this share of the span takes longer than this share of [`MARGIN`] times
/// [`LONGEST`].
const TRIAL: f64 = 0.05;
const MARGIN: f64 = 8.0;

/// How many turns each run takes; the shortest time counts.
const TURNS: usize = 5;

/// How many runs a prepared simulator makes for each first one.
const PREPARED: usize = 4;

/// Runs that take longer \[s\] are made once.
const TIMED_ONCE: f64 = 0.1;

/// Whole runs of a scene: how long they take and how wrong they are at the end.
#[derive(Clone, Debug)]
pub struct WorkPrecision {
    /// The scene's name.
    pub scene: String,
    /// Largest relative difference of two references: series on recorded equations and Runge-Kutta
    /// on the recursion, both at the smallest tolerance. Errors that small say nothing.
    pub known_to: f64,
    /// The runs, tolerance by tolerance for each code and integrator.
    pub runs: Vec<TimedRun>,
}

/// One run.
#[derive(Clone, Copy, Debug)]
pub struct TimedRun {
    /// `generic`, `generated`, or `recorded`: what series are made of.
    pub path: &'static str,
    /// The formulation; of recorded equations the one that the run chooses.
    pub formulation: &'static str,
    /// The integrator.
    pub integrator: Method,
    /// Relative error allowed in a step.
    pub rtol: f64,
    /// The largest difference of any quantity at the end from the reference by series, each relative
    /// to its natural size.
    pub error: f64,
    /// The largest difference of any variable from that reference, over the largest value of any:
    /// attitude, β, velocity of O, ω, τ, all in main-body axes.
    pub error_as_peers: f64,
    /// The shortest time of a run of a simulator that is prepared, as in a sweep.
    pub microseconds: f64,
    /// How much longer the shortest first run takes, from a checked scene on: it prepares its modes.
    pub preparation: f64,
    /// Evaluations of the equations of motion; of series, as many as there are series.
    pub evaluations: usize,
}

impl WorkPrecision {
    /// Runs `scene` in all ways that cover it, generated routines and those of them for eight states
    /// included, again and again for about so many `seconds` for each code and integrator. A curve
    /// ends early where runs become long.
    ///
    /// # Errors
    /// When a reference does not come to its end.
    pub fn measure(
        scene: &Scene,
        routines: (&'static [Kernel], &'static [Batch]),
        seconds: f64,
    ) -> Result<Self, Failure> {
        let truth = Truth::of(scene)?;
        let second = reference(scene, Method::Dop853)?;
        let mut measured: Vec<(TimedRun, Options)> = Vec::new();
        let beginning = beginning(scene);
        let seconds = seconds / (TOLERANCES.count() * TURNS) as f64;
        for (code, integrator) in combinations(routines.0) {
            if crawls(&beginning, &code.options(integrator, *TOLERANCES.start(), routines)) {
                continue;
            }
            for exponent in TOLERANCES {
                let options = code.options(integrator, exponent, routines);
                // A run that does not come to the end will not at smaller tolerances either.
                let Some(run) = timed(scene, code, &options, &truth, seconds) else { break };
                measured.push((run, options));
                if run.microseconds > LONGEST * 1e6 {
                    break;
                }
            }
        }
        for _ in 1..TURNS {
            let quick = measured.iter_mut().filter(|(run, _)| run.microseconds < 1e6 * TIMED_ONCE);
            for (run, options) in quick {
                run.take(shortest(scene, options, seconds));
            }
        }
        Ok(Self {
            scene: scene.name.clone(),
            known_to: truth.error(second.end().expect("a run ends with an event")),
            runs: measured.into_iter().map(|(run, _)| run).collect(),
        })
    }

    /// All runs as comma-separated values.
    pub fn csv(&self) -> String {
        let head =
            "path,formulation,integrator,rtol,error,microseconds,evaluations,error_as_peers\n";
        self.runs.iter().fold(head.to_owned(), |mut text, run| {
            let TimedRun { path, formulation, integrator, rtol, .. } = run;
            let TimedRun { error, microseconds, evaluations, error_as_peers, .. } = run;
            writeln!(
                text,
                "{path},{formulation},{integrator},{rtol:e},{error:.3e},{microseconds:.1},{evaluations},\
                 {error_as_peers:.3e}"
            )
            .expect("a string takes any text");
            text
        })
    }

    /// Each integrator with its fastest code, and each code with `dop853`, as a picture (SVG).
    pub fn picture(&self) -> String {
        let curves = self.curves();
        let is_fastest = |curve: &[TimedRun]| {
            let same = curves.iter().filter(|other| other[0].integrator == curve[0].integrator);
            same.map(|other| other[0].microseconds).all(|time| curve[0].microseconds <= time)
        };
        let shown = curves.iter().filter(|c| c[0].integrator == Method::Dop853 || is_fastest(c));
        let shown: Vec<Curve> = shown
            .map(|runs| Curve {
                name: name(runs),
                points: runs.iter().map(|run| (run.error, run.microseconds)).collect(),
            })
            .collect();
        plot(&self.scene, &shown)
    }

    /// The shortest time of each code and integrator that is as accurate as every other decade.
    pub fn table(&self) -> String {
        let Self { scene, known_to, .. } = self;
        let mut text = format!(
            "{scene}: microseconds of a prepared run, by its relative error at the end, and of its \
             preparation; the reference is known to {known_to:.0e}\n{:<36}",
            "code and integrator"
        );
        let decades = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
        let mut cell = |cell: String| text.push_str(&cell);
        decades.iter().for_each(|decade| cell(format!(" {decade:>9e}")));
        cell(format!(" {:>11}", "preparation"));
        for runs in self.curves() {
            cell(format!("\n{:<36}", name(runs)));
            for decade in decades {
                let within = runs.iter().filter(|run| run.error <= decade);
                let least = within.map(|run| run.microseconds).fold(f64::INFINITY, f64::min);
                cell(if least.is_finite() {
                    format!(" {least:>9.0}")
                } else {
                    format!(" {:>9}", "-")
                });
            }
            let mut preparations: Vec<f64> = runs.iter().map(|run| run.preparation).collect();
            preparations.sort_by(f64::total_cmp);
            cell(format!(" {:>11.0}", preparations[preparations.len() / 2]));
        }
        text + "\n"
    }

    /// The runs of each code and integrator.
    fn curves(&self) -> Vec<&[TimedRun]> {
        let key = |run: &TimedRun| (run.path, run.formulation, run.integrator);
        self.runs.chunk_by(|a, b| key(a) == key(b)).collect()
    }
}

impl TimedRun {
    /// Takes the shorter of its times and these.
    fn take(&mut self, (first, prepared): (f64, f64)) {
        let first = first.min(self.microseconds + self.preparation);
        self.microseconds = self.microseconds.min(prepared);
        // Below the noise of what both have in common it is nothing.
        self.preparation = (first - self.microseconds).max(0.0);
    }
}

fn name(curve: &[TimedRun]) -> String {
    let TimedRun { path, formulation, integrator, .. } = curve[0];
    format!("{path} {formulation} {integrator}")
}

/// What computes accelerations.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// Library code.
    Library(Form),
    /// A generated routine.
    Generated(Formulation),
    /// Equations that the integrator records, whatever code there is.
    Recorded,
}

impl Source {
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Library(form) => (Path::Generic.name(), form.name()),
            Self::Generated(formulation) => (Path::Generated.name(), formulation.name()),
            Self::Recorded => ("recorded", "any"),
        }
    }

    fn options(
        self,
        integrator: Method,
        exponent: i32,
        (kernels, batches): (&'static [Kernel], &'static [Batch]),
    ) -> Options {
        let (path, formulation) = match self {
            Self::Library(form) => (Path::Generic, Some(form)),
            Self::Generated(formulation) => (Path::Generated, Some(Form::Closed(formulation))),
            Self::Recorded => (Path::Auto, None),
        };
        Options {
            path,
            formulation,
            integrator,
            rtol: 10.0_f64.powi(-exponent),
            atol: 10.0_f64.powi(-exponent - 2),
            samples: 1,
            max_steps: MOST_STEPS,
            kernels,
            batches,
            ..Options::default()
        }
    }
}

/// Each code with each integrator that uses it.
fn combinations(kernels: &[Kernel]) -> impl Iterator<Item = (Source, Method)> {
    let is_there = |form: &Formulation| kernels.iter().any(|k| k.formulation == form.name());
    let library = Formulation::ALL.into_iter().map(|form| Source::Library(Form::Closed(form)));
    let generated = Formulation::ALL.into_iter().filter(is_there).map(Source::Generated);
    let codes = [Source::Library(Form::Recursive)].into_iter().chain(library).chain(generated);
    let methods = || Method::ALL.into_iter().filter(|method| *method != Method::Taylor);
    let pairs = codes.flat_map(move |code| methods().map(move |method| (code, method)));
    let pairs: Vec<_> = pairs.chain([(Source::Recorded, Method::Taylor)]).collect();
    pairs.into_iter()
}

/// What is seen of a run that is as good as `f64` allows.
fn reference(scene: &Scene, integrator: Method) -> Result<Witness, Failure> {
    let (rtol, atol) = TIGHTEST;
    let options = Options { path: Path::Generic, integrator, rtol, atol, ..Options::default() };
    let mut witness = Witness::new();
    simulate(scene, &options, &mut witness)?;
    Ok(witness)
}

/// What runs are compared with: how a reference ends, and the natural sizes of its quantities.
struct Truth {
    end: Snapshot,
    scales: Scales,
}

impl Truth {
    fn of(scene: &Scene) -> Result<Self, Failure> {
        let witness = reference(scene, Method::Taylor)?;
        let end = witness.end().expect("a run ends with an event").clone();
        Ok(Self { end, scales: witness.scales(scene) })
    }

    /// The largest difference of any quantity, relative to its natural size.
    fn error(&self, end: &Snapshot) -> f64 {
        let quantities = differences(end, &self.end, &self.scales);
        quantities.iter().map(|digits| digits.difference).fold(0.0, f64::max)
    }

    /// The largest difference of any variable, relative to the largest one.
    fn error_as_peers(&self, end: &Snapshot) -> f64 {
        let (ours, true_ones) = (variables(end), variables(&self.end));
        let largest = true_ones.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let off = ours.iter().zip(&true_ones).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        off / largest
    }
}

/// What those integrate who have no closed form for the mass centre.
fn variables(end: &Snapshot) -> Vec<f64> {
    let attitude = end.attitude;
    let velocity_body = attitude.to_matrix().transpose_mul(end.velocity_inertial);
    let vectors = [attitude.vector, velocity_body, end.omega_body];
    let vectors = vectors.into_iter().flat_map(|vector| vector.to_array());
    let all = [attitude.scalar].into_iter().chain(vectors);
    all.chain(end.beta.iter().copied()).chain(end.tau.iter().copied()).collect()
}

/// The scene for a small share of its span.
fn beginning(scene: &Scene) -> Scene {
    let start = scene.initial.time;
    let end_time = start + TRIAL * (scene.end_time - start);
    scene.ending_at(end_time).expect("a time between two times of a scene is one")
}

/// Whether a run would take [`MARGIN`] times [`LONGEST`].
fn crawls(beginning: &Scene, options: &Options) -> bool {
    let started = Instant::now();
    let run = simulate(beginning, options, &mut Witness::new());
    run.is_err() || started.elapsed().as_secs_f64() > LONGEST * MARGIN * TRIAL
}

/// `None` where the run does not come to its end.
fn timed(
    scene: &Scene,
    code: Source,
    options: &Options,
    truth: &Truth,
    seconds: f64,
) -> Option<TimedRun> {
    let mut witness = Witness::new();
    let started = Instant::now();
    let summary = simulate(scene, options, &mut witness).ok()?;
    let first = started.elapsed().as_secs_f64();
    let (path, formulation) = code.names();
    let mut run = TimedRun {
        path,
        formulation,
        integrator: options.integrator,
        rtol: options.rtol,
        error: truth.error(witness.end()?),
        error_as_peers: truth.error_as_peers(witness.end()?),
        microseconds: first * 1e6,
        preparation: 0.0,
        evaluations: summary.evaluations,
    };
    if first < seconds {
        run.take(shortest(scene, options, seconds));
    }
    Some(run)
}

/// The shortest times \[µs\] of first runs and of runs of a prepared simulator, of as many as fit into `seconds`.
fn shortest(scene: &Scene, options: &Options, seconds: f64) -> (f64, f64) {
    let (mut first, mut prepared) = (f64::INFINITY, f64::INFINITY);
    let all = Instant::now();
    while all.elapsed().as_secs_f64() < seconds {
        let started = Instant::now();
        let mut simulator = Simulator::new(scene, *options);
        if simulator.run(&mut Witness::new()).is_err() {
            continue;
        }
        first = first.min(started.elapsed().as_secs_f64() * 1e6);
        for _ in 0..PREPARED {
            let mut witness = Witness::new();
            let started = Instant::now();
            if simulator.run(&mut witness).is_ok() {
                prepared = prepared.min(started.elapsed().as_secs_f64() * 1e6);
            }
        }
    }
    (first, prepared)
}
