//! What can be said against a run before its first step.

use nboom_model::Scene;
use nboom_ode::Method;

use super::Run;
use crate::error::SimError;
use crate::options::{Form, Options, Path};
use crate::run::record::{Failure, Recorder};
use crate::run::simulate;

/// Ends a run before its first step.
struct InterruptAtOnce;

impl Recorder for InterruptAtOnce {
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

/// Refuses options with which no run of `scene` can begin: numbers with which nothing can be run,
/// and code or a formulation that does not exist for the first mode.
///
/// # Errors
/// [`SimError::Option`], [`SimError::NoRoutine`] and [`SimError::NotCovered`]. A motion that
/// cannot be computed at its initial time is no error here; running it is.
pub fn check_start(scene: &Scene, options: &Options) -> Result<(), SimError> {
    use SimError::{NoRoutine, NotCovered, Option};
    match simulate(scene, options, &mut InterruptAtOnce) {
        Err(Failure {
            error: error @ (Option(_) | NoRoutine { .. } | NotCovered { .. }), ..
        }) => Err(error),
        _ => Ok(()),
    }
}
