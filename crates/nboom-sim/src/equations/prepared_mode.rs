use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_model::{Mode, Scene};
use nboom_scalar::Vec3;

use crate::code::fit::Repertoire;
use crate::code::right_side::RightSide;
use crate::code::selection::Selection;
use crate::code::{AccelerationCode, CodeError};
use crate::equations::layout::Unknowns;
use crate::equations::rates::Rates;
use crate::options::Options;

/// What a mode needs that does not depend on how it is entered.
pub(crate) struct PreparedMode {
    pub mode: Mode,
    /// β of every hinge; those of held ones are built in.
    beta: Vec<f64>,
    pub dynamics: Recursive<f64>,
    /// What computes accelerations, once it has been chosen.
    code: AccelerationCode,
    /// What computes all rates of change, if something does.
    right_side: Option<RightSide>,
    selection: Option<Selection>,
}

impl PreparedMode {
    /// The mode of the scene of `dynamics` in which held hinges are at `beta`.
    pub fn new(mut dynamics: Recursive<f64>, mode: &Mode, beta: &[f64]) -> Self {
        dynamics.set_mode(mode, beta);
        let (mode, beta) = (mode.clone(), beta.to_vec());
        let code = AccelerationCode::Recursion;
        Self { mode, beta, dynamics, code, right_side: None, selection: None }
    }

    /// Whether it is this mode, with held hinges at these angles.
    pub fn is(&self, mode: &Mode, beta: &[f64]) -> bool {
        let held = (0..beta.len()).filter(|&i| !mode.is_free(i));
        self.mode == *mode && held.into_iter().all(|i| self.beta[i] == beta[i])
    }

    /// Chooses the code that computes accelerations from the time `since` on, unless it was chosen before.
    ///
    /// # Errors
    /// When the code that is demanded does not fit.
    pub fn select(
        &mut self,
        scene: &Scene,
        repertoire: &Repertoire,
        options: &Options,
        since: f64,
    ) -> Result<Selection, CodeError> {
        if let Some(selection) = &self.selection {
            return Ok(Selection { since, ..selection.clone() });
        }
        let (code, selection) =
            AccelerationCode::choose(scene, &self.dynamics, repertoire, options, since)?;
        if let AccelerationCode::Generated(_) = code {
            self.right_side = RightSide::fit(&self.dynamics, repertoire);
        }
        (self.code, self.selection) = (code, Some(selection.clone()));
        Ok(selection)
    }

    /// Writes ẏ at `y` to `dy`, in the layout of `rates`; without thrust the mass centre would fall with the
    /// velocity `free_fall`, inertial axes.
    pub fn rates(
        &mut self,
        rates: &mut Rates<f64>,
        free_fall: Vec3<f64>,
        y: &[f64],
        dy: &mut [f64],
    ) {
        let Self { dynamics, code, right_side, .. } = self;
        match right_side {
            Some(right_side) if rates.layout.unknowns == Unknowns::Velocities => {
                let power = right_side.write(y, dy);
                rates.complete(dynamics, power, free_fall, y, dy);
            }
            _ => {
                let accelerate =
                    |dynamics: &mut Recursive<f64>, motion: &Motion<'_, f64>, out: &mut _| {
                        code.accelerations(dynamics, motion, out);
                    };
                rates.write(dynamics, accelerate, free_fall, y, dy);
            }
        }
    }

    /// Accelerations: ω̇, a_O without gravity, τ̇.
    pub fn accelerations(&mut self, motion: &Motion<'_, f64>, out: &mut Accelerations<f64>) {
        self.code.accelerations(&mut self.dynamics, motion, out);
    }
}
