use crate::TablesError;

/// A format of other programs for the tables of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A file for each table: pandas, polars, Arrow.
    Parquet,
    /// One file with a group for each table: MATLAB, h5py.
    Hdf5,
}

impl Format {
    /// All of them, built or not.
    pub const ALL: [Self; 2] = [Self::Parquet, Self::Hdf5];

    /// Its name, which that of the feature is too.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Hdf5 => "hdf5",
        }
    }

    /// # Errors
    /// [`TablesError::NotBuilt`] where the feature is off.
    pub fn require(self) -> Result<(), TablesError> {
        let is_built = match self {
            Self::Parquet => cfg!(feature = "parquet"),
            Self::Hdf5 => cfg!(feature = "hdf5"),
        };
        if is_built { Ok(()) } else { Err(TablesError::NotBuilt(self)) }
    }
}
