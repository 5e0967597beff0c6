//! Stops of hinges and slides.

use nboom_model::{
    Hinge, HingeState, Joint, Release, SceneDescription, Spring, Stops, TorqueTable,
};
use nboom_ode::Method;
use nboom_sim::{EventKind, Options};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use crate::friction::{METHODS, growing, kinds, run};
use crate::{BOOM, HUB, REDUCED, ball, free, rotors, scene, tight};

fn stops(lower: f64, upper: f64, restitution: f64) -> Stops {
    Stops { lower, upper, restitution }
}

/// A hinge that this torque turns at any angle.
fn pushed(description: &mut SceneDescription, hinge: usize, torque: f64) {
    let points = vec![[-10.0, torque], [10.0, torque]];
    description.torque_tables.push(TorqueTable { hinge, points });
}

/// Between two stops a boom goes to and fro, each time slower by the restitution; with one of 1 for ever.
#[test]
fn a_boom_rebounds_at_its_restitution() {
    for restitution in [0.6, 1.0] {
        let hinge = Hinge { stops: stops(-0.5, 1.0, restitution), ..free(0.0, 2.0) };
        let scene = scene(rotors(&[hinge], 6.0));
        for integrator in METHODS {
            let (told, summary) = run(&scene, Options { integrator, ..tight(50) });
            let (mut time, mut rate, mut at) = (0.0, 2.0_f64, 0.0);
            for event in &told.events[..told.events.len() - 1] {
                let stop = if rate > 0.0 { 1.0 } else { -0.5 };
                time += (stop - at) / rate;
                assert_eq!(event.kind, EventKind::Impact, "{integrator:?}");
                assert!((event.time - time).abs() < 1e-11, "{integrator:?}: {event:?}");
                let impulse = -(1.0 + restitution) * REDUCED * rate;
                let found = event.impulse.expect("an impact has one");
                assert!((found - impulse).abs() < 1e-12, "{found}, {impulse}");
                let lost = 0.5 * REDUCED * rate * rate * (1.0 - restitution * restitution);
                let found = event.before.kinetic_energy - event.after.kinetic_energy;
                assert!((found - lost).abs() < 1e-12, "{found}, {lost}");
                (at, rate) = (stop, -restitution * rate);
            }
            let next = if rate > 0.0 { 1.0 } else { -0.5 };
            assert!(time + (next - at) / rate > 6.0, "all impacts: {:?}", told.events);
            let last = told.last();
            assert!((last.beta[0] - (at + rate * (6.0 - time))).abs() < 1e-10);
            assert!((last.tau[0] - rate).abs() < 1e-11);
            assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
        }
    }
}

/// A constant torque presses a boom against its stop: it bounces as a ball does, each flight shorter by the restitution,
/// and rests once a rebound is below a thousandth of the first impact.
#[test]
fn a_boom_that_is_pressed_bounces_and_comes_to_rest() {
    let (restitution, torque, first) = (0.5_f64, 0.4, 1.2);
    let hinge = Hinge { stops: stops(f64::NEG_INFINITY, 0.3, restitution), ..free(0.3, -first) };
    let mut description = rotors(&[hinge], 20.0);
    pushed(&mut description, 0, torque);
    let scene = scene(description);
    let flight = 2.0 * first * REDUCED / torque;
    for integrator in METHODS {
        let (told, summary) = run(&scene, Options { integrator, ..tight(400) });
        // 0.5⁹ of the rate is the last one that rebounds by more than a thousandth.
        let mut expected = vec![EventKind::Impact; 10];
        expected.extend([EventKind::Rest, EventKind::End]);
        assert_eq!(kinds(&told.events), expected, "{integrator:?}");
        for (k, event) in told.events[..10].iter().enumerate() {
            let time = flight * (1.0 - restitution.powi(k as i32 + 1)) / (1.0 - restitution);
            assert!((event.time - time).abs() < 1e-9, "{integrator:?}, {k}: {} {time}", event.time);
        }
        assert_eq!(told.events[9].time, told.events[10].time);
        let verdict = &summary.verdict.hinges[0];
        assert_eq!((verdict.state, verdict.angle), (HingeState::Stuck, 0.3));
        assert!(told.samples.iter().all(|sample| sample.beta[0] <= 0.3), "{integrator:?}");
        assert!(summary.conservation.energy < 1e-10, "{integrator:?}: {:?}", summary.conservation);
        let account = told.last().account.expect("an output time has one");
        let had = 0.5 * REDUCED * first * first;
        assert!((account.lock_up_loss - had).abs() < 1e-9, "{integrator:?}: {account:?}");
    }
}

