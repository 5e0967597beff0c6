use crate::{HingeState, Scene};

/// Everything discontinuous about a scene at one moment.
///
/// Equations of motion are smooth within a mode; only events change it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode {
    /// State of each hinge.
    pub hinges: Vec<HingeState>,
    /// The piece that holds of each force law that has several, counted from 0, in the order of
    /// [`SceneDescription::pieces_at_rest`](crate::SceneDescription::pieces_at_rest).
    pub pieces: Vec<usize>,
    /// Whether the thrust is on.
    pub thrust: bool,
}

impl Mode {
    /// Hinge states as the scene starts, no kick-off spring and no thrust acting.
    pub fn at_start(scene: &Scene) -> Self {
        Self {
            hinges: scene.bodies.iter().map(|body| body.hinge.start.state).collect(),
            pieces: scene.pieces_at_rest(),
            thrust: false,
        }
    }

    /// Whether hinge `i` turns.
    pub fn is_free(&self, i: usize) -> bool {
        self.hinges[i] == HingeState::Free
    }
}
