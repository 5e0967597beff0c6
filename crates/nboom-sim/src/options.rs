use nboom_scalar::Kernel;

/// Which code computes accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// A generated routine where one fits, else the recursive formulation.
    #[default]
    Auto,
    /// A generated routine in every mode, or none.
    Generated,
    /// The recursive formulation.
    Generic,
}

/// How to run a scene.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Output times are the initial time and this many equal parts of the span after it.
    pub samples: usize,
    /// Relative error allowed in a step.
    pub rtol: f64,
    /// Absolute error allowed in a step, in the units of each variable.
    pub atol: f64,
    /// Steps after which the run is given up.
    pub max_steps: usize,
    /// Which code computes accelerations.
    pub path: Path,
    /// The generated routines to choose from.
    pub kernels: &'static [Kernel],
}

impl Default for Options {
    fn default() -> Self {
        Self {
            samples: 200,
            rtol: 1e-9,
            atol: 1e-12,
            max_steps: 10_000_000,
            path: Path::Auto,
            kernels: &[],
        }
    }
}
