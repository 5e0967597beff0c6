use nboom_dynamics::Recursive;
use nboom_model::{Mode, Scene};
use nboom_scalar::{Number, Vec3};

use crate::state::{MassCenter, State};

/// How a scene begins.
#[derive(Clone, Debug)]
pub(crate) struct Start<R> {
    pub state: State<R>,
    pub mode: Mode,
    /// Sign of β − β_lock of each hinge, zero where it starts on its lock angle.
    pub lock_sides: Vec<f64>,
}

impl<R: Number> Start<R> {
    pub fn of(scene: &Scene) -> Self {
        let (mut state, mut mode) = (State::initial(scene), Mode::at_start(scene));
        let mut dynamics = Recursive::new(scene);
        put_mass_center(&mut dynamics, &mut state);
        for (i, body) in scene.bodies.iter().enumerate() {
            let [length, _] = state.spring_length(&mut dynamics, i);
            let pushes = |limit: f64| R::to_f64(length - R::constant(limit)) <= 0.0;
            mode.kick_off[i] = body.hinge.kick_off.is_some_and(|k| pushes(k.limit_length));
        }
        let time = scene.initial.time;
        mode.thrust = scene.thrust.is_some_and(|f| f.on <= time && time < f.off);
        let lock_sides = scene.bodies.iter().map(|body| {
            let angle = body.hinge.lock_angle.unwrap_or(f64::NEG_INFINITY);
            let from_lock = body.hinge.start.angle - angle;
            if from_lock == 0.0 { 0.0 } else { from_lock.signum() }
        });
        Self { state, lock_sides: lock_sides.collect(), mode }
    }
}

/// Moves the mass centre of `state`, which stands at O, to where it belongs.
fn put_mass_center<R: Number>(dynamics: &mut Recursive<R>, state: &mut State<R>) {
    let MassCenter { position, velocity } = state.center;
    state.center.velocity = Vec3::zero();
    let found = state.invariants(dynamics);
    let to_inertial = state.attitude.to_matrix();
    state.center = MassCenter {
        position: position + to_inertial * found.mass_center,
        velocity: velocity - to_inertial * found.origin_velocity,
    };
}
