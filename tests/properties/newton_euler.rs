//! An independent derivation of motion: every body by itself with Newton's and Euler's
//! equations, the hinges as constraints, one dense system. Vectors along the main-body axes.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Unit, Vector3};
use nboom::model::{
    Body, Coupling, Course, External, ExternalAxes, ExternalKind, HingeState, Joint,
    MassProperties, Mode, Rotor, SceneDescription,
};
use nboom::scalar::{Mat3, Vec3};

use super::random_scene::turning;

type V3 = Vector3<f64>;
type M3 = Matrix3<f64>;

pub fn vector(v: Vec3<f64>) -> V3 {
    V3::new(v.x, v.y, v.z)
}

pub fn matrix(m: &Mat3<f64>) -> M3 {
    let [a, b, c] = m.rows;
    M3::new(a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z)
}

fn skew(v: V3) -> M3 {
    v.cross_matrix()
}

/// A body and the rotors in it.
struct Carrier<'a> {
    body: &'a MassProperties,
    /// Each with its speed and the rate of change of that.
    rotors: Vec<(&'a Rotor, [f64; 2])>,
}

fn carrier(scene: &SceneDescription, body: Option<usize>) -> Carrier<'_> {
    let of_body = scene.rotors.iter().filter(|rotor| rotor.body == body);
    let rotors = of_body.map(|rotor| (rotor, turning(rotor, scene.initial.time))).collect();
    let body = body.map_or(&scene.main_body, |i| &scene.bodies[i].mass_properties);
    Carrier { body, rotors }
}

/// One body where it is, and how it moves; the main body is number 0, hinged body i is i + 1.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub rot: M3,
    /// The body's origin (its hinge) from O.
    pub origin: V3,
    pub axis: V3,
    pub center: V3,
    pub mass: f64,
    pub inertia: M3,
    /// Angular momentum of its rotors relative to it.
    pub spin: V3,
    /// How fast that changes along the body's axes.
    pub spin_rate: V3,
    pub omega: V3,
    pub velocity: V3,
    /// Velocity of the mass centre.
    pub center_velocity: V3,
}

impl Placed {
    fn new(body: &Carrier<'_>, rot: M3, origin: V3, axis: V3, omega: V3, velocity: V3) -> Self {
        let Carrier { body, rotors } = body;
        let i = body.inertia;
        let own = M3::new(i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz);
        let (mut spin, mut spin_rate, mut own) = (V3::zeros(), V3::zeros(), own);
        for (rotor, [speed, rate]) in rotors {
            let axis = vector(rotor.axis);
            own += axis * axis.transpose() * rotor.inertia;
            spin += axis * (rotor.inertia * speed);
            spin_rate += axis * (rotor.inertia * rate);
        }
        let arm = rot * vector(body.center_of_mass);
        Self {
            spin: rot * spin,
            spin_rate: rot * spin_rate,
            rot,
            origin,
            axis,
            center: origin + arm,
            mass: body.mass,
            inertia: rot * own * rot.transpose(),
            omega,
            velocity,
            center_velocity: velocity + omega.cross(&arm),
        }
    }

    /// The moment that the motion takes when the rate of the body does not change.
    pub fn gyroscopic(&self) -> V3 {
        self.omega.cross(&(self.inertia * self.omega + self.spin)) + self.spin_rate
    }

    /// Velocity of the body's point that is at `point` from O.
    pub fn velocity_at(&self, point: V3) -> V3 {
        self.velocity + self.omega.cross(&(point - self.origin))
    }
}

/// Places all bodies; `velocity` is that of O.
pub fn place(
    scene: &SceneDescription,
    beta: &[f64],
    tau: &[f64],
    omega: V3,
    velocity: V3,
) -> Vec<Placed> {
    let zero = V3::zeros();
    let main = Placed::new(&carrier(scene, None), M3::identity(), zero, zero, omega, velocity);
    let mut placed = vec![main];
    for (i, body) in scene.bodies.iter().enumerate() {
        let inboard = placed[inboard_of(body)];
        let still = inboard.rot * matrix(&body.mount.rot_inboard_from_hinge);
        let axis = Unit::new_normalize(vector(body.axis));
        let point = inboard.origin + inboard.rot * vector(body.mount.point);
        let turned = still * Rotation3::from_axis_angle(&axis, beta[i]).matrix();
        let axis = still * axis.into_inner();
        let (rot, origin, omega, velocity) = match body.joint {
            Joint::Revolute => {
                (turned, point, inboard.omega + axis * tau[i], inboard.velocity_at(point))
            }
            Joint::Prismatic => {
                let origin = point + axis * beta[i];
                (still, origin, inboard.omega, inboard.velocity_at(origin) + axis * tau[i])
            }
        };
        placed.push(Placed::new(&carrier(scene, Some(i)), rot, origin, axis, omega, velocity));
    }
    placed
}

