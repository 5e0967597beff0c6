use std::path::{Path, PathBuf};

use nboom_tables::{Cell, read_table};

use crate::description::Description;
use crate::directory::{self, STATISTICS_FILE, STUDY_FILE, SWEPT_SCENE_FILE};
use crate::journal::Part;
use crate::statistics::Summary;
use crate::{StudyError, tables};

/// The directory of a finished sweep.
#[derive(Clone, Debug)]
pub struct SweepDirectory {
    path: PathBuf,
    /// What the sweep is.
    pub description: Description,
}

impl SweepDirectory {
    /// Reads what the sweep in a directory is; none if no sweep has written there.
    ///
    /// # Errors
    /// When it is not complete, or a shard; when its description cannot be read; when its study or scene is not what
    /// the sweep wrote.
    pub fn read(path: &Path) -> Result<Option<Self>, StudyError> {
        let Some(description) = directory::description(path)? else { return Ok(None) };
        let directory = path.to_owned();
        if let Some(shard) = description.shard {
            return Err(StudyError::Shard { directory, shard });
        }
        if !description.complete {
            let (done, cases) = (directory::journal(path, &description)?.done(), description.cases);
            return Err(StudyError::Unfinished { directory, done, cases });
        }
        directory::sources(path, &description)?;
        Ok(Some(Self { path: directory, description }))
    }

    /// Statistics of all cases.
    ///
    /// # Errors
    /// When they cannot be read.
    pub fn statistics(&self) -> Result<Summary, StudyError> {
        let path = self.path.join(STATISTICS_FILE);
        let text = directory::text(&path)?;
        let found = serde_json::from_str(&text)
            .map_err(|error| StudyError::NoSweep { path, found: error.to_string() });
        Ok(Summary::renewed(found?, &self.description.fields()))
    }

    /// Hands on the rows of the table of cases, in order.
    ///
    /// # Errors
    /// When the table cannot be read, and those of `take`.
    pub fn each_case(
        &self,
        take: impl FnMut(&[Cell<'_>]) -> Result<(), StudyError>,
    ) -> Result<(), StudyError> {
        read_table(&tables::path(&self.path, Part::Case), &self.description.columns, take)
    }

    /// The text of the study.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn study(&self) -> Result<String, StudyError> {
        directory::text(&self.path.join(STUDY_FILE))
    }

    /// The text of the scene, which stands alone.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn scene(&self) -> Result<String, StudyError> {
        directory::text(&self.path.join(SWEPT_SCENE_FILE))
    }
}
