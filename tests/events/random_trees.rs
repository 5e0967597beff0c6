//! No event is missed: random trees with every kind of event against events found by steps a
//! hundred times finer than those of the run, in another way ([`Sampled`]).

use std::ops::Range;

use nboom::dynamics::{Motion, Recursive};
use nboom::model::{Course, HingeState, Release, Scene, SceneDescription};
use nboom::sim::Options;

use crate::collect::run;
use crate::error_bound::largest_share;
use crate::random_scene::{Rng, description, spring};
use crate::sampled::{Happening, Sampled};

/// Steps of the comparison at least, so that its own error is below that of the run.
const FEWEST: f64 = 2000.0;

/// A tree of one to six bodies for one time unit: springs, dashpots, kick-off springs and thrust
/// as in other random scenes, latches, and releases by time and by angles of other hinges.
fn eventful(seed: u64) -> SceneDescription {
    let dice = &mut Rng::new(seed ^ 0xe7e7);
    let bodies = 1 + dice.below(6);
    let mut scene = description(bodies, seed);
    scene.end_time = 1.0;
    for thrust in &mut scene.externals {
        let on = dice.between(-0.3, 1.0);
        thrust.course = Course::Pulse { on, off: on + dice.between(0.0, 0.8) };
    }
    for i in 0..bodies {
        let hinge = &mut scene.bodies[i].hinge;
        // Torques that grow as squares would let the motion run away.
        hinge.spring.quadratic *= 0.1;
        hinge.dashpot.rate_quadratic *= 0.1;
        hinge.dashpot.angle_quadratic *= 0.1;
        if dice.chance(0.6) {
            hinge.lock_angle = Some(hinge.start.angle + dice.between(-0.5, 0.5));
        }
        if dice.chance(0.4) {
            hinge.start.state = HingeState::Unreleased;
            hinge.start.rate = 0.0;
            hinge.release = Release::Time(dice.between(-0.1, 0.7));
        }
        let other = dice.below(bodies);
        let (angle, lock) = (dice.between(-0.5, 0.5), dice.chance(0.3));
        if scene.bodies[i].hinge.start.state == HingeState::Unreleased
            && other != i
            && dice.chance(0.6)
        {
            let trigger = &scene.bodies[other].hinge;
            let by_itself = trigger.start.angle + angle;
            let angle = trigger.lock_angle.filter(|_| lock).unwrap_or(by_itself);
            scene.bodies[i].hinge.release = Release::Angle { hinge: other, angle };
        }
    }
    let lengths = spring_lengths(&scene);
    for (body, length) in scene.bodies.iter_mut().zip(lengths) {
        if let Some(spring) = &mut body.hinge.kick_off {
            spring.limit_length = length * dice.between(0.8, 1.2);
        }
    }
    scene
}

/// Length of each kick-off spring as the scene starts; zero where there is none.
fn spring_lengths(description: &SceneDescription) -> Vec<f64> {
    let scene = checked(description);
    let free = scene.bodies.iter().filter(|body| body.hinge.start.state == HingeState::Free);
    let beta: Vec<f64> = free.map(|body| body.hinge.start.angle).collect();
    let tau = vec![0.0; beta.len()];
    let motion = Motion { omega_body: scene.initial.omega_body, beta: &beta, tau: &tau };
    let dynamics = Recursive::new(&scene);
    let length = |i: usize| {
        let line = scene.bodies[i].hinge.kick_off.map(|_| spring(&scene.bodies, i));
        line.map_or(0.0, |line| {
            dynamics.line_length(line, |j| [motion.beta[j], motion.tau[j]]).squared.sqrt()
        })
    };
    (0..scene.bodies.len()).map(length).collect()
}

fn checked(description: &SceneDescription) -> Scene {
    Scene::new(description.clone()).expect("a physical scene")
}

fn events_of(description: &SceneDescription, options: &Options) -> (Vec<Happening>, usize) {
    let (found, summary) = run(&checked(description), options);
    (found.happenings(), summary.steps_accepted)
}

/// What a comparison of many scenes comes to.
#[derive(Debug, Default)]
struct Tally {
    events: usize,
    mismatches: Vec<u64>,
    /// The largest difference of times, and its scene.
    worst: (f64, u64),
    /// The largest difference in units of what had to be allowed, and its scene.
    worst_share: (f64, u64),
    /// Most steps whose share of what is allowed was needed, and all of that run.
    most_terms: (usize, usize),
}

impl Tally {
    fn compare(&mut self, seed: u64, options: &Options, finer: f64) {
        let description = eventful(seed);
        let (found, steps) = events_of(&description, options);
        let scene = checked(&description);
        let mut sampled = Sampled::new(&scene);
        sampled.run(scene.end_time / (finer * steps as f64).max(FEWEST));
        let names =
            |events: &[Happening]| -> Vec<_> { events.iter().map(|e| (e.0, e.1)).collect() };
        if names(&found) != names(&sampled.events) {
            println!("scene {seed}: {found:?}\n{:?}", sampled.events);
            self.mismatches.push(seed);
            return;
        }
        self.events += found.len();
        let off = |(found, expected): (&Happening, &Happening)| (found.2 - expected.2).abs();
        let off: Vec<f64> = found.iter().zip(&sampled.events).map(off).collect();
        let worst = off.iter().fold(0.0, |worst: f64, &off| worst.max(off));
        let (share, terms) = largest_share(&description, options, &found, &off);
        for (worst, now) in [(&mut self.worst, worst), (&mut self.worst_share, share)] {
            *worst = if now > worst.0 { (now, seed) } else { *worst };
        }
        self.most_terms = self.most_terms.max((terms, steps));
    }
}

/// Compares scenes with steps that are `finer` than the run's so many times.
fn compare(seeds: Range<u64>, rtol: f64, finer: f64) {
    let options = Options { samples: 1, rtol, atol: 1e-3 * rtol, ..Options::default() };
    let mut tally = Tally::default();
    seeds.clone().for_each(|seed| tally.compare(seed, &options, finer));
    println!("{tally:?}");
    assert!(tally.mismatches.is_empty(), "{tally:?}");
    assert!(tally.worst_share.0 <= 1.0, "{tally:?}");
    // The scenes are here for their events.
    assert!(tally.events as u64 > 2 * (seeds.end - seeds.start), "{tally:?}");
}

#[test]
fn no_event_of_some_random_trees_is_missed() {
    // At the default tolerance, and at one that lets guards go and come back within a step.
    compare(0..150, 1e-9, 20.0);
    compare(0..150, 1e-5, 20.0);
}

#[test]
#[ignore = "long; figures in docs/accuracy.md"]
fn no_event_of_10_000_random_trees_is_missed() {
    compare(0..10_000, 1e-9, 100.0);
}
