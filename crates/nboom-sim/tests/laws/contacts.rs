//! Several hinges at stops, latches and cables at once.

use nboom_model::{
    Appendage, Coupling, Hinge, HingeStart, HingeState, MassProperties, Mount, Release, Segment,
    Spring, Stops,
};
use nboom_ode::Method;
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::{Event, EventKind, Options};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use crate::friction::{METHODS, kinds, run};
use crate::stops::{pushed, stops};
use crate::{BOOM, HUB, ball, free, rotors, scene, tight};

/// A lock-up sends a hinge off its stop in the instant in which another rebounds, which presses it back: no energy is
/// made.
#[test]
fn a_lock_up_and_a_rebound_make_no_energy() {
    for share in [0.01, 0.1, 0.5] {
        let locks = Hinge { lock_angle: Some(share), ..free(0.0, share) };
        let rebounds = Hinge { stops: stops(-1.0, 9.0, 1.0), ..free(0.0, -1.0) };
        let rests = Hinge { stops: stops(-9.0, 0.0, 0.0), ..free(0.0, 0.0) };
        let (told, summary) = run(&scene(rotors(&[locks, rebounds, rests], 2.0)), tight(2));
        let [before, after, _] = &told.samples[..] else { panic!("three output times") };
        let alone = 0.5 * share * share * HUB * BOOM / (HUB + BOOM);
        assert!(after.kinetic_energy <= before.kinetic_energy - alone * (1.0 - 1e-3), "{share}");
        assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
    }
}

/// A cable over pulleys holds a stowed hinge at its stop by a torque that cancels but for rounding.
#[test]
fn a_cable_without_pull_leaves_a_hinge_at_its_stop() {
    // Of so many angles and ratios some round to a pull off the stop.
    for case in 0..60 {
        let stiffness = [10.0, 300.0, 1e6][case % 3];
        let angle = 1.1 + 0.01 * case as f64;
        let held = Hinge {
            start: HingeStart { angle, rate: 0.0, state: HingeState::Unreleased },
            release: Release::Time(2.0),
            ..free(0.0, 0.0)
        };
        let stowed = angle / 1.3;
        let rests = Hinge { stops: stops(-1.0, stowed, 0.2), ..free(stowed, 0.0) };
        let mut description = rotors(&[held, rests], 4.0);
        let (hinges, ratio) = ([1, 0], 1.0 / 1.3);
        let (rest, damping, is_mutual) = (0.0, 0.0, true);
        description.couplings.push(Coupling { hinges, ratio, stiffness, rest, damping, is_mutual });
        let (told, _) = run(&scene(description), tight(1));
        let expected = [EventKind::Rest, EventKind::Release, EventKind::End];
        assert_eq!(kinds(&told.events), expected, "{angle}, {stiffness}");
    }
}

