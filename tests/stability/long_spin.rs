//! Free spin for thousands of periods: momentum and energy by `gauss` and by the other methods.

use std::f64::consts::TAU;

use nboom::io::read_scene;
use nboom::model::{Appendage, HingeState, Mount, Scene, Segment, Spring};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Method, Options, Summary};

use crate::collect::{Collected, run};
use crate::stress::{checked, free};

/// Stiffness of the booms' hinges; their swings are slower than the spin.
const STIFFNESS: f64 = 4.0;

/// The report's satellite, `periods` turns about its angular momentum beyond the last lock-up.
fn report(periods: f64) -> Scene {
    let deck = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/n-boom-1970.nml");
    let mut scene = (*read_scene(deck.as_ref()).expect("the example is valid").scene).clone();
    scene.thrust = None;
    let (found, _) = run(&checked(scene.clone()), &gauss(1));
    let last = found.events.iter().rev().nth(1).expect("four hinges lock");
    assert!(last.1.hinges.iter().all(|hinge| *hinge == HingeState::Locked));
    scene.end_time = last.0.time + periods * TAU / last.1.omega_body.norm();
    checked(scene)
}

/// An asymmetric hub that spins at 1 rad/s, and two booms on springs without dashpots.
fn swinging(periods: f64) -> Scene {
    let hub = nboom::model::MassProperties::new(
        20.0,
        Vec3::new(0.1, -0.05, 0.02),
        Sym3::diagonal(30.0, 24.0, 18.0),
    );
    let boom = nboom::model::MassProperties::new(
        1.0,
        Vec3::unit_y() * 1.5,
        Sym3::diagonal(2.0, 0.1, 2.0),
    );
    let mut scene =
        nboom::model::SceneDescription::at_rest("swinging booms", hub, periods * TAU);
    for (side, angle) in [(1.0, 0.2), (-1.0, -0.1)] {
        let mut hinge = free(angle, 0.0);
        hinge.spring = Spring { quadratic: 0.0, linear: -STIFFNESS, preload_angle: 0.0 };
        scene.attach(&Appendage::Regular {
            mount: Mount::at(Vec3::unit_y() * side),
            segments: vec![Segment { length: 3.0, mass_properties: boom, hinge }],
        });
    }
    scene.initial.omega_body = Vec3::new(1.0, 0.1, 0.05);
    checked(scene)
}

fn gauss(samples: usize) -> Options {
    Options { samples, integrator: Method::Gauss, rtol: 1e-12, atol: 1e-14, ..Options::default() }
}

/// Energy of a sample; the hinges' springs do not store any where they are held.
fn energy(sample: &nboom::sim::Snapshot) -> f64 {
    let free = sample.hinges.iter().zip(&sample.beta).filter(|(h, _)| **h == HingeState::Free);
    sample.kinetic_energy + free.map(|(_, beta)| 0.5 * STIFFNESS * beta * beta).sum::<f64>()
}

/// Largest relative change of energy and momentum from `start` until each sample after it.
fn growth(found: &Collected, start: f64) -> Vec<(f64, f64, f64)> {
    let samples: Vec<_> = found.samples.iter().filter(|s| s.time >= start).collect();
    let (e, h) = (energy(samples[0]), samples[0].angular_momentum_inertial);
    let mut worst = (0.0_f64, 0.0_f64);
    let until = |sample: &&nboom::sim::Snapshot| {
        worst.0 = worst.0.max((energy(sample) / e - 1.0).abs());
        worst.1 = worst.1.max((sample.angular_momentum_inertial - h).norm() / h.norm());
        (sample.time - start, worst.0, worst.1)
    };
    samples.iter().map(until).collect()
}

/// The exponent with which a residual grows from a tenth of the span to its end.
fn exponent(growth: &[(f64, f64, f64)], of: impl Fn(&(f64, f64, f64)) -> f64) -> f64 {
    let (tenth, end) = (&growth[growth.len() / 10], &growth[growth.len() - 1]);
    (of(end) / of(tenth)).log(end.0 / tenth.0)
}

fn told(name: &str, options: &Options, scene: &Scene) -> Summary {
    let start = std::time::Instant::now();
    let (found, summary) = run(scene, options);
    let last = found.events.iter().rev().nth(1).map_or(0.0, |(event, _)| event.time);
    let growth = growth(&found, last);
    let (_, e, h) = growth[growth.len() - 1];
    println!(
        "{name} {} {:e}: energy {e:.1e} t^{:.2}, momentum {h:.1e} t^{:.2}, norm {:.1e}, {} steps, {} rejected, \
         {} evaluations, {:.1} s",
        options.integrator, options.rtol,
        exponent(&growth, |g| g.1),
        exponent(&growth, |g| g.2),
        summary.attitude_drift,
        summary.steps_accepted,
        summary.steps_rejected,
        summary.evaluations,
        start.elapsed().as_secs_f64()
    );
    summary
}

#[test]
fn quick() {
    for scene in [report(100.0), swinging(100.0)] {
        told(&scene.name, &gauss(1000), &scene);
        told(&scene.name, &Options { integrator: Method::Dop853, ..gauss(1000) }, &scene);
    }
}

#[test]
#[ignore = "minutes"]
fn ten_thousand_periods() {
    for scene in [report(1e4), swinging(1e4)] {
        for integrator in [Method::Gauss, Method::Dop853, Method::Dopri5, Method::Radau5] {
            for rtol in [1e-9, 1e-12] {
                let atol = 1e-2 * rtol;
                let max_steps = usize::MAX;
                told(&scene.name, &Options { integrator, rtol, atol, max_steps, ..gauss(1000) }, &scene);
            }
        }
    }
}

#[test]
#[ignore = "an hour"]
fn a_million_periods() {
    for scene in [report(1e6), swinging(1e6)] {
        let max_steps = usize::MAX;
        told(&scene.name, &Options { max_steps, ..gauss(1000) }, &scene);
    }
}
