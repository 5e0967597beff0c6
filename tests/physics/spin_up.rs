//! Rotors whose speeds change over time, against closed forms and against wheels on hinges.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::elements::Commands;
use nboom::loads::{LoadEquations, SceneMotion, VelocityChange};
use nboom::model::{
    Body, Hinge, HingeState, Joint, MassProperties, Mount, Rotor, RotorSpeed, Scene,
    SceneDescription,
};
use nboom::ode::Method;
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Detail, Nobody, Options, Reference, Snapshot, Witness, simulate, trust};
use nboom_codegen::{Level, StressRequest};

use super::log::{options, run};
use super::random_scene::{Rng, all_acting, conservative, hinged, rotors};

/// A body alone with these principal moments that turns like this for a while.
fn body([x, y, z]: [f64; 3], omega: Vec3<f64>) -> SceneDescription {
    let body = MassProperties::new(20.0, Vec3::zero(), Sym3::diagonal(x, y, z));
    let mut scene = SceneDescription::at_rest("spin up", body, 8.0);
    scene.initial.omega_body = omega;
    scene
}

fn table(axis: Vec3<f64>, inertia: f64, points: &[[f64; 2]]) -> Rotor {
    Rotor { body: None, axis, inertia, speed: RotorSpeed::Table(points.to_vec()) }
}

fn detail(seen: &Snapshot) -> &Detail {
    seen.detail.as_ref().expect("the recorder asks for it")
}

const POINTS: [[f64; 2]; 3] = [[1.0, 3.0], [3.0, 40.0], [6.0, 10.0]];

/// The speed by `POINTS`, its rate of change, and the angle since time zero.
fn by_table(t: f64) -> [f64; 3] {
    match t {
        t if t < 1.0 => [3.0, 0.0, 3.0 * t],
        t if t < 3.0 => {
            let since = t - 1.0;
            [3.0 + 18.5 * since, 18.5, 3.0 + 3.0 * since + 9.25 * since * since]
        }
        t if t < 6.0 => {
            let since = t - 3.0;
            [40.0 - 10.0 * since, -10.0, 46.0 + 40.0 * since - 5.0 * since * since]
        }
        t => [10.0, 0.0, 121.0 + 10.0 * (t - 6.0)],
    }
}

/// About a principal axis ω + J Ω / (I + J) is constant, and the motor's torque is J I / (I + J)
/// dΩ/dt.
#[test]
fn a_wheel_that_spins_up_turns_its_body_back() {
    let (about_z, j, start) = (5.0, 0.2, 0.4);
    let mut scene = body([3.0, 4.0, about_z], Vec3::unit_z() * start);
    scene.rotors = vec![table(Vec3::unit_z(), j, &POINTS)];
    let ratio = j / (about_z + j);
    for integrator in [Method::Auto, Method::Dop853, Method::Taylor, Method::Radau5, Method::Gauss]
    {
        let found = run(&scene, &Options { integrator, ..options(16, 1e-12) });
        let first = found.samples[0].kinetic_energy;
        for seen in &found.samples {
            let [speed, rate, angle] = by_table(seen.time);
            let at = format!("{} at {}", integrator.name(), seen.time);
            assert!((seen.rotor_speeds[0] - speed).abs() < 1e-13 * 40.0, "{at}");
            let omega = start - ratio * (speed - 3.0);
            assert!((seen.omega_body - Vec3::unit_z() * omega).norm() < 1e-12, "{at}");
            let half = 0.5 * (start * seen.time - ratio * (angle - 3.0 * seen.time));
            let off = seen.attitude.vector.z * half.cos() - seen.attitude.scalar * half.sin();
            // Rounding, and what a method of order 5 leaves.
            assert!(off.abs() < 1e-10, "{at}: {off:e}");
            // At a bend either slope may be seen.
            if ![1.0, 3.0, 6.0].contains(&seen.time) {
                let torque = detail(seen).motor_torques[0];
                assert!((torque - about_z * ratio * rate).abs() < 1e-11, "{at}: {torque}");
            }
            let work = seen.account.expect("an output time has one").motor_work;
            let gained = seen.kinetic_energy - first;
            assert!((work - gained).abs() < 1e-10 * found.samples[8].kinetic_energy, "{at}");
        }
        let balance = found.summary.conservation;
        let angular = balance.angular_momentum.expect("a free main body");
        assert!(balance.energy < 1e-11 && angular < 1e-11, "{}: {balance:?}", integrator.name());
    }
}

