//! Coulomb's friction about hinges.

use std::f64::consts::PI;

use nboom_elements::Kind;
use nboom_model::{
    Base, Course, External, ExternalAxes, ExternalKind, Gravity, Hinge, HingeState, Joint,
    MassProperties, Release, Rotor, RotorSpeed, Scene, Spring,
};
use nboom_ode::Method;
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::{
    Commands, Control, Event, EventKind, Options, SimError, Simulator, Snapshot, Summary,
};

use crate::{BOOM, HUB, REDUCED, Told, free, rotors, scene, tight};

pub fn run(scene: &Scene, options: Options) -> (Told, Summary) {
    let (mut simulator, mut told) = (Simulator::new(scene, options), Told::default());
    let summary = simulator.run(&mut told).expect("it runs to its end");
    (told, summary.clone())
}

pub fn spring(stiffness: f64, rest: f64) -> Spring {
    Spring { linear: -stiffness, preload_angle: -rest, ..Spring::default() }
}

/// A torque along x on the hub that grows by so much per time unit.
pub fn growing(rate: f64) -> External {
    External {
        body: None,
        kind: ExternalKind::Torque,
        amount: Vec3::unit_x() * (rate * 100.0),
        axes: ExternalAxes::Body,
        point: Vec3::zero(),
        course: Course::Table(vec![[0.0, 0.0], [100.0, 1.0]]),
    }
}

pub fn kinds(events: &[Event]) -> Vec<EventKind> {
    events.iter().map(|event| event.kind).collect()
}

/// The methods that differ in how they step and tell dense output.
pub const METHODS: [Method; 6] = [
    Method::Auto,
    Method::Dop853,
    Method::GaussLanes,
    Method::Radau5,
    Method::Taylor,
    Method::Gauss,
];

/// A spring of stiffness k swings the boom about an angle that friction F shifts against the motion by F/k: each half
/// period takes 2F/k off the amplitude, until the spring is no match for friction.
#[test]
fn a_boom_on_a_spring_swings_less_by_the_same_each_time_and_sticks() {
    let (stiffness, friction, start) = (2.0, 0.3, 1.0);
    let hinge = Hinge { spring: spring(stiffness, 0.0), friction, ..free(start, 0.0) };
    let scene = scene(rotors(&[hinge], 20.0));
    let half_period = PI * (REDUCED / stiffness).sqrt();
    for integrator in METHODS {
        let (told, summary) = run(&scene, Options { integrator, ..tight(200) });
        // 1, -0.7, 0.4, -0.1: there the spring has 0.2 against 0.3.
        let expected =
            [EventKind::Rise(Kind::Friction), EventKind::Fall(Kind::Friction), EventKind::Stick];
        assert_eq!(kinds(&told.events)[..3], expected, "{integrator:?}");
        assert_eq!(told.events.len(), 4);
        for (number, event) in told.events[..3].iter().enumerate() {
            let off = event.time - (number + 1) as f64 * half_period;
            assert!(off.abs() < 1e-10, "{integrator:?}: {off}");
        }
        let verdict = &summary.verdict.hinges[0];
        assert_eq!(verdict.state, HingeState::Stuck);
        assert!((verdict.angle + 0.1).abs() < 1e-10, "{integrator:?}: {}", verdict.angle);
        // That of Radau's method of order 5 is largest.
        assert!(summary.conservation.energy < 1e-9, "{integrator:?}: {:?}", summary.conservation);
        let account = told.last().account.expect("an output time has one");
        let way = 1.7 + 1.1 + 0.5;
        assert!((account.dashpot_work + friction * way).abs() < 1e-9, "{account:?}");
        for sample in &told.samples {
            let turns = (sample.time / half_period) as i32;
            let amplitude = start - friction / stiffness * f64::from(2 * turns + 1);
            let middle = friction / stiffness * if turns % 2 == 0 { 1.0 } else { -1.0 };
            let expected = if turns < 3 {
                middle + amplitude * (sample.time * PI / half_period).cos()
            } else {
                -0.1
            };
            assert!((sample.beta[0] - expected).abs() < 1e-8, "{integrator:?} {}", sample.time);
        }
    }
}

