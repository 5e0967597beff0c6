use nboom_dynamics::Recursive;
use nboom_elements::{Switched, thrust_acts};
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
        for (piece, element) in mode.pieces.iter_mut().zip(Switched::all(scene)) {
            let [value, _] = state.coordinate(&mut dynamics, element.coordinate);
            *piece = element.piece_at(value);
        }
        mode.thrust = scene.thrust.is_some_and(|f| thrust_acts(&f, scene.initial.time));
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
