use faer::linalg::solvers::Solve;
use faer::{ColMut, MatRef, Side};
use nboom_dynamics::{Motion, Recursive};
use nboom_scalar::{Twist, Vec3};

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
        if let Some(held) = dynamics.tree().held {
            hold(matrix, right, held);
        }
        match MatRef::from_row_major_slice(matrix, size, size).llt(Side::Lower) {
            Ok(factors) => factors.solve_in_place(ColMut::from_slice_mut(right)),
            Err(_) => right.fill(f64::NAN),
        }
        right
    }
}

/// Puts a_O = v and ω̇ = α in place of the equations of the main body.
fn hold(matrix: &mut [f64], right: &mut [f64], held: Twist<f64>) {
    let size = right.len();
    let [v, alpha] = [held.linear, held.angular].map(Vec3::to_array);
    let given = [v[0], v[1], v[2], alpha[0], alpha[1], alpha[2]];
    for (row, right) in matrix.chunks_exact_mut(size).zip(&mut *right).skip(6) {
        for (entry, given) in row.iter_mut().zip(given) {
            *right -= *entry * given;
            *entry = 0.0;
        }
    }
    for (i, (row, right)) in matrix.chunks_exact_mut(size).zip(right).take(6).enumerate() {
        row.fill(0.0);
        row[i] = 1.0;
        *right = given[i];
    }
}