/// The hub is turned faster and faster: the boom goes with it as long as friction can make it, then lags behind.
#[test]
fn a_boom_slips_when_its_hinge_has_to_bear_more_than_friction() {
    let (rate, friction) = (0.5, 0.2);
    for sign in [1.0, -1.0] {
        let mut description = rotors(&[Hinge { friction, ..free(0.3, 0.0) }], 4.0);
        description.externals.push(growing(sign * rate));
        let scene = scene(description);
        let slips = friction * (HUB + BOOM) / (BOOM * rate);
        for integrator in METHODS {
            let (told, summary) = run(&scene, Options { integrator, ..tight(40) });
            let expected = [EventKind::Stick, EventKind::Slip, EventKind::End];
            assert_eq!(kinds(&told.events), expected, "{integrator:?}");
            assert!(
                (told.events[1].time - slips).abs() < 1e-8,
                "{integrator:?}: {:?}",
                told.events[1]
            );
            for sample in &told.samples {
                let since = (sample.time - slips).max(0.0);
                let expected = 0.3 - sign * rate * since.powi(3) / (6.0 * HUB);
                assert!((sample.beta[0] - expected).abs() < 1e-9, "{integrator:?} {}", sample.time);
            }
            // The work of the torque rides along; that of Radau's method of order 5 errs most.
            assert!(
                summary.conservation.energy < 1e-7,
                "{integrator:?}: {:?}",
                summary.conservation
            );
        }
    }
}

/// Two booms that do the same stop and slip at the same time, also when one of them counts its angle the other way.
#[test]
fn mirrored_booms_stick_and_slip_together() {
    for integrator in METHODS {
        let boom =
            |sign: f64| Hinge { spring: spring(2.0, 0.0), friction: 0.3, ..free(0.7 * sign, 0.0) };
        let mut description = rotors(&[boom(1.0), boom(-1.0)], 12.0);
        description.bodies[1].axis = -description.bodies[1].axis;
        description.externals.push(growing(0.2));
        let (told, summary) = run(&scene(description), Options { integrator, ..tight(1) });
        for kind in [EventKind::Stick, EventKind::Slip] {
            let times: Vec<f64> = told
                .events
                .iter()
                .filter(|event| event.kind == kind)
                .map(|event| event.time)
                .collect();
            assert!(
                !times.is_empty() && times.len().is_multiple_of(2),
                "{integrator:?}: {:?}",
                told.events
            );
            assert!(times.chunks(2).all(|pair| pair[0] == pair[1]), "{integrator:?}: {times:?}");
        }
        assert!(told.events.len() < 20, "{integrator:?}: {:?}", kinds(&told.events));
        let [one, other] = [0, 1].map(|i| summary.verdict.hinges[i].angle);
        assert!((one + other).abs() < 1e-8, "{integrator:?}: {one}, {other}");
    }
}

/// Friction is a bounded torque and bears no impulse: in a lock-up a hinge that sticks is like one without friction.
#[test]
fn a_lock_up_makes_a_hinge_slip_that_sticks() {
    let friction = 0.05;
    let locks = Hinge { lock_angle: Some(0.5), ..free(0.0, 1.0) };
    let sticks = Hinge { friction, ..free(0.0, 0.0) };
    let (told, summary) = run(&scene(rotors(&[locks, sticks], 8.0)), tight(200));
    let expected =
        [EventKind::Stick, EventKind::LockUp, EventKind::Slip, EventKind::Stick, EventKind::End];
    assert_eq!(kinds(&told.events), expected);
    let [_, locked, slipped, stuck, _] = &told.events[..] else { panic!("{:?}", told.events) };
    assert_eq!(locked.time, slipped.time);
    // The hub takes the first boom's momentum with it; the second boom stands still in space until friction has it.
    let (carrier, rate) = (HUB + BOOM, BOOM / (HUB + BOOM));
    let acceleration = friction / BOOM + friction / carrier;
    assert!((stuck.time - locked.time - rate / acceleration).abs() < 1e-10);
    for sample in told.samples.iter().filter(|sample| sample.time > locked.time) {
        let since = (sample.time - locked.time).min(rate / acceleration);
        assert!((sample.tau[1] + rate - acceleration * since).abs() < 1e-10, "{}", sample.time);
        let beta = (0.5 * acceleration * since - rate) * since;
        assert!((sample.beta[1] - beta).abs() < 1e-10, "{}", sample.time);
    }
    assert!(summary.conservation.energy < 1e-10, "{:?}", summary.conservation);
}

