//! What can be said against a run before its first step.

use nboom_model::{Hinge, HingeState, Mode, Release, Scene, WeldedTree};
use nboom_ode::Method;

use super::Run;
use crate::code::closed_form::ClosedForm;
use crate::error::SimError;
use crate::options::{Form, Options, Path};
use crate::run::record::{Failure, Recorder};
use crate::run::simulate;

/// Ends a run before its first step.
struct Reluctant;

impl Recorder for Reluctant {
    fn interrupted(&self) -> bool {
        true
    }
}

impl Run<'_> {
    /// Refuses hinge laws of the program's own that are of no hinge, and to run them by code that does not
    /// know them.
    pub(super) fn check_own_laws(&self) -> Result<(), SimError> {
        let (options, count) = (&self.options, self.equations.scene.bodies.len());
        if let Some(law) = self.equations.own.iter().find(|law| law.hinge >= count) {
            return Err(SimError::OwnLawHinge { hinge: law.hinge.saturating_add(1), count });
        }
        let demanded = match options.formulation {
            _ if self.equations.own.is_empty() => None,
            _ if options.integrator == Method::Taylor => Some("power series"),
            _ if options.path == Path::Generated => Some("generated code"),
            Some(Form::Closed(_)) => Some("a closed form"),
            Some(Form::Recursive) | None => None,
        };
        demanded.map_or(Ok(()), |demanded| Err(SimError::OwnLaws { demanded }))
    }
}

/// Refuses options with which no run of `scene` can begin or end: numbers with which nothing can be run,
/// code or a formulation that does not exist for the first mode, and a formulation that does not exist where releases
/// at known times lead.
///
/// # Errors
/// [`SimError::Option`], [`SimError::NoRoutine`] and [`SimError::NotCovered`]. A motion that
/// cannot be computed at its initial time is no error here; running it is.
pub fn check_start(scene: &Scene, options: &Options) -> Result<(), SimError> {
    use SimError::{NoRoutine, NotCovered, Option};
    match simulate(scene, options, &mut Reluctant) {
        Err(Failure {
            error: error @ (Option(_) | NoRoutine { .. } | NotCovered { .. }), ..
        }) => Err(error),
        _ => check_releases(scene, options),
    }
}

/// Refuses a closed form that is demanded and does not cover the hinges that are free when others are released: these,
/// and earlier ones that cannot lock. Which of the others are free by then only the run can tell; with more free hinges
/// nothing is covered that is not with fewer.
fn check_releases(scene: &Scene, options: &Options) -> Result<(), SimError> {
    let (Path::Generic, Some(Form::Closed(formulation))) = (options.path, options.formulation)
    else {
        return Ok(());
    };
    let release = |hinge: &Hinge| match (hinge.start.state, hinge.release) {
        (HingeState::Unreleased, Release::Time(time)) => time,
        (HingeState::Free, _) => scene.initial.time,
        _ => f64::INFINITY,
    };
    let hinges = || scene.bodies.iter().map(|body| &body.hinge);
    let beta: Vec<f64> = hinges().map(|hinge| hinge.start.angle).collect();
    let mut times: Vec<f64> = hinges().map(release).filter(|time| *time < scene.end_time).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times.into_iter().filter(|time| *time > scene.initial.time).try_for_each(|time| {
        let state = |hinge: &Hinge| {
            let since = release(hinge);
            let is_free = since == time || since < time && hinge.lock_angle.is_none();
            if is_free { HingeState::Free } else { HingeState::Unreleased }
        };
        let mode = Mode { hinges: hinges().map(state).collect(), ..Mode::at_start(scene) };
        let tree = WeldedTree::new(scene, &mode, &beta);
        let fitted = ClosedForm::<f64>::fit(scene, &tree, formulation);
        fitted.map(drop).map_err(|source| SimError::NotCovered { time, source })
    })
}
