//! Free spin for thousands of periods: momentum and energy by `gauss` and by the other methods.

use std::f64::consts::TAU;

use nboom::io::read_scene;
use nboom::model::{
    Appendage, HingeState, MassProperties, Mount, Scene, SceneDescription, Segment, Spring,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{EventKind, Method, Options, Snapshot};

use crate::collect::{Collected, run};
use crate::stress::{checked, free};

/// Of the swinging booms' hinges.
const STIFFNESS: f64 = 4.0;

/// The report's satellite for `periods` turns after its last lock-up, when it is rigid.
fn report(periods: f64) -> Scene {
    let deck = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/n-boom-1970.nml");
    let mut scene = (*read_scene(deck.as_ref()).expect("the example is valid").scene).clone();
    let (found, _) = run(&checked(scene.clone()), &gauss(1e-9));
    let rigid = last_lock_up(&found).expect("four hinges lock");
    assert!(rigid.hinges.iter().all(|hinge| *hinge == HingeState::Locked));
    scene.end_time = rigid.time + periods * TAU / rigid.omega_body.norm();
    checked(scene)
}

/// A hub without symmetry that turns once in a period, with two booms on springs without dashpots.
fn swinging(periods: f64) -> Scene {
    let inertia = Sym3::diagonal(30.0, 24.0, 18.0);
    let hub = MassProperties::new(20.0, Vec3::new(0.1, -0.05, 0.02), inertia);
    let boom = MassProperties::new(1.0, Vec3::unit_y() * 1.5, Sym3::diagonal(2.0, 0.1, 2.0));
    let mut scene = SceneDescription::at_rest("swinging booms", hub, periods * TAU);
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

fn gauss(rtol: f64) -> Options {
    let (samples, max_steps) = (1000, usize::MAX);
    let integrator = Method::Gauss;
    Options { samples, integrator, rtol, atol: 0.01 * rtol, max_steps, ..Options::default() }
}

fn last_lock_up(found: &Collected) -> Option<&Snapshot> {
    let mut backwards = found.events.iter().rev();
    backwards.find(|(event, _)| event.kind == EventKind::LockUp).map(|(_, after)| after)
}

/// Kinetic energy, and what the springs of the hinges that swing have stored.
fn energy(sample: &Snapshot) -> f64 {
    let hinges = sample.hinges.iter().zip(&sample.beta);
    let stored = |(state, beta): (&HingeState, &f64)| match state {
        HingeState::Free => 0.5 * STIFFNESS * beta * beta,
        _ => 0.0,
    };
    sample.kinetic_energy + hinges.map(stored).sum::<f64>()
}

/// Largest relative changes of energy and angular momentum until some time.
#[derive(Clone, Copy)]
struct Residuals {
    since: f64,
    energy: f64,
    momentum: f64,
}

/// Those until each output time of the free spin.
fn residuals(found: &Collected) -> Vec<Residuals> {
    let start = last_lock_up(found).unwrap_or(&found.samples[0]);
    let (e, h) = (energy(start), start.angular_momentum_inertial);
    let mut largest = Residuals { since: 0.0, energy: 0.0, momentum: 0.0 };
    let spin = found.samples.iter().filter(|sample| sample.time > start.time);
    let until = |sample: &Snapshot| {
        largest.since = sample.time - start.time;
        largest.energy = largest.energy.max((energy(sample) / e - 1.0).abs());
        let change = sample.angular_momentum_inertial - h;
        largest.momentum = largest.momentum.max(change.norm() / h.norm());
        largest
    };
    spin.map(until).collect()
}

/// Residuals at the end, and the power of time with which that of energy grew since a tenth.
fn follow(scene: &Scene, options: &Options) -> (Residuals, f64) {
    let (found, summary) = run(scene, options);
    let all = residuals(&found);
    let (tenth, end) = (all[all.len() / 10], all[all.len() - 1]);
    let power = (end.energy / tenth.energy).log(end.since / tenth.since);
    println!(
        "{} | {} {:e} | energy {:.1e} as t^{power:.2} | momentum {:.1e} | norm {:.1e} | {} steps",
        scene.name,
        options.integrator,
        options.rtol,
        end.energy,
        end.momentum,
        summary.attitude_drift,
        summary.steps_accepted
    );
    (end, power)
}

/// What free spin owes under `gauss`.
fn check(scene: &Scene, options: &Options) {
    let (end, power) = follow(scene, options);
    // Momentum is that of the rate it gives, to rounding.
    assert!(end.momentum < 1e-14, "{}: {:e}", scene.name, end.momentum);
    assert!(end.energy < 1e-12, "{}: {:e}", scene.name, end.energy);
    // A random walk grows as t^0.5, on average; a trend as t.
    assert!(power < 0.75, "{}: t^{power}", scene.name);
}

#[test]
fn a_hundred_periods() {
    for scene in [report(100.0), swinging(100.0)] {
        for rtol in [1e-9, 1e-12] {
            check(&scene, &gauss(rtol));
        }
    }
}

/// A ball that turns about one axis at a rate of 1: half the angle that its attitude is behind after
/// full turns, and the drift of its norm.
fn spin(turns: f64, options: &Options) -> [f64; 2] {
    let ball = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut scene = SceneDescription::at_rest("ball", ball, turns * TAU);
    scene.initial.omega_body = Vec3::unit_x();
    let (found, summary) = run(&checked(scene), options);
    // After full turns it is the unit quaternion or its opposite.
    [found.last().attitude.vector.x.abs().asin(), summary.attitude_drift]
}

/// Where the absolute tolerance is the larger one, steps are as long as the norm allows. With a norm
/// that is put back to 1 they are of one length, and each of them errs as the one before.
#[test]
fn attitude_and_norm_drift_as_much_in_every_turn() {
    let (integrator, rtol, atol) = (Method::Dop853, 1e-6, 1e-3);
    let options = Options { samples: 1, integrator, rtol, atol, ..Options::default() };
    let [few, many] = [200.0, 2000.0].map(|turns| spin(turns, &options));
    println!("{few:?}, {many:?}");
    for (few, many) in few.into_iter().zip(many) {
        assert!(few > 0.01, "{few:e} is too little to matter to steps");
        // The first steps are others, and so are the last ones: a few of each of some thousand.
        assert!((9.7..10.3).contains(&(many / few)), "{few:e}, then {many:e}");
    }
}

#[test]
#[ignore = "minutes"]
fn ten_thousand_periods() {
    for scene in [report(1e4), swinging(1e4)] {
        for rtol in [1e-9, 1e-12] {
            check(&scene, &gauss(rtol));
        }
        for (integrator, rtol) in [
            (Method::Dop853, 1e-9),
            (Method::Dop853, 1e-12),
            (Method::Dopri5, 1e-9),
            (Method::Radau5, 1e-9),
        ] {
            follow(&scene, &Options { integrator, ..gauss(rtol) });
        }
    }
}

#[test]
#[ignore = "an hour"]
fn a_million_periods() {
    for scene in [report(1e6), swinging(1e6)] {
        check(&scene, &gauss(1e-9));
    }
}
