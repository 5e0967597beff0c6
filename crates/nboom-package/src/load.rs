//! Routines out of libraries.
#![allow(unsafe_code, reason = "what a library says of itself cannot be checked before it is run")]

use std::fs;
use std::mem::ManuallyDrop;
use std::path::Path;

use libloading::Library;
use nboom_scalar::{Batch, ForeignTable, Kernel};

use crate::PackageError;

/// What the table of a library's routines is called.
const SYMBOL: &str = "nboom_routines";

/// The function of that name.
type Routines = unsafe extern "C" fn() -> *const ForeignTable;

/// The routines of a library, which stay until the program ends.
#[derive(Clone, Copy, Debug)]
pub struct Loaded {
    /// Those on one state.
    pub kernels: &'static [Kernel],
    /// Those on eight states.
    pub batches: &'static [Batch],
}

/// Opens a library that [`library`](fn@crate::library) has built, this version or another, for good.
///
/// A library is code, and runs with all that this program may do: it has to be one to be trusted.
///
/// # Errors
/// [`PackageError::Read`] when it is not there, [`PackageError::NoLibrary`] when it is none,
/// [`PackageError::NoRoutines`] when it is another one, and [`PackageError::OtherVersion`] when its
/// routines are laid out in another way than this program reads them.
pub fn load(path: &Path) -> Result<Loaded, PackageError> {
    // Without a folder in it, the system would look for a name elsewhere.
    let path = fs::canonicalize(path).map_err(PackageError::reading(path))?;
    let no_library = |source| PackageError::NoLibrary { path: path.clone(), source };
    let no_routines = |source| PackageError::NoRoutines { path: path.clone(), source };
    // SAFETY: a library by `library` runs nothing when it is opened; others are the caller's to trust.
    let library = unsafe { Library::new(&path) }.map_err(no_library)?;
    // Its routines stay, so it does.
    let library = ManuallyDrop::new(library);
    // SAFETY: nobody else has a function of that name, and all versions give it this type.
    let routines = unsafe { library.get::<Routines>(SYMBOL) }.map_err(no_routines)?;
    // SAFETY: the table is by `ForeignTable::of`, and the library is never closed.
    let loaded = unsafe { ForeignTable::routines(routines()) };
    let (kernels, batches) =
        loaded.map_err(|source| PackageError::OtherVersion { path: path.clone(), source })?;
    Ok(Loaded { kernels, batches })
}
