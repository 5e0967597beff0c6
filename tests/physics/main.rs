//! Whole runs against closed forms and against each other: what must come out whatever the
//! equations of motion look like inside.

#[path = "../support/collect.rs"]
mod collect;
#[path = "../support/jacobi.rs"]
mod jacobi;
mod log;
#[path = "../properties/newton_euler.rs"]
mod newton_euler;
#[path = "../support/random_scene.rs"]
mod random_scene;
#[path = "../support/scaled.rs"]
mod scaled;

mod balances;
mod couplings;
mod free_fall;
mod independence;
mod latch;
mod masts;
mod oscillators;
mod outside;
mod rigs;
mod spin_up;
mod thrust;
mod torque_free;
mod torque_table;
mod transforms;
mod weld;
mod wheels;
mod wings;
