//! Runs: what is done in each step, from one event to the next.

use std::collections::BTreeSet;
use std::path::Path;

use nboom::elements::Kind;
use nboom::formulation::Formulation;
use nboom::model::{Course, External, ExternalAxes, HingeState, Release, Scene, SceneDescription};
use nboom::ode::Method;
use nboom::scalar::Vec3;
use nboom::sim::{
    Commands, Control, Event, EventKind, Form, Nobody, Options, OwnLaw, Recorder, Simulator,
    Snapshot, StepMotion, simulate,
};
use nboom::strength::{Settings, StressAnalysis};

use crate::counting::{allocations, so_far};
use crate::{scene_and_mode, structure};

/// Counts what an analysis asks for while it looks at steps, and the evaluations of the equations of motion
/// and of the loads for it.
struct Counted {
    analysis: StressAnalysis,
    steps: usize,
    /// Of the steps after the first ones.
    allocations: usize,
}

impl Recorder for Counted {
    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> std::io::Result<()> {
        let analysis = &mut self.analysis;
        let count = allocations(|| analysis.step(step).expect("loads balance"));
        self.steps += 1;
        self.allocations += if self.steps > 2 { count } else { 0 };
        Ok(())
    }
}

#[test]
fn looking_for_the_worst_of_a_step_allocates_nothing() {
    let momentum = Some(Form::Closed(Formulation::Momentum));
    [None, momentum].into_iter().for_each(looking_allocates_nothing);
}

fn looking_allocates_nothing(formulation: Option<Form>) {
    let (scene, _) = scene_and_mode();
    // Its dashpots feed energy, later.
    let scene = scene.ending_at(0.3).expect("a time");
    let analysis = StressAnalysis::new(&scene, &structure(&scene), Settings::default());
    let mut counted =
        Counted { analysis: analysis.expect("tubes are sections"), steps: 0, allocations: 0 };
    let (integrator, rtol, atol) = (Method::Dop853, 1e-13, 1e-15);
    let options = Options { samples: 1, integrator, rtol, atol, formulation, ..Options::default() };
    simulate(&scene, &options, &mut counted).expect("an ordinary motion");
    assert!(counted.steps > 5, "{} steps", counted.steps);
    assert_eq!(counted.allocations, 0, "in {} steps", counted.steps);
    assert!(counted.analysis.envelope().iter().all(|worst| worst.driver.is_some()));
}

/// Counts what a run asks for from the events of one instant to the last step before the next.
#[derive(Default)]
struct Watched {
    /// What had been asked for at the last step or event; nothing is counted up to the first.
    before: Option<usize>,
    steps: usize,
    events: BTreeSet<EventKind>,
    allocations: usize,
}

impl Recorder for Watched {
    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, _step: &mut dyn StepMotion) -> std::io::Result<()> {
        let now = so_far();
        self.allocations += now - self.before.unwrap_or(now);
        self.steps += 1;
        self.before = Some(now);
        Ok(())
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> std::io::Result<()> {
        self.events.insert(event.kind);
        self.before = Some(so_far());
        Ok(())
    }
}

/// A tree some of whose hinges lock, one of which another one releases, and with springs that let go.
fn eventful() -> Scene {
    let mut scene = SceneDescription::clone(&scene_and_mode().0);
    for (i, body) in scene.bodies.iter_mut().enumerate() {
        let start = &mut body.hinge.start;
        let ahead = |share: f64| start.angle + share * start.rate;
        match i {
            2 => (start.state, start.rate) = (HingeState::Unreleased, 0.0),
            3 => body.hinge.lock_angle = Some(ahead(0.1)),
            6 => body.hinge.lock_angle = Some(ahead(0.2)),
            _ => (),
        }
    }
    let trigger = &scene.bodies[5].hinge.start;
    let angle = trigger.angle + 0.04 * trigger.rate;
    scene.bodies[2].hinge.release = Release::Angle { hinge: 5, angle };
    scene.end_time = 0.4;
    Scene::new(scene).expect("a physical scene")
}

