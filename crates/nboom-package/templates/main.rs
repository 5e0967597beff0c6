//! A simulator, written by `nboom compile`.

use std::process::ExitCode;
use std::sync::OnceLock;

use nboom_scalar::Kernel;

mod routines;

fn kernels() -> &'static [Kernel] {
    static KERNELS: OnceLock<Vec<Kernel>> = OnceLock::new();
    KERNELS.get_or_init(|| {
        vec![
/*KERNELS*/        ]
    })
}

fn main() -> ExitCode {
    nboom_cli::simulator(std::env::args_os(), kernels())
}
