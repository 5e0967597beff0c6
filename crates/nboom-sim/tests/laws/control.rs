//! Control laws at a sample rate.

use nboom_formulation::Formulation;
use nboom_model::{
    External, Gravity, Hinge, HingeState, Release, Scene, SceneDescription, TorqueTable,
};
use nboom_ode::Method;
use nboom_scalar::{Vec3, Wrench};
use nboom_sim::{
    Commands, Control, EventKind, Form, Nobody, OptionError, Options, SimError, Simulator,
    Snapshot, Summary,
};

use crate::{HUB, REDUCED, Told, apart, free, reference, rotors, scene, tight};

/// A run under a control law, and what it told.
fn controlled(
    scene: &Scene,
    options: Options,
    period: f64,
    mut law: impl FnMut(&Snapshot, &mut Commands),
) -> (Told, Summary) {
    let (mut simulator, mut told) = (Simulator::new(scene, options), Told::default());
    let control = Control { period, law: &mut law };
    let summary = simulator.run_controlled(control, &mut told).expect("it runs to its end");
    (told, summary.clone())
}

#[test]
fn it_is_asked_at_every_multiple_of_the_period_but_at_the_end() {
    let (start, period) = (0.3, 0.1);
    let mut description = rotors(&[free(0.0, 1.0)], start + 1.0);
    description.initial.time = start;
    let mut times = Vec::new();
    controlled(&scene(description), tight(1), period, |seen, _| times.push(seen.time));
    let expected: Vec<f64> = (0..10).map(|k| start + f64::from(k) * period).collect();
    assert_eq!(times, expected);
}

#[test]
fn it_sees_what_the_instant_has_changed() {
    let waits = |release| {
        let mut hinge = Hinge { release, ..free(0.0, 0.0) };
        hinge.start.state = HingeState::Unreleased;
        hinge
    };
    // One is released in the instant of a sample, one a rounding later.
    let hinges = [waits(Release::Time(0.5)), waits(Release::Time(1.0_f64.next_up()))];
    let mut seen = Vec::new();
    let scene = scene(rotors(&hinges, 1.25));
    let (told, _) = controlled(&scene, tight(1), 0.5, |now, _| seen.push(now.hinges.clone()));
    use HingeState::{Free, Unreleased};
    assert_eq!(seen, [[Unreleased; 2], [Free, Unreleased], [Free; 2]]);
    let expected = [(EventKind::Release, Some(0)), (EventKind::Release, Some(1))];
    assert_eq!(told.kinds()[..2], expected);
}

/// Between samples the hinge has constant acceleration: β and τ follow in closed form.
#[test]
fn torques_are_held_between_samples() {
    let (period, mut sign) = (0.125, 1.0);
    let scene = scene(rotors(&[free(0.2, -0.3)], 2.0));
    let (told, summary) = controlled(&scene, tight(32), period, |_, commands| {
        sign = -sign;
        commands.hinge_torques_mut()[0] = sign * 2.0 + 0.5;
    });
    let (mut beta, mut tau, half) = (0.2, -0.3, 0.0625);
    for (number, sample) in told.samples.iter().enumerate() {
        // Rounding of numbers of about 1 over thirty steps.
        assert!((sample.beta[0] - beta).abs() < 1e-13, "{number}: {}", sample.beta[0] - beta);
        assert!((sample.tau[0] - tau).abs() < 1e-13, "{number}: {}", sample.tau[0] - tau);
        let torque = if (number / 2) % 2 == 0 { -1.5 } else { 2.5 };
        let acceleration = torque / REDUCED;
        beta += (tau + 0.5 * acceleration * half) * half;
        tau += acceleration * half;
    }
    assert!(summary.conservation.energy < 1e-13, "{:?}", summary.conservation);
}

