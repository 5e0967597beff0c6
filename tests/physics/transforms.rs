//! A scene told in other words, and how to read its motion back in the first ones.

use nboom::model::{ExternalAxes, Joint, Release, SceneDescription};
use nboom::scalar::{Mat3, Quaternion, Vec3};

use super::scaled::Units;

/// A motion as the first telling has it; hinge quantities in its numbering.
#[derive(Clone, Debug)]
pub struct View {
    pub time: f64,
    pub position: Vec3<f64>,
    pub velocity: Vec3<f64>,
    /// Inertial acceleration of O, inertial axes.
    pub acceleration: Vec3<f64>,
    pub attitude: Mat3<f64>,
    pub omega: Vec3<f64>,
    pub omega_dot: Vec3<f64>,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
    pub tau_dot: Vec<f64>,
}

/// A scene told differently.
pub struct Variant {
    pub name: &'static str,
    pub scene: SceneDescription,
    pub back: Box<dyn Fn(View) -> View>,
    /// For each hinge of the variant, its number in the original.
    pub order: Vec<usize>,
    /// Original impulsive torque per one of the variant.
    pub impulse: Box<dyn Fn(usize) -> f64>,
    /// Original time per one of the variant.
    pub time: f64,
}

impl Variant {
    fn new(
        name: &'static str,
        scene: SceneDescription,
        back: impl Fn(View) -> View + 'static,
    ) -> Self {
        let order = (0..scene.bodies.len()).collect();
        Self { name, scene, back: Box::new(back), order, impulse: Box::new(|_| 1.0), time: 1.0 }
    }
}

/// Bodies listed in another order (still branch by branch, inboard before outboard).
pub fn reordered(original: &SceneDescription, order: &[usize]) -> SceneDescription {
    let new = |old: usize| order.iter().position(|&i| i == old).expect("every body is listed");
    let mut scene = original.clone();
    scene.bodies = order.iter().map(|&old| original.bodies[old]).collect();
    for body in &mut scene.bodies {
        body.inboard = body.inboard.map(new);
        if let Release::Angle { hinge, .. } = &mut body.hinge.release {
            *hinge = new(*hinge);
        }
    }
    for external in &mut scene.externals {
        external.body = external.body.map(new);
    }
    scene
}

/// Bodies in depth-first order, the branches and the bodies on each body last first.
pub fn backwards(scene: &SceneDescription) -> Vec<usize> {
    fn visit(scene: &SceneDescription, inboard: Option<usize>, order: &mut Vec<usize>) {
        for i in (0..scene.bodies.len()).rev().filter(|&i| scene.bodies[i].inboard == inboard) {
            order.push(i);
            visit(scene, Some(i), order);
        }
    }
    let mut order = Vec::new();
    visit(scene, None, &mut order);
    order
}

pub fn renumbered(original: &SceneDescription) -> Variant {
    let order = backwards(original);
    let by = order.clone();
    let sorted = move |values: &[f64]| {
        let mut back = vec![0.0; values.len()];
        by.iter().zip(values).for_each(|(&old, &value)| back[old] = value);
        back
    };
    let back = move |view: View| View {
        beta: sorted(&view.beta),
        tau: sorted(&view.tau),
        tau_dot: sorted(&view.tau_dot),
        ..view
    };
    Variant {
        order: order.clone(),
        ..Variant::new("renumbered", reordered(original, &order), back)
    }
}

/// Main-body axes turned, and O moved to another point of the main body.
pub fn other_main_body_axes(
    original: &SceneDescription,
    turn: Quaternion<f64>,
    origin: Vec3<f64>,
) -> Variant {
    let rot = turn.to_matrix();
    let mut scene = original.clone();
    let point = |p: Vec3<f64>| rot * (p - origin);
    let main = &mut scene.main_body;
    main.center_of_mass = point(main.center_of_mass);
    main.inertia = main.inertia.rotated(&rot);
    for body in &mut scene.bodies {
        if body.inboard.is_none() {
            body.mount.point = point(body.mount.point);
            body.mount.rot_inboard_from_hinge = rot * body.mount.rot_inboard_from_hinge;
        }
        if let Some(spring) = &mut body.hinge.kick_off {
            spring.main_body_point = point(spring.main_body_point);
        }
    }
    for external in scene.externals.iter_mut().filter(|external| external.body.is_none()) {
        external.point = point(external.point);
        if external.axes == ExternalAxes::Body {
            external.amount = rot * external.amount;
        }
    }
    let initial = &mut scene.initial;
    let to_inertial = initial.attitude.to_matrix();
    initial.position_inertial += to_inertial * origin;
    initial.velocity_inertial += to_inertial * initial.omega_body.cross(origin);
    initial.omega_body = rot * initial.omega_body;
    let undo = Quaternion { scalar: turn.scalar, vector: -turn.vector };
    initial.attitude = initial.attitude.compose(undo);
    Variant::new("other main-body axes", scene, move |view| {
        let attitude = view.attitude * rot;
        let (omega, omega_dot) = (rot.transpose_mul(view.omega), rot.transpose_mul(view.omega_dot));
        let whirl = omega.cross(omega.cross(origin));
        View {
            position: view.position - attitude * origin,
            velocity: view.velocity - attitude * omega.cross(origin),
            acceleration: view.acceleration - attitude * (omega_dot.cross(origin) + whirl),
            attitude,
            omega,
            omega_dot,
            ..view
        }
    })
}