/// The hub is turned faster and faster: it draws the boom off its stop when that takes more than what presses it there,
/// with the friction of the hinge where it has some.
#[test]
fn a_boom_leaves_its_stop_when_it_is_drawn_off() {
    let (rate, torque) = (0.5, 0.2);
    for friction in [0.0, 0.1] {
        for sign in [1.0, -1.0] {
            let (stops, start) = match sign {
                1.0 => (stops(-1.0, 0.3, 0.0), 0.3),
                _ => (stops(-0.3, 1.0, 0.0), -0.3),
            };
            let hinge = Hinge { stops, friction, ..free(start, 0.0) };
            let mut description = rotors(&[hinge], 4.0);
            pushed(&mut description, 0, sign * torque);
            description.externals.push(growing(sign * rate));
            let scene = scene(description);
            let leaves = (torque + friction) * (HUB + BOOM) / (BOOM * rate);
            for integrator in METHODS {
                let (told, summary) = run(&scene, Options { integrator, ..tight(40) });
                let expected = [EventKind::Rest, EventKind::Leave, EventKind::End];
                assert_eq!(kinds(&told.events), expected, "{integrator:?}, {friction}, {sign}");
                let off = told.events[1].time - leaves;
                assert!(off.abs() < 1e-8, "{integrator:?}: {off:e}");
                for sample in &told.samples {
                    let since = (sample.time - leaves).max(0.0);
                    let expected = start - sign * rate * since.powi(3) / (6.0 * HUB);
                    assert!((sample.beta[0] - expected).abs() < 1e-9, "{integrator:?}");
                }
                // As for friction: the work of the torque errs most.
                assert!(summary.conservation.energy < 1e-7, "{:?}", summary.conservation);
            }
        }
    }
}

/// A lock-up turns the hub: a boom at its stop is pressed to it, and goes with the hub, or is left behind.
#[test]
fn a_stop_bears_the_impulse_of_a_lock_up_or_lets_go() {
    for sign in [1.0, -1.0] {
        let locks = Hinge { lock_angle: Some(0.5 * sign), ..free(0.0, sign) };
        let rests = Hinge { stops: stops(-1.0, 0.2, 0.0), ..free(0.2, 0.0) };
        let (told, summary) = run(&scene(rotors(&[locks, rests], 2.0)), tight(20));
        // The hub takes the first boom's momentum: relative to it the second one stays back.
        let (last, kinds) = (told.last(), kinds(&told.events));
        if sign > 0.0 {
            use EventKind::{End, Leave, LockUp, Rest};
            assert_eq!(kinds, [Rest, LockUp, Leave, End]);
            let rate = -BOOM / (HUB + BOOM);
            assert!((last.tau[1] - rate).abs() < 1e-12);
            assert!((last.beta[1] - (0.2 + 1.5 * rate)).abs() < 1e-11);
        } else {
            use EventKind::{End, Impact, LockUp, Rest};
            assert_eq!(kinds, [Rest, LockUp, Impact, End]);
            // All three turn together.
            let rate = -BOOM / (HUB + 2.0 * BOOM);
            assert_eq!((last.tau[1], last.beta[1]), (0.0, 0.2));
            assert!((last.omega_body.x - rate).abs() < 1e-12, "{:?}", last.omega_body);
            let [locked, borne] = [1, 2].map(|event| told.events[event].impulse.expect("one"));
            assert!((locked - BOOM * (rate + 1.0)).abs() < 1e-12, "{locked}");
            assert!((borne - BOOM * rate).abs() < 1e-12, "{borne}");
        }
        assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
        assert!(summary.conservation.angular_momentum.expect("it is free") < 1e-12);
    }
}

