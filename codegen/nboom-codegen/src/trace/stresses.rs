use nboom_expr::Graph;
use nboom_loads::SceneMotion;

use crate::request::{CodegenError, StressRequest};
use crate::trace::OPERATION_LIMIT;

impl StressRequest {
    /// Traces the equations: numbers of the scene first, then the motion.
    pub fn trace(&self) -> Graph {
        let Self { equations, .. } = self;
        let mut inputs = self.assumptions();
        let numbers = inputs.len();
        let size = equations.motion_size();
        inputs.resize(numbers + size.count(), None);
        Graph::trace_with(&inputs, |inputs| {
            let (of_scene, of_motion) = inputs.split_at(numbers);
            let mut equations = equations.with_numbers(of_scene);
            let mut found = equations.load_set();
            let motion = SceneMotion::of_numbers(of_motion, size);
            equations.evaluate(&motion, &mut found);
            found.numbers()
        })
    }

    /// # Errors
    /// When the line would be too long for a compiler.
    pub(crate) fn check_length(&self) -> Result<(), CodegenError> {
        let (operations, limit) = (self.trace().operations().flops(), OPERATION_LIMIT);
        if operations > limit {
            return Err(CodegenError::Length { name: self.name.clone(), operations, limit });
        }
        Ok(())
    }
}
