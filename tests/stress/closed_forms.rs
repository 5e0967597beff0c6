//! Stresses of one boom against what is known without a computer.

use nboom::scalar::Vec3;
use nboom::strength::Settings;

use crate::follow::{
    Follow, HUB_MASS, LENGTH, MASS, PULSE_CONSTANT, RADIUS, STATIONS, THICKNESS, held, swinging,
};

#[test]
fn a_spinning_rod_is_in_tension() {
    let spin = 3.0;
    let follow = Follow::run(&held(Vec3::unit_z() * spin), Settings::default());
    // From the mass centre of rod and hub, about which they turn.
    let center = MASS * 0.5 * LENGTH / (HUB_MASS + MASS);
    let area = 2.0 * std::f64::consts::PI * RADIUS * THICKNESS;
    for stresses in &follow.at_samples {
        for (stress, s) in stresses.iter().zip(STATIONS) {
            let arms = 0.5 * (LENGTH - center).powi(2) - 0.5 * (s - center).powi(2);
            let tension = MASS / LENGTH * spin * spin * arms / area;
            // A uniform tension, up to the roundings of a run over a few steps.
            let at = stress.max_von_mises.stress;
            assert!((at.normal - tension).abs() < 1e-11 * tension, "{s}: {at:?} {tension}");
            assert!(at.shear() < 1e-11 * tension, "{s}: {at:?}");
        }
    }
    assert_eq!(follow.at_samples.len(), 11);
}

#[test]
fn at_a_lock_up_the_hinge_carries_the_latchs_impulse_over_its_pulse_constant() {
    for amplification in [1.0, 1.7] {
        let settings = Settings { amplification, ..Settings::default() };
        let follow = Follow::run(&swinging(), settings);
        let [impulse] = follow.impulses[..] else { panic!("one lock-up: {:?}", follow.impulses) };
        let [at_lock_up] = &follow.at_lock_ups[..] else { panic!("one lock-up") };
        let at_hinge = at_lock_up.last().expect("the last station is at the hinge").load;
        // Nothing else acts about the axis of a hinge without spring and dashpot.
        let peak = amplification * impulse / PULSE_CONSTANT;
        assert!((at_hinge.moment.x - peak).abs() < 1e-9 * peak.abs(), "{at_hinge:?} {peak}");
    }
}

#[test]
fn a_pulse_is_added_to_what_the_motion_makes() {
    let with = |amplification| {
        let follow = Follow::run(&swinging(), Settings { amplification, ..Settings::default() });
        follow.at_lock_ups[0].iter().map(|at| at.load.moment.x).collect::<Vec<f64>>()
    };
    let [half, one, two] = [0.5, 1.0, 2.0].map(with);
    for i in 0..STATIONS.len() {
        // Linear in the amplification, and not proportional to it away from the hinge.
        let (first, second) = (one[i] - half[i], two[i] - one[i]);
        assert!((second - 2.0 * first).abs() < 1e-9 * second.abs(), "{half:?} {one:?} {two:?}");
    }
}
