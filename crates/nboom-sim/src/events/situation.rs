use nboom_dynamics::Recursive;
use nboom_elements::thrust_acts;
use nboom_model::{Mode, Scene};
use nboom_scalar::{Number, Vec3};

use crate::equations::state::{MassCenter, State};
use crate::error::SimError;
use crate::events::guard::{GuardKind, Guards};
use crate::events::instant::{self, Arrivals, Outcome};
use crate::events::side::LockSide;

/// Where a motion has come to: its state and mode, and what may end the mode.
///
/// `dynamics`, which its methods borrow, are those of the scene in the same mode.
pub(crate) struct Situation<'a, R> {
    pub scene: &'a Scene,
    pub state: State<R>,
    pub mode: Mode,
    pub guards: Guards,
    /// The side of its lock angle that each hinge was last known to be on; none of a hinge without
    /// a lock angle, or on it since it became free.
    lock_sides: Vec<Option<LockSide>>,
}

impl<'a, R: Number> Situation<'a, R> {
    /// At the beginning of `scene`, before the first instant; nothing is watched yet. `dynamics` is in
    /// the mode in which the scene starts.
    pub fn at_start(scene: &'a Scene, dynamics: &mut Recursive<R>) -> Self {
        let (mut state, mut mode) = (State::initial(scene), Mode::at_start(scene));
        put_mass_center(dynamics, &mut state);
        for (piece, element) in mode.pieces.iter_mut().zip(dynamics.elements().switched()) {
            let [value, _] = state.coordinate(dynamics, element.coordinate);
            *piece = element.piece_at(value);
        }
        mode.thrust = scene.thrust.is_some_and(|f| thrust_acts(&f, scene.initial.time));
        let lock_side = |i: usize| LockSide::of(scene, i, state.beta[i]);
        let lock_sides = (0..scene.bodies.len()).map(lock_side).collect();
        Self { scene, state, mode, guards: Guards::new(), lock_sides }
    }

    /// Watches all that may end the mode; `crossed` has the elements that are at a bound of their
    /// law just now, and which.
    pub fn watch(&mut self, dynamics: &mut Recursive<R>, crossed: &[(usize, usize)]) {
        let Self { scene, state, mode, guards, lock_sides } = self;
        guards.set(scene, mode, dynamics, state, lock_sides, crossed);
    }

    /// What the initial time itself brings.
    pub fn arrivals_at_start(&self, dynamics: &mut Recursive<R>) -> Arrivals {
        Arrivals::at_start(self.scene, &self.guards, dynamics, &self.state)
    }

    /// What arrives in the present instant, which `located` ended the step for.
    pub fn arrivals(&self, dynamics: &mut Recursive<R>, located: Option<GuardKind>) -> Arrivals {
        Arrivals::find(self.scene, &self.guards, dynamics, &self.state, located)
    }

    /// Goes through the instant of `arrivals`; `dynamics` stays in the mode before.
    ///
    /// # Errors
    /// When hinges cannot lock.
    pub fn pass(
        &mut self,
        dynamics: &mut Recursive<R>,
        arrivals: &Arrivals,
    ) -> Result<Outcome, SimError> {
        for (hinge, side) in self.lock_sides.iter_mut().enumerate() {
            *side = self.guards.lock_side(hinge).or(*side);
        }
        let Self { scene, state, mode, .. } = self;
        let outcome = instant::pass(scene, dynamics, arrivals, state, mode)?;
        for &hinge in &outcome.released {
            self.lock_sides[hinge] = LockSide::of(scene, hinge, self.state.beta[hinge]);
        }
        Ok(outcome)
    }

    /// The next time at which the scene itself changes the mode, or its end.
    pub fn limit(&self) -> f64 {
        let scheduled = instant::next_scheduled(self.scene, &self.mode, self.state.time.to_f64());
        scheduled.min(self.scene.end_time)
    }

    /// Whether the end time is reached.
    pub fn is_at_end(&self) -> bool {
        self.state.time.to_f64() >= self.scene.end_time
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