#[test]
fn looking_for_events_allocates_nothing() {
    let scene = eventful();
    for integrator in [Method::Dop853, Method::GaussLanes, Method::Auto] {
        let options =
            Options { integrator, samples: 1, rtol: 1e-13, atol: 1e-15, ..Options::default() };
        let mut watched = Watched::default();
        simulate(&scene, &options, &mut watched).expect("an ordinary motion");
        let kinds = [EventKind::LockUp, EventKind::Release, EventKind::Rise(Kind::KickOff)];
        assert!(kinds.iter().all(|kind| watched.events.contains(kind)), "{:?}", watched.events);
        assert_eq!(watched.allocations, 0, "{integrator}, {} steps", watched.steps);
    }
}

/// A deck of this repository.
fn deck(path: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    nboom::io::read_scene(&path).expect("a valid deck").scene
}

#[test]
fn runs_after_the_first_allocate_nothing() {
    let with_routines = Options {
        kernels: nboom_routines::for_runs(),
        batches: nboom_routines::right_sides_of_eight(),
        ..Options::default()
    };
    for path in [
        "examples/n-boom-1970.nml",
        "tests/data/scenes/s06_gravity_thrust.nml",
        "tests/data/scenes/s08_kickoff_disengage.nml",
    ] {
        for options in [Options::default(), with_routines] {
            // Taylor's power series are made anew for each mode that is entered.
            for integrator in Method::ALL.into_iter().filter(|&m| m != Method::Taylor) {
                let options = Options { integrator, ..options };
                let options = Options { rtol: 1e-6, atol: 1e-9, ..options };
                later_runs_allocate_nothing(&deck(path), options, path);
                later_runs_allocate_nothing(&pushed(path), options, path);
            }
        }
    }
}

/// The deck with more from outside: on a hinged body, along inertial axes, over time.
fn pushed(path: &str) -> Scene {
    let mut scene = SceneDescription::clone(&deck(path));
    let span = scene.end_time - scene.initial.time;
    let time = |share: f64| scene.initial.time + share * span;
    let course = Course::Table(vec![[time(0.1), 0.0], [time(0.4), 1.0], [time(0.9), 0.5]]);
    let thrust = External::thrust(Vec3::unit_x() * 1e-3, Vec3::unit_y(), [time(0.2), time(0.7)]);
    let inertial = ExternalAxes::Inertial;
    scene.externals.push(External { body: Some(0), ..thrust.clone() });
    scene.externals.push(External { course, axes: inertial, ..thrust });
    Scene::new(scene).expect("a valid deck under more forces")
}

fn later_runs_allocate_nothing(scene: &Scene, options: Options, name: &str) {
    let mut simulator = Simulator::new(scene, options);
    let first = simulator.run(&mut Nobody).expect("an ordinary motion").clone();
    for _ in 0..2 {
        let count = allocations(|| {
            std::hint::black_box(simulator.run(&mut Nobody).expect("an ordinary motion"));
        });
        assert_eq!(count, 0, "{name}, {}, {first:?}", options.integrator);
    }
}

#[test]
fn later_runs_under_a_control_law_allocate_nothing() {
    let scene = deck("tests/data/scenes/s06_gravity_thrust.nml");
    let kernels = nboom_routines::for_runs();
    let own = OwnLaw::new(0, |beta: f64, tau: f64| -0.1 * beta.sin() - 0.1 * tau);
    for mut simulator in [
        Simulator::new(&scene, Options::default()),
        Simulator::new(&scene, Options { kernels, ..Options::default() }),
        Simulator::under_laws(&scene, Options::default(), vec![own]),
    ] {
        let mut run = || {
            let mut law = |seen: &Snapshot, commands: &mut Commands| {
                commands.hinge_torques_mut()[0] = (3.0 * seen.time).sin();
                commands.main_body.force.x = (seen.time - 0.5).max(0.0);
            };
            let control = Control { period: 0.1, law: &mut law };
            simulator
                .run_controlled(control, &mut Nobody)
                .expect("an ordinary motion")
                .steps_accepted
        };
        let steps = run();
        assert_eq!(allocations(|| assert_eq!(run(), steps)), 0, "{steps} steps");
    }
}
