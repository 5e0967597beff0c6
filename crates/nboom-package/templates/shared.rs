//! Routines of a scene as a library, written by nboom.

use nboom_scalar::ForeignTable;

mod routines;

/// The routines, in a layout that every compiler agrees on; they stay for ever.
#[unsafe(no_mangle)]
pub extern "C" fn nboom_routines() -> *const ForeignTable {
    ForeignTable::of(routines::kernels(), routines::batches())
}