/// A hinge that is released against friction it cannot overcome stays where it is, and the run says so.
#[test]
fn a_released_hinge_may_stay() {
    let mut hinge = Hinge { spring: spring(1.0, 0.0), friction: 0.5, ..free(0.4, 0.0) };
    (hinge.release, hinge.start.state) = (Release::Time(1.0), HingeState::Unreleased);
    let (told, summary) = run(&scene(rotors(&[hinge], 3.0)), tight(1));
    assert_eq!(kinds(&told.events), [EventKind::Release, EventKind::Stick, EventKind::End]);
    assert_eq!(summary.verdict.hinges[0].state, HingeState::Stuck);
    assert_eq!(summary.verdict.hinges[0].angle, 0.4);
}

/// A hinge that is released where hardly more acts than its friction, and soon less, hardly moves.
#[test]
fn a_hinge_that_barely_slips_sticks_again() {
    for more in [1e-9, 3e-7, 1e-5] {
        let mut hinge = Hinge { friction: 1.0, ..free(0.0, 0.0) };
        (hinge.release, hinge.start.state) = (Release::Time(50.0), HingeState::Unreleased);
        let mut description = rotors(&[hinge], 100.0);
        description.base = Base::Fixed;
        let course = Course::Table(vec![[50.0, 1.0 + more], [100.0, 0.9]]);
        let (body, amount) = (Some(0), Vec3::unit_x());
        description.externals.push(External { body, amount, course, ..growing(0.0) });
        let (told, summary) = run(&scene(description), tight(3));
        assert!(told.events.len() <= 5, "{:?}", kinds(&told.events));
        assert_eq!(summary.verdict.hinges[0].state, HingeState::Stuck, "{more}");
        // The excess is gone after t, and the motion after 2 t, ⅔ t² of it farther; BOOM is 1.
        let t = 50.0 * more / (0.1 + more);
        assert!(summary.verdict.hinges[0].angle < more * t * t + 1e-14, "{more}");
    }
}

/// A command above friction moves a hinge from the sample on at which it is given, one below it does not.
#[test]
fn a_command_makes_a_hinge_slip_at_once() {
    let friction = 0.5;
    let scene = scene(rotors(&[Hinge { friction, ..free(0.0, 0.0) }], 4.0));
    let mut told = Told::default();
    let mut simulator = Simulator::new(&scene, tight(64));
    let mut law = |seen: &Snapshot, commands: &mut Commands| {
        commands.hinge_torques_mut()[0] = match seen.time {
            early if early < 1.0 => 0.49,
            while_it_moves if while_it_moves < 2.0 => 0.9,
            _ => 0.0,
        };
    };
    let control = Control { period: 0.25, law: &mut law };
    let summary = simulator.run_controlled(control, &mut told).expect("it runs to its end");
    assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
    let expected = [EventKind::Stick, EventKind::Slip, EventKind::Stick, EventKind::End];
    assert_eq!(kinds(&told.events), expected);
    assert_eq!(told.events[1].time, 1.0);
    // It gains for one time unit what friction takes in 0.8 of another.
    assert!((told.events[2].time - 2.8).abs() < 1e-12, "{:?}", told.events[2]);
    let [gain, loss] = [0.9 - friction, friction].map(|torque| torque / REDUCED);
    for sample in &told.samples {
        let [driven, braked] =
            [(1.0, 1.0), (2.0, 0.8)].map(|(from, most)| (sample.time - from).clamp(0.0, most));
        let expected = 0.5 * gain * driven * driven + (gain - 0.5 * loss * braked) * braked;
        assert!((sample.beta[0] - expected).abs() < 1e-12, "{}", sample.time);
    }
}

