//! Laws that a program brings itself: control laws at a sample rate, and laws of hinge torques.

mod contacts;
mod control;
mod friction;
mod letting_go;
mod own;
mod rebounds;
mod rough;
mod stops;
mod wheels;

use std::io;
use std::path::Path;

use nboom_model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom_ode::Method;
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::{Event, EventKind, Options, Recorder, Simulator, Snapshot};

use friction::run;

/// Moment of inertia of the hub about its axis.
const HUB: f64 = 4.0;
/// Moment of inertia of the boom about it.
const BOOM: f64 = 1.0;
/// Reduced moment of inertia of the two: a torque Q about the hinge makes β̈ = Q / `REDUCED`.
const REDUCED: f64 = HUB * BOOM / (HUB + BOOM);

fn ball(moment: f64) -> MassProperties {
    MassProperties::new(2.0, Vec3::zero(), Sym3::diagonal(moment, moment, moment))
}

/// A hub and booms that turn about the x axis, through all mass centres.
fn rotors(hinges: &[Hinge], end_time: f64) -> SceneDescription {
    let mut description = SceneDescription::at_rest("rotors", ball(HUB), end_time);
    for &hinge in hinges {
        let segments = vec![Segment { length: 1.0, mass_properties: ball(BOOM), hinge }];
        description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    }
    description
}

fn scene(description: SceneDescription) -> Scene {
    Scene::new(description).expect("bodies are physical")
}

/// A hinge that starts free.
fn free(angle: f64, rate: f64) -> Hinge {
    Hinge { start: HingeStart { angle, rate, state: HingeState::Free }, ..Hinge::free() }
}

/// A reference scene, whose tolerances and events are those of a whole deployment.
fn reference(name: &str) -> Scene {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/scenes");
    let path = Path::new(folder).join(name).with_extension("nml");
    nboom_io::read_scene(&path).expect("reference decks are valid").scene
}

fn tight(samples: usize) -> Options {
    Options { samples, rtol: 1e-12, atol: 1e-14, ..Options::default() }
}

/// Keeps all that a run tells.
#[derive(Debug, Default, PartialEq)]
struct Told {
    samples: Vec<Snapshot>,
    events: Vec<Event>,
}

impl Told {
    fn last(&self) -> &Snapshot {
        self.samples.last().expect("every run has a first output time")
    }

    fn kinds(&self) -> Vec<(EventKind, Option<usize>)> {
        self.events.iter().map(|event| (event.kind, event.hinge)).collect()
    }
}

impl Recorder for Told {
    fn needs_detail(&self) -> bool {
        true
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.samples.push(snapshot.clone());
        Ok(())
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        self.events.push(*event);
        Ok(())
    }
}

/// The largest difference of the angles, rates and attitudes of two states.
fn apart(a: &Snapshot, b: &Snapshot) -> f64 {
    let numbers = |seen: &Snapshot| {
        let mut all = [&seen.beta[..], &seen.tau].concat();
        all.extend(seen.omega_body.to_array());
        all.extend(seen.attitude.vector.to_array());
        all.extend(seen.position_inertial.to_array());
        all
    };
    let pairs = numbers(a).into_iter().zip(numbers(b));
    pairs.fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

/// Methods that share nothing but the equations find the same events and the same end.
fn methods_agree(name: &str, scene: &Scene) {
    let (expected, _) = run(scene, tight(4));
    for integrator in [Method::Dopri5, Method::GaussLanes, Method::Adams, Method::Taylor] {
        let (found, _) = run(scene, Options { integrator, ..tight(4) });
        assert_eq!(found.kinds(), expected.kinds(), "{name}, {integrator:?}");
        // Tolerances of 1e-12, magnified by the events on the way.
        for (a, b) in found.events.iter().zip(&expected.events) {
            assert!((a.time - b.time).abs() < 1e-7, "{name}, {integrator:?}: {a:?}, {b:?}");
        }
        let off = apart(found.last(), expected.last());
        assert!(off < 1e-8, "{name}, {integrator:?}: {off:e}");
    }
}

/// Runs of one simulator are those of new ones to the last bit.
fn runs_again(scenes: &[Scene]) {
    let mut simulator = Simulator::new(&scenes[0], tight(4));
    for scene in scenes {
        simulator.set_scene(scene);
        for _ in 0..2 {
            let mut told = Told::default();
            simulator.run(&mut told).expect("it runs to its end");
            assert_eq!(told, run(scene, tight(4)).0);
        }
    }
}
