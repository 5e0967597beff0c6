//! Scenes of any topology from a seed: branching trees, hinges and slides in any direction, full
//! inertia tensors, every kind of force.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nboom::model::{
    Body, Course, Dashpot, External, ExternalAxes, ExternalKind, Gravity, Hinge, HingeState, Joint,
    KickOffSpring, MassProperties, Mode, Mount, Rotor, RotorSpeed, Scene, SceneDescription, Spring,
};
use nboom::scalar::{Mat3, Quaternion, Sym3, Vec3};

pub use random::Rng;

#[path = "random.rs"]
mod random;

impl Rng {
    /// Components uniform within ±`size`.
    pub fn vector(&mut self, size: f64) -> Vec3<f64> {
        let mut one = || self.between(-size, size);
        Vec3::new(one(), one(), one())
    }

    /// A unit vector, any direction.
    pub fn direction(&mut self) -> Vec3<f64> {
        loop {
            let v = self.vector(1.0);
            if (0.1..1.0).contains(&v.norm()) {
                return v * (1.0 / v.norm());
            }
        }
    }

    /// A unit quaternion, any attitude.
    pub fn attitude(&mut self) -> Quaternion<f64> {
        let angle = self.between(0.0, std::f64::consts::PI);
        let (s, c) = angle.sin_cos();
        Quaternion { scalar: c, vector: self.direction() * s }.normalized()
    }

    /// A rotation matrix, any attitude.
    pub fn rotation(&mut self) -> Mat3<f64> {
        self.attitude().to_matrix()
    }

    fn pick(&mut self, probability: f64, low: f64, high: f64) -> f64 {
        let value = self.between(low, high);
        if self.chance(probability) { value } else { 0.0 }
    }

    /// The mass properties of five points: full inertia, physical by construction.
    pub fn mass_properties(&mut self, mass: f64, size: f64) -> MassProperties {
        let points: [Vec3<f64>; 5] = std::array::from_fn(|_| self.vector(size));
        let share = mass / 5.0;
        let mean = points.iter().fold(Vec3::zero(), |sum, &p| sum + p) * 0.2;
        let mut inertia = Sym3::zero();
        for point in points {
            let r = point - mean;
            let d = r.norm_squared();
            inertia += (Sym3::diagonal(d, d, d) + Sym3::outer(r) * -1.0) * share;
        }
        let center = self.vector(size);
        MassProperties::new(mass, center, inertia)
    }
}

/// A tree of `bodies` bodies, most of them hinged and some that slide, with every kind of force;
/// all joints start free.
pub fn description(bodies: usize, seed: u64) -> SceneDescription {
    let mut scene = hinged(bodies, seed);
    let dice = &mut Rng::new(seed ^ 0x511d);
    for body in &mut scene.bodies {
        if dice.chance(0.25) {
            body.joint = Joint::Prismatic;
        }
    }
    scene
}

/// A tree of `bodies` hinged bodies with every kind of force; all hinges start free.
pub fn hinged(bodies: usize, seed: u64) -> SceneDescription {
    let dice = &mut Rng::new(seed);
    let mass = dice.between(5.0, 50.0);
    let main_body = dice.mass_properties(mass, 1.5);
    let mut scene = SceneDescription::at_rest("random tree", main_body, 1.0);
    let mut branch = 0;
    for i in 0..bodies {
        let new_branch = i == 0 || dice.chance(0.3);
        let inboard = (!new_branch).then(|| branch + dice.below(i - branch));
        if new_branch {
            branch = i;
        }
        scene.bodies.push(body(dice, inboard));
    }
    if dice.chance(0.5) {
        let (acceleration, up) = (dice.between(1.0, 10.0), dice.direction());
        scene.gravity = Some(Gravity { acceleration, up });
    }
    if dice.chance(0.5) {
        let (force, point) = (dice.vector(10.0), dice.vector(1.0));
        scene.externals = vec![External::thrust(force, point, [0.0, 0.5])];
    }
    scene.initial.attitude = dice.attitude();
    scene.initial.position_inertial = dice.vector(3.0);
    scene.initial.velocity_inertial = dice.vector(3.0);
    scene.initial.omega_body = dice.vector(2.0);
    scene
}

fn body(dice: &mut Rng, inboard: Option<usize>) -> Body {
    let mass = dice.between(0.5, 10.0);
    let mass_properties = dice.mass_properties(mass, 0.8);
    let mut hinge = Hinge::free();
    hinge.spring = Spring {
        quadratic: dice.pick(0.3, -1.0, 1.0),
        linear: dice.pick(0.7, -8.0, 0.0),
        preload_angle: dice.between(-1.0, 1.0),
    };
    hinge.dashpot = Dashpot {
        rate_quadratic: dice.pick(0.3, -0.3, 0.3),
        rate_linear: dice.pick(0.5, -2.0, 0.0),
        angle_quadratic: dice.pick(0.2, -0.5, 0.5),
        angle_linear: dice.pick(0.2, -1.0, 0.0),
        preload_angle: dice.between(-1.0, 1.0),
    };
    if dice.chance(0.3) {
        hinge.kick_off = Some(KickOffSpring {
            main_body_point: dice.vector(1.0),
            body_point: dice.vector(1.0),
            coefficients: [dice.between(1.0, 5.0), dice.between(-1.0, 1.0), 0.2, -0.05],
            limit_length: dice.between(1.0, 5.0),
        });
    }
    hinge.start.angle = dice.between(-3.0, 3.0);
    hinge.start.rate = dice.between(-2.0, 2.0);
    let mount = Mount { point: dice.vector(1.0), rot_inboard_from_hinge: dice.rotation() };
    let (joint, axis, tip) = (Joint::Revolute, dice.direction(), Vec3::zero());
    Body { inboard, mount, joint, axis, mass_properties, tip, hinge }
}

