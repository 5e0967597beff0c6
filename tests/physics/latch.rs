//! The latch micro-benchmark: a panel that turns on a spinning hub is latched in motion.
//!
//! Three well-known engines set the hinge rate to zero there and lose 28 % of the angular
//! momentum. The numbers below are the exact projection as an independent rigid-body library
//! computes it, to the digits given; see also Section 7 of the report.

use nboom::model::{Body, Hinge, Joint, MassProperties, Mount, SceneDescription};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::EventKind;

use super::log::{options, run};

/// A hub of 100 kg and a panel of 10 kg on a hinge along z.
fn scene(lock_angle: Option<f64>, end_time: f64) -> SceneDescription {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let panel = MassProperties::new(10.0, Vec3::new(0.5, 0.0, 0.0), Sym3::diagonal(0.1, 1.0, 1.0));
    let mut scene = SceneDescription::at_rest("latch", hub, end_time);
    let mut hinge = Hinge { lock_angle, ..Hinge::free() };
    hinge.start.rate = 1.0;
    scene.bodies.push(Body {
        inboard: None,
        mount: Mount::at(Vec3::unit_x()),
        joint: Joint::Revolute,
        axis: Vec3::unit_z(),
        mass_properties: panel,
        tip: Vec3::unit_x(),
        hinge,
    });
    scene.initial.omega_body = Vec3::new(0.2, 0.0, 0.0);
    scene
}

/// Whether a number is the printed one, to half a unit of its last digit.
fn prints_as(found: f64, printed: &str) -> bool {
    let decimals = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
    format!("{found:.decimals$}") == printed
}

#[test]
fn a_latch_in_motion_loses_no_momentum() {
    let tight = options(1, 1e-13);
    let before = run(&scene(None, 0.5), &tight);
    let start = &before.samples[0];
    let h = start.angular_momentum_inertial;
    assert!(prints_as(h.x, "8.020") && prints_as(h.y.abs(), "0.000") && prints_as(h.z, "7.818"));
    assert!(prints_as(h.norm(), "11.2002"), "{}", h.norm());
    assert!(prints_as(start.kinetic_energy, "2.5520"), "{}", start.kinetic_energy);
    assert!(prints_as(before.last().tau[0], "0.9475"), "{}", before.last().tau[0]);

    // A hinge locks at an angle: the one that it has after half a second.
    let angle = before.last().beta[0];
    let latched = run(&scene(Some(angle), 1.5), &tight);
    let locks = latched.of_kind(EventKind::LockUp);
    let [(event, after)] = locks[..] else { panic!("one lock-up expected") };
    // The angle found carries the rounding and the tolerance of the first run.
    assert!((event.time - 0.5).abs() < 1e-12, "{}", event.time);
    let impulse = event.impulse.expect("a lock-up has an impulse");
    assert!(prints_as(impulse, "-1.8568"), "{impulse}");
    assert!(prints_as(event.before.kinetic_energy, "2.5520"));
    assert!(prints_as(event.after.kinetic_energy, "1.672315"), "{}", event.after.kinetic_energy);
    assert!(prints_as(after.omega_body.z, "0.19413"), "{}", after.omega_body.z);
    assert_eq!(after.tau[0], 0.0);

    // Nothing is lost: neither in the instant (rounding) nor over the run (tolerance).
    let change = event.after.angular_momentum_inertial - event.before.angular_momentum_inertial;
    assert!(change.norm() < 1e-14 * h.norm(), "{:e}", change.norm());
    let change = event.after.linear_momentum_inertial - event.before.linear_momentum_inertial;
    assert!(change.norm() < 1e-14, "{:e}", change.norm());
    for seen in [after, latched.last()] {
        let change = (seen.angular_momentum_inertial - h).norm();
        assert!(change < 1e-12 * h.norm(), "{change:e}");
        assert!(prints_as(seen.kinetic_energy, "1.672315"));
    }
    // Carnot: ½ Λ τ is the energy lost.
    let lost = event.before.kinetic_energy - event.after.kinetic_energy;
    let rate = before.last().tau[0];
    assert!((lost + 0.5 * impulse * rate).abs() < 1e-12);
}
