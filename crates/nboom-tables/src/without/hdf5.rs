//! HDF5 in a build without it.

use std::path::Path;

use crate::{Format, Run, TablesError};

pub(crate) fn write(_: &Run, _: &Path) -> Result<(), TablesError> {
    Err(TablesError::NotBuilt(Format::Hdf5))
}
