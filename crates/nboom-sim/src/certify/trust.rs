//! How many digits of a run can be trusted, from a second run that is more accurate.

#[cfg(test)]
mod tests;

use std::io;

use nboom_model::Scene;
use nboom_ode::Method;
use nboom_scalar::Vec3;

use crate::certify::expansion::Accuracy;
use crate::certify::replay::Replay;
use crate::certify::scales::{Largest, Scales, natural};
use crate::error::SimError;
use crate::events::event::{Event, EventKind};
use crate::options::Options;
use crate::run::record::{Failure, InstantMotion, Recorder, Snapshot, Summary};
use crate::run::simulate;
use crate::run::step_motion::StepMotion;

/// The reference's tolerances are this many times tighter, as far as rounding allows.
const TIGHTER: f64 = 1e-3;

/// The tightest relative tolerance of a reference.
const TIGHTEST: f64 = 1e-14;

/// Events beyond these are not compared.
const MOST_EVENTS: usize = 100_000;

/// What of a run is compared: its events and how it ends.
#[derive(Clone, Debug, Default)]
pub struct Witness {
    pub(crate) events: Vec<Event>,
    last: Option<Snapshot>,
    largest: Largest,
}

impl Witness {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// How the run ended; none of one that failed.
    pub fn end(&self) -> Option<&Snapshot> {
        self.last.as_ref()
    }

    /// Natural sizes of what was seen of a run of `scene`.
    pub fn scales(&self, scene: &Scene) -> Scales {
        Scales::of(scene, &self.largest)
    }
}

impl Recorder for Witness {
    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.largest.saw(snapshot);
        Ok(())
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> io::Result<()> {
        self.largest.saw(after);
        if let (Some(hinge), Some(impulse)) = (event.hinge, event.impulse) {
            self.largest.saw_impulse(hinge, impulse);
        }
        if event.kind == EventKind::End {
            self.last = Some(after.clone());
        } else if self.events.len() < MOST_EVENTS {
            self.events.push(*event);
        }
        Ok(())
    }
}

/// The witness of a reference, and who else looks at it.
struct Both<'a> {
    witness: Witness,
    beside: &'a mut dyn Recorder,
}

impl Recorder for Both<'_> {
    fn needs_detail(&self) -> bool {
        self.beside.needs_detail()
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.witness.sample(snapshot)?;
        self.beside.sample(snapshot)
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> io::Result<()> {
        self.witness.event(event, after)?;
        self.beside.event(event, after)
    }

    fn interrupted(&self) -> bool {
        self.beside.interrupted()
    }

    fn needs_instants(&self) -> bool {
        self.beside.needs_instants()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.beside.instant(instant)
    }

    fn needs_steps(&self) -> bool {
        self.beside.needs_steps()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.beside.step(step)
    }
}

/// What a run is compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reference {
    /// A run with tolerances a thousand times tighter.
    #[default]
    TighterTolerance,
    /// A run in double-double, which has all digits that an `f64` can have.
    DoubleDouble,
}

impl Reference {
    /// All.
    pub const ALL: [Self; 2] = [Self::TighterTolerance, Self::DoubleDouble];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::TighterTolerance => "tighter-tolerance",
            Self::DoubleDouble => "double-double",
        }
    }

    /// The reference with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|reference| reference.name() == name)
    }
}

/// Differences between a run and its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Trust {
    /// What the reference is.
    pub reference: Reference,
    /// Relative tolerance of the reference.
    pub rtol: f64,
    /// Absolute tolerance of the reference.
    pub atol: f64,
    /// Whether the two runs have the same events in the same order.
    pub same_events: bool,
    /// The events up to the first that differs.
    pub events: Vec<EventTrust>,
    /// The final state, quantity by quantity. It is empty when a reference in double-double has
    /// other events, as that ends at the first of them.
    pub end: Vec<Digits>,
}

/// How well an event is known.
#[derive(Clone, Debug, PartialEq)]
pub struct EventTrust {
    /// The event, as the run has it.
    pub event: Event,
    /// Its time since the beginning, relative to itself.
    pub time: Digits,
    /// Its impulse, if it has one.
    pub impulse: Option<Digits>,
}

/// A difference of a quantity, relative to its natural size; see [`Scales`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Digits {
    /// What it is.
    pub quantity: &'static str,
    /// The difference, relative to that size.
    pub difference: f64,
}

impl Digits {
    /// Of a quantity of this natural size.
    pub fn new(quantity: &'static str, difference: f64, size: f64) -> Self {
        let difference = if difference == 0.0 { 0.0 } else { difference / size };
        Self { quantity, difference }
    }

    /// Significant digits that both runs agree in, 16 at most.
    pub fn count(&self) -> u32 {
        match self.difference {
            difference if difference.is_nan() || difference >= 1.0 => 0,
            // The number is from 0 to 16.
            difference => (-difference.max(1e-16).log10()) as u32,
        }
    }
}