/// A random tree without anything that takes or gives energy: no dashpot rates and no thrust.
pub fn conservative(bodies: usize, seed: u64) -> SceneDescription {
    let mut scene = description(bodies, seed);
    scene.externals.clear();
    for body in &mut scene.bodies {
        body.hinge.dashpot.rate_quadratic = 0.0;
        body.hinge.dashpot.rate_linear = 0.0;
    }
    scene
}

/// A scene in a mode and a state: every hinge has an angle and a rate, zero where held.
pub struct Moment {
    pub scene: Scene,
    pub mode: Mode,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
    pub omega: Vec3<f64>,
    pub velocity_body: Vec3<f64>,
}

/// The mode with these hinges in which every spring pushes and all from outside and every table of
/// a rotor is in its first piece.
pub fn all_acting(scene: &Scene, hinges: Vec<HingeState>) -> Mode {
    let pieces = vec![0; Mode::at_start(scene).pieces.len()];
    let [externals, rotors] =
        [scene.externals.len(), scene.rotors.len()].map(|count| vec![1; count]);
    Mode { hinges, pieces, externals, drive: 0, rotors }
}

/// The thrust of a scene of one, while it is on.
pub fn thrust<'s>(scene: &'s SceneDescription, mode: &Mode) -> Option<&'s External> {
    scene.externals.first().filter(|thrust| thrust.course.acts(mode.externals[0]))
}

/// The place of the kick-off spring of body `i` among the lines of a scene.
pub fn spring(bodies: &[Body], i: usize) -> usize {
    bodies[..i].iter().filter(|body| body.hinge.kick_off.is_some()).count()
}

/// Three rotors in a tree of so many hinged bodies, the first in the main body: at constant speeds,
/// or by tables over time, in whose first pieces time zero is.
pub fn rotors(dice: &mut Rng, bodies: usize) -> Vec<Rotor> {
    let one = |i: usize| Rotor {
        body: (i > 0).then(|| dice.below(bodies)),
        axis: dice.direction(),
        inertia: dice.between(0.05, 0.5),
        speed: match dice.chance(0.3) {
            true => RotorSpeed::Constant(dice.between(-30.0, 30.0)),
            false => {
                let mut speed = || dice.between(-30.0, 30.0);
                RotorSpeed::Table(vec![[-0.7, speed()], [0.1, speed()], [0.2, speed()]])
            }
        },
    };
    (0..3).map(one).collect()
}

/// Speed and its rate of change of such a rotor at a time in the first piece of its table.
pub fn turning(rotor: &Rotor, time: f64) -> [f64; 2] {
    match &rotor.speed {
        RotorSpeed::Constant(speed) => [*speed, 0.0],
        RotorSpeed::Table(points) => {
            let ([t0, s0], [t1, s1]) = (points[0], points[1]);
            [(s0 * (t1 - time) + s1 * (time - t0)) / (t1 - t0), (s1 - s0) / (t1 - t0)]
        }
    }
}

/// A force or torque from outside on any of so many hinged bodies or on the main body, along any
/// axes, always on or by a table over time, in whose first piece time zero is.
pub fn external(dice: &mut Rng, bodies: usize) -> External {
    let either = |dice: &mut Rng| dice.chance(0.5);
    let body = dice.below(bodies + 1).checked_sub(1);
    let kind = if either(dice) { ExternalKind::Force } else { ExternalKind::Torque };
    let axes = if either(dice) { ExternalAxes::Body } else { ExternalAxes::Inertial };
    let (amount, point) = (dice.vector(10.0), dice.vector(1.0));
    let course = if either(dice) {
        Course::Pulse { on: -1.0, off: 2.0 }
    } else {
        let mut share = || dice.between(-1.0, 1.0);
        Course::Table(vec![[-0.7, share()], [0.3, share()], [0.6, share()]])
    };
    External { body, kind, amount, axes, point, course }
}

/// A random tree in a random mode, often under forces and torques from outside; each hinge is held
/// with probability `held`.
pub fn moment(bodies: usize, seed: u64, held: f64) -> Moment {
    let mut description = description(bodies, seed);
    let dice = &mut Rng::new(seed ^ 0x0075);
    for _ in 0..dice.below(4) {
        description.externals.push(external(dice, bodies));
    }
    moment_of(Scene::new(description).expect("random bodies are physical"), seed, held)
}

/// A scene in a random mode; each hinge is held with probability `held`.
pub fn moment_of(scene: Scene, seed: u64, held: f64) -> Moment {
    let bodies = scene.bodies.len();
    let dice = &mut Rng::new(seed ^ 0x5eed);
    let states = [HingeState::Unreleased, HingeState::Locked];
    let hinges = (0..bodies).map(|_| match dice.chance(held) {
        true => states[dice.below(2)],
        false => HingeState::Free,
    });
    let hinges: Vec<HingeState> = hinges.collect();
    let mode = all_acting(&scene, hinges);
    let beta = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
    let rate = |i: usize| if mode.is_free(i) { scene.bodies[i].hinge.start.rate } else { 0.0 };
    let tau = (0..bodies).map(rate).collect();
    let (omega, velocity_body) = (scene.initial.omega_body, dice.vector(2.0));
    Moment { mode, beta, tau, omega, velocity_body, scene }
}
