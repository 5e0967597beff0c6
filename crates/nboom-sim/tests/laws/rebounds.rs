//! Stops in whole satellites, against steep springs and between methods.

use nboom_model::{Scene, SceneDescription, Stops};
use nboom_ode::Method;
use nboom_sim::{EventKind, Options, OwnLaw, Simulator};

use crate::friction::{kinds, run};
use crate::{Told, apart, methods_agree, reference, runs_again, tight};

/// A scene whose latches have failed: hinges come to stops in their places.
fn failed(name: &str, restitution: f64) -> Scene {
    let mut description = SceneDescription::clone(&reference(name));
    for body in &mut description.bodies {
        let hinge = &mut body.hinge;
        let Some(lock) = hinge.lock_angle.take() else { continue };
        let stops = Stops { restitution, ..Stops::NONE };
        hinge.stops = match lock > hinge.start.angle {
            true => Stops { upper: lock, ..stops },
            false => Stops { lower: lock, ..stops },
        };
    }
    Scene::new(description).expect("bodies are physical")
}

const FAILED: [&str; 4] =
    ["s03_chain3_general", "s04_paddle_general", "s10_symmetric_lock", "s13_initial_states"];

/// Stops as the limit of stiffer and stiffer springs, which give back all energy, on hinges of a satellite that turns in
/// space.
#[test]
fn stops_are_the_limit_of_stiff_springs() {
    for name in FAILED {
        let exact = failed(name, 1.0);
        let (expected, summary) = run(&exact, tight(40));
        let impacts = expected.events.iter().filter(|of| of.kind == EventKind::Impact).count();
        println!("{name}: {impacts} impacts, {:e}", summary.conservation.energy);
        assert!(impacts > 0, "{name}: {:?}", kinds(&expected.events));
        assert!(summary.conservation.energy < 1e-9, "{name}: {:?}", summary.conservation);
        let off = |stiffness: f64| {
            let mut soft = SceneDescription::clone(&exact);
            let laws = soft.bodies.iter_mut().enumerate().map(|(i, body)| {
                let Stops { lower, upper, .. } = std::mem::take(&mut body.hinge.stops);
                OwnLaw::new(i, move |beta, _| {
                    stiffness * ((lower - beta).max(0.0) - (beta - upper).max(0.0))
                })
            });
            let laws = laws.collect();
            let soft = Scene::new(soft).expect("bodies are physical");
            let options = Options { integrator: Method::Dop853, rtol: 1e-10, ..tight(40) };
            let (mut simulator, mut told) =
                (Simulator::under_laws(&soft, options, laws), Told::default());
            simulator.run(&mut told).expect("it runs to its end");
            let pairs = told.samples.iter().zip(&expected.samples);
            pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
        };
        let [coarse, fine] = [1e6, 1e10].map(off);
        println!("{name}: {coarse:e}, {fine:e}");
        // The time of an impact is inverse to the root of the stiffness.
        assert!(fine < 0.02 * coarse, "{name}: {coarse:e}, {fine:e}");
    }
}

/// Methods find the same impacts and the same end.
#[test]
fn methods_agree_on_impacts() {
    for name in FAILED {
        methods_agree(name, &failed(name, 0.4));
    }
}

/// Also of satellites with other stops or none.
#[test]
fn a_simulator_runs_again_as_if_it_were_new() {
    let with = |restitution| failed(FAILED[0], restitution);
    runs_again(&[with(0.4), with(0.0), reference(FAILED[0]), with(0.4)]);
}