pub fn other_inertial_axes(original: &SceneDescription, turn: Quaternion<f64>) -> Variant {
    let rot = turn.to_matrix();
    let mut scene = original.clone();
    let initial = &mut scene.initial;
    initial.attitude = turn.compose(initial.attitude);
    initial.position_inertial = rot * initial.position_inertial;
    initial.velocity_inertial = rot * initial.velocity_inertial;
    if let Some(gravity) = &mut scene.gravity {
        gravity.up = rot * gravity.up;
    }
    for external in &mut scene.externals {
        if external.axes == ExternalAxes::Inertial {
            external.amount = rot * external.amount;
        }
    }
    Variant::new("other inertial axes", scene, move |view| View {
        position: rot.transpose_mul(view.position),
        velocity: rot.transpose_mul(view.velocity),
        acceleration: rot.transpose_mul(view.acceleration),
        attitude: rot.transpose() * view.attitude,
        ..view
    })
}

/// The axes of body `i` turned, and its origin moved along the hinge axis.
pub fn other_body_axes(
    original: &SceneDescription,
    i: usize,
    rot: Mat3<f64>,
    along: f64,
) -> Variant {
    let mut scene = original.clone();
    let origin = scene.bodies[i].axis * along;
    let point = |p: Vec3<f64>| rot * (p - origin);
    for body in &mut scene.bodies {
        if body.inboard == Some(i) {
            body.mount.point = point(body.mount.point);
            body.mount.rot_inboard_from_hinge = rot * body.mount.rot_inboard_from_hinge;
        }
    }
    let body = &mut scene.bodies[i];
    body.mount.point += body.mount.rot_inboard_from_hinge * origin;
    body.mount.rot_inboard_from_hinge = body.mount.rot_inboard_from_hinge * rot.transpose();
    body.axis = rot * body.axis;
    body.mass_properties.center_of_mass = point(body.mass_properties.center_of_mass);
    body.mass_properties.inertia = body.mass_properties.inertia.rotated(&rot);
    if let Some(spring) = &mut body.hinge.kick_off {
        spring.body_point = point(spring.body_point);
    }
    for external in scene.externals.iter_mut().filter(|external| external.body == Some(i)) {
        external.point = point(external.point);
        if external.axes == ExternalAxes::Body {
            external.amount = rot * external.amount;
        }
    }
    Variant::new("other body axes", scene, |view| view)
}

/// The angle of hinge `i` counted the other way round, from another zero: β' = −β − `shift`.
pub fn other_angle(original: &SceneDescription, i: usize, shift: f64) -> Variant {
    let mut scene = original.clone();
    let new = |angle: f64| -angle - shift;
    for body in &mut scene.bodies {
        if let Release::Angle { hinge, angle } = &mut body.hinge.release
            && *hinge == i
        {
            *angle = new(*angle);
        }
    }
    let body = &mut scene.bodies[i];
    let rot = body.mount.rot_inboard_from_hinge;
    body.mount.point += rot * body.joint.travel(body.axis, -shift);
    body.mount.rot_inboard_from_hinge = rot * body.joint.turn(body.axis, -shift);
    body.axis = -body.axis;
    let hinge = &mut body.hinge;
    // Q'(β') = −Q(β) with β + θ = −(β' + shift − θ).
    hinge.spring.quadratic *= -1.0;
    hinge.spring.preload_angle = shift - hinge.spring.preload_angle;
    hinge.dashpot.rate_quadratic *= -1.0;
    hinge.dashpot.angle_quadratic *= -1.0;
    hinge.dashpot.preload_angle = shift - hinge.dashpot.preload_angle;
    hinge.lock_angle = hinge.lock_angle.map(new);
    hinge.start.angle = new(hinge.start.angle);
    hinge.start.rate *= -1.0;
    let back = move |mut view: View| {
        view.beta[i] = -view.beta[i] - shift;
        view.tau[i] *= -1.0;
        view.tau_dot[i] *= -1.0;
        view
    };
    let impulse = Box::new(move |hinge| if hinge == i { -1.0 } else { 1.0 });
    Variant { impulse, ..Variant::new("other angle", scene, back) }
}

/// Numbers in units that are this many times smaller than the original ones.
pub fn in_units(original: &SceneDescription, length: f64, mass: f64, time: f64) -> Variant {
    let (l, t) = (length, time);
    let units = Units { time, mass, length };
    let scene = units.scene(original);
    let joints: Vec<Joint> = original.bodies.iter().map(|body| body.joint).collect();
    let of_joints = joints.clone();
    let times = move |values: Vec<f64>, by: f64| {
        let pairs = values.into_iter().zip(&of_joints);
        pairs.map(|(value, &joint)| value * by / units.coordinate(joint)).collect::<Vec<_>>()
    };
    let back = move |view: View| View {
        time: view.time / t,
        position: view.position * (1.0 / l),
        velocity: view.velocity * (t / l),
        acceleration: view.acceleration * (t * t / l),
        attitude: view.attitude,
        omega: view.omega * t,
        omega_dot: view.omega_dot * (t * t),
        beta: times(view.beta, 1.0),
        tau: times(view.tau, t),
        tau_dot: times(view.tau_dot, t * t),
    };
    let impulse = Box::new(move |hinge: usize| 1.0 / units.impulse(joints[hinge]));
    Variant { impulse, time: 1.0 / t, ..Variant::new("other units", scene, back) }
}
