//! Loads of booms whose closed forms are in every book on beams.

use nboom_dynamics::{Impulses, Recursive, Struck};
use nboom_loads::{LoadSet, Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom_model::{
    Appendage, Body, Hinge, HingeState, Joint, KickOffSpring, MassProperties, Material, Mode,
    Mount, Rotor, RotorSpeed, Scene, SceneDescription, SectionShape, Segment, SegmentStructure,
    Station, Structure,
};
use nboom_scalar::{Mat3, Sym3, Vec3};

const MASS: f64 = 3.0;
const LENGTH: f64 = 2.0;
/// Mass per length.
const DENSITY: f64 = MASS / LENGTH;
const STATIONS: [f64; 6] = [2.0, 1.7, 1.0, 0.4, 0.1, 0.0];
const HUB_MASS: f64 = 20.0;
/// Of the hub about the hinge axis, x.
const HUB_INERTIA: f64 = 7.0;

/// A few roundings of the numbers that a load is made of, all of them about ten at most.
const ROUNDING: f64 = 1e-13;

fn slice(from: f64, to: f64) -> MassProperties {
    let (mass, length) = (DENSITY * (to - from), to - from);
    let across = mass * length * length / 12.0;
    let middle = Vec3::unit_y() * (0.5 * (from + to));
    MassProperties::new(mass, middle, Sym3::diagonal(across, 0.0, across))
}

fn cut_at(distances: &[f64]) -> SegmentStructure {
    let outer = [LENGTH].into_iter().chain(distances.iter().copied());
    let station = |(&distance, outer): (&f64, f64)| Station {
        distance_from_hinge: distance,
        slice: slice(distance, outer),
        section: SectionShape::Tube { radius: 0.1, thickness: 0.01 },
    };
    SegmentStructure {
        pulse_constant: 0.25,
        material: Material::elastic(7e10, 0.3),
        stations: distances.iter().zip(outer).map(station).collect(),
    }
}

/// A uniform boom along y on a hub whose mass centre is at O.
fn boom(mount: Vec3<f64>, kick_off: Option<KickOffSpring>) -> Scene {
    let hub = MassProperties::new(HUB_MASS, Vec3::zero(), Sym3::diagonal(HUB_INERTIA, 9.0, 8.0));
    let hinge = Hinge { kick_off, ..Hinge::free() };
    let segments = vec![Segment { length: LENGTH, mass_properties: slice(0.0, LENGTH), hinge }];
    let mut description = SceneDescription::at_rest("one boom", hub, 1.0);
    description.attach(&Appendage::Regular { mount: Mount::at(mount), segments });
    Scene::new(description).expect("a rod is a body")
}

fn structure(scene: &Scene, distances: &[f64]) -> Structure {
    Structure::new(scene, vec![cut_at(distances)]).expect("slices make the rod")
}

/// Rates ω and accelerations (ω̇, a_O) of a scene whose one hinge stands still at angle zero.
fn rigid(
    scene: &Scene,
    omega_body: Vec3<f64>,
    [omega_dot, origin]: [Vec3<f64>; 2],
    kick_off: bool,
) -> LoadSet {
    let mut loads = Loads::new(scene, Some(&structure(scene, &STATIONS)));
    let mut found = loads.load_set();
    let acceleration = VelocityChange { origin_body: origin, omega_body: omega_dot, tau: &[0.0] };
    let force_densities = &[if kick_off { (1.0 + 2.0 * 1.5) / 1.5 } else { 0.0 }];
    let motion = SceneMotion {
        omega_body,
        beta: &[0.0],
        tau: &[0.0],
        acceleration,
        force_densities,
        outside: &[],
        rotors: &[],
    };
    loads.continuous(&motion, &mut found);
    found
}

#[track_caller]
fn assert_near(found: Vec3<f64>, expected: [f64; 3]) {
    let error = (found - expected.into()).norm();
    let scale = 10.0 * DENSITY;
    assert!(error < ROUNDING * scale, "{found:?} found, {expected:?} expected");
}

#[test]
fn tension_of_a_spinning_boom() {
    let (spin, offset) = (2.0, 0.5);
    let scene = boom(Vec3::unit_y() * offset, None);
    let found = rigid(&scene, Vec3::unit_z() * spin, [Vec3::zero(); 2], false);
    for (load, s) in found.stations(0).iter().zip(STATIONS) {
        // ∫ μ w² (d + y) dy from s to the tip, towards the hinge.
        let tension =
            DENSITY * spin * spin * (offset * (LENGTH - s) + 0.5 * (LENGTH * LENGTH - s * s));
        assert_near(load.force, [0.0, -tension, 0.0]);
        assert_near(load.moment, [0.0; 3]);
    }
}

#[test]
fn a_cantilever_that_is_accelerated() {
    let scene = boom(Vec3::zero(), None);
    let (along_x, along_z) = (0.7, -1.3);
    let acceleration = Vec3::new(along_x, 0.0, along_z);
    let found = rigid(&scene, Vec3::zero(), [Vec3::zero(), acceleration], false);
    for (load, s) in found.stations(0).iter().zip(STATIONS) {
        let (mass, arm) = (DENSITY * (LENGTH - s), 0.5 * (LENGTH - s));
        assert_near(load.force, [mass * along_x, 0.0, mass * along_z]);
        assert_near(load.moment, [arm * mass * along_z, 0.0, -arm * mass * along_x]);
    }
    assert_eq!(found.hinge(0).force, found.stations(0)[5].force);
}

/// Force across and bending moment at s of a boom whose points at y accelerate with a + α y.
fn bending(a: f64, alpha: f64, s: f64) -> (f64, f64) {
    let power = |n: i32| (LENGTH.powi(n) - s.powi(n)) / f64::from(n);
    let force = DENSITY * (a * power(1) + alpha * power(2));
    (force, DENSITY * (a * power(2) + alpha * power(3)) - s * force)
}

#[test]
fn a_cantilever_that_starts_to_turn() {
    let scene = boom(Vec3::zero(), None);
    let found = rigid(&scene, Vec3::zero(), [Vec3::unit_x() * 2.5, Vec3::zero()], false);
    for (load, s) in found.stations(0).iter().zip(STATIONS) {
        let (force, moment) = bending(0.0, 2.5, s);
        assert_near(load.force, [0.0, 0.0, force]);
        assert_near(load.moment, [moment, 0.0, 0.0]);
    }
}

#[test]
fn a_swinging_boom_has_the_hinge_rates_and_its_own_axes() {
    // The hinge turns by 0.6 rad/s about x at an angle of 0.4; the hub stands still.
    let scene = boom(Vec3::zero(), None);
    let mut loads = Loads::new(&scene, Some(&structure(&scene, &STATIONS)));
    let mut found = loads.load_set();
    let zero = Vec3::zero();
    let acceleration = VelocityChange { origin_body: zero, omega_body: zero, tau: &[2.5] };
    let (omega_body, beta, tau) = (zero, &[0.4], &[0.6]);
    let motion = SceneMotion {
        omega_body,
        beta,
        tau,
        acceleration,
        force_densities: &[0.0],
        outside: &[],
        rotors: &[],
    };
    loads.continuous(&motion, &mut found);
    for (load, s) in found.stations(0).iter().zip(STATIONS) {
        let (force, moment) = bending(0.0, 2.5, s);
        let tension = DENSITY * 0.36 * 0.5 * (LENGTH * LENGTH - s * s);
        assert_near(load.force, [0.0, -tension, force]);
        assert_near(load.moment, [moment, 0.0, 0.0]);
    }
}

#[test]
fn lock_up_of_a_boom() {
    // Plane motion: hub (M, J) with its mass centre on the hinge, boom (m, L) at rate Ω + τ.
    let scene = boom(Vec3::zero(), None);
    let structure = structure(&scene, &STATIONS);
    let (beta, tau) = (0.7, -1.9);
    let first_moment = 0.5 * MASS * LENGTH;
    let effective = MASS * LENGTH * LENGTH / 3.0 - first_moment.powi(2) / (HUB_MASS + MASS);
    let latch = -tau * HUB_INERTIA * effective / (HUB_INERTIA + effective);
    let turn = latch / effective;
    let origin = -first_moment * turn / (HUB_MASS + MASS);

    let mut dynamics = Recursive::new(&scene);
    dynamics.set_mode(&Mode::at_start(&scene), &[beta]);
    let mut lock_up = Impulses::of_none();
    let locks = [Struck::locks(0)];
    dynamics.strike(&[beta], &[tau], &locks, &mut lock_up).expect("the boom has inertia");
    assert!((lock_up.torques[0] - latch).abs() < 1e-14 * latch);
    let jump = VelocityChange {
        origin_body: lock_up.delta_velocity_body,
        omega_body: lock_up.delta_omega_body,
        tau: &lock_up.delta_tau,
    };
    let mut loads = Loads::new(&scene, Some(&structure));
    let mut impulses = loads.load_set();
    loads.impulses(&[beta], &jump, &mut impulses);
    for (load, s) in impulses.stations(0).iter().zip(STATIONS) {
        let (force, moment) = bending(origin, turn, s);
        assert_near(load.force, [0.0, 0.0, force]);
        assert_near(load.moment, [moment, 0.0, 0.0]);
    }
    assert_near(impulses.hinge(0).moment, [latch, 0.0, 0.0]);

    let pulse_constant = structure.segments()[0].pulse_constant;
    let share = LockUpShare { pulse_constant, jump };
    let mut peaks = rigid(&scene, Vec3::unit_z(), [Vec3::zero(); 2], false);
    let continuous = peaks.clone();
    loads.add_lock_up(&[beta], &[share], 1.5, &mut peaks);
    let all = continuous.stations(0).iter().zip(impulses.stations(0)).zip(peaks.stations(0));
    for ((before, impulse), peak) in all {
        assert_near(peak.force, (before.force + impulse.force * (1.5 / 0.25)).to_array());
        assert_near(peak.moment, (before.moment + impulse.moment * (1.5 / 0.25)).to_array());
    }
}

#[test]
fn a_station_does_not_depend_on_others() {
    let scene = boom(Vec3::new(0.1, 0.3, -0.2), None);
    let omega = Vec3::new(0.3, -1.0, 0.8);
    let accelerations = [Vec3::new(1.0, 2.0, -0.5), Vec3::new(0.2, -0.1, 0.4)];
    let many = rigid(&scene, omega, accelerations, false);
    for (j, s) in STATIONS.into_iter().enumerate().filter(|(_, s)| *s > 0.0) {
        let mut loads = Loads::new(&scene, Some(&structure(&scene, &[s, 0.0])));
        let mut found = loads.load_set();
        let [omega_body, origin_body] = accelerations;
        let acceleration = VelocityChange { origin_body, omega_body, tau: &[0.0] };
        let (beta, tau, force_densities) = (&[0.0], &[0.0], &[0.0]);
        let motion = SceneMotion {
            omega_body: omega,
            beta,
            tau,
            acceleration,
            force_densities,
            outside: &[],
            rotors: &[],
        };
        loads.continuous(&motion, &mut found);
        for (alone, beside) in [(0, j), (1, STATIONS.len() - 1)] {
            let (alone, beside) = (found.stations(0)[alone], many.stations(0)[beside]);
            assert_near(alone.force, beside.force.to_array());
            assert_near(alone.moment, beside.moment.to_array());
        }
    }
}

#[test]
fn a_kick_off_spring_pushes_inboard_of_where_it_is_attached() {
    // From (0, 1, −1) on the hub to (0, 1, 0.5) on the boom: 1.5 long, along z.
    let spring = KickOffSpring {
        main_body_point: Vec3::new(0.0, 1.0, -1.0),
        body_point: Vec3::new(0.0, 1.0, 0.5),
        coefficients: [1.0, 2.0, 0.0, 0.0],
        limit_length: 5.0,
    };
    let scene = boom(Vec3::zero(), Some(spring));
    let [pushed, slack] =
        [true, false].map(|acts| rigid(&scene, Vec3::zero(), [Vec3::zero(); 2], acts));
    let force = 1.0 + 2.0 * 1.5;
    let stations = pushed.stations(0).iter().copied().chain([pushed.hinge(0)]);
    for (load, s) in stations.zip(STATIONS.into_iter().chain([0.0])) {
        let (felt, arm) = if s <= 1.0 { (force, 1.0 - s) } else { (0.0, 0.0) };
        assert_near(load.force, [0.0, 0.0, -felt]);
        assert_near(load.moment, [-felt * arm, 0.0, 0.0]);
    }
    assert!(slack.stations(0).iter().all(|load| load.force == Vec3::zero()));
}

#[test]
fn a_second_boom_is_carried_by_the_stations_inboard_of_it() {
    // A branch at y = 1, square to the first boom, that is dragged along x.
    let mut description = (*boom(Vec3::zero(), None)).clone();
    let mut branch = description.bodies[0];
    branch.inboard = Some(0);
    branch.mount = Mount {
        point: Vec3::unit_y(),
        rot_inboard_from_hinge: Mat3::about_x(std::f64::consts::FRAC_PI_2),
    };
    description.bodies.push(branch);
    let scene = Scene::new(description).expect("rods are bodies");
    let structure = Structure::new(&scene, vec![cut_at(&STATIONS), cut_at(&[])]);
    let mut loads = Loads::new(&scene, Some(&structure.expect("slices make the rods")));
    let mut found = loads.load_set();
    let zero = Vec3::zero();
    let acceleration =
        VelocityChange { origin_body: Vec3::unit_x(), omega_body: zero, tau: &[0.0; 2] };
    let (beta, tau, force_densities) = (&[0.0; 2], &[0.0; 2], &[0.0; 2]);
    let motion = SceneMotion {
        omega_body: zero,
        beta,
        tau,
        acceleration,
        force_densities,
        outside: &[],
        rotors: &[],
    };
    loads.continuous(&motion, &mut found);
    assert_near(found.hinge(1).force, [MASS, 0.0, 0.0]);
    assert_near(found.hinge(1).moment, [0.0, 0.0, -MASS]);
    for (load, s) in found.stations(0).iter().zip(STATIONS) {
        let (force, moment) = bending(1.0, 0.0, s);
        let carried = if s <= 1.0 { MASS } else { 0.0 };
        assert_near(load.force, [force + carried, 0.0, 0.0]);
        // The branch reaches along z; its mass centre is 1 from the first boom.
        assert_near(load.moment, [0.0, carried, -moment - carried * (1.0 - s)]);
    }
}

#[test]
fn the_hinge_that_is_out_of_balance_most_is_named_wherever_it_is() {
    // Two booms on one hub, turning about x with their hinges alone: torques are J τ̇.
    let mut description = (*boom(Vec3::zero(), None)).clone();
    description.bodies.push(description.bodies[0]);
    let scene = Scene::new(description).expect("rods are bodies");
    let mut loads = Loads::new(&scene, None);
    let mut found = loads.load_set();
    let (zero, tau_dot) = (Vec3::zero(), [2.0, 3.0]);
    let acceleration = VelocityChange { origin_body: zero, omega_body: zero, tau: &tau_dot };
    let (beta, tau, force_densities) = (&[0.0; 2], &[0.0; 2], &[0.0; 2]);
    let motion = SceneMotion {
        omega_body: zero,
        beta,
        tau,
        acceleration,
        force_densities,
        outside: &[],
        rotors: &[],
    };
    loads.continuous(&motion, &mut found);
    let torques = tau_dot.map(|tau_dot| MASS * LENGTH * LENGTH / 3.0 * tau_dot);
    let free = [HingeState::Free; 2];
    let (_, residual) = loads.largest_torque_residual(&found, &free, &torques).expect("two");
    assert!(residual < ROUNDING, "{residual:e}");
    for hinge in [0, 1] {
        let mut wrong = torques;
        wrong[hinge] *= 1.1;
        let most = loads.largest_torque_residual(&found, &free, &wrong);
        let (named, residual) = most.expect("two are free");
        // A tenth of a torque, of what is at most some times as much.
        assert!(named == hinge && residual > 0.01, "{named} instead of {hinge}, {residual}");
        // Nobody looks at a hinge that is held.
        let mut held = free;
        held[hinge] = HingeState::Locked;
        let (named, residual) = loads.largest_torque_residual(&found, &held, &wrong).expect("one");
        assert!(named == 1 - hinge && residual < ROUNDING, "{named}: {residual:e}");
    }
}

#[test]
fn slides_turn_no_load_that_is_handed_on_as_in_1970() {
    // One boom on another, each at its own travel: what 1970 turned by an angle is not turned.
    let mut description = (*boom(Vec3::zero(), None)).clone();
    description.bodies[0].joint = Joint::Prismatic;
    let outer = Body { inboard: Some(0), ..description.bodies[0] };
    description.bodies.push(outer);
    let scene = Scene::new(description).expect("rods are bodies");
    let mut loads = Loads::new(&scene, None);
    let mut right = loads.load_set();
    let beta = [1.5, 0.7];
    let acceleration = VelocityChange {
        origin_body: Vec3::new(0.3, -0.5, 0.9),
        omega_body: Vec3::new(-0.2, 0.8, 0.4),
        tau: &[0.0; 2],
    };
    let motion = SceneMotion {
        omega_body: Vec3::new(0.4, -0.3, 0.6),
        beta: &beta,
        tau: &[0.1, -0.2],
        acceleration,
        force_densities: &[0.0; 2],
        outside: &[],
        rotors: &[],
    };
    loads.continuous(&motion, &mut right);
    let mut of_1970 = right.clone();
    loads.hand_on_as_in_1970(&beta, &mut of_1970);
    for hinge in [0, 1] {
        let [found, expected] = [&of_1970, &right].map(|loads| loads.hinge(hinge));
        assert_near(found.force, expected.force.to_array());
        assert_near(found.moment, expected.moment.to_array());
    }
}

#[test]
fn rotors_that_cancel_each_other_count_in_what_a_load_is_made_of() {
    let mut description = (*boom(Vec3::zero(), None)).clone();
    let (inertia, speed, driven) = (0.05, 1e12, 1e10);
    let rotor = |axis| Rotor { body: Some(0), axis, inertia, speed: RotorSpeed::Constant(speed) };
    description.rotors = [Vec3::unit_y(), -Vec3::unit_y()].map(rotor).into();
    let scene = Scene::new(description).expect("rods are bodies");
    let mut loads = Loads::new(&scene, None);
    let mut found = loads.load_set();
    let (zero, omega_body) = (Vec3::zero(), Vec3::new(0.2, 0.3, 0.1));
    let acceleration = VelocityChange { origin_body: zero, omega_body: zero, tau: &[0.0] };
    let motion = SceneMotion {
        omega_body,
        beta: &[0.0],
        tau: &[0.0],
        acceleration,
        force_densities: &[0.0],
        outside: &[],
        rotors: &[[speed, driven]; 2],
    };
    loads.continuous(&motion, &mut found);
    // Off by as little as rounding of either rotor's moment is.
    let wrong = [found.hinge(0).moment.x + 1e-15 * inertia * speed];
    let residual = loads.largest_torque_residual(&found, &[HingeState::Free], &wrong);
    assert!(residual.is_some_and(|(_, residual)| residual < 1e-13), "{residual:?}");
}
