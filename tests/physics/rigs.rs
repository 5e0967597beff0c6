//! A main body that a test rig holds: closed forms, and the motion of a free one under the reaction.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::model::{
    Base, Body, Drive, DrivePoint, Gravity, Hinge, HingeStart, HingeState, InitialMotion, Joint,
    MassProperties, Mode, Mount, Release, Scene, SceneDescription,
};
use nboom::scalar::{Kernel, Sym3, Vec3};
use nboom::sim::{EventKind, Form, Method, Options, Path, Selection};

use super::collect::{self, detail};
use super::log::{options, run};
use super::random_scene::{all_acting, conservative, hinged};

/// Runs at the tightest tolerance err by a few 1e-14 of each quantity.
const TOLERANCE: f64 = 1e-12;

fn is_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= TOLERANCE * expected.abs(), "{found} {expected}");
}

/// A main body that is fixed, which carries one body.
fn on_rig(
    mass_properties: MassProperties,
    joint: Joint,
    axis: Vec3<f64>,
    hinge: Hinge,
) -> SceneDescription {
    let hub = MassProperties::new(5.0, Vec3::unit_z(), Sym3::diagonal(2.0, 3.0, 4.0));
    let mut scene = SceneDescription::at_rest("rig", hub, 3.0);
    scene.base = Base::Fixed;
    let mount = Mount::at(Vec3::zero());
    let tip = Vec3::unit_x();
    scene.bodies = vec![Body { inboard: None, mount, joint, axis, mass_properties, tip, hinge }];
    scene
}

/// Fixes the main body, or moves it about and along `axis` with these changes of rate and speed.
fn hold(scene: &mut SceneDescription, axis: Vec3<f64>, [alpha, a]: [f64; 2]) {
    let point = |time: f64| DrivePoint { time, rate: 0.4 + alpha * time, speed: -0.3 + a * time };
    let points = vec![point(0.0), point(0.25), point(2.0)];
    let is_fixed = [alpha, a] == [0.0, 0.0];
    scene.base = if is_fixed { Base::Fixed } else { Base::Driven(Drive { axis, points }) };
    (scene.initial.omega_body, scene.initial.velocity_inertial) = (Vec3::zero(), Vec3::zero());
    scene.begin_driven([false; 2]);
}

/// A quarter of the period of a pendulum of the natural frequency 1 that turns back at `amplitude`, by the
/// arithmetic-geometric mean.
fn quarter_period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * std::f64::consts::PI / a
}

/// A pendulum on a rig falls from rest and latches at the bottom. The rig is turned in space, and so is
/// gravity with it.
#[test]
fn a_pendulum_takes_a_quarter_of_its_period_to_the_bottom() {
    let (mass, length, about_centre, g, amplitude) = (2.0, 1.5, 0.4, 9.81, 2.0);
    let bob =
        MassProperties::new(mass, Vec3::unit_x() * length, Sym3::diagonal(0.2, 0.3, about_centre));
    let start = HingeStart { angle: -amplitude, rate: 0.0, state: HingeState::Free };
    let hinge = Hinge { start, lock_angle: Some(0.0), ..Hinge::free() };
    let mut scene = on_rig(bob, Joint::Revolute, Vec3::unit_z(), hinge);
    let tilted = super::random_scene::Rng::new(5).attitude();
    // At angle zero the pendulum hangs along x of the rig.
    let up = tilted.to_matrix() * -Vec3::unit_x();
    scene.gravity = Some(Gravity { acceleration: g, up });
    let position_inertial = Vec3::new(3.0, -2.0, 1.0);
    scene.initial =
        InitialMotion { attitude: tilted, position_inertial, ..InitialMotion::at_rest() };
    let found = run(&scene, &options(3, 1e-13));

    let about_hinge = about_centre + mass * length * length;
    let frequency = (mass * g * length / about_hinge).sqrt();
    let [(latch, after)] = found.of_kind(EventKind::LockUp)[..] else { panic!("one latch") };
    is_close(latch.time, quarter_period(amplitude) / frequency);
    let rate = 2.0 * frequency * (0.5 * amplitude).sin();
    is_close(latch.impulse.expect("a latch has an impulse"), -about_hinge * rate);
    is_close(latch.before.kinetic_energy, 0.5 * about_hinge * rate * rate);
    assert_eq!(latch.after.kinetic_energy, 0.0);
    assert_eq!(after.omega_body, Vec3::zero());
    for seen in &found.samples {
        assert_eq!(seen.position_inertial, position_inertial);
    }
    // At rest the rig carries the weight of all.
    let reaction = detail(found.last()).reaction.expect("the rig holds the main body");
    is_close(reaction.force.x, -(mass + 5.0) * g);
    is_close(reaction.moment.y, -5.0 * g);
    let balance = found.summary.conservation;
    assert!(balance.energy < 1e-12, "{balance:?}");
    assert_eq!((balance.linear_momentum, balance.angular_momentum), (None, None));
}