/// What the thrust of a scene does, commanded; and what a constant torque of a table does.
#[test]
fn constant_commands_are_a_thrust_and_a_table() {
    let deck = SceneDescription::clone(&reference("s03_chain3_general"));
    let (force, point) = (Vec3::new(0.3, -0.2, 0.5), Vec3::new(0.1, 0.4, -0.2));
    let torque = 0.7;
    let mut by_scene = deck.clone();
    by_scene.end_time = 1.0;
    by_scene.externals = vec![External::thrust(force, point, [0.0, 9.0])];
    by_scene.torque_tables =
        vec![TorqueTable { hinge: 0, points: vec![[-20.0, torque], [20.0, torque]] }];
    let mut bare = deck;
    bare.end_time = 1.0;
    bare.externals.clear();
    let law = |_: &Snapshot, commands: &mut Commands| {
        commands.hinge_torques_mut()[0] = torque;
        commands.main_body = Wrench::of_force(point, force);
    };
    let (commanded, summary) = controlled(&scene(bare), tight(4), 0.3, law);
    let mut expected = Told::default();
    nboom_sim::simulate(&scene(by_scene), &tight(4), &mut expected).expect("it runs to its end");
    assert_eq!(commanded.kinds(), expected.kinds());
    for (found, expected) in commanded.samples.iter().zip(&expected.samples) {
        let off = apart(found, expected);
        // The tolerance is 1e-12 in some dozen steps.
        assert!(off < 1e-10, "{off:e} at {}", found.time);
        let torques = |seen: &Snapshot| seen.detail.as_ref().expect("asked for").hinge_torque[0];
        assert!((torques(found) - torques(expected)).abs() < 1e-9);
    }
    assert!(summary.conservation.energy < 1e-11, "{:?}", summary.conservation);
}

/// A law that changes all it can, now and then nothing.
fn busy(seen: &Snapshot, commands: &mut Commands) {
    let t = seen.time;
    for (i, torque) in commands.hinge_torques_mut().iter_mut().enumerate() {
        *torque = 0.4 * (7.0 * t + i as f64).sin() - 0.2 * seen.tau[i];
    }
    let is_silent = (10.0 * t).fract() > 0.7;
    let wave = Vec3::new((3.0 * t).sin(), (4.0 * t).cos(), (5.0 * t).sin());
    commands.main_body = if is_silent {
        Wrench::zero()
    } else {
        Wrench { force: wave * 0.3, moment: wave * 0.5 - seen.omega_body * 0.1 }
    };
}

/// A chain in a spin under gravity and a thrust, with hinges that lock.
fn eventful() -> Scene {
    let mut description = SceneDescription::clone(&reference("s03_chain3_general"));
    description.end_time = 1.0;
    description.gravity = Some(Gravity { acceleration: 2.0, up: Vec3::unit_z() });
    let force = Vec3::new(0.0, 0.4, 0.1);
    description.externals = vec![External::thrust(force, Vec3::unit_x(), [0.2, 0.6])];
    for body in &mut description.bodies {
        let start = body.hinge.start;
        body.hinge.lock_angle = Some(start.angle + 0.3 * start.rate.signum());
    }
    scene(description)
}

#[test]
fn the_ledger_balances_and_all_methods_agree() {
    let scene = eventful();
    let period = 0.0625;
    let (expected, summary) = controlled(&scene, tight(4), period, busy);
    assert!(expected.events.iter().any(|event| event.kind == EventKind::LockUp), "{expected:?}");
    let kept = summary.conservation;
    // The tolerance is 1e-12 in each of some hundred steps.
    for (_, residual) in kept.laws() {
        assert!(residual < 1e-10, "{kept:?}");
    }
    let momentum = Some(Form::Closed(Formulation::Momentum));
    let relative = Some(Form::Closed(Formulation::Relative));
    let generic = Options { path: nboom_sim::Path::Generic, ..tight(4) };
    for (options, tolerance) in [
        (Options { integrator: Method::Taylor, ..tight(4) }, 1e-9),
        (Options { integrator: Method::Gauss, ..tight(4) }, 1e-9),
        (Options { integrator: Method::GaussLanes, ..tight(4) }, 1e-9),
        (Options { integrator: Method::Radau5, rtol: 1e-9, atol: 1e-11, ..tight(4) }, 1e-6),
        (Options { formulation: momentum, ..tight(4) }, 1e-9),
        (Options { formulation: relative, ..generic }, 1e-9),
    ] {
        let (found, summary) = controlled(&scene, options, period, busy);
        let name = (options.integrator.name(), options.formulation);
        assert_eq!(found.kinds(), expected.kinds(), "{name:?}");
        let off = apart(found.last(), expected.last());
        assert!(off < tolerance, "{name:?}: {off:e}");
        let kept = summary.conservation;
        assert!(
            kept.energy < tolerance && kept.angular_momentum.is_some_and(|off| off < tolerance),
            "{name:?}: {kept:?}"
        );
    }
}

