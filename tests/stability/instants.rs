//! Lock-ups close to each other, thresholds that chatter, springs that engage again.

use nboom::model::{
    Appendage, Dashpot, Hinge, KickOffSpring, Mount, SceneDescription, Segment, Spring,
};
use nboom::scalar::Vec3;
use nboom::sim::EventKind::LockUp;
use nboom::sim::{Options, SimError};

use crate::collect::{DISENGAGES, ENGAGES, run, try_run};
use crate::stress::{ball, both, chain, checked, conserving, error, free, options};

const HUB: f64 = 4.0;
const BOOM: f64 = 1.0;
const RATE: f64 = 2.0;

/// Two rotors on a hub that is one, too, which lock at 0.5 and `apart` later.
fn rotors(apart: f64) -> SceneDescription {
    let mut scene = SceneDescription::at_rest("rotors", ball(2.0, 0.0, HUB), 1.0);
    // The first lock-up turns the hub, so that the second angle closes faster or slower by it.
    let angle = |late: f64| -RATE * (0.5 + late);
    for hinge in [free(angle(0.0), RATE), free(angle(apart), RATE)] {
        let hinge = Hinge { lock_angle: Some(0.0), ..hinge };
        let boom = Segment { length: 1.0, mass_properties: ball(2.0, 0.0, BOOM), hinge };
        scene.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments: vec![boom] });
    }
    scene
}

#[test]
fn lock_ups_1e_minus_14_to_1e_minus_10_apart_end_alike() {
    for apart in [0.0, 1e-14, 1e-13, 1e-12, 4e-12, 6e-12, 1e-10] {
        let scene = checked(rotors(apart));
        for options in both(&options(4)) {
            let (found, _) = run(&scene, &options);
            let happened = found.happenings();
            let kinds: Vec<_> = happened.iter().map(|h| (h.0, h.1)).collect();
            assert_eq!(kinds, [(LockUp, Some(0)), (LockUp, Some(1))], "{apart:e}");
            // One instant is the time in which they turn by 1e-11.
            assert_eq!(
                happened[0].2 == happened[1].2,
                apart < 1e-11 / RATE,
                "{apart:e} {happened:?}"
            );
            // All turns about one axis: whatever the order, angular momentum gives the rate.
            let expected = 2.0 * BOOM * RATE / (HUB + 2.0 * BOOM);
            let after = found.last();
            let off = (after.omega_body.x - expected).abs();
            println!("{apart:e}: {off:.1e}");
            // Some ten roundings.
            assert!(off < 4e-15, "{apart:e}: {off:e}");
            assert_eq!(after.tau, [0.0, 0.0]);
            // What is locked early stays short of its lock angle by what it had to go.
            assert!(after.beta.iter().all(|b| b.abs() < RATE * 1e-11), "{:?}", after.beta);
        }
    }
}

/// At a million time units a time is known to 1.2e-10; what is closer happens at the same time, in
/// one instant or in two.
#[test]
fn lock_ups_closer_than_the_digits_of_time_are_both_made() {
    for apart in [0.0, 1e-12, 2e-11, 5e-11, 1e-10] {
        let mut scene = rotors(apart);
        scene.initial.time = 1e6;
        scene.end_time = 1e6 + 1.0;
        for options in both(&options(4)) {
            let (found, _) = run(&checked(scene.clone()), &options);
            let happened = found.happenings();
            assert_eq!(happened.len(), 2, "{apart:e}: {happened:?}");
            assert!(happened.iter().all(|h| (h.2 - 1e6 - 0.5).abs() < 1.3e-10), "{happened:?}");
            let expected = 2.0 * BOOM * RATE / (HUB + 2.0 * BOOM);
            assert!((found.last().omega_body.x - expected).abs() < 4e-15, "{apart:e}");
        }
    }
}

const A: f64 = 1.0;
const B: f64 = 0.8;

/// A rotor with a kick-off spring that pushes with `force` up to a length of 0.9.
fn pushed(hinge: Hinge, force: f64, end_time: f64) -> SceneDescription {
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::unit_y() * A,
        body_point: Vec3::unit_y() * B,
        coefficients: [force, 0.0, 0.0, 0.0],
        limit_length: 0.9,
    });
    let segments = [(ball(2.0, 0.0, BOOM), Hinge { kick_off, ..hinge })];
    chain(ball(2.0, 0.0, HUB), Vec3::zero(), &segments, end_time)
}

/// β at which the kick-off spring has its limit length.
fn limit_angle() -> f64 {
    ((A * A + B * B - 0.81) / (2.0 * A * B)).acos()
}

/// A spring that drives back what the kick-off spring drives out: the boom comes to rest at the
/// limit length, which it passes ever more often.
#[test]
fn a_threshold_that_chatters_ends_in_a_typed_error_or_is_passed() {
    let mut chattered = 0;
    for (damping, end_time) in [(0.0, 20.0), (0.1, 20.0), (1.0, 50.0)] {
        for start in [0.5, 1.0, 1.1] {
            let mut hinge = free(start * limit_angle(), 0.0);
            hinge.spring = Spring { quadratic: 0.0, linear: -1.0, preload_angle: 0.0 };
            hinge.dashpot = Dashpot { rate_linear: -damping, ..Dashpot::default() };
            let scene = checked(pushed(hinge, 3.0, end_time));
            for options in both(&Options { rtol: 1e-9, max_events: 2000, ..options(10) }) {
                let (found, result) = try_run(&scene, &options);
                println!("{damping} {start}: {} events", found.events.len());
                assert!(found.events.len() <= 2000, "{}", found.events.len());
                match result {
                    Ok(_) if damping == 1.0 => panic!("its throws have no end"),
                    Ok(summary) => assert!(summary.conservation.energy < 1e-6, "{summary:?}"),
                    Err(failure) => {
                        use SimError::{Chatter, EventsUsedUp};
                        let is_told = matches!(failure.error, Chatter { .. } | EventsUsedUp { .. });
                        assert!(is_told, "{failure}");
                        chattered += 1;
                    }
                }
            }
        }
    }
    assert!(chattered > 0, "nothing chattered");
}

#[test]
fn a_spring_that_engages_again_gives_back_what_it_took() {
    // Thrown out, swung back by the hinge's spring, thrown out again.
    let mut hinge = free(0.2, 0.0);
    hinge.spring = Spring { quadratic: 0.0, linear: -1.0, preload_angle: 0.0 };
    let scene = checked(pushed(hinge, 3.0, 60.0));
    for options in both(&options(50)) {
        let (found, _) = conserving(&scene, &options, 10.0);
        let happened = found.happenings();
        println!("{} events", happened.len());
        assert!(happened.len() > 10, "{happened:?}");
        let alternate = [DISENGAGES, ENGAGES];
        assert!(happened.iter().zip(alternate.iter().cycle()).all(|(h, &kind)| h.0 == kind));
        let (off, same_events) = error(&scene, &options);
        // Some thousand steps, and errors of phase grow no faster than time.
        assert!(same_events && off < 1000.0 * 10.0 * options.rtol, "{off:e}");
    }
}