/// No event tells of a bend, and every digit is confirmed by a run in double-double.
#[test]
fn tumbling_under_a_table_keeps_all_its_digits() {
    let mut scene = body([3.0, 4.0, 5.0], Vec3::new(0.4, 0.3, -0.2));
    let axes = [Vec3::new(0.6, 0.0, 0.8), Vec3::unit_y()];
    scene.rotors = axes.map(|axis| table(axis, 0.2, &POINTS)).to_vec();
    scene.rotors[1].speed = RotorSpeed::Table(vec![[2.0, 0.0], [2.5, -20.0]]);
    let found = run(&scene, &options(16, 1e-13));
    assert_eq!(found.events.len(), 1);
    let balance = found.summary.conservation;
    assert!(balance.energy < 1e-11, "{balance:?}");
    let scene = Scene::new(scene).expect("a valid scene");
    let (options, mut witness) = (options(16, 1e-13), Witness::new());
    simulate(&scene, &options, &mut witness).expect("it runs to its end");
    let said = trust(&scene, &options, &witness, Reference::DoubleDouble, &mut Nobody)
        .expect("the reference runs, too");
    assert!(said.same_events);
    for digits in said.end {
        assert!(digits.count() >= 11, "{digits:?}");
    }
}

/// A wheel in place of a rotor: a body without mass and without inertia across its axis.
fn wheel(rotor: &Rotor, speed: f64) -> Body {
    let about_axis = Sym3::outer(rotor.axis) * rotor.inertia;
    let mut hinge = Hinge::free();
    hinge.start.rate = speed;
    Body {
        inboard: rotor.body,
        mount: Mount::at(Vec3::unit_x()),
        joint: Joint::Revolute,
        axis: rotor.axis,
        mass_properties: MassProperties::new(0.0, Vec3::zero(), about_axis),
        tip: Vec3::zero(),
        hinge,
    }
}

/// The torque of a motor about the hinge of a wheel gives the wheel the acceleration that was
/// commanded, and moves all else alike.
#[test]
fn torques_of_motors_turn_wheels_on_hinges() {
    for seed in 0..30 {
        let bodies = 1 + (seed % 5) as usize;
        let mut with_rotor = hinged(bodies, seed);
        let outermost = bodies - 1;
        let mut rotor = rotors(&mut Rng::new(seed), bodies).swap_remove(1);
        rotor.body = Some(outermost);
        let points = [[-1.0, -7.0], [1.0, 12.0]];
        let ([speed, rate], speeds) = ([2.5, 9.5], RotorSpeed::Table(points.to_vec()));
        let mut with_wheel = with_rotor.clone();
        with_wheel.bodies.push(wheel(&rotor, speed));
        rotor.speed = speeds;
        with_rotor.rotors = vec![rotor];
        let moved = |description: SceneDescription, torque: Option<f64>| {
            let of = |value: fn(&Body) -> f64| description.bodies.iter().map(value).collect();
            let beta: Vec<f64> = of(|body| body.hinge.start.angle);
            let tau: Vec<f64> = of(|body| body.hinge.start.rate);
            let omega_body = description.initial.omega_body;
            let scene = Scene::new(description).expect("a valid scene");
            let mode = all_acting(&scene, vec![HingeState::Free; beta.len()]);
            let mut dynamics = Recursive::new(&scene);
            dynamics.set_mode(&mode, &beta);
            if let Some(torque) = torque {
                let mut commands = Commands::none(&scene);
                commands.hinge_torques_mut()[bodies] = torque;
                dynamics.command(&commands);
            }
            dynamics.set_outside(scene.initial.attitude, 0.0);
            let motion = Motion { omega_body, beta: &beta, tau: &tau };
            let mut found = Accelerations::for_hinges(beta.len());
            dynamics.accelerations(&motion, &mut found);
            let mut torques = Vec::new();
            dynamics.motor_torques(&motion, &found, &mut torques);
            (found, torques)
        };
        let (driven, torques) = moved(with_rotor, None);
        let (free, _) = moved(with_wheel, Some(torques[0]));
        let size = driven.tau_dot.iter().fold(10.0_f64, |most, x| most.max(x.abs()));
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-10 * size, "seed {seed}: {a} {b}");
        close((driven.omega_dot_body - free.omega_dot_body).norm(), 0.0);
        close((driven.origin_body - free.origin_body).norm(), 0.0);
        driven.tau_dot.iter().zip(&free.tau_dot).for_each(|(a, b)| close(*a, *b));
        close(free.tau_dot[bodies], rate);
    }
}