/// A spring pushes a mast out of a rig: the mass that moves is that of the mast alone.
#[test]
fn a_mast_on_a_rig_is_pushed_out_and_caught() {
    let (mass, k, rest, [from, to]) = (8.0, 40.0, 3.0, [0.2, 2.0]);
    let mast = MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(0.3, 0.4, 0.5));
    let start = HingeStart { angle: from, rate: 0.0, state: HingeState::Unreleased };
    let release = Release::Time(0.5);
    let mut hinge = Hinge { start, release, lock_angle: Some(to), ..Hinge::free() };
    (hinge.spring.linear, hinge.spring.preload_angle) = (-k, -rest);
    let found = run(&on_rig(mast, Joint::Prismatic, Vec3::unit_x(), hinge), &options(10, 1e-13));

    let frequency = (k / mass).sqrt();
    let phase = ((to - rest) / (from - rest)).acos();
    let speed = (rest - from) * frequency * phase.sin();
    let [(latch, _)] = found.of_kind(EventKind::LockUp)[..] else { panic!("one latch") };
    is_close(latch.time, 0.5 + phase / frequency);
    is_close(latch.impulse.expect("a latch has an impulse"), -mass * speed);
    for seen in &found.samples {
        let moves = seen.hinges[0] == HingeState::Free;
        let push = if moves { k * (rest - seen.beta[0]) } else { 0.0 };
        let reaction = detail(seen).reaction.expect("the rig holds the main body");
        assert!((reaction.force.x - push).abs() < 1e-11 * k, "{reaction:?} {push}");
    }
}

/// Mass matrix and right side of the free satellite, another derivation, hold with the accelerations of the
/// held one and the reaction that was found.
#[test]
fn a_free_main_body_moves_likewise_under_the_reaction() {
    for seed in 0..60 {
        let bodies = 1 + (seed % 6) as usize;
        let mut scene = hinged(bodies, seed);
        let axis = Vec3::new(0.6, 0.0, 0.8);
        let up = scene.initial.attitude.to_matrix() * axis;
        scene.gravity = Some(Gravity { acceleration: 3.0, up });
        let (alpha, a) = if seed % 2 == 0 { (0.0, 0.0) } else { (0.7, -1.1) };
        hold(&mut scene, axis, [alpha, a]);
        let omega_body = scene.initial.omega_body;
        let scene = Scene::new(scene).expect("a valid scene");
        let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
        let tau: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.rate).collect();
        let mode = all_acting(&scene, vec![HingeState::Free; bodies]);
        let mode = Mode { drive: 1, ..mode };
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &beta);
        let mut found = Accelerations::for_hinges(bodies);
        let motion = Motion { omega_body, beta: &beta, tau: &tau };
        dynamics.set_outside(scene.initial.attitude, 0.0);
        dynamics.accelerations(&motion, &mut found);
        assert!((found.omega_dot_body - axis * alpha).norm() < 1e-15);
        // Gravity is no acceleration here, so the rig accelerates upward.
        assert!((found.origin_body - axis * (3.0 + a)).norm() < 1e-14);
        let reaction = dynamics.reaction(&motion, &found);

        let size = 6 + bodies;
        let (mut matrix, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        dynamics.equations(&motion, &mut matrix, &mut right);
        let unknowns = [found.origin_body.to_array(), found.omega_dot_body.to_array()].concat();
        let unknowns = [unknowns, found.tau_dot].concat();
        let acting = [reaction.force.to_array(), reaction.moment.to_array()].concat();
        for (i, right) in right.iter().enumerate() {
            let terms = matrix[i * size..][..size].iter().zip(&unknowns).map(|(m, x)| m * x);
            let terms: Vec<f64> = terms.collect();
            let scale = terms.iter().fold(right.abs(), |most, term| most.max(term.abs()));
            let left: f64 = terms.iter().sum();
            let expected = right + acting.get(i).copied().unwrap_or(0.0);
            // The elimination errs by rounding times the condition of the hinges' block.
            assert!((left - expected).abs() < 1e-11 * scale, "seed {seed}, row {i}");
        }
    }
}