/// Booms about one axis, of which one locks as another comes to its stop while others rest at theirs: at each stop an
/// impulse presses, and the hinge rebounds by its restitution, or no impulse acts, and it rebounds faster. Energy is
/// lost.
#[test]
fn stops_only_press() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1656);
    let mut any = move || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let (mut pressed, mut left, mut plastic) = (0, 0, 0);
    for _ in 0..300 {
        let sign = |any: f64| if any < 0.5 { -1.0 } else { 1.0 };
        let rate = sign(any());
        let mut hinges = vec![Hinge { lock_angle: Some(rate), ..free(0.0, rate) }];
        let (away, speed) = (sign(any()), 0.1 + any());
        let restitution = any();
        let at = |away: f64, angle: f64, restitution| match away {
            1.0 => stops(angle, 9.0, restitution),
            _ => stops(-9.0, angle, restitution),
        };
        let arrives = Stops { restitution, ..at(away, -away * speed, restitution) };
        hinges.push(Hinge { stops: arrives, ..free(0.0, -away * speed) });
        let sides = [sign(any()), sign(any()), sign(any())];
        hinges.extend(sides.map(|away| Hinge { stops: at(away, 0.0, 0.7), ..free(0.0, 0.0) }));
        let mut description = rotors(&hinges, 2.0);
        let inertias: Vec<f64> = (0..5).map(|_| 0.2 + 3.0 * any()).collect();
        for (body, &inertia) in description.bodies.iter_mut().zip(&inertias) {
            body.mass_properties = ball(inertia);
        }
        let (told, _) = run(&scene(description), tight(2));
        let [before, after, _] = &told.samples[..] else { panic!("three output times") };
        let turned = after.omega_body.x - before.omega_body.x;
        let impulse = |i: usize| inertias[i] * (turned + after.tau[i] - before.tau[i]);
        let all: f64 = (0..5).map(impulse).sum();
        assert!((HUB * turned + all).abs() < 1e-12, "the angular momentum");
        // The lock-up takes this, and impacts give nothing back.
        let taken = 0.5 * rate * rate * inertias[0] * HUB / (HUB + inertias[0]);
        let most = before.kinetic_energy - taken + 1e-12;
        assert!(after.kinetic_energy <= most, "{before:?}, {after:?}");
        assert!(after.tau[0] == 0.0);
        for (i, away) in [away].into_iter().chain(sides).enumerate().map(|(k, away)| (k + 1, away))
        {
            let presses = impulse(i) * away;
            // The rate at which the lock-up, which comes first, lets it come.
            let comes = before.tau[i] - inertias[0] * rate / (HUB + inertias[0]);
            let mut share = if i == 1 && comes * away < 0.0 { restitution } else { 0.0 };
            if presses > 1e-9 && share > 1e-3 && after.tau[i].abs() < 1e-12 {
                // A rebound would have made energy.
                (share, plastic) = (0.0, plastic + 1);
            }
            let faster = (after.tau[i] + share * comes) * away;
            assert!(presses > -1e-12 && faster > -1e-12, "{i}: {presses}, {faster}");
            assert!(presses < 1e-12 || faster < 1e-12, "{i}: {presses}, {faster}");
            let mut events = told.events.iter().filter(|event| (event.time - 1.0).abs() < 1e-9);
            let event = events.find(|of| (of.kind, of.hinge) == (EventKind::Impact, Some(i)));
            let found = event.map_or(0.0, |of| of.impulse.expect("an impact has one"));
            assert!((found - impulse(i)).abs() < 1e-11, "{i}: {found}, {presses}");
            if presses > 1e-9 { pressed += 1 } else { left += 1 }
        }
    }
    assert!(pressed > 300 && left > 300 && plastic < 60, "{pressed}, {left}, {plastic}");
}

/// Booms that come to their stops in one instant, each with its own restitution, as another one locks: energy is lost.
#[test]
fn rebounds_of_different_restitutions_make_no_energy() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1687);
    let mut any = move || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    for _ in 0..300 {
        let mut rate = || (0.1 + any()) * if any() < 0.5 { -1.0 } else { 1.0 };
        let (locks, comes) = (rate(), [rate(), rate(), rate()]);
        let mut hinges = vec![Hinge { lock_angle: Some(locks), ..free(0.0, locks) }];
        hinges.extend(comes.map(|rate| {
            let (lower, upper) = if rate > 0.0 { (-9.0, rate) } else { (rate, 9.0) };
            Hinge { stops: stops(lower, upper, any()), ..free(0.0, rate) }
        }));
        let mut description = rotors(&hinges, 2.0);
        let inertias: Vec<f64> = hinges.iter().map(|_| 0.2 + 3.0 * any()).collect();
        for (body, &inertia) in description.bodies.iter_mut().zip(&inertias) {
            body.mass_properties = ball(inertia);
        }
        let (told, summary) = run(&scene(description), tight(2));
        let impacts = told.events.iter().filter(|of| of.kind == EventKind::Impact);
        assert!(impacts.take(3).all(|of| (of.time - 1.0).abs() < 1e-9), "{:?}", told.events);
        let [before, after, _] = &told.samples[..] else { panic!("three output times") };
        // The lock-up takes this, and impacts give nothing back.
        let taken = 0.5 * locks * locks * inertias[0] * HUB / (HUB + inertias[0]);
        assert!(after.kinetic_energy <= before.kinetic_energy - taken + 1e-12, "{comes:?}");
        assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
    }
}

