//! Which code computes accelerations in a mode.

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_elements::OwnLaws;
use nboom_formulation::{Formulation, Recognised, Uncovered};
use nboom_model::Scene;
use nboom_ode::Method;

use crate::code::closed_form::{ClosedForm, NotCovered};
use crate::code::fit::Repertoire;
use crate::code::generated::{Generated, NoRoutine};
use crate::code::selection::{AS_DEMANDED, Selection};
use crate::options::{Form, Options, Path};

pub(crate) mod closed_form;
pub(crate) mod fit;
pub(crate) mod generated;
pub(crate) mod right_side;
pub(crate) mod selection;

/// Code that computes the accelerations of one mode.
#[derive(Clone, Debug)]
pub(crate) enum AccelerationCode {
    Recursion,
    /// The recursion under hinge laws of the program's own as well.
    UnderOwnLaws(OwnLaws),
    ClosedForm(ClosedForm<f64>),
    Generated(Generated),
}

/// Why the code that is demanded cannot be had.
#[derive(Debug)]
pub(crate) enum CodeError {
    NoRoutine(NoRoutine),
    NotCovered(NotCovered),
}

/// Code, and why that.
type Chosen = (AccelerationCode, String);

impl AccelerationCode {
    /// What `options`, whose generated routines are in `repertoire`, demand for the mode of `dynamics`, whose
    /// tree was `recognised` or not and which begins at `since`.
    ///
    /// # Errors
    /// When it cannot be had.
    pub fn choose(
        scene: &Scene,
        dynamics: &Recursive<f64>,
        recognised: Result<&Recognised, Uncovered>,
        repertoire: &mut Repertoire,
        options: &Options,
        since: f64,
    ) -> Result<(Self, Selection), CodeError> {
        if options.integrator == Method::Taylor {
            let code = Self::recorded(scene, dynamics);
            let (path, (_, formulation)) = (Selection::SERIES, code.path_and_formulation());
            let reason = "power series of these equations, as recorded".into();
            return Ok((code, Selection { since, path, formulation, reason, evaluations: 0 }));
        }
        let as_demanded = AS_DEMANDED.to_owned();
        let (code, reason) = match (options.path, options.formulation) {
            (Path::Generated, _) => generated(scene, dynamics, recognised, repertoire, options)
                .map_err(CodeError::NoRoutine)?,
            (Path::Generic, form) => {
                library(scene, dynamics, form, as_demanded).map_err(CodeError::NotCovered)?
            }
            (Path::Auto, Some(Form::Recursive)) => (Self::Recursion, as_demanded),
            (Path::Auto, _) => whatever_fits(scene, dynamics, recognised, repertoire, options),
        };
        let (path, formulation) = code.path_and_formulation();
        let reason = reason.into();
        Ok((code, Selection { since, path, formulation, reason, evaluations: 0 }))
    }

    /// The recursion under hinge laws of the program's own, which no other code knows, for a mode that
    /// begins at `since`.
    pub fn under_own_laws(own: &OwnLaws, since: f64) -> (Self, Selection) {
        let code = Self::UnderOwnLaws(own.clone());
        let (path, formulation) = code.path_and_formulation();
        let reason = "hinge laws of the program's own act".into();
        (code, Selection { since, path, formulation, reason, evaluations: 0 })
    }

    /// The equations that power series are taken of, for what is told beside.
    pub fn recorded(scene: &Scene, dynamics: &Recursive<f64>) -> Self {
        let form = ClosedForm::fit(scene, dynamics.tree(), Formulation::Articulated);
        form.map_or(Self::Recursion, Self::ClosedForm)
    }

    fn path_and_formulation(&self) -> (&'static str, &'static str) {
        match self {
            Self::Recursion | Self::UnderOwnLaws(_) => (Selection::GENERIC, Form::Recursive.name()),
            Self::ClosedForm(form) => (Selection::GENERIC, form.formulation().name()),
            Self::Generated(routine) => {
                (Selection::GENERATED, routine.routine().kernel.formulation)
            }
        }
    }

    /// Accelerations in the mode of `dynamics`: ω̇, a_O without gravity, τ̇.
    pub fn accelerations(
        &mut self,
        dynamics: &mut Recursive<f64>,
        motion: &Motion<'_, f64>,
        out: &mut Accelerations<f64>,
    ) {
        match self {
            Self::Recursion => dynamics.accelerations(motion, out),
            Self::UnderOwnLaws(own) => under_own_laws(own, dynamics, motion, out),
            Self::ClosedForm(form) => form.accelerations(dynamics, motion, out),
            Self::Generated(routine) => routine.accelerations(dynamics, motion, out),
        }
        dynamics.hold(out);
    }
}

/// Accelerations by the recursion under hinge laws of the program's own as well.
pub(crate) fn under_own_laws(
    own: &OwnLaws,
    dynamics: &mut Recursive<f64>,
    motion: &Motion<'_, f64>,
    out: &mut Accelerations<f64>,
) {
    let add = |free: &[usize], torques: &mut [f64]| {
        own.add_torques(free, [motion.beta, motion.tau], torques);
    };
    dynamics.accelerations_with(add, motion, out);
}

fn generated(
    scene: &Scene,
    dynamics: &Recursive<f64>,
    recognised: Result<&Recognised, Uncovered>,
    repertoire: &mut Repertoire,
    options: &Options,
) -> Result<Chosen, NoRoutine> {
    let routine = Generated::fit(scene, dynamics, recognised, repertoire, options)?;
    let reason = routine.routine().reason();
    Ok((AccelerationCode::Generated(routine), reason))
}

fn library(
    scene: &Scene,
    dynamics: &Recursive<f64>,
    form: Option<Form>,
    reason: String,
) -> Result<Chosen, NotCovered> {
    match form {
        None | Some(Form::Recursive) => Ok((AccelerationCode::Recursion, reason)),
        Some(Form::Closed(formulation)) => {
            let form = ClosedForm::fit(scene, dynamics.tree(), formulation)?;
            Ok((AccelerationCode::ClosedForm(form), reason))
        }
    }
}

/// A generated routine, else library code of the same formulation, else the recursion.
fn whatever_fits(
    scene: &Scene,
    dynamics: &Recursive<f64>,
    recognised: Result<&Recognised, Uncovered>,
    repertoire: &mut Repertoire,
    options: &Options,
) -> Chosen {
    generated(scene, dynamics, recognised, repertoire, options)
        .or_else(|none| library(scene, dynamics, options.formulation, none.to_string()))
        .unwrap_or_else(|not_covered| (AccelerationCode::Recursion, not_covered.to_string()))
}