/// A whole motion of a wheel on a hinge with a spring and a brake, whose rate becomes the table of
/// a rotor: what is left is the error of straight lines, in proportion to h² and h⁴.
#[test]
fn a_table_of_a_wheel_s_rate_moves_its_carrier_as_the_wheel_does() {
    let tumbling = || {
        let mut scene = body([3.0, 4.0, 5.0], Vec3::new(0.4, 0.3, -0.2));
        scene.end_time = 2.0;
        scene
    };
    let mut rotor = table(Vec3::new(0.6, 0.0, 0.8), 0.2, &[]);
    let mut with_wheel = tumbling();
    let mut hinged = wheel(&rotor, 20.0);
    (hinged.hinge.spring.linear, hinged.hinge.dashpot.rate_linear) = (-2.0, -0.3);
    with_wheel.bodies = vec![hinged];
    let mut with_rotor = tumbling();
    let mut ends = Vec::new();
    let truth = run(&with_wheel, &options(400, 1e-13));
    for every in [4, 2] {
        let points = truth.samples.iter().step_by(every).map(|seen| [seen.time, seen.tau[0]]);
        rotor.speed = RotorSpeed::Table(points.collect());
        with_rotor.rotors = vec![rotor.clone()];
        let found = run(&with_rotor, &options(1, 1e-13));
        assert!(found.summary.conservation.energy < 1e-11);
        ends.push(found.last().omega_body);
    }
    let expected = truth.last().omega_body;
    let [coarse, fine] = [ends[0], ends[1]].map(|end| (end - expected).norm());
    assert!((coarse / fine - 4.0).abs() < 0.05, "{coarse:e} {fine:e}");
    let both = (ends[1] * 4.0 - ends[0]) * (1.0 / 3.0);
    assert!((both - expected).norm() < 1e-8, "{:e}", (both - expected).norm());
}

/// Tables bend before and after a latch, at which rotors keep their speeds; the balances of all
/// code.
#[test]
fn latches_leave_speeds_and_balances() {
    for seed in 0..12 {
        let bodies = 1 + (seed % 4) as usize;
        let mut scene = conservative(bodies, seed);
        scene.end_time = 0.3;
        scene.rotors = rotors(&mut Rng::new(seed), bodies);
        let hinge = &mut scene.bodies[0].hinge;
        hinge.lock_angle = Some(hinge.start.angle + 0.05 * hinge.start.rate);
        let found = run(&scene, &options(3, 1e-12));
        for (event, after) in &found.events {
            for (rotor, &speed) in scene.rotors.iter().zip(&after.rotor_speeds) {
                let expected = rotor.speed.at(event.time);
                assert!((speed - expected).abs() < 1e-12 * 30.0, "seed {seed} at {}", event.time);
            }
        }
        let balance = found.summary.conservation;
        let angular = balance.angular_momentum.expect("a free main body");
        assert!(balance.energy < 1e-9 && angular < 1e-9, "seed {seed}: {balance:?}");
    }
}

/// What a rig holds: J dΩ/dt about its axis, and nothing that it does.
#[test]
fn a_fixed_main_body_bears_the_torque_of_the_motor() {
    let mut scene = body([3.0, 4.0, 5.0], Vec3::zero());
    scene.base = nboom::model::Base::Fixed;
    scene.rotors = vec![table(Vec3::unit_y(), 0.2, &POINTS)];
    let found = run(&scene, &options(16, 1e-12));
    for seen in found.samples.iter().filter(|seen| ![1.0, 3.0, 6.0].contains(&seen.time)) {
        let [speed, rate, _] = by_table(seen.time);
        let reaction = detail(seen).reaction.expect("the rig holds the main body").moment;
        assert!((reaction - Vec3::unit_y() * (0.2 * rate)).norm() < 1e-12, "{reaction:?}");
        let work = seen.account.expect("an output time has one").motor_work;
        assert!((work - 0.1 * (speed * speed - 9.0)).abs() < 1e-11, "{work}");
    }
    assert!(found.summary.conservation.energy < 1e-12);
}

/// Code for loads is generated from the same equations, whose inputs have the rotors.
#[test]
fn traced_loads_take_the_speeds_of_rotors() {
    let bodies = 4;
    let mut scene = hinged(bodies, 7);
    scene.rotors = rotors(&mut Rng::new(7), bodies);
    let scene = Scene::new(scene).expect("a valid scene");
    let mut equations = LoadEquations::new(&scene, None);
    let size = equations.motion_size();
    let values: Vec<f64> = (0..bodies).map(|i| 0.3 + 0.1 * i as f64).collect();
    let (origin_body, omega_body) = (Vec3::unit_x(), Vec3::new(0.3, -0.7, 0.2));
    let turning = vec![[13.0, -2.0]; size.rotors];
    let motion = SceneMotion {
        omega_body,
        beta: &values,
        tau: &values,
        acceleration: VelocityChange { origin_body, omega_body, tau: &values },
        force_densities: &values,
        outside: &vec![[0.5; 3]; size.externals],
        rotors: &turning,
    };
    let mut expected = equations.load_set();
    equations.evaluate(&motion, &mut expected);
    let numbers = equations.numbers().len();
    let mut inputs = vec![f64::NAN; numbers + size.count()];
    motion.write(&mut inputs[numbers..]);
    let (name, scalar_path) = ("Loads".to_owned(), "::nboom_scalar".to_owned());
    let request = StressRequest { name, scalar_path, equations, level: Level::Exact };
    assert_eq!(request.trace().evaluate(&inputs), expected.numbers());
}
