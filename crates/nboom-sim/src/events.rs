//! Instants in which something happens: when they come, and what they change.

pub(crate) mod angle_range;
pub(crate) mod angles;
pub(crate) mod arrivals;
pub(crate) mod bound;
pub(crate) mod contacts;
pub(crate) mod event;
pub(crate) mod guard;
pub(crate) mod instant;
pub(crate) mod line_path;
mod outlook;
pub(crate) mod pieces;
pub(crate) mod rest;
pub(crate) mod schedule;
pub(crate) mod side;
pub(crate) mod situation;
