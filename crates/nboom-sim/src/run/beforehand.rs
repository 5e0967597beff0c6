//! What can be said against a run before its first step.

use nboom_model::Scene;

use crate::error::SimError;
use crate::options::Options;
use crate::run::record::{Failure, Recorder};
use crate::run::simulate;

/// Ends a run before its first step.
struct Reluctant;

impl Recorder for Reluctant {
    fn interrupted(&self) -> bool {
        true
    }
}

/// Refuses what no run of `scene` under `options` could begin with: a number among them with which
/// nothing can be run, and code or a formulation for the first mode that there is not.
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
        _ => Ok(()),
    }
}
