//! The recursion at one state after another, each in the mode that holds there.

use std::sync::Arc;

use nboom_dynamics::Recursive;
use nboom_model::{HingeState, Mode, RotorMotion, Scene};
use nboom_scalar::Quaternion;
use nboom_sim::{set_pieces_at_motion, set_pieces_at_time};

/// The recursion of a scene in which the same hinges are held at all states. Which pieces hold of laws with several,
/// of what acts from outside, of a prescribed motion and of the speeds of rotors follows from the state, as in a run.
#[derive(Clone)]
pub(crate) struct AtState {
    recursion: Recursive<f64>,
    mode: Mode,
    /// β of every hinge: of held ones always, of free ones as of the last state that was asked for.
    beta: Vec<f64>,
    /// τ of every hinge as of that state; zero of held ones.
    tau: Vec<f64>,
    /// Where none is said: that in which the scene holds its main body, else 1.
    usual_attitude: Quaternion<f64>,
    attitude: Quaternion<f64>,
    time: f64,
}

/// How far the upward direction of two attitudes may differ.
const SAME_DIRECTION: f64 = 1e-6;

impl AtState {
    /// The hinges of `scene` are free but those that are `held` at an angle.
    pub fn new(scene: &Scene, held: &[Option<f64>]) -> Self {
        let state = |angle: &Option<f64>| match angle {
            Some(_) => HingeState::Locked,
            None => HingeState::Free,
        };
        let mode = Mode { hinges: held.iter().map(state).collect(), ..Mode::at_start(scene) };
        let beta: Vec<f64> = held.iter().map(|angle| angle.unwrap_or(0.0)).collect();
        let mut recursion = Recursive::new(scene);
        recursion.set_mode(&mode, &beta);
        let usual_attitude = if scene.base.is_held() {
            scene.initial.attitude.normalized()
        } else {
            Quaternion::identity()
        };
        let (attitude, time) = (usual_attitude, scene.initial.time);
        let tau = vec![0.0; beta.len()];
        Self { recursion, mode, beta, tau, usual_attitude, attitude, time }
    }

    /// The recursion, whose tree is the same at all states but for what moves the main body and the rotors.
    pub fn recursion(&self) -> &Recursive<f64> {
        &self.recursion
    }

    /// Whether something acts on the main body at some state, as
    /// [`Recursive::acts_on_main_body`] says of one.
    pub fn may_act_on_main_body(&self) -> bool {
        let scene = self.recursion.scene();
        let is_driven = scene.base.drive().is_some();
        is_driven || !scene.externals.is_empty() || self.recursion.acts_on_main_body()
    }

    /// Whether gravity on a main body that is held is as at this attitude: it acts as at the usual one.
    pub fn holds_at(&self, attitude: &Quaternion<f64>) -> bool {
        let scene = self.recursion.scene();
        let Some(gravity) = scene.gravity.filter(|_| scene.base.is_held()) else { return true };
        let up = |at: &Quaternion<f64>| at.to_matrix().transpose_mul(gravity.up);
        (up(attitude) - up(&self.usual_attitude)).norm() <= SAME_DIRECTION
    }

    /// Says at which attitude, if not at the usual one, and when the next states are.
    pub fn set_outside(&mut self, attitude: Option<Quaternion<f64>>, time: f64) {
        (self.attitude, self.time) = (attitude.unwrap_or(self.usual_attitude), time);
        let changed = set_pieces_at_time(&mut self.mode, self.recursion.scene(), time);
        self.enter(changed);
    }

    /// The recursion in the mode that holds where the free hinges are at `beta` and go at `tau`; at rest none has
    /// friction.
    pub fn at(&mut self, [beta, tau]: [&[f64]; 2]) -> &mut Recursive<f64> {
        let Self { recursion, mode, beta: all_beta, tau: all_tau, .. } = self;
        if !mode.pieces.is_empty() {
            for (j, &hinge) in recursion.free_hinges().iter().enumerate() {
                (all_beta[hinge], all_tau[hinge]) = (beta[j], tau[j]);
            }
            if set_pieces_at_motion(mode, recursion, [all_beta, all_tau]) {
                self.enter(true);
            }
        }
        &mut self.recursion
    }

    /// Goes to the time and the attitude, in a mode that has `changed` or not.
    fn enter(&mut self, changed: bool) {
        let Self { recursion, mode, beta, attitude, time, .. } = self;
        if changed {
            recursion.set_mode(mode, beta);
        }
        if recursion.tree().has_rotors() {
            let scene = Arc::clone(recursion.scene());
            let rotors = scene.rotors.iter().zip(&mode.rotors);
            let motions = rotors.map(|(rotor, &piece)| RotorMotion {
                speed: rotor.speed.at(*time),
                acceleration: rotor.speed.acceleration(piece),
            });
            recursion.spin_from(*time, motions);
        }
        recursion.set_outside(*attitude, *time);
    }
}
