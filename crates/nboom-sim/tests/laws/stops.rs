//! Stops of hinges and slides.

use nboom_model::{
    Course, External, Hinge, HingeState, Joint, MassProperties, Release, SceneDescription, Spring,
    Stops, TorqueTable,
};
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::{Commands, Control, EventKind, Options, OwnLaw, Simulator, Snapshot};

use crate::friction::{METHODS, growing, kinds, run, spring};
use crate::{BOOM, HUB, REDUCED, Told, free, rotors, scene, tight};

pub fn stops(lower: f64, upper: f64, restitution: f64) -> Stops {
    Stops { lower, upper, restitution }
}

/// A hinge that this torque turns at any angle.
pub fn pushed(description: &mut SceneDescription, hinge: usize, torque: f64) {
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
    let (latched, summary) = run(&scene(rotors(&[hinge(Some(1.0))], 2.0)), tight(1));
    assert_eq!(kinds(&latched.events), [EventKind::LockUp, EventKind::End]);
    assert_eq!(summary.verdict.hinges[0].impact_rate, None);
    let (failed, _) = run(&scene(rotors(&[hinge(None)], 2.0)), tight(1));
    assert_eq!(kinds(&failed.events), [EventKind::Impact, EventKind::End]);
    assert!((failed.last().beta[0] - 0.7).abs() < 1e-11);
}