/// A hinge that is released, and one that locks, under a torque that is held all the way.
#[test]
fn commands_last_over_events() {
    let hinges = [free(0.0, 0.5)];
    let mut description = rotors(&hinges, 2.0);
    description.bodies[0].hinge.lock_angle = Some(0.6);
    let (told, summary) = controlled(&scene(description), tight(1), 5.0, |_, commands| {
        commands.hinge_torques_mut()[0] = 0.08;
    });
    // β = 0.5 t + 0.05 t², which is 0.6 at t = -5 + sqrt(37).
    let expected = 37.0_f64.sqrt() - 5.0;
    assert!((told.events[0].time - expected).abs() < 1e-13, "{}", told.events[0].time);
    assert!(summary.conservation.energy < 1e-13, "{:?}", summary.conservation);
}

#[test]
fn a_law_can_hold_an_attitude() {
    // A hub alone turns at 0.4 about x; a moment against angle and rate, sampled often, stops it.
    let mut description = rotors(&[], 60.0);
    description.initial.omega_body = Vec3::unit_x() * 0.4;
    let (told, summary) = controlled(&scene(description), tight(1), 0.05, |seen, commands| {
        let angle = 2.0 * seen.attitude.vector.x.atan2(seen.attitude.scalar);
        let moment = -HUB * (0.25 * angle + seen.omega_body.x);
        commands.main_body.moment = Vec3::unit_x() * moment;
    });
    let last = told.last();
    assert!(last.omega_body.norm() < 1e-9 && last.attitude.vector.norm() < 1e-9, "{last:?}");
    assert!(summary.conservation.energy < 1e-10, "{:?}", summary.conservation);
    assert!(
        summary.conservation.angular_momentum.is_some_and(|balance| balance < 1e-10),
        "{:?}",
        summary.conservation
    );
}

#[test]
fn nothing_of_it_is_left_in_the_next_run() {
    let scene = eventful();
    let (mut simulator, mut before, mut after) =
        (Simulator::new(&scene, tight(4)), Told::default(), Told::default());
    simulator.run(&mut before).expect("it runs to its end");
    let mut run_under_control = || {
        let mut told = Told::default();
        let control = Control { period: 0.0625, law: &mut busy };
        simulator.run_controlled(control, &mut told).expect("it runs to its end");
        told
    };
    let first = run_under_control();
    assert_eq!(run_under_control(), first);
    assert_ne!(first, before);
    simulator.run(&mut after).expect("it runs to its end");
    assert_eq!(before, after);
}

#[test]
fn periods_and_commands_that_are_none_are_refused() {
    let scene = scene(rotors(&[free(0.0, 1.0)], 1.0));
    let mut simulator = Simulator::new(&scene, tight(1));
    for period in [0.0, -1.0, 1e-300, f64::NAN, f64::INFINITY] {
        let control = Control { period, law: &mut |_, _| panic!("it is not asked") };
        let error = simulator.run_controlled(control, &mut Nobody).expect_err("no period").error;
        let is_told = |error: &SimError| {
            matches!(error, SimError::Option(OptionError { option: "sample period", .. }))
        };
        assert!(is_told(&error), "{period}: {error}");
    }
    let told = |law: &mut dyn FnMut(&Snapshot, &mut Commands)| {
        let control = Control { period: 0.25, law };
        let failure =
            Simulator::new(&scene, tight(1)).run_controlled(control, &mut Nobody).map(|_| ());
        failure.expect_err("no number").error.to_string()
    };
    let torque = told(&mut |seen, commands| {
        commands.hinge_torques_mut()[0] = if seen.time < 0.5 { 0.0 } else { f64::NAN };
    });
    assert!(
        torque.starts_with("at time 0.5: commanded torque of hinge 1,1 is not finite"),
        "{torque}"
    );
    let wrench = told(&mut |_, commands| commands.main_body.force.y = f64::INFINITY);
    assert!(wrench.starts_with("at time 0: commanded wrench is not finite"), "{wrench}");
}

#[test]
fn commands_for_another_scene_are_refused_and_not_kept() {
    let two = scene(rotors(&[free(0.0, 0.0), free(0.0, 0.0)], 1.0));
    let one = scene(rotors(&[free(0.0, 0.0)], 1.0));
    let mut simulator = Simulator::new(&two, tight(1));
    let mut law = |_: &Snapshot, commands: &mut Commands| *commands = Commands::none(&one);
    let control = Control { period: 0.1, law: &mut law };
    let failure = simulator.run_controlled(control, &mut Nobody).expect_err("another scene's");
    assert!(matches!(failure.error, SimError::OtherCommands { time: 0.0 }), "{failure}");
    let mut law = |_: &Snapshot, commands: &mut Commands| commands.hinge_torques_mut()[1] = 1.0;
    let control = Control { period: 0.1, law: &mut law };
    simulator.run_controlled(control, &mut Nobody).expect("its own commands");
}
