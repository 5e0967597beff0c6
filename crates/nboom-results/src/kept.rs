use std::path::{Path, PathBuf};

use nboom_model::Scene;
use nboom_sim::Trust;

use crate::destination::Destination;
use crate::whole::Draft;
use crate::{PeakDigits, REPORT_FILE, ResultsError, TRUST_FILE, trust};

/// The results of a run that has ended; no other run can write there while this value lives.
#[derive(Debug)]
pub struct Kept {
    pub(crate) place: Destination,
    /// Where it is.
    pub directory: PathBuf,
    /// Whether all of it could be written.
    pub written: Result<(), ResultsError>,
}

impl Kept {
    /// Adds how many digits of the run, and of its largest loads, can be trusted.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add_trust(
        &self,
        scene: &Scene,
        found: &Trust,
        peaks: &[PeakDigits],
    ) -> Result<(), ResultsError> {
        let text = trust::text(scene, found, peaks);
        let publish = |draft: Draft, target: &Path| draft.publish(target, text.as_bytes());
        self.place.add(&self.directory, TRUST_FILE, publish)
    }

    /// Adds the page that shows the run.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add_report(&self, page: &str) -> Result<(), ResultsError> {
        let publish = |draft: Draft, target: &Path| draft.publish_unsynced(target, page.as_bytes());
        self.place.add(&self.directory, REPORT_FILE, publish)
    }

    /// Adds a file of this name that `make` writes at a path; one that it cannot write leaves nothing.
    ///
    /// # Errors
    /// That of `make`, or when the file cannot be moved to the results.
    pub fn add_made<E: From<ResultsError>>(
        &self,
        name: &'static str,
        make: impl FnOnce(&Path) -> Result<(), E>,
    ) -> Result<(), E> {
        let (draft, target) = self.place.addition(&self.directory, name)?;
        draft.publish_made(&target, make)
    }
}