pub fn inboard_of(body: &Body) -> usize {
    body.inboard.map_or(0, |inboard| inboard + 1)
}

/// Energy and momenta, added up body by body.
#[derive(Clone, Copy, Debug)]
pub struct Sums {
    pub mass: f64,
    pub center: V3,
    pub kinetic_energy: f64,
    pub linear: V3,
    /// About the common mass centre.
    pub angular: V3,
    /// The sum of the magnitudes of the bodies' own momenta.
    pub linear_scale: f64,
    pub angular_scale: f64,
}

pub fn sums(placed: &[Placed]) -> Sums {
    let mass: f64 = placed.iter().map(|b| b.mass).sum();
    let center = placed.iter().map(|b| b.center * b.mass).sum::<V3>() / mass;
    let linear: V3 = placed.iter().map(|b| b.center_velocity * b.mass).sum();
    let own = |b: &Placed| {
        let relative = b.center_velocity - linear / mass;
        b.inertia * b.omega + b.spin + (b.center - center).cross(&relative) * b.mass
    };
    let energy = |b: &Placed| {
        0.5 * b.mass * b.center_velocity.norm_squared() + 0.5 * b.omega.dot(&(b.inertia * b.omega))
    };
    Sums {
        mass,
        center,
        kinetic_energy: placed.iter().map(energy).sum(),
        linear,
        angular: placed.iter().map(own).sum(),
        linear_scale: placed.iter().map(|b| b.mass * b.center_velocity.norm()).sum(),
        angular_scale: placed.iter().map(|b| own(b).norm()).sum(),
    }
}

/// What acts on each body: force, and moment about its mass centre; and the hinge torques.
pub struct Loads {
    pub forces: Vec<(V3, V3)>,
    pub torques: Vec<f64>,
    /// Power of everything that acts.
    pub power: f64,
    /// Force from outside, and its moment about O.
    pub outside: (V3, V3),
}

/// Springs, dashpots, kick-off springs and forces from outside by eqs. (6.1), (6.4) and (6.10) as printed, at the initial
/// time and attitude.
pub fn loads(
    scene: &SceneDescription,
    mode: &Mode,
    placed: &[Placed],
    beta: &[f64],
    tau: &[f64],
) -> Loads {
    let none = (V3::zeros(), V3::zeros());
    let mut loads = Loads {
        forces: vec![none; placed.len()],
        torques: vec![0.0; beta.len()],
        power: 0.0,
        outside: none,
    };
    let mut pieces = mode.pieces.iter();
    for (i, body) in scene.bodies.iter().enumerate() {
        let (spring, dashpot) = (body.hinge.spring, body.hinge.dashpot);
        let (x, y) = (beta[i] + spring.preload_angle, beta[i] + dashpot.preload_angle);
        let torque = spring.quadratic * x * x
            + spring.linear * x
            + dashpot.rate_quadratic * tau[i] * tau[i]
            + dashpot.rate_linear * tau[i]
            + dashpot.angle_quadratic * y * y
            + dashpot.angle_linear * y;
        if mode.hinges[i] == HingeState::Free {
            let torque = torque + coupled(scene, i, beta, tau);
            loads.torques[i] = torque;
            let own = placed[i + 1];
            match body.joint {
                Joint::Revolute => {
                    loads.power += torque * tau[i];
                    loads.forces[i + 1].1 += own.axis * torque;
                    loads.forces[inboard_of(body)].1 -= own.axis * torque;
                }
                Joint::Prismatic => {
                    loads.push(placed, i + 1, own.origin, own.axis * torque);
                    loads.push(placed, inboard_of(body), own.origin, -own.axis * torque);
                }
            }
        }
        if let Some(spring) = body.hinge.kick_off.filter(|_| pieces.next() == Some(&0)) {
            let to = placed[i + 1].origin + placed[i + 1].rot * vector(spring.body_point);
            let from = vector(spring.main_body_point);
            let x = (to - from).norm();
            let [a0, a1, a2, a3] = spring.coefficients;
            let force = (to - from) / x * (a0 + a1 * x + a2 * x * x + a3 * x * x * x);
            loads.push(placed, i + 1, to, force);
            loads.push(placed, 0, from, -force);
        }
    }
    for (external, &piece) in scene.externals.iter().zip(&mode.externals) {
        if external.course.acts(piece) {
            loads.push_from_outside(scene, placed, external, piece);
        }
    }
    loads
}

