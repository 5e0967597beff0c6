//! The Python package `nboom`: what Rust does for it. Python files beside give it its form.
//!
//! Scenes are read, run and swept by the crates that the command is made of, so that results are the
//! same to the last bit.

mod arrays;
mod at_state;
mod columns;
mod command;
mod dynamics;
mod error;
mod evaluator;
mod gathering;
mod patience;
mod routine;
mod run;
mod scene;
mod simulator;
mod study;
mod table;
mod toml_text;
mod words;

use pyo3::prelude::*;

/// Rust's part of the package `nboom`.
#[pymodule]
mod _nboom {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::command::main;
    #[pymodule_export]
    use crate::dynamics::Dynamics;
    #[pymodule_export]
    use crate::gathering::Gathering;
    #[pymodule_export]
    use crate::run::Run;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::simulator::Simulator;
    #[pymodule_export]
    use crate::study::{Ended, Study, SweepOptions, cases, maker, merge};
    #[pymodule_export]
    use crate::toml_text::toml_text;
    #[pymodule_export]
    use crate::words::options;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