/// A rotor that begins to speed up lets go of a boom in the same instant.
#[test]
fn a_rotor_that_speeds_up_lets_a_boom_go_at_once() {
    let (friction, inertia, acceleration) = (0.1, 0.5, 2.0);
    for integrator in METHODS {
        let mut description = rotors(&[Hinge { friction, ..free(0.0, 0.0) }], 2.0);
        description.rotors.push(Rotor {
            body: None,
            axis: Vec3::unit_x(),
            inertia,
            speed: RotorSpeed::Table(vec![[0.0, 0.0], [1.0, 0.0], [3.0, 2.0 * acceleration]]),
        });
        let (told, _) = run(&scene(description), Options { integrator, ..tight(20) });
        assert_eq!(kinds(&told.events), [EventKind::Stick, EventKind::Slip, EventKind::End]);
        assert_eq!(told.events[1].time, 1.0, "{integrator:?}");
        // The motor pushes off from the hub, which the boom lags behind: friction takes it along.
        let hub = -(inertia * acceleration - friction) / (HUB + inertia);
        let boom = -friction / BOOM;
        for sample in told.samples.iter().filter(|sample| sample.time > 1.0) {
            let since = sample.time - 1.0;
            let (found, tau) = (sample.omega_body.x, sample.tau[0]);
            assert!((found - hub * since).abs() < 1e-9, "{integrator:?}: {found}, {}", hub * since);
            assert!((tau - (boom - hub) * since).abs() < 1e-9, "{integrator:?}: {tau}");
        }
    }
}

/// A hinge about which nothing has inertia is refused, with friction as without.
#[test]
fn a_hinge_without_inertia_does_not_stick() {
    let mut description =
        rotors(&[Hinge { spring: spring(10.0, 1.0), friction: 0.1, ..free(0.0, 0.0) }], 1.0);
    description.bodies[0].mass_properties = MassProperties::new(1.0, Vec3::zero(), Sym3::zero());
    let failed = Simulator::new(&scene(description), tight(1)).run(&mut Told::default()).err();
    let error = failed.map(|failed| failed.error);
    assert!(matches!(error, Some(SimError::SingularMassMatrix { .. })), "{error:?}");
}

/// No event depends on units: a block that slides to rest, in metres and seconds and in kilometres and milliseconds.
#[test]
fn a_slide_stops_in_any_units() {
    let stops = |length: f64, time: f64| {
        let speed = 3.0 * length / time;
        let force = 2.0 * length / (time * time);
        let hinge = Hinge { friction: force, lock_angle: Some(-5.0 * length), ..free(0.0, speed) };
        let mut description = rotors(&[hinge], 10.0 * time);
        description.base = Base::Fixed;
        (description.bodies[0].joint, description.bodies[0].axis) =
            (Joint::Prismatic, Vec3::unit_x());
        let (told, summary) = run(&scene(description), tight(1));
        assert_eq!(kinds(&told.events), [EventKind::Stick, EventKind::End]);
        // v² / 2 a after v / a, at 1 from the mass of two.
        let verdict = &summary.verdict.hinges[0];
        assert!((told.events[0].time / time - 3.0).abs() < 1e-12, "{:?}", told.events);
        assert!((verdict.angle / length - 4.5).abs() < 1e-12, "{verdict:?}");
        let miss = verdict.miss.expect("it is short of its latch");
        assert!((miss.by / length - 5.0).abs() < 1e-12, "{miss:?}");
    };
    stops(1.0, 1.0);
    stops(1e-3, 1e3);
    stops(1e6, 1e-3);
}

/// A block of 2 kg on an incline of four in five, held to the ground, under a gravity of 10: 16 N pull it down.
#[test]
fn a_block_on_an_incline_stays_or_slides() {
    for (friction, acceleration) in [(17.0, 0.0), (15.0, 0.5)] {
        let mut description = rotors(&[Hinge { friction, ..free(0.0, 0.0) }], 2.0);
        description.base = Base::Fixed;
        description.gravity = Some(Gravity { up: Vec3::unit_z(), acceleration: 10.0 });
        let block = &mut description.bodies[0];
        (block.joint, block.axis) = (Joint::Prismatic, Vec3::new(0.6, 0.0, -0.8));
        let (told, summary) = run(&scene(description), tight(8));
        for sample in &told.samples {
            let expected = 0.5 * acceleration * sample.time * sample.time;
            assert!((sample.beta[0] - expected).abs() < 1e-13, "{friction}, {}", sample.time);
        }
        let state = summary.verdict.hinges[0].state;
        assert_eq!(state == HingeState::Stuck, acceleration == 0.0, "{state:?}");
        assert!(summary.conservation.energy < 1e-12, "{:?}", summary.conservation);
    }
}

