use faer::linalg::solvers::Solve;
use faer::{ColMut, MatRef, Side};
use nboom_dynamics::{Motion, Recursive};

/// Accelerations from the whole mass matrix: by composite bodies, factored by Cholesky's method.
///
/// It shares poses and forces with the recursion, but neither articulated inertias nor any
/// elimination with other code.
#[derive(Clone, Debug)]
pub struct Dense {
    dynamics: Recursive<f64>,
    /// B₀ of (V, ω, τ), row by row.
    matrix: Vec<f64>,
    /// u₀, then (a_O, ω̇, τ̇).
    right: Vec<f64>,
}

impl Dense {
    pub(crate) fn new(dynamics: &Recursive<f64>) -> Self {
        let size = 6 + dynamics.free_hinges().len();
        Self { dynamics: dynamics.clone(), matrix: vec![0.0; size * size], right: vec![0.0; size] }
    }

    /// a_O and ω̇, main-body axes, and τ̇ of the free hinges in the scene's order; no numbers where
    /// the matrix is not positive definite.
    pub fn accelerations(&mut self, motion: &Motion<'_, f64>) -> &[f64] {
        let Self { dynamics, matrix, right } = self;
        dynamics.equations(motion, matrix, right);
        let size = right.len();
        match MatRef::from_row_major_slice(matrix, size, size).llt(Side::Lower) {
            Ok(factors) => factors.solve_in_place(ColMut::from_slice_mut(right)),
            Err(_) => right.fill(f64::NAN),
        }
        right
    }
}
