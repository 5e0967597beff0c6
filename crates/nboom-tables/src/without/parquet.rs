//! Parquet in a build without it.

use std::path::Path;

use crate::group::Group;
use crate::{Column, Format, TablesError};

/// It cannot be read.
pub(crate) fn each_group<E: From<TablesError>>(
    _: &Path,
    _: &[Column],
    _: impl FnMut(&Group) -> Result<(), E>,
) -> Result<(), E> {
    Err(TablesError::NotBuilt(Format::Parquet).into())
}

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
