//! How many digits of a run are right.

pub(crate) mod expansion;
pub(crate) mod replay;
pub(crate) mod scales;
pub(crate) mod trust;
