//! The worst of each station, and runs that are not to know of it.

use nboom::sim::{Options, simulate};
use nboom::strength::{Cause, Component, Settings, StationStress, StrengthError};

use crate::collect::Collected;
use crate::follow::{Follow, STATIONS, analysis, swinging};

#[test]
fn the_envelope_is_no_less_than_all_that_was_told() {
    let limit = 3e8;
    let settings =
        Settings { yield_stress: Some(limit), safety_factor: 1.25, ..Settings::default() };
    let follow = Follow::run(&swinging(), settings);
    let envelope = follow.analysis.envelope();
    assert_eq!(envelope.len(), STATIONS.len());
    for (station, worst) in envelope.iter().enumerate() {
        let von_mises = |all: &Vec<StationStress>| all[station].max_von_mises.stress.von_mises();
        let told = follow.at_samples.iter().chain(&follow.at_lock_ups);
        let largest = told.map(von_mises).fold(0.0, f64::max);
        let found = worst.max_von_mises.stress.von_mises();
        assert_eq!(worst.station, station);
        // By what the search may miss.
        assert!(found >= largest * (1.0 - 1e-7), "{found} {largest}");
        assert_eq!(worst.margins.on_yield, Some(limit / (1.25 * found) - 1.0));
    }
    // A latch that stops a swing bends the root, about the hinge's axis.
    let root = envelope.last().expect("stations");
    assert_eq!(root.driver, Some(Component::MomentXi));
    let Cause::Pulse { hinge: 0, share, .. } = root.cause else { panic!("{root:?}") };
    assert!(share > 0.9 && share < 1.1, "{share}");
}

#[test]
fn loads_balance_the_torques_of_free_hinges() {
    let follow = Follow::run(&swinging(), Settings::default());
    // A few roundings of the numbers that loads are made of.
    assert!(follow.analysis.largest_residual() < 1e-13, "{}", follow.analysis.largest_residual());
}

#[test]
fn accelerations_that_contradict_the_torques_are_refused() {
    let scene = swinging();
    let follow = Follow::run(&scene, Settings::default());
    let snapshot = &follow.samples[0];
    let mut detail = snapshot.detail.clone().expect("detail was asked for");
    let mut fresh = analysis(&scene, Settings::default()).expect("tubes are sections");
    assert!(fresh.motion(snapshot, &detail).is_ok());
    // A hinge that is accelerated by no torque.
    detail.beta_ddot[0] += 1e-3;
    let refused = fresh.motion(snapshot, &detail);
    assert!(matches!(refused, Err(StrengthError::Unbalanced { .. })), "{refused:?}");
}

#[test]
fn stresses_change_nothing_in_the_run() {
    let scene = swinging();
    let options = Options { samples: 10, rtol: 1e-12, atol: 1e-14, ..Options::default() };
    let mut plain = Collected::default();
    simulate(&scene, &options, &mut plain).expect("a smooth motion");
    let follow = Follow::run(&scene, Settings::default());
    assert_eq!(follow.samples, plain.samples);
}

#[test]
fn settings_that_are_no_factors_are_refused() {
    let scene = swinging();
    let refused = |settings| analysis(&scene, settings).err();
    assert_eq!(refused(Settings::default()), None);
    for (settings, name) in [
        (Settings { amplification: 0.0, ..Settings::default() }, "dynamic amplification"),
        (Settings { yield_stress: Some(f64::NAN), ..Settings::default() }, "yield stress"),
        (Settings { safety_factor: f64::INFINITY, ..Settings::default() }, "safety factor"),
    ] {
        let Some(StrengthError::Setting { name: found, .. }) = refused(settings) else {
            panic!("{settings:?}")
        };
        assert_eq!(found, name);
    }
}
