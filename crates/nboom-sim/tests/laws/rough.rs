//! Coulomb's friction in whole satellites, against steep dampers and between methods.

use nboom_model::{Hinge, Scene, SceneDescription};
use nboom_ode::Method;
use nboom_sim::{EventKind, Options, OwnLaw, Simulator};

use crate::friction::{kinds, run};
use crate::{Told, apart, methods_agree, reference, runs_again, tight};

/// A scene whose hinges have this share of the torque of their springs at the start as friction.
fn rough(name: &str, share: f64) -> Scene {
    let mut description = SceneDescription::clone(&reference(name));
    for body in &mut description.bodies {
        let Hinge { spring, start, .. } = body.hinge;
        let from = start.angle + spring.preload_angle;
        body.hinge.friction = share * ((spring.quadratic * from + spring.linear) * from).abs();
    }
    Scene::new(description).expect("bodies are physical")
}

/// Scenes with friction in which hinges stick, slip, turn back and lock.
const ROUGH: [(&str, f64); 5] = [
    ("s03_chain3_general", 0.9),
    ("s04_paddle_general", 0.9),
    ("s07_quadratic_terms", 0.6),
    ("s08_kickoff_disengage", 0.9),
    ("s13_initial_states", 2.0),
];

/// Friction as the limit of steeper and steeper dampers, on hinges of a satellite that turns in space: the same motion
/// but for what a hinge creeps that ought to stick.
#[test]
fn friction_is_the_limit_of_steep_dampers() {
    for (name, share) in ROUGH {
        let exact = rough(name, share);
        let (expected, summary) = run(&exact, tight(40));
        let sticks = expected.events.iter().filter(|event| event.kind == EventKind::Stick).count();
        assert!(sticks > 0, "{name}: {:?}", kinds(&expected.events));
        assert!(summary.conservation.energy < 1e-9, "{name}: {:?}", summary.conservation);
        let off = |steepness: f64| {
            let mut smooth = SceneDescription::clone(&exact);
            let laws = smooth.bodies.iter_mut().enumerate().map(|(i, body)| {
                let friction = std::mem::take(&mut body.hinge.friction);
                OwnLaw::new(i, move |_, tau| -friction * (tau * steepness).tanh())
            });
            let laws = laws.collect();
            let smooth = Scene::new(smooth).expect("bodies are physical");
            let options = Options { integrator: Method::Radau9, rtol: 1e-9, ..tight(40) };
            let (mut simulator, mut told) =
                (Simulator::under_laws(&smooth, options, laws), Told::default());
            simulator.run(&mut told).expect("it runs to its end");
            let pairs = told.samples.iter().zip(&expected.samples);
            pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
        };
        let [coarse, fine] = [1e3, 1e5].map(off);
        // Creeping is inverse to steepness.
        println!("{name}: {coarse:e}, {fine:e}");
        assert!(fine < 1e-3 && fine < 0.05 * coarse, "{name}: {coarse:e}, {fine:e}");
    }
}

/// Methods find the same events and the same end.
#[test]
fn methods_agree_on_sticking_and_slipping() {
    for (name, share) in ROUGH {
        methods_agree(name, &rough(name, share));
    }
}

/// Also of satellites with other friction or none.
#[test]
fn a_simulator_runs_again_as_if_it_were_new() {
    runs_again(&[0.9, 0.3, 0.0, 0.9].map(|share| rough("s03_chain3_general", share)));
}