/// Booms that are pressed against their stops alike bounce alike, each time in one instant.
#[test]
fn booms_that_do_the_same_bounce_together() {
    for integrator in METHODS {
        for restitution in [0.2, 0.7] {
            let boom = |sign: f64| Hinge {
                stops: stops(-1.0, 1.0, restitution),
                ..free(0.1 * sign, 0.3 * sign)
            };
            let mut description = rotors(&[1.0, -1.0, 1.0, -1.0].map(boom), 20.0);
            for (hinge, sign) in [1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
                pushed(&mut description, hinge, 0.2 * sign);
            }
            let (told, _) = run(&scene(description), Options { integrator, ..tight(1) });
            let (last, all) = told.events.split_last().expect("there is an end");
            assert_eq!(last.kind, EventKind::End);
            for four in all.chunks(4) {
                let is_alike = |of: &Event| (of.time, of.kind) == (four[0].time, four[0].kind);
                assert!(four.len() == 4 && four.iter().all(is_alike), "{integrator:?}: {four:?}");
            }
        }
    }
}

/// An impact at one hinge of a chain sends the other off its stop, and so on, ever more feebly: they come to rest, by all
/// methods after the same events.
#[test]
fn hinges_that_send_each_other_off_come_to_rest() {
    let hinge = |start: f64, upper: bool| {
        let (angle, rest) = if upper { (0.1, 0.5) } else { (-0.2, -0.5) };
        let stops = if upper { stops(-1.0, angle, 0.3) } else { stops(angle, 1.0, 0.3) };
        let spring = Spring { linear: -2.0, preload_angle: -rest, ..Spring::default() };
        Hinge { spring, stops, ..free(start, 0.0) }
    };
    let body = MassProperties::new(2.0, Vec3::unit_y() * 0.5, Sym3::diagonal(0.2, 0.2, 0.2));
    let segment = |hinge| Segment { length: 0.8, mass_properties: body, hinge };
    let mut description = rotors(&[], 30.0);
    let segments = vec![segment(hinge(0.7, false)), segment(hinge(-0.7, true))];
    let mount = Mount::at(Vec3::new(0.0, 0.8, 0.0));
    description.attach(&Appendage::Regular { mount, segments });
    let scene = scene(description);
    let (expected, summary) = run(&scene, tight(4));
    let sent_off = expected.events.iter().filter(|of| of.kind == EventKind::Leave).count();
    assert!(sent_off > 4, "{:?}", expected.kinds());
    assert!(summary.verdict.hinges.iter().all(|of| of.state == HingeState::Stuck));
    for integrator in METHODS.into_iter().chain([Method::Adams, Method::Radau9, Method::Radau13]) {
        let (found, summary) = run(&scene, Options { integrator, ..tight(4) });
        assert_eq!(found.kinds(), expected.kinds(), "{integrator:?}");
        assert!(summary.conservation.energy < 1e-7, "{integrator:?}: {:?}", summary.conservation);
        for (a, b) in found.events.iter().zip(&expected.events) {
            assert!((a.time - b.time).abs() < 1e-6, "{integrator:?}: {a:?}, {b:?}");
        }
    }
}

/// Two booms that do the same reach their stops in one instant, and each rebounds as it would alone on a hub that does
/// not turn.
#[test]
fn mirrored_booms_rebound_together() {
    let boom = |sign: f64| Hinge { stops: stops(-1.0, 1.0, 0.5), ..free(0.0, sign) };
    let (told, _) = run(&scene(rotors(&[boom(1.0), boom(-1.0)], 2.0)), tight(1));
    assert_eq!(kinds(&told.events), [EventKind::Impact, EventKind::Impact, EventKind::End]);
    assert_eq!(told.events[0].time, told.events[1].time);
    for (event, sign) in told.events.iter().zip([1.0, -1.0]) {
        assert!((event.time - 1.0).abs() < 1e-12);
        assert!((event.impulse.expect("one") + 1.5 * sign * BOOM).abs() < 1e-12);
    }
    assert!((told.last().beta[0] - 0.5).abs() < 1e-12 && told.last().omega_body.norm() < 1e-14);
}