/// What couplings exert on hinge `i`, term by term.
fn coupled(scene: &SceneDescription, i: usize, beta: &[f64], tau: &[f64]) -> f64 {
    let on_this = |coupling: &Coupling| {
        let [first, second] = coupling.hinges;
        let (k, c, r) = (coupling.stiffness, coupling.damping, coupling.ratio);
        let own = if coupling.is_mutual { [beta[first], tau[first]] } else { [0.0; 2] };
        let sign = if coupling.is_mutual { 1.0 } else { -1.0 };
        let torque = -k * (own[0] - sign * r * beta[second] - coupling.rest)
            - c * (own[1] - sign * r * tau[second]);
        match () {
            () if i == first => torque,
            () if i == second && coupling.is_mutual => -r * torque,
            () => 0.0,
        }
    };
    scene.couplings.iter().map(on_this).sum()
}

impl Loads {
    fn push(&mut self, placed: &[Placed], body: usize, point: V3, force: V3) {
        self.forces[body].0 += force;
        self.forces[body].1 += (point - placed[body].center).cross(&force);
        self.power += force.dot(&placed[body].velocity_at(point));
    }

    fn push_from_outside(
        &mut self,
        scene: &SceneDescription,
        placed: &[Placed],
        external: &External,
        piece: usize,
    ) {
        let body = external.body.map_or(0, |i| i + 1);
        let share = match &external.course {
            Course::Pulse { .. } => 1.0,
            Course::Table(points) => {
                let ([t0, s0], [t1, s1], t) =
                    (points[piece - 1], points[piece], scene.initial.time);
                (s0 * (t1 - t) + s1 * (t - t0)) / (t1 - t0)
            }
        };
        let rot = match external.axes {
            ExternalAxes::Body => placed[body].rot,
            ExternalAxes::Inertial => matrix(&scene.initial.attitude.to_matrix()).transpose(),
        };
        let acting = rot * vector(external.amount) * share;
        match external.kind {
            ExternalKind::Force => {
                let point = placed[body].origin + placed[body].rot * vector(external.point);
                self.push(placed, body, point, acting);
                self.outside.0 += acting;
                self.outside.1 += point.cross(&acting);
            }
            ExternalKind::Torque => {
                self.forces[body].1 += acting;
                self.power += acting.dot(&placed[body].omega);
                self.outside.1 += acting;
            }
        }
    }
}

/// Accelerations of every body's mass centre, every body's ω̇, and τ̇ of every hinge.
pub struct Accelerated {
    pub centers: Vec<V3>,
    pub omega_dots: Vec<V3>,
    pub tau_dots: Vec<f64>,
    /// Acceleration of O.
    pub origin: V3,
}