/// A hinge that starts at its stop on the way beyond it hits it at once; one that is released there under a spring that
/// presses it stays.
#[test]
fn a_hinge_may_start_at_its_stop() {
    for at in [0.0, 0.7] {
        let hits = Hinge { stops: stops(-1.0, at, 1.0), ..free(at, 1.0) };
        let (told, _) = run(&scene(rotors(&[hits], 0.5)), tight(1));
        assert_eq!(kinds(&told.events), [EventKind::Impact, EventKind::End]);
        assert_eq!(told.events[0].time, 0.0);
        assert!((told.last().beta[0] - (at - 0.5)).abs() < 1e-12);
    }

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

/// A momentum wheel beside it, with a mass or without, does not make a slow hinge stick to its stop, nor keep it from
/// rebounding.
#[test]
fn a_fast_wheel_does_not_hide_what_draws_a_hinge_off() {
    for mass in [0.0, 2.0] {
        let beside_wheel = |hinge: Hinge| {
            let mut description = rotors(&[free(0.0, 400.0), hinge], 100.0);
            if mass == 0.0 {
                let about_axis = Sym3::diagonal(BOOM, 0.0, 0.0);
                description.bodies[0].mass_properties =
                    MassProperties::new(0.0, Vec3::zero(), about_axis);
            }
            description
        };
        let mut description = beside_wheel(Hinge { stops: stops(0.0, 1.0, 0.5), ..free(0.0, 0.0) });
        let torque = 1e-8;
        pushed(&mut description, 1, torque);
        let (told, _) = run(&scene(description), tight(1));
        assert_eq!(kinds(&told.events), [EventKind::End]);
        let expected = 0.5 * torque / REDUCED * 1e4;
        let off = told.last().beta[1] - expected;
        assert!(off.abs() < 1e-6 * expected, "{mass}: {off:e}");

        let comes = beside_wheel(Hinge { stops: stops(0.0, 1.0, 0.5), ..free(0.0, -1e-5) });
        let (told, _) = run(&scene(comes), tight(1));
        assert_eq!(kinds(&told.events), [EventKind::Impact, EventKind::End]);
        assert!((told.last().tau[1] - 0.5e-5).abs() < 1e-15, "{mass}: {:?}", told.last().tau);
    }
}

/// A spring draws a hinge off its stop by no more than what a law of the program's own, or a command, takes back leaves
/// by rounding.
#[test]
fn torques_that_cancel_do_not_draw_a_hinge_off_its_stop() {
    let (stiffness, rest) = (4e6, 0.3_f64);
    let sprung = spring(stiffness, rest);
    let hinge = Hinge { spring: sprung, stops: stops(0.0, 1.0, 0.0), ..free(0.0, 0.0) };
    let scene = scene(rotors(&[hinge], 1e3));
    let opposed = -(stiffness * rest).next_down();
    let (mut by_own_law, mut by_two) = (Told::default(), Told::default());
    let mut simulator =
        Simulator::under_laws(&scene, tight(4), vec![OwnLaw::new(0, move |_, _| opposed)]);
    simulator.run(&mut by_own_law).expect("it runs to its end");
    let laws = [opposed, opposed, (-2.0 * opposed).next_up()];
    let laws = laws.map(|torque| OwnLaw::new(0, move |_, _| torque)).into();
    let free = Hinge { spring: Spring::default(), ..hinge };
    let alone = crate::scene(rotors(&[free], 1e3));
    Simulator::under_laws(&alone, tight(4), laws).run(&mut by_two).expect("it runs to its end");
    let (mut commanded, mut simulator) = (Told::default(), Simulator::new(&scene, tight(4)));
    let law =
        &mut |_: &Snapshot, commands: &mut Commands| commands.hinge_torques_mut()[0] = opposed;
    let control = Control { period: 1e4, law };
    simulator.run_controlled(control, &mut commanded).expect("it runs to its end");
    for told in [by_own_law, by_two, commanded] {
        assert_eq!(kinds(&told.events), [EventKind::Rest, EventKind::End], "{:?}", told.events);
    }
}

/// Bouncing is long and dense, and a small share of a day, but no chatter.
#[test]
fn a_bounce_in_a_day_comes_to_its_end() {
    let hinge = Hinge { stops: stops(f64::NEG_INFINITY, 0.0, 0.995), ..free(0.0, 0.01) };
    let mut description = rotors(&[hinge], 86400.0);
    pushed(&mut description, 0, 1.0);
    let (told, summary) = run(&scene(description), tight(1));
    let impacts = told.events.iter().filter(|of| of.kind == EventKind::Impact).count();
    // ln 10⁻³ / ln 0.995.
    assert!((1370..1390).contains(&impacts), "{impacts}");
    assert_eq!(summary.verdict.hinges[0].state, HingeState::Stuck);
}

/// A torque that draws a hinge off its stop more and more feebly, and then presses it: it leaves slowly and comes back.
#[test]
fn a_hinge_that_is_barely_drawn_off_comes_back() {
    // The second is so little beside rounding that its acceleration may be none.
    for falling in [1e-4, 1e-13] {
        let hinge = Hinge { stops: stops(0.0, 1.0, 0.0), ..free(0.0, 0.0) };
        let mut description = rotors(&[hinge], 40.0);
        description.externals.push(External {
            body: Some(0),
            course: Course::Table(vec![[0.0, 1.0], [20.0, -1.0], [40.0, -1.0]]),
            ..growing(0.0)
        });
        description.externals[0].amount = Vec3::unit_x() * falling;
        let (told, _) = run(&scene(description), tight(60));
        let kinds = kinds(&told.events);
        let of_hinge: Vec<_> = kinds.iter().filter(|kind| **kind != EventKind::ThrustOn).collect();
        assert!(matches!(of_hinge[..], [EventKind::Impact, EventKind::Rest, ..]), "{kinds:?}");
        let impact = told.events.iter().find(|of| of.kind == EventKind::Impact).expect("one");
        // T (1 − t/10) brings it to rest at 20, as far as T (t²/2 − t³/60), from where −T takes it back.
        let (height, pull) = (200.0 / 3.0, 1.0);
        assert!((impact.time - 20.0 - f64::sqrt(2.0 * height / pull)).abs() < 1e-6, "{impact:?}");
    }
}

/// Bouncing without an end is given up, and blamed on the stop.
#[test]
fn a_boom_that_bounces_for_ever_is_told() {
    let hinge = Hinge { stops: stops(-0.5, 0.5, 1.0), ..free(0.0, 2.0) };
    let scene = scene(rotors(&[hinge], 1e3));
    let options = Options { max_events: 30, ..tight(1) };
    let failure = Simulator::new(&scene, options).run(&mut Told::default()).err();
    let told = failure.expect("it never ends").error.to_string();
    assert!(told.contains("hinge 1,1: the 30 events that max_events allows are used up"), "{told}");
    assert!(told.contains("a hinge at its stop may bounce on and on"), "{told}");
}
