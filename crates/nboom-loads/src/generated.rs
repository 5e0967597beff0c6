use nboom_scalar::Kernel;

use crate::load_set::LoadSet;
use crate::motion::SceneMotion;

/// What [`Kernel::result`] says of generated code for loads and stresses.
pub const RESULT: &str = "stresses";

/// Generated code in place of the equations of one scene.
#[derive(Clone, Debug)]
pub(crate) struct Generated {
    kernel: Kernel,
    constants: Vec<f64>,
    motion: Vec<f64>,
    loads: Vec<f64>,
}

impl Generated {
    /// The first kernel that is for loads and assumes nothing but these numbers.
    pub fn of(kernels: &[Kernel], numbers: &[f64]) -> Option<Self> {
        let is_ours = |kernel: &&Kernel| kernel.result == RESULT && kernel.accepts(numbers);
        let kernel = *kernels.iter().find(is_ours)?;
        let mut constants = vec![0.0; kernel.constants];
        kernel.prepare(numbers, &mut constants);
        let (motion, loads) = (vec![0.0; kernel.coordinates], vec![0.0; kernel.outputs]);
        Some(Self { kernel, constants, motion, loads })
    }

    pub fn evaluate(&mut self, motion: &SceneMotion<'_>, out: &mut LoadSet) {
        motion.write(&mut self.motion);
        self.kernel.evaluate(&self.constants, &self.motion, &mut self.loads);
        out.set_numbers(&self.loads);
    }

    pub fn instructions(&self) -> &'static str {
        self.kernel.instructions
    }
}