#[test]
fn trees_on_a_rig_keep_their_energy_by_all_code_that_covers_them() {
    let mut latches = 0;
    for seed in 0..20 {
        let bodies = 1 + (seed % 5) as usize;
        let mut scene = conservative(bodies, seed);
        let axis = Vec3::new(0.6, 0.0, 0.8);
        let up = scene.initial.attitude.to_matrix() * axis;
        scene.gravity = Some(Gravity { acceleration: 3.0, up });
        scene.end_time = 0.5;
        hold(&mut scene, axis, if seed % 2 == 0 { [0.0, 0.0] } else { [0.7, -1.1] });
        for hinge in scene.bodies.iter_mut().map(|body| &mut body.hinge) {
            hinge.lock_angle = Some(hinge.start.angle + 0.2 * hinge.start.rate);
        }
        let mut ends = Vec::new();
        for formulation in [None, Form::named("symmetric")] {
            let options = Options { formulation, ..options(2, 1e-12) };
            let found = run(&scene, &options);
            assert!(found.summary.conservation.energy < 1e-9, "{seed}");
            latches += found.of_kind(EventKind::LockUp).len();
            ends.push(found.last().beta.clone());
        }
        for (a, b) in ends[0].iter().zip(&ends[1]) {
            assert!((a - b).abs() < 1e-9, "seed {seed}: {a} {b}");
        }
    }
    assert!(latches > 20, "{latches}");
}

/// Routines for accelerations, and for right sides those that are for eight states too.
fn also_of_eight_states() -> &'static [Kernel] {
    let batches = nboom_routines::right_sides_of_eight();
    let of_eight = |kernel: &&Kernel| batches.iter().any(|batch| batch.is_of_same_routine(*kernel));
    let right_sides = nboom_routines::right_sides().iter().filter(of_eight);
    nboom_routines::all().iter().chain(right_sides).copied().collect::<Vec<_>>().leak()
}

/// A chain on a rig, by stock routines and by the recursion: whole right sides, one state and eight at once, under
/// dashpots whose work is integrated, on a rig that is fixed, in weightlessness too, or is moved.
#[test]
fn rigs_run_by_generated_code_as_by_the_recursion() {
    let (axis, kernels) = (Vec3::unit_z(), also_of_eight_states());
    for (weight, changes) in [(0.0, [0.0, 0.0]), (3.0, [0.0, 0.0]), (3.0, [0.7, -1.1])] {
        let label = format!("weight {weight}, changes {changes:?}");
        let mut scene = on_rig(
            MassProperties::new(2.0, Vec3::unit_x(), Sym3::diagonal(0.1, 0.9, 0.9)),
            Joint::Revolute,
            Vec3::unit_y(),
            Hinge::free(),
        );
        let second = Body { inboard: Some(0), ..scene.bodies[0] };
        scene.bodies.push(second);
        for (body, lock) in scene.bodies.iter_mut().zip([Some(0.6), None]) {
            body.mount.point = if body.inboard.is_some() { body.tip } else { Vec3::unit_x() };
            body.hinge.dashpot.rate_linear = -0.3;
            body.hinge.lock_angle = lock;
        }
        scene.gravity = (weight > 0.0).then_some(Gravity { acceleration: weight, up: axis });
        scene.bodies[0].hinge.start.rate = 0.5;
        hold(&mut scene, axis, changes);
        let scene = Scene::new(scene).expect("a valid scene");
        for integrator in [Method::Dop853, Method::GaussLanes] {
            let by = |path: Path| {
                let batches = nboom_routines::right_sides_of_eight();
                let options = Options { path, kernels, batches, integrator, ..options(8, 1e-12) };
                collect::run(&scene, &options)
            };
            let [(generated, told), (generic, _)] = [Path::Generated, Path::Generic].map(by);
            assert_eq!(told.code().generated_share, 1.0);
            for Selection { reason, .. } in &told.selections {
                assert!(reason.ends_with("whole right side, also of eight states"), "{reason}");
            }
            let latches = generated.happenings();
            assert!(latches.iter().any(|(kind, ..)| *kind == EventKind::LockUp), "{label}");
            assert!(told.conservation.energy < 1e-10, "{label}: {:?}", told.conservation);
            for (a, b) in generated.samples.iter().zip(&generic.samples) {
                if scene.base == Base::Fixed {
                    assert_eq!(a.omega_body, Vec3::zero());
                }
                let [acceleration, expected] = [a, b].map(|seen| detail(seen).omega_dot_body);
                assert_eq!(acceleration, expected);
                // Sums over other steps.
                assert!((a.omega_body - b.omega_body).norm() < 1e-13);
                let [a, b] = [a, b].map(|seen| [&seen.beta[..], &seen.tau].concat());
                let differ = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                // Both take the same steps and differ by rounding, a few 1e-15.
                assert!(differ < 1e-12, "{label}, {integrator}: {differ:e}");
            }
        }
    }
}

