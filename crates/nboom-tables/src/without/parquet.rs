//! Parquet in a build without it.

use std::path::Path;

use crate::group::Group;
use crate::{Column, Format, TablesError};

/// There is none.
#[derive(Debug)]
pub(crate) enum ParquetFile {}

impl ParquetFile {
    pub fn create(_: &Path, _: &[Column], _: &[(&str, &str)]) -> Result<Self, TablesError> {
        Err(TablesError::NotBuilt(Format::Parquet))
    }

    pub fn write(&mut self, _: &Group) -> Result<(), TablesError> {
        match *self {}
    }

    pub fn close(self) -> Result<(), TablesError> {
        match self {}
    }
}
