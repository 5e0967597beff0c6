//! The sample run of the 1970 report: its deck (Section 17) against its printout (Section 18,
//! pp. 18-9 to 18-36).

#[path = "../support/mod.rs"]
mod support;

#[path = "../support/collect.rs"]
mod collect;

mod blocks;
mod emulation;
mod events;
mod kick_off;
mod loads;
mod quantity;
mod sample_run;
