use nboom_scalar::{ArticulatedInertia, Real, Twist, Vec3, Wrench};

use crate::ldl;

/// The factored 6×6 equation of the main link, L D Lᵀ (ω̇, a_O) = (moment about O, force).
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseFactor<R> {
    /// L below the diagonal.
    lower: [[R; 6]; 6],
    inverse_pivots: [R; 6],
}

impl<R: Real> BaseFactor<R> {
    #[inline(always)]
    pub fn unset() -> Self {
        Self { lower: [[R::zero(); 6]; 6], inverse_pivots: [R::zero(); 6] }
    }

    #[inline(always)]
    pub fn new(inertia: &ArticulatedInertia<R>) -> Self {
        let mut factor = Self { lower: to_matrix(inertia), ..Self::unset() };
        ldl::factor(&mut factor.lower, &mut factor.inverse_pivots);
        factor
    }

    #[inline(always)]
    pub fn solve(&self, right: Wrench<R>) -> Twist<R> {
        let (m, f) = (right.moment, right.force);
        let mut x = [m.x, m.y, m.z, f.x, f.y, f.z];
        ldl::solve(&self.lower, &self.inverse_pivots, &mut x);
        Twist { angular: Vec3::new(x[0], x[1], x[2]), linear: Vec3::new(x[3], x[4], x[5]) }
    }
}

impl BaseFactor<f64> {
    /// Whether all pivots, angular and linear ones, are above zero and above these bounds.
    pub fn is_above(&self, [angular, linear]: [f64; 2]) -> bool {
        let is_above = |bound: f64, inverses: &[f64]| inverses.iter().all(|p| 1.0 / p > bound);
        let [of_angular, of_linear] = [&self.inverse_pivots[..3], &self.inverse_pivots[3..]];
        ldl::is_positive_definite(&self.inverse_pivots)
            && is_above(angular, of_angular)
            && is_above(linear, of_linear)
    }
}

/// The lower triangle of the 6×6 matrix, moments first.
#[inline(always)]
fn to_matrix<R: Real>(inertia: &ArticulatedInertia<R>) -> [[R; 6]; 6] {
    let angular = inertia.angular.to_matrix().rows;
    let below = inertia.coupling.transpose().rows;
    let linear = inertia.linear.to_matrix().rows;
    let mut matrix = [[R::zero(); 6]; 6];
    for i in 0..3 {
        matrix[i][..3].copy_from_slice(&angular[i].to_array());
        matrix[i + 3][..3].copy_from_slice(&below[i].to_array());
        matrix[i + 3][3..].copy_from_slice(&linear[i].to_array());
    }
    matrix
}
