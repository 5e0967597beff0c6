//! Sweeps whose cases run elsewhere.

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use nboom_study::Maker;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::of_study;
use crate::study::Ended;

/// The directory of a sweep that waits for batches of cases.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Gathering {
    gathering: Mutex<Option<nboom_study::Gathering>>,
    directory: PathBuf,
}

impl Gathering {
    pub fn of(gathering: nboom_study::Gathering, directory: PathBuf) -> Self {
        Self { gathering: Mutex::new(Some(gathering)), directory }
    }

    fn with<T>(&self, work: impl FnOnce(&mut nboom_study::Gathering) -> T) -> PyResult<T> {
        let mut gathering = self.gathering.lock().unwrap_or_else(PoisonError::into_inner);
        let ended =
            || PyValueError::new_err("a gathering that has ended found, an open one expected");
        gathering.as_mut().map(work).ok_or_else(ended)
    }
}

#[pymethods]
impl Gathering {
    /// First and last case of each range that is missing.
    fn missing(&self) -> PyResult<Vec<(u64, u64)>> {
        let ends = |range: std::ops::RangeInclusive<u64>| range.into_inner();
        self.with(|gathering| gathering.missing().into_iter().map(ends).collect())
    }

    /// Cases that are there, and all.
    fn done(&self) -> PyResult<(u64, u64)> {
        self.with(|gathering| gathering.done().into())
    }

    /// Adds a batch that a program of this version, vector instructions and platform has run.
    fn add(&self, py: Python<'_>, batch: &[u8], maker: (String, String, String)) -> PyResult<()> {
        let (version, instructions, platform) = maker;
        let maker = Maker { version, features: None, instructions, platform };
        py.detach(|| self.with(|gathering| gathering.add(batch, &maker)))?.map_err(of_study)
    }

    /// Makes the tables if all cases are there.
    fn finish(&self, py: Python<'_>) -> PyResult<Ended> {
        let taken = self.gathering.lock().unwrap_or_else(PoisonError::into_inner).take();
        let ended =
            || PyValueError::new_err("a gathering that has ended found, an open one expected");
        let gathering = taken.ok_or_else(ended)?;
        let report = py.detach(|| gathering.finish()).map_err(of_study)?;
        Ok(Ended::of(report, self.directory.clone()))
    }
}
