//! Runs: what is done in each step, from one event to the next.

use std::collections::BTreeSet;

use nboom::elements::Kind;
use nboom::formulation::Formulation;
use nboom::model::{HingeState, Release, Scene, SceneDescription};
use nboom::ode::Method;
use nboom::sim::{Event, EventKind, Form, Options, Recorder, Snapshot, StepMotion, simulate};
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
    let options =
        Options { samples: 1, rtol: 1e-13, atol: 1e-15, formulation, ..Options::default() };
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
