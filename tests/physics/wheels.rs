//! Momentum wheels: rotors at commanded speeds and wheels that turn freely, against closed forms,
//! balances and the independent derivation.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::loads::{Loads, SceneMotion, VelocityChange};
use nboom::model::{
    Base, Body, Hinge, HingeState, Joint, MassDefect, MassProperties, ModelError, Mount, Rotor,
    Scene, SceneDescription, SectionShape, SegmentStructure, Station, Structure,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::Form;

use super::log::{options, run};
use super::newton_euler::{accelerations, loads, place, vector};
use super::random_scene::{Rng, all_acting, conservative, description, rotors, turning};

/// A body of revolution about x that turns about all axes.
fn top(about_x: f64, across: f64, omega: Vec3<f64>) -> SceneDescription {
    let body = MassProperties::new(20.0, Vec3::zero(), Sym3::diagonal(about_x, across, across));
    let mut scene = SceneDescription::at_rest("top", body, 20.0);
    scene.initial.omega_body = omega;
    scene
}

/// A wheel about x: without mass and without inertia across its axis, which its carrier has.
fn wheel(inertia: f64, speed: f64) -> Body {
    let about_x = MassProperties::new(0.0, Vec3::zero(), Sym3::diagonal(inertia, 0.0, 0.0));
    let mut hinge = Hinge::free();
    hinge.start.rate = speed;
    Body {
        inboard: None,
        mount: Mount::at(Vec3::zero()),
        joint: Joint::Revolute,
        axis: Vec3::unit_x(),
        mass_properties: about_x,
        tip: Vec3::unit_x(),
        hinge,
    }
}

const OMEGA: Vec3<f64> = Vec3::new(0.4, 0.3, -0.1);

/// ω turns about the axis of a symmetric gyrostat at ((A − C) ω₁ + h) / C, A with the rotor.
#[test]
fn a_rotor_turns_the_rate_of_a_symmetric_top() {
    let (a, c, j, speed) = (3.0, 5.0, 0.2, 40.0);
    let mut scene = top(a, c, OMEGA);
    scene.rotors =
        vec![Rotor { body: None, axis: Vec3::unit_x(), inertia: j, speed: speed.into() }];
    let found = run(&scene, &options(16, 1e-13));
    let turning = ((a + j - c) * OMEGA.x + j * speed) / c;
    for seen in &found.samples {
        let (s, cosine) = (turning * seen.time).sin_cos();
        let expected =
            Vec3::new(OMEGA.x, cosine * OMEGA.y - s * OMEGA.z, s * OMEGA.y + cosine * OMEGA.z);
        let off = (seen.omega_body - expected).norm();
        // Thirty radians of turning at a few 1e-14.
        assert!(off < 1e-12, "{off:e} at {}", seen.time);
    }
    let energy = found.summary.conservation.energy;
    let angular = found.summary.conservation.angular_momentum.expect("a free main body");
    assert!(angular < 1e-12 && energy < 1e-12, "{energy:e}");
    let held = 0.5 * ((a + j) * OMEGA.x * OMEGA.x + c * (OMEGA.y * OMEGA.y + OMEGA.z * OMEGA.z));
    let of_rotor = 0.5 * j * speed * speed + j * speed * OMEGA.x;
    let kinetic = found.samples[0].kinetic_energy;
    assert!((kinetic - held - of_rotor).abs() < 1e-12 * kinetic, "{kinetic}");
}

/// About the axis of a symmetric top a free wheel has no reason to change its speed: it is a rotor.
#[test]
fn a_free_wheel_on_a_symmetric_top_is_a_rotor() {
    let (j, speed) = (0.2, 40.0);
    let mut free = top(3.0, 5.0, OMEGA);
    free.bodies = vec![wheel(j, speed)];
    let mut driven = top(3.0, 5.0, OMEGA);
    driven.rotors =
        vec![Rotor { body: None, axis: Vec3::unit_x(), inertia: j, speed: speed.into() }];
    let [free, driven] = [free, driven].map(|scene| run(&scene, &options(8, 1e-13)));
    for (a, b) in free.samples.iter().zip(&driven.samples) {
        assert!((a.omega_body - b.omega_body).norm() < 1e-12, "at {}", a.time);
        assert!((a.tau[0] - speed).abs() < 1e-11);
        assert!((a.kinetic_energy - b.kinetic_energy).abs() < 1e-12 * a.kinetic_energy);
    }
}

/// A brake between wheel and carrier takes its speed away and leaves the common one of both.
#[test]
fn a_wheel_that_brakes_spins_its_carrier_up() {
    let (a, j, speed, brake) = (3.0, 0.2, 40.0, 0.05);
    let mut scene = top(a, 5.0, Vec3::zero());
    let mut braked = wheel(j, speed);
    braked.hinge.dashpot.rate_linear = -brake;
    scene.bodies = vec![braked];
    let found = run(&scene, &options(8, 1e-13));
    for seen in &found.samples {
        let left = (-brake * (1.0 / a + 1.0 / j) * seen.time).exp();
        assert!((seen.tau[0] - speed * left).abs() < 1e-11, "{} {}", seen.time, seen.tau[0]);
        let spin = j * speed * (1.0 - left) / (a + j);
        assert!((seen.omega_body.x - spin).abs() < 1e-12, "{} {}", seen.time, seen.omega_body.x);
    }
}

#[test]
fn what_is_no_wheel_must_have_mass() {
    let refused = |change: &dyn Fn(&mut Body)| {
        let mut scene = top(3.0, 5.0, OMEGA);
        let mut body = wheel(0.2, 0.0);
        change(&mut body);
        scene.bodies = vec![body];
        Scene::new(scene).expect_err("no body")
    };
    let across = refused(&|body| body.mass_properties.inertia.yy = 1e-3);
    let other_axis = refused(&|body| body.axis = Vec3::unit_y());
    let sliding = refused(&|body| body.joint = Joint::Prismatic);
    for (errors, expected) in [
        (across, MassDefect::WheelInertia),
        (other_axis, MassDefect::WheelInertia),
        (sliding, MassDefect::WheelSlides),
    ] {
        let [ModelError::Mass { defect, .. }] = &errors[..] else { panic!("{errors:?}") };
        assert_eq!(*defect, expected);
    }
}

/// Held or not, something has to have mass.
#[test]
fn a_wheel_alone_on_a_ground_without_mass_is_refused() {
    let mut scene = top(3.0, 5.0, Vec3::zero());
    scene.base = Base::Fixed;
    scene.main_body = MassProperties::nothing();
    scene.bodies = vec![wheel(0.2, 0.0)];
    let errors = Scene::new(scene.clone()).expect_err("no mass");
    let [ModelError::Mass { defect, .. }] = &errors[..] else { panic!("{errors:?}") };
    assert_eq!(*defect, MassDefect::Mass(0.0));
    scene.bodies[0].mass_properties.mass = 1.0;
    scene.bodies[0].mass_properties.inertia = Sym3::diagonal(1.0, 1.0, 1.0);
    Scene::new(scene).expect("what it carries has mass");
}

/// A station at each hinge, whose slice is the body.
fn stations_at_hinges(scene: &Scene) -> Structure {
    let segment = |body: &Body| SegmentStructure {
        stations: vec![Station {
            distance_from_hinge: 0.0,
            slice: body.mass_properties,
            section: SectionShape::Tube { radius: 0.05, thickness: 0.001 },
        }],
        ..SegmentStructure::default()
    };
    let segments = scene.bodies.iter().map(segment).collect();
    Structure::new(scene, segments).expect("each slice is its body")
}

fn random_rotors(bodies: usize, seed: u64) -> Vec<Rotor> {
    rotors(&mut Rng::new(seed ^ 0x5917), bodies)
}

/// Accelerations, torques of motors, and the loads that they leave at the hinges.
#[test]
fn trees_with_rotors_move_as_by_newton_and_euler() {
    for seed in 0..40 {
        let bodies = 1 + (seed % 6) as usize;
        let mut scene = description(bodies, seed);
        scene.rotors = random_rotors(bodies, seed);
        let dice = &mut Rng::new(seed);
        let held = |dice: &mut Rng| match dice.chance(0.2) {
            true => HingeState::Locked,
            false => HingeState::Free,
        };
        let hinges: Vec<HingeState> = (0..bodies).map(|_| held(dice)).collect();
        let of = |value: fn(&Body) -> f64| scene.bodies.iter().map(value).collect::<Vec<f64>>();
        let beta = of(|body| body.hinge.start.angle);
        let rates = of(|body| body.hinge.start.rate);
        let is_free: Vec<bool> = hinges.iter().map(|state| *state == HingeState::Free).collect();
        let of_free = |all: &[f64]| -> Vec<f64> {
            all.iter().zip(&is_free).filter(|(_, free)| **free).map(|(x, _)| *x).collect()
        };
        let tau: Vec<f64> = rates
            .iter()
            .zip(&is_free)
            .map(|(rate, free)| if *free { *rate } else { 0.0 })
            .collect();
        let omega = scene.initial.omega_body;
        let checked = Scene::new(scene.clone()).expect("a valid scene");
        let mode = all_acting(&checked, hinges);
        let mut dynamics = Recursive::new(&checked);
        dynamics.set_mode(&mode, &beta);
        let (free_beta, free_tau) = (of_free(&beta), of_free(&tau));
        let mut found = Accelerations::for_hinges(free_beta.len());
        let motion = Motion { omega_body: omega, beta: &free_beta, tau: &free_tau };
        dynamics.accelerations(&motion, &mut found);
        let placed = place(&scene, &beta, &tau, vector(omega), vector(Vec3::zero()));
        let acting = loads(&scene, &mode, &placed, &beta, &tau);
        let expected = accelerations(&scene, &mode, &placed, &tau, &acting);
        let expected_free = of_free(&expected.tau_dots);
        let largest = expected.omega_dots.iter().map(|w| w.norm()).fold(1.0, f64::max);
        // The dense solution errs by rounding times its condition.
        let off = (vector(found.omega_dot_body) - expected.omega_dots[0]).norm();
        assert!(off < 1e-9 * largest, "seed {seed}: {off:e}");
        for (a, b) in found.tau_dot.iter().zip(&expected_free) {
            assert!((a - b).abs() < 1e-9 * largest, "seed {seed}: {a} {b}");
        }
        let mut torques = Vec::new();
        dynamics.motor_torques(&motion, &found, &mut torques);
        for (rotor, torque) in scene.rotors.iter().zip(torques) {
            let carrier = rotor.body.map_or(0, |body| body + 1);
            let axis = placed[carrier].rot * vector(rotor.axis);
            let [_, rate] = turning(rotor, 0.0);
            let own = rotor.inertia * (rate + axis.dot(&expected.omega_dots[carrier]));
            assert!((torque - own).abs() < 1e-9 * largest, "seed {seed}: {torque} {own}");
        }
        let in_hinged = scene.rotors.iter().filter(|rotor| rotor.body.is_some());
        let turning: Vec<[f64; 2]> = in_hinged.map(|rotor| turning(rotor, 0.0)).collect();
        let mut of_loads = Loads::new(&checked, Some(&stations_at_hinges(&checked)));
        let mut set = of_loads.load_set();
        let tau_dot: Vec<f64> = expected.tau_dots.clone();
        let densities = vec![0.0; bodies];
        let acceleration = VelocityChange {
            origin_body: found.origin_body,
            omega_body: found.omega_dot_body,
            tau: &tau_dot,
        };
        let motion = SceneMotion {
            omega_body: omega,
            beta: &beta,
            tau: &tau,
            acceleration,
            force_densities: &densities,
            outside: &[],
            rotors: &turning,
        };
        of_loads.continuous(&motion, &mut set);
        for body in 0..bodies {
            let (at_hinge, [station]) = (set.hinge(body).moment, set.stations(body)) else {
                panic!("one station of each body")
            };
            let off = (station.moment - at_hinge).norm();
            // Both are sums of the same terms.
            assert!(off < 1e-12 * (1.0 + at_hinge.norm()), "seed {seed}: {off:e}");
        }
        let outermost = bodies - 1;
        if scene.bodies[outermost].hinge.kick_off.is_none() {
            let own = &placed[bodies];
            let rate = expected.centers[bodies] * own.mass;
            let spin = own.inertia * expected.omega_dots[bodies]
                + own.gyroscopic()
                + (own.center - own.origin).cross(&rate);
            let off = (own.rot * vector(set.hinge(outermost).moment) - spin).norm();
            assert!(off < 1e-9 * (1.0 + spin.norm()), "seed {seed}: {off:e}");
        }
    }
}

#[test]
fn trees_with_rotors_keep_their_balances_by_all_code() {
    for seed in 0..12 {
        let bodies = 1 + (seed % 4) as usize;
        let mut scene = conservative(bodies, seed);
        scene.end_time = 0.3;
        scene.rotors = random_rotors(bodies, seed);
        // A latch jerks at the motors as well.
        let hinge = &mut scene.bodies[0].hinge;
        hinge.lock_angle = Some(hinge.start.angle + 0.05 * hinge.start.rate);
        let mut ends = Vec::new();
        for formulation in [None, Form::named("symmetric")] {
            let options = nboom::sim::Options { formulation, ..options(2, 1e-12) };
            let found = run(&scene, &options);
            let balance = found.summary.conservation;
            assert!(
                balance.energy < 1e-9 && balance.angular_momentum.is_some_and(|off| off < 1e-9),
                "{seed} {balance:?}"
            );
            let last = found.last();
            let of_bodies = last.bodies(&Scene::new(scene.clone()).expect("a valid scene"));
            let sum = of_bodies
                .iter()
                .fold(Vec3::zero(), |sum, body| sum + body.angular_momentum_about(Vec3::zero()));
            let mass: f64 = scene.main_body.mass
                + scene.bodies.iter().map(|body| body.mass_properties.mass).sum::<f64>();
            let center = of_bodies.iter().zip(
                std::iter::once(scene.main_body.mass)
                    .chain(scene.bodies.iter().map(|body| body.mass_properties.mass)),
            );
            let center = center
                .fold(Vec3::zero(), |sum, (body, mass)| sum + body.mass_center_inertial * mass)
                * (1.0 / mass);
            let about_center = sum - center.cross(last.linear_momentum_inertial);
            let off = (about_center - last.angular_momentum_inertial).norm();
            assert!(off < 1e-11 * (1.0 + sum.norm()), "{seed}: {off:e}");
            ends.push(last.beta.clone());
        }
        for (a, b) in ends[0].iter().zip(&ends[1]) {
            assert!((a - b).abs() < 1e-9, "seed {seed}: {a} {b}");
        }
    }
}
