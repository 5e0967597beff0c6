//! What is left of the balances does not depend on when somebody looks.

use nboom::model::{
    Body, Dashpot, Hinge, HingeStart, HingeState, Joint, MassProperties, Mount, SceneDescription,
    Spring,
};
use nboom::scalar::{Sym3, Vec3};

use super::log::{options, run};

/// A satellite at rest with a boom beside its mass centre, on a spring.
fn boom(hinge: Hinge, end_time: f64) -> SceneDescription {
    let hub = MassProperties::new(50.0, Vec3::zero(), Sym3::diagonal(20.0, 30.0, 25.0));
    let mut scene = SceneDescription::at_rest("boom", hub, end_time);
    scene.bodies.push(Body {
        inboard: None,
        mount: Mount::at(Vec3::new(0.3, 0.5, 0.1)),
        joint: Joint::Revolute,
        axis: Vec3::unit_x(),
        mass_properties: MassProperties::new(
            4.0,
            Vec3::new(0.1, 1.0, 0.0),
            Sym3::diagonal(1.4, 0.1, 1.4),
        ),
        tip: Vec3::unit_y() * 2.0,
        hinge: Hinge {
            start: HingeStart { angle: 1.5, rate: 0.0, state: HingeState::Free },
            spring: Spring { quadratic: 0.0, linear: -2.0, preload_angle: 0.0 },
            ..hinge
        },
    });
    scene
}

/// The satellite is at rest at its initial time and at its end, and what is left of its angular momentum there is
/// compared with what the bodies had in between. A latch closes at the fastest moment; on the way to rest every
/// sixteenth step is looked at, which misses that moment, but not by two orders. The end alone would make the
/// residuals larger by seven.
#[test]
fn few_output_times_find_the_residuals_of_many() {
    let latching = boom(Hinge { lock_angle: Some(0.0), ..Hinge::free() }, 30.0);
    // It creeps to its rest without an event.
    let dashpot = Dashpot { rate_linear: -3.0, ..Dashpot::default() };
    let damped = boom(Hinge { dashpot, ..Hinge::free() }, 60.0);
    for (scene, latches, factor) in [(latching, true, 2.0), (damped, false, 100.0)] {
        let [few, many] = [1, 200].map(|samples| run(&scene, &options(samples, 1e-7)));
        assert_eq!(few.events.len() > 1, latches);
        assert!(few.last().tau[0].abs() < 1e-6 && few.last().omega_body.norm() < 1e-5);
        let of = |found: super::log::Log| {
            found.summary.conservation.angular_momentum.expect("a free main body")
        };
        let (few, many) = (of(few), of(many));
        assert!(few > 0.0 && few <= factor * many, "latches {latches}: {few:e} {many:e}");
    }
}
