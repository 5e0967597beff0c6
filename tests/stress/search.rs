//! The envelope is the maximum over the motion, whatever is asked of the run beside it.

use std::io;

use nboom::model::{
    Body, Hinge, HingeStart, HingeState, Joint, MassProperties, Mount, Scene, SceneDescription,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{InstantMotion, Method, MotionAt, Options, Recorder, StepMotion, simulate};
use nboom::strength::{Settings, StressAnalysis};

use crate::random::{BruteForce, Satellite, envelope};

/// How many are searched; of the first four hundred each agrees within 5e-9.
const SATELLITES: u64 = 12;

fn analysed(satellite: &Satellite, scene: &Scene, options: &Options) -> StressAnalysis {
    let mut analysis = satellite.analysis(Settings::default());
    simulate(scene, options, &mut analysis).expect("a run");
    analysis.finish().expect("finite loads");
    analysis
}

/// By what `found` is smaller and by what it is larger than `expected`, each in shares of it; stresses
/// below the rounding of the largest do not count.
fn below_and_above(found: &[f64], expected: &[f64]) -> [f64; 2] {
    let mut off = [0.0, 0.0_f64];
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let change = found / expected - 1.0;
        off = [off[0].max(-change), off[1].max(change)];
    }
    off
}

#[test]
fn nothing_is_worse_at_any_of_a_thousand_times_of_each_step() {
    let mut together = 0;
    for seed in 0..SATELLITES {
        let satellite = Satellite::new(1 + (seed % 5) as usize, seed);
        let rtol = [1e-9, 1e-12, 1e-6, 1e-4][(seed % 4) as usize];
        let integrator = [Method::Auto, Method::Gauss, Method::Dopri5][(seed % 3) as usize];
        let options = Options { rtol, atol: 1e-3 * rtol, integrator, ..Options::default() };
        let brute = BruteForce::run(&satellite, &options, 1000);
        let found = envelope(&analysed(&satellite, &satellite.scene, &options));
        let [below, above] = below_and_above(&found, &brute.largest);
        // By what the search may miss and its polynomials may err, and some more.
        assert!(below < 1e-7 && above < 1e-7, "{seed}: {below:e} {above:e}");
        together = together.max(brute.together);
    }
    assert!(together > 1, "pulses act together");
}

/// Shows an analysis what happens until `end`, and counts.
struct Until {
    analysis: StressAnalysis,
    end: f64,
    steps: usize,
    looks: usize,
}

impl Until {
    fn run(analysis: StressAnalysis, scene: &Scene, options: &Options, end: f64) -> Self {
        let mut until = Self { analysis, end, steps: 0, looks: 0 };
        simulate(scene, options, &mut until).expect("a run");
        until.analysis.finish().expect("finite loads");
        until
    }
}

impl Recorder for Until {
    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        if instant.after.snapshot.time <= self.end {
            self.analysis.instant(instant).map_err(io::Error::other)?;
        }
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        if step.span()[0] >= self.end {
            return Ok(());
        }
        let mut part = Part { step, end: self.end, looks: 0 };
        self.analysis.step(&mut part).map_err(io::Error::other)?;
        self.looks += part.looks;
        self.steps += 1;
        Ok(())
    }
}

/// The part of a step that is before `end`.
struct Part<'a> {
    step: &'a mut dyn StepMotion,
    end: f64,
    looks: usize,
}

impl StepMotion for Part<'_> {
    fn span(&self) -> [f64; 2] {
        self.step.span().map(|time| time.min(self.end))
    }

    fn goes_on(&self) -> bool {
        self.step.goes_on()
    }

    fn at(&mut self, time: f64) -> MotionAt<'_> {
        self.looks += 1;
        self.step.at(time)
    }
}

#[test]
fn it_does_not_depend_on_output_times() {
    for seed in 0..12 {
        let satellite = Satellite::new(1 + (seed % 4) as usize, seed);
        let with = |samples| {
            let options = Options { samples, ..Options::default() };
            envelope(&analysed(&satellite, &satellite.scene, &options))
        };
        assert_eq!(with(1), with(1000));
    }
}

#[test]
fn it_does_not_depend_on_how_long_the_run_goes_on() {
    for seed in 0..12 {
        let satellite = Satellite::new(1 + (seed % 4) as usize, seed);
        let end = satellite.scene.end_time;
        let options = Options { samples: 10, ..Options::default() };
        let envelope_of = |times: f64| {
            let scene = satellite.scene.clone().ending_at(times * end).expect("a time");
            let analysis = satellite.analysis(Settings::default());
            envelope(&Until::run(analysis, &scene, &options, end).analysis)
        };
        let [below, above] = below_and_above(&envelope_of(3.0), &envelope_of(1.0));
        // The last step of the shorter run is cut off, and what the search may miss.
        assert!(below < 1e-7 && above < 1e-7, "{seed}: {below:e} {above:e}");
    }
}

#[test]
fn most_steps_are_looked_at_in_few_places() {
    let (mut steps, mut looks) = (0, 0);
    for seed in 0..24 {
        let satellite = Satellite::new(1 + (seed % 4) as usize, seed);
        let end = satellite.scene.end_time;
        let analysis = satellite.analysis(Settings::default());
        let run = Until::run(analysis, &satellite.scene, &Options::default(), end);
        (steps, looks) = (steps + run.steps, looks + run.looks);
    }
    // Five points with the first one known, nine where something may become larger.
    assert!(looks < 9 * steps, "{looks} looks at {steps} steps");
}

/// A boom that swings on a spring, and in it a wheel that turns at `rate`.
fn with_a_wheel(rate: f64) -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let mut description = SceneDescription::at_rest("a wheel in a boom", hub, 60.0);
    let start = |rate| HingeStart { angle: 0.5, rate, state: HingeState::Free };
    let mut swings = Hinge { start: start(0.0), ..Hinge::free() };
    swings.spring.linear = -0.05;
    let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.01, 1.0));
    let wheel = MassProperties::new(2.0, Vec3::zero(), Sym3::diagonal(0.02, 0.04, 0.02));
    let hinge = Hinge { start: start(rate), ..Hinge::free() };
    let (mount, at_tip) = (Mount::at(Vec3::unit_x()), Mount::at(Vec3::unit_y()));
    let bodies = [
        (None, mount, Vec3::unit_z(), boom, swings),
        (Some(0), at_tip, Vec3::unit_y(), wheel, hinge),
    ];
    description.bodies.extend(bodies.map(|(inboard, mount, axis, mass_properties, hinge)| {
        let (joint, tip) = (Joint::Revolute, Vec3::zero());
        Body { inboard, mount, joint, axis, mass_properties, tip, hinge }
    }));
    Scene::new(description).expect("a boom and a wheel")
}

#[test]
fn a_wheel_that_turns_fast_costs_no_more_looks() {
    for rate in [4.0, 400.0, 4e3] {
        let scene = with_a_wheel(rate);
        let analysis = StressAnalysis::of_hinges(&scene, None, Settings::default());
        let analysis = analysis.expect("usual settings");
        let run = Until::run(analysis, &scene, &Options::default(), scene.end_time);
        let Until { looks, steps, .. } = run;
        // Nine points, the first one known; twice as many in few steps.
        assert!(looks < 9 * steps, "{rate}: {looks} looks at {steps} steps");
    }
}
