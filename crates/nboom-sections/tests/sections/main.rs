//! Sections against independent values, closed forms, symmetries and their own equilibrium.

mod closed_forms;
mod data;
mod equilibrium;
mod invariance;
mod maximum;
mod printed;
mod random;
mod refusals;
