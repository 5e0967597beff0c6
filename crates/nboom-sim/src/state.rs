use nboom_model::Scene;
use nboom_scalar::{Quaternion, Vec3};

/// The motion at one time, with everything that is not integrated filled in.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub time: f64,
    pub attitude: Quaternion<f64>,
    pub omega_body: Vec3<f64>,
    /// β of every hinge.
    pub beta: Vec<f64>,
    /// τ of every hinge; zero where held.
    pub tau: Vec<f64>,
    /// The system mass centre, inertial axes.
    pub center: MassCenter,
    pub work: Work,
}

/// Position and velocity of the system mass centre, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MassCenter {
    pub position: Vec3<f64>,
    pub velocity: Vec3<f64>,
}

/// What forces without a potential have done since the initial time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Work {
    /// Work of the rate-dependent hinge torques.
    pub dashpots: f64,
    /// Work of the thrust.
    pub thrust: f64,
    /// Impulse of the thrust, inertial axes.
    pub thrust_impulse: Vec3<f64>,
    /// Angular impulse of the thrust about the mass centre, inertial axes.
    pub thrust_angular_impulse: Vec3<f64>,
    /// Kinetic energy taken away by lock-ups.
    pub lock_ups: f64,
}

impl Work {
    pub fn none() -> Self {
        Self {
            dashpots: 0.0,
            thrust: 0.0,
            thrust_impulse: Vec3::zero(),
            thrust_angular_impulse: Vec3::zero(),
            lock_ups: 0.0,
        }
    }
}

impl State {
    /// The initial state of `scene`, but for the mass centre, which is put at O.
    pub fn initial(scene: &Scene) -> Self {
        let initial = &scene.initial;
        Self {
            time: initial.time,
            attitude: from_non_negative_scalar(initial.attitude.normalized()),
            omega_body: initial.omega_body,
            beta: scene.bodies.iter().map(|body| body.hinge.start.angle).collect(),
            tau: scene.bodies.iter().map(|body| body.hinge.start.rate).collect(),
            center: MassCenter {
                position: initial.position_inertial,
                velocity: initial.velocity_inertial,
            },
            work: Work::none(),
        }
    }
}

impl MassCenter {
    /// Where free fall with `acceleration` takes it in `duration`.
    pub fn after(self, duration: f64, acceleration: Vec3<f64>) -> Self {
        let halfway = self.velocity + acceleration * (0.5 * duration);
        Self {
            position: self.position + halfway * duration,
            velocity: self.velocity + acceleration * duration,
        }
    }
}

fn from_non_negative_scalar(q: Quaternion<f64>) -> Quaternion<f64> {
    let sign = if q.scalar < 0.0 { -1.0 } else { 1.0 };
    Quaternion { scalar: q.scalar * sign, vector: q.vector * sign }
}