/// Friction may be any share of what acts: a boom that a torque on the hub drags along slips when it should, and one
/// with next to none goes on as without.
#[test]
fn friction_of_any_size_ends() {
    for integrator in [Method::Auto, Method::Dopri5, Method::Taylor] {
        // A stiff spring swings the boom about.
        for friction in [1e-1, 1e-3, 1e-17] {
            let preload = Spring { linear: -1e4, preload_angle: 1.0, ..Spring::default() };
            let mut description =
                rotors(&[Hinge { spring: preload, friction, ..free(-0.9, 0.0) }], 0.2);
            description.externals.push(growing(friction));
            let (told, summary) = run(&scene(description), Options { integrator, ..tight(2) });
            assert!(
                told.events.len() < 30,
                "{integrator:?}, {friction:e}: {:?}",
                kinds(&told.events)
            );
            assert!(summary.verdict.hinges[0].angle.abs() < 1.1 + 1e-3, "{friction:e}");
        }
        let hinge = Hinge { spring: spring(1.0, 0.0), friction: 1e300, ..free(0.4, 0.0) };
        let (told, _) = run(&scene(rotors(&[hinge], 1.0)), Options { integrator, ..tight(1) });
        assert_eq!(kinds(&told.events), [EventKind::Stick, EventKind::End], "{integrator:?}");
    }
}

/// A hinge that rests at its lock angle from the start is in no doubt.
#[test]
fn a_hinge_that_sticks_at_its_lock_angle_has_not_missed_it() {
    let hinge = Hinge { friction: 1.0, lock_angle: Some(0.2), ..free(0.2, 0.0) };
    let (_, summary) = run(&scene(rotors(&[hinge], 1.0)), tight(1));
    assert_eq!(summary.verdict.hinges[0].miss, None);
}

/// A boom that swings on a spring shakes another one by almost all that its friction bears. Where dense output says that
/// it slips and the motion does not, the run takes the steps that it takes under more friction.
#[test]
fn a_boom_that_barely_sticks_does_not_disturb_the_motion() {
    let (stiffness, amplitude, end) = (2.0_f64, 0.5, 12.0);
    let others = HUB + BOOM;
    let frequency = (stiffness * (others + BOOM) / (others * BOOM)).sqrt();
    let largest = BOOM * stiffness * amplitude / others;
    let swings = Hinge { spring: spring(stiffness, 0.0), ..free(0.0, amplitude * frequency) };
    for integrator in [Method::Adams, Method::Dop853, Method::GaussLanes] {
        let under = |friction: f64| {
            let sticks = Hinge { friction, ..free(0.3, 0.0) };
            let options = Options { integrator, rtol: 1e-6, atol: 1e-8, samples: 1, ..tight(1) };
            let (told, summary) = run(&scene(rotors(&[swings, sticks], end)), options);
            (told, [summary.steps_accepted, summary.steps_rejected])
        };
        let (_, undisturbed) = under(10.0 * largest);
        let mut stuck = 0;
        for number in 0..60 {
            let margin = 10.0_f64.powf(-9.0 + 0.1 * f64::from(number));
            let (told, steps) = under(largest * (1.0 + margin));
            // With smaller margins errors of the run may make it slip.
            if kinds(&told.events) == [EventKind::Stick, EventKind::End] {
                stuck += 1;
                let off = told.last().beta[0] - amplitude * (frequency * end).sin();
                assert!(off.abs() < 1e-6, "{integrator:?}, {margin:e}: {off:e}");
                assert_eq!(steps, undisturbed, "{integrator:?}, {margin:e}");
            }
        }
        assert!(stuck >= 25, "{integrator:?}: {stuck} of 60");
    }
}