/// Solves all bodies' equations together with the hinges' constraints.
pub fn accelerations(
    scene: &SceneDescription,
    mode: &Mode,
    placed: &[Placed],
    tau: &[f64],
    loads: &Loads,
) -> Accelerated {
    let (bodies, hinges) = (placed.len(), scene.bodies.len());
    let held = mode.hinges.iter().filter(|state| **state != HingeState::Free).count();
    let (unknowns, constraints) = (6 * bodies, 5 * hinges + held);
    let mut matrix = DMatrix::<f64>::zeros(unknowns + constraints, unknowns + constraints);
    let mut right = DVector::<f64>::zeros(unknowns + constraints);
    for (b, body) in placed.iter().enumerate() {
        let (force, moment) = loads.forces[b];
        matrix.view_mut((6 * b, 6 * b), (3, 3)).copy_from(&(M3::identity() * body.mass));
        matrix.view_mut((6 * b + 3, 6 * b + 3), (3, 3)).copy_from(&body.inertia);
        right.rows_mut(6 * b, 3).copy_from(&force);
        right.rows_mut(6 * b + 3, 3).copy_from(&(moment - body.gyroscopic()));
    }
    let mut row = unknowns;
    let mut constrain = |row: usize, block: usize, entries: &DMatrix<f64>| {
        let rows = entries.nrows();
        matrix.view_mut((row, block), (rows, 3)).copy_from(entries);
        matrix.view_mut((block, row), (3, rows)).copy_from(&entries.transpose());
    };
    for (i, body) in scene.bodies.iter().enumerate() {
        let (p, b) = (inboard_of(body), i + 1);
        let (inboard, outboard) = (&placed[p], &placed[b]);
        // The hinge point accelerates alike on both bodies, but for what slides along the axis.
        let (from, to) = (outboard.origin - inboard.center, outboard.origin - outboard.center);
        let whirl = |omega: V3, arm: V3| omega.cross(&omega.cross(&arm));
        let across = outboard.axis.cross(&least_parallel(outboard.axis)).normalize();
        let square = [across, outboard.axis.cross(&across)];
        let free = mode.hinges[i] == HingeState::Free;
        let along = |is_free: bool| (!is_free).then_some(outboard.axis);
        let slides = body.joint == Joint::Prismatic;
        let carried = inboard.omega.cross(&outboard.axis) * tau[i];
        let coriolis = if slides { carried * 2.0 } else { V3::zeros() };
        let difference = whirl(inboard.omega, from) - whirl(outboard.omega, to) + coriolis;
        for e in square.into_iter().chain(along(slides && free)) {
            let times = |m: M3| DMatrix::from_row_slice(1, 3, (e.transpose() * m).as_slice());
            constrain(row, 6 * b, &times(M3::identity()));
            constrain(row, 6 * b + 3, &times(-skew(to)));
            constrain(row, 6 * p, &times(-M3::identity()));
            constrain(row, 6 * p + 3, &times(skew(from)));
            right[row] = e.dot(&difference);
            row += 1;
        }
        // Across the axis (and along it, unless the body turns) the bodies turn alike.
        let turning = if slides { V3::zeros() } else { carried };
        for e in square.into_iter().chain(along(!slides && free)) {
            let e_row = DMatrix::from_row_slice(1, 3, e.as_slice());
            constrain(row, 6 * b + 3, &e_row);
            constrain(row, 6 * p + 3, &(-&e_row));
            right[row] = e.dot(&turning);
            row += 1;
        }
    }
    let solved = matrix.lu().solve(&right).expect("hinges are independent");
    let part = |at: usize| V3::new(solved[at], solved[at + 1], solved[at + 2]);
    let centers: Vec<V3> = (0..bodies).map(|b| part(6 * b)).collect();
    let omega_dots: Vec<V3> = (0..bodies).map(|b| part(6 * b + 3)).collect();
    let at = |b: usize, point: V3| {
        let (body, arm) = (&placed[b], point - placed[b].center);
        centers[b] + omega_dots[b].cross(&arm) + body.omega.cross(&body.omega.cross(&arm))
    };
    let tau_dot = |(i, body): (usize, &Body)| {
        let (own, b, p) = (&placed[i + 1], i + 1, inboard_of(body));
        own.axis.dot(&match body.joint {
            Joint::Revolute => omega_dots[b] - omega_dots[p],
            Joint::Prismatic => at(b, own.origin) - at(p, own.origin),
        })
    };
    let tau_dots = scene.bodies.iter().enumerate().map(tau_dot).collect();
    let (main, arm) = (&placed[0], -placed[0].center);
    let origin = centers[0] + omega_dots[0].cross(&arm) + main.omega.cross(&main.omega.cross(&arm));
    Accelerated { centers, omega_dots, tau_dots, origin }
}

fn least_parallel(axis: V3) -> V3 {
    let mut unit = V3::zeros();
    unit[axis.iamin()] = 1.0;
    unit
}
