use nboom_model::{MassProperties, Scene};
use nboom_scalar::{Mat3, Sym3, Vec3};

use crate::run::record::Snapshot;

/// How one body moves and what momentum it has; all vectors along inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion {
    /// Turns body components into inertial ones.
    pub rot_inertial_from_body: Mat3<f64>,
    /// Position of its mass centre.
    pub mass_center_inertial: Vec3<f64>,
    /// Velocity of its mass centre.
    pub velocity_inertial: Vec3<f64>,
    /// Angular rate \[rad/T\].
    pub omega_inertial: Vec3<f64>,
    /// Linear momentum.
    pub linear_momentum_inertial: Vec3<f64>,
    /// Angular momentum about its own mass centre, with that of its rotors.
    pub own_angular_momentum_inertial: Vec3<f64>,
}

impl BodyMotion {
    /// Angular momentum about `point`, a fixed point given by its inertial position.
    pub fn angular_momentum_about(&self, point: Vec3<f64>) -> Vec3<f64> {
        let arm = self.mass_center_inertial - point;
        self.own_angular_momentum_inertial + arm.cross(self.linear_momentum_inertial)
    }

    /// `rotors` have the inertia and the momentum relative to the body, body axes.
    fn new(body: &MassProperties, rotors: (Sym3<f64>, Vec3<f64>), at_origin: &Placed) -> Self {
        let (inertia, momentum) = rotors;
        let Placed { rot, origin, velocity, omega } = *at_origin;
        let arm = rot * body.center_of_mass;
        let velocity_inertial = velocity + omega.cross(arm);
        Self {
            rot_inertial_from_body: rot,
            mass_center_inertial: origin + arm,
            velocity_inertial,
            omega_inertial: omega,
            linear_momentum_inertial: velocity_inertial * body.mass,
            own_angular_momentum_inertial: rot
                * ((body.inertia + inertia) * rot.transpose_mul(omega) + momentum),
        }
    }
}

/// Where the origin of a body is and how it moves, inertial axes.
#[derive(Clone, Copy)]
struct Placed {
    /// Turns body components into inertial ones.
    rot: Mat3<f64>,
    origin: Vec3<f64>,
    velocity: Vec3<f64>,
    omega: Vec3<f64>,
}

impl Snapshot {
    /// The motion of each body of `scene`, of which this is a snapshot: the main body first, then
    /// those outboard of the hinges.
    ///
    /// Their momenta sum up to those of the snapshot, unless the scene has
    /// [`Departures`](nboom_model::Departures).
    pub fn bodies(&self, scene: &Scene) -> Vec<BodyMotion> {
        let rot = self.attitude.to_matrix();
        let main = Placed {
            rot,
            origin: self.position_inertial,
            velocity: self.velocity_inertial,
            omega: rot * self.omega_body,
        };
        let mut placed: Vec<Placed> = Vec::with_capacity(scene.bodies.len());
        for (body, (&beta, &tau)) in scene.bodies.iter().zip(self.beta.iter().zip(&self.tau)) {
            let inboard = body.inboard.map_or(main, |i| placed[i]);
            let rot_at_zero = inboard.rot * body.mount.rot_inboard_from_hinge;
            let axis = rot_at_zero * body.axis;
            let arm = inboard.rot * body.mount.point + body.joint.travel(axis, beta);
            let own = body.joint.motion(axis, tau);
            placed.push(Placed {
                rot: rot_at_zero * body.joint.turn(body.axis, beta),
                origin: inboard.origin + arm,
                velocity: inboard.velocity + inboard.omega.cross(arm) + own.linear,
                omega: inboard.omega + own.angular,
            });
        }
        let hinged = scene.bodies.iter().zip(&placed).enumerate().map(|(i, (body, at))| {
            BodyMotion::new(&body.mass_properties, self.rotors_of(scene, Some(i)), at)
        });
        let main = BodyMotion::new(&scene.main_body, self.rotors_of(scene, None), &main);
        std::iter::once(main).chain(hinged).collect()
    }

    /// Inertia and momentum relative to it of the rotors of a body, body axes.
    fn rotors_of(&self, scene: &Scene, body: Option<usize>) -> (Sym3<f64>, Vec3<f64>) {
        let all = scene.rotors.iter().zip(&self.rotor_speeds);
        let momenta = all.filter(|(rotor, _)| rotor.body == body);
        let momenta = momenta.map(|(rotor, speed)| rotor.axis * (rotor.inertia * speed));
        (scene.rotor_inertia_of(body), momenta.fold(Vec3::zero(), |sum, one| sum + one))
    }
}