/// Runs `scene` again, more accurately than `options` say, and compares with what `witness` saw
/// of the run under `options`.
///
/// The reference tells `beside` what a run tells its recorder. In double-double it is the `f64` run
/// that the reference follows which does so; its errors are rounding.
///
/// # Errors
/// When the reference cannot be computed to the end, or `beside` interrupts it.
///
/// # Panics
/// When `witness` saw no run come to its end.
pub fn trust(
    scene: &Scene,
    options: &Options,
    witness: &Witness,
    reference: Reference,
    beside: &mut dyn Recorder,
) -> Result<Trust, Failure> {
    let (rtol, atol, truth) = match reference {
        Reference::TighterTolerance => {
            let rtol = (options.rtol * TIGHTER).max(TIGHTEST);
            let atol = options.atol * TIGHTER;
            (rtol, atol, run_again(scene, options, rtol, atol, beside)?.0)
        }
        Reference::DoubleDouble => {
            let Accuracy { relative, absolute, .. } = Accuracy::REFERENCE;
            (relative, absolute, in_double_double(scene, options, Accuracy::REFERENCE, beside)?)
        }
    };
    let same = |(a, b): &(&Event, &Event)| (a.kind, a.hinge) == (b.kind, b.hinge);
    let pairs = witness.events.iter().zip(&truth.events).take_while(same);
    let (start, scales) = (scene.initial.time, witness.scales(scene));
    let compared = pairs.map(|(run, truth)| compare(start, run, truth, &scales));
    let events: Vec<EventTrust> = compared.collect();
    let counts = [witness.events.len(), truth.events.len()];
    let last = witness.last.as_ref().expect("a run ends with an event");
    let end = truth.last.as_ref().map(|truth| differences(last, truth, &scales));
    let same_events = counts == [events.len(); 2] && end.is_some();
    Ok(Trust { reference, rtol, atol, same_events, events, end: end.unwrap_or_default() })
}

/// Runs the scene again with these tolerances.
fn run_again(
    scene: &Scene,
    options: &Options,
    rtol: f64,
    atol: f64,
    beside: &mut dyn Recorder,
) -> Result<(Witness, Summary), Failure> {
    // `auto` reaches tolerances that other methods do not. Where the motion is stiff it takes `radau9` or `radau13`,
    // but never `radau5`, which is compared with itself.
    let integrator = match options.integrator {
        Method::Radau5 => Method::Radau5,
        _ => Method::Auto,
    };
    let max_steps = Options::default().max_steps.max(options.max_steps);
    let tighter = Options { integrator, rtol, atol, max_steps, samples: 1, ..*options };
    let mut both = Both { witness: Witness::new(), beside };
    let summary = simulate(scene, &tighter, &mut both)?;
    Ok((both.witness, summary))
}

/// The witness in double-double, along the events of a run that is as accurate as `f64` allows.
fn in_double_double(
    scene: &Scene,
    options: &Options,
    accuracy: Accuracy,
    beside: &mut dyn Recorder,
) -> Result<Witness, Failure> {
    if scene.bodies.iter().any(|body| body.hinge.may_stick()) {
        let has_friction = scene.hinges_with_friction().next().is_some();
        let what = if has_friction { "friction" } else { "stops" };
        let error = SimError::NotReplayed { what };
        return Err(Failure { error, summary: Box::new(Summary::empty()) });
    }
    let atol = options.atol * TIGHTER;
    let (guide, summary) = run_again(scene, options, TIGHTEST, atol, beside)?;
    let interrupted = || beside.interrupted();
    let mut replay = Replay::new(scene, &guide.events, accuracy, options.max_steps, &interrupted);
    match replay.complete() {
        Ok(as_guided) => {
            let last = as_guided.then(|| replay.snapshot());
            Ok(Witness { events: replay.events, last, ..Witness::new() })
        }
        Err(error) => Err(Failure { error, summary: Box::new(summary) }),
    }
}

fn compare(start: f64, event: &Event, truth: &Event, scales: &Scales) -> EventTrust {
    let since = natural((truth.time - start).abs(), scales.time);
    let impulse = event.impulse.zip(truth.impulse).map(|(run, truth)| {
        let size = event.hinge.map_or(1.0, |hinge| scales.of_hinges[hinge]);
        let difference = (run - truth).abs() * size;
        Digits::new("impulse", difference, natural(truth.abs() * size, scales.impulse))
    });
    // Both times are rounded, on average by a quarter of their spacing.
    let rounded = 0.25 * (event.time.abs().next_up() - event.time.abs());
    let time = Digits::new("time", (event.time - truth.time).abs().max(rounded), since);
    EventTrust { event: *event, time, impulse }
}

/// How far one state of a scene is from another, quantity by quantity: the largest difference of each,
/// relative to its natural size.
pub fn differences(run: &Snapshot, truth: &Snapshot, scales: &Scales) -> Vec<Digits> {
    let vector = |quantity, run: Vec3<f64>, truth: Vec3<f64>, size| {
        of_list(quantity, &run.to_array(), &truth.to_array(), size)
    };
    let of_hinges = |quantity, run: &[f64], truth: &[f64], sizes: &[f64]| {
        let pairs = run.iter().zip(truth).zip(sizes);
        let off = pairs.map(|((a, b), size)| Digits::new(quantity, (a - b).abs(), *size));
        let worst = off.max_by(|a, b| a.difference.total_cmp(&b.difference));
        worst.unwrap_or(Digits { quantity, difference: 0.0 })
    };
    // The angle between the two attitudes; half of it is the length of the difference.
    let (a, b) = (run.attitude, truth.attitude);
    let turned = (a.scalar - b.scalar).hypot((a.vector - b.vector).norm()) * 2.0;
    vec![
        Digits::new("attitude", turned, 1.0),
        vector("omega", run.omega_body, truth.omega_body, scales.omega),
        of_hinges("beta", &run.beta, &truth.beta, &scales.beta),
        of_hinges("tau", &run.tau, &truth.tau, &scales.tau),
        vector("rho", run.position_inertial, truth.position_inertial, scales.rho),
        vector("v", run.velocity_inertial, truth.velocity_inertial, scales.v),
    ]
}

fn of_list(quantity: &'static str, run: &[f64], truth: &[f64], size: f64) -> Digits {
    let off = run.iter().zip(truth).map(|(a, b)| (a - b).abs());
    Digits::new(quantity, off.fold(0.0, f64::max), size)
}