/// A hinge whose latch fails at its stop rebounds from it; one that latches there does not.
#[test]
fn a_latch_at_a_stop_locks() {
    let hinge = |lock_angle| Hinge { lock_angle, stops: stops(0.0, 1.0, 0.3), ..free(0.0, 1.0) };
    let (latched, _) = run(&scene(rotors(&[hinge(Some(1.0))], 2.0)), tight(1));
    assert_eq!(kinds(&latched.events), [EventKind::LockUp, EventKind::End]);
    let (failed, _) = run(&scene(rotors(&[hinge(None)], 2.0)), tight(1));
    assert_eq!(kinds(&failed.events), [EventKind::Impact, EventKind::End]);
    assert!((failed.last().beta[0] - 0.7).abs() < 1e-11);
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

/// A hinge that starts at its stop on the way beyond it hits it at once; one that is released there under a spring that
/// presses it stays.
#[test]
fn a_hinge_may_start_at_its_stop() {
    let hits = Hinge { stops: stops(-1.0, 0.0, 1.0), ..free(0.0, 1.0) };
    let (told, _) = run(&scene(rotors(&[hits], 0.5)), tight(1));
    assert_eq!(kinds(&told.events), [EventKind::Impact, EventKind::End]);
    assert_eq!(told.events[0].time, 0.0);
    assert!((told.last().beta[0] + 0.5).abs() < 1e-12);

    let spring = Spring { linear: -1.0, preload_angle: -0.5, ..Spring::default() };
    let mut stays = Hinge { spring, stops: stops(-1.0, 0.0, 1.0), ..free(0.0, 0.0) };
    (stays.release, stays.start.state) = (Release::Time(0.25), HingeState::Unreleased);
    let (told, _) = run(&scene(rotors(&[stays], 0.5)), tight(1));
    assert_eq!(kinds(&told.events), [EventKind::Release, EventKind::Rest, EventKind::End]);
    assert_eq!(told.last().beta[0], 0.0);
}

/// The stops of a slide, in units that make its travel a thousand times as large.
#[test]
fn a_slide_rebounds_in_any_unit() {
    for unit in [1.0, 1e3] {
        let hinge = Hinge { stops: stops(-0.5 * unit, unit, 0.5), ..free(0.0, unit) };
        let mut description = rotors(&[hinge], 2.9);
        description.bodies[0].joint = Joint::Prismatic;
        let (told, _) = run(&scene(description), tight(1));
        // At 1, and at -0.5 three later.
        assert_eq!(kinds(&told.events), [EventKind::Impact, EventKind::End], "{unit}");
        assert!((told.last().beta[0] / unit - (1.0 - 0.5 * 1.9)).abs() < 1e-11, "{unit}");
    }
}

/// A momentum wheel beside it does not make a slow hinge stick to its stop.
#[test]
fn a_fast_wheel_does_not_hide_what_draws_a_hinge_off() {
    let wheel = free(0.0, 400.0);
    let slow = Hinge { stops: stops(0.0, 1.0, 0.0), ..free(0.0, 0.0) };
    let mut description = rotors(&[wheel, slow], 100.0);
    let torque = 1e-5;
    pushed(&mut description, 1, torque);
    let (told, _) = run(&scene(description), Options { integrator: Method::Dop853, ..tight(1) });
    assert_eq!(kinds(&told.events), [EventKind::End]);
    let expected = 0.5 * torque / REDUCED * 1e4;
    assert!((told.last().beta[1] - expected).abs() < 1e-6 * expected, "{}", told.last().beta[1]);
}

/// Booms about one axis, of which one locks as another comes to its stop while others rest at theirs: at each stop an
/// impulse presses, and the hinge rebounds by its restitution, or no impulse acts, and it rebounds faster. Energy is
/// lost.
#[test]
fn stops_only_press() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1656);
    let mut any = move || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let (mut pressed, mut left) = (0, 0);
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
        assert!(after.kinetic_energy <= before.kinetic_energy, "{before:?}, {after:?}");
        assert!(after.tau[0] == 0.0);
        for (i, away) in [away].into_iter().chain(sides).enumerate().map(|(k, away)| (k + 1, away))
        {
            let presses = impulse(i) * away;
            // The rate at which the lock-up, which comes first, lets it come.
            let comes = before.tau[i] - inertias[0] * rate / (HUB + inertias[0]);
            let share = if i == 1 && comes * away < 0.0 { restitution } else { 0.0 };
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
    assert!(pressed > 300 && left > 300, "{pressed}, {left}");
}