/// A table speeds up and slows down under a boom on its axis, which stays as it is in space, whatever gravity
/// along the axis; it turns half a turn on the table until its latch takes it along.
#[test]
fn a_boom_on_the_axis_of_a_spin_table_stays_behind() {
    let boom = MassProperties::new(2.0, Vec3::unit_x() * 1.5, Sym3::diagonal(0.1, 0.4, 0.5));
    let half_turn = std::f64::consts::PI;
    let hinge = Hinge { lock_angle: Some(-half_turn), ..Hinge::free() };
    let mut scene = on_rig(boom, Joint::Revolute, Vec3::unit_z(), hinge);
    let rates = [(0.0, 0.0), (2.0, 1.0), (4.0, 1.5), (5.0, 0.5)];
    let points = rates.map(|(time, rate)| DrivePoint { time, rate, speed: 0.0 }).to_vec();
    scene.base = Base::Driven(Drive { axis: Vec3::unit_z(), points });
    scene.gravity = Some(Gravity { acceleration: 9.81, up: Vec3::unit_z() });
    scene.end_time = 6.0;
    let found = run(&scene, &options(60, 1e-13));
    // The table has turned by 1 at 2, by 1 + s + s²/8 later on.
    let latch_time = 2.0 + 4.0 * (-1.0 + (1.0 + 0.5 * (half_turn - 1.0)).sqrt());
    let [(latch, after)] = found.of_kind(EventKind::LockUp)[..] else { panic!("one latch") };
    is_close(latch.time, latch_time);
    let rate = 1.0 + 0.25 * (latch_time - 2.0);
    let about_axis = 0.5 + 2.0 * 1.5 * 1.5;
    is_close(latch.impulse.expect("a latch has an impulse"), about_axis * rate);
    is_close(after.omega_body.z, rate);
    for seen in &found.samples {
        let behind = seen.beta[0] + 2.0 * seen.attitude.vector.z.atan2(seen.attitude.scalar);
        if seen.time < latch_time {
            assert!(behind.abs() < 1e-12 && (seen.tau[0] + seen.omega_body.z).abs() < 1e-12);
            continue;
        }
        let reaction = detail(seen).reaction.expect("the table holds the main body");
        let alpha = match seen.time {
            time if time < 4.0 => 0.25,
            time if time < 5.0 => -1.0,
            _ => 0.0,
        };
        let torque = (about_axis + 4.0) * alpha;
        assert!((reaction.moment.z - torque).abs() < 1e-12, "{} {reaction:?}", seen.time);
    }
    assert!(found.summary.conservation.energy < 1e-12, "{:?}", found.summary.conservation);
}

/// A shaker pulls the rig away from a sprung mass: an oscillator under the opposite acceleration. The shaker
/// may begin to speed up in the instant in which the run starts.
#[test]
fn a_sprung_mass_on_a_shaker_swings_about_another_point() {
    for (start, speeds_up) in [(0.0, 0.0), (3.0, 3.0_f64.next_up())] {
        let (mass, k, a) = (3.0, 12.0, 0.8);
        let body = MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(0.3, 0.4, 0.5));
        let mut hinge = Hinge::free();
        hinge.spring.linear = -k;
        let mut scene = on_rig(body, Joint::Prismatic, Vec3::unit_x(), hinge);
        (scene.initial.time, scene.end_time) = (start, start + 3.0);
        let point = |time: f64, speed: f64| DrivePoint { time, rate: 0.0, speed };
        let before = point(speeds_up - 1.0, -0.5);
        let points = vec![before, point(speeds_up, -0.5), point(start + 10.0, -0.5 + 10.0 * a)];
        scene.base = Base::Driven(Drive { axis: Vec3::unit_x(), points });
        scene.begin_driven([false; 2]);
        let found = run(&scene, &options(20, 1e-13));
        let (frequency, rest) = ((k / mass).sqrt(), -mass * a / k);
        for seen in &found.samples {
            let time = seen.time - start;
            let x = rest * (1.0 - (frequency * time).cos());
            assert!((seen.beta[0] - x).abs() < 1e-12, "{}", seen.time);
            let place = (-0.5 + 0.5 * a * time) * time;
            assert!((seen.position_inertial.x - place).abs() < 1e-12);
        }
        assert!(found.summary.conservation.energy < 1e-12);
    }
}
