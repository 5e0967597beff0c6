//! Writes `routines.rs` into the output directory: accelerations of a satellite with a boom of
//! two segments and a paddle, all numbers at run time.

use nboom_build::{BuildError, Config, Level};

fn main() -> Result<(), BuildError> {
    Config::new()
        .topology("Satellite", "S2_P")
        .level(Level::Fast)
        .scalar_path("::nboom::scalar")
        .write("routines.rs")
}
