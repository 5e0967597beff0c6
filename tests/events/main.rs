//! Events of small scenes whose motion is known in closed form.

#[path = "../support/mod.rs"]
mod support;

#[path = "../support/collect.rs"]
mod collect;

#[path = "../support/random_scene.rs"]
mod random_scene;

mod rotors;
mod sampled;

mod after_lock;
mod crossings;
mod error_bound;
mod failures;
mod interrupts;
mod kick_off;
mod limits;
mod lock_ups;
mod misses;
mod output;
mod random_rotors;
mod random_trees;
mod releases;
mod runaways;
mod steps;
mod thrust;
