use nboom_scalar::{ArticulatedInertia, Real, Twist, Vec3, Wrench};

/// The factored 6×6 equation of the main link, L D Lᵀ (ω̇, a_O) = (moment about O, force).
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseFactor<R> {
    /// Strictly lower triangle of L.
    lower: [[R; 6]; 6],
    inverse_pivots: [R; 6],
}

impl<R: Real> BaseFactor<R> {
    pub fn unset() -> Self {
        Self { lower: [[R::zero(); 6]; 6], inverse_pivots: [R::zero(); 6] }
    }

    #[inline]
    pub fn new(inertia: &ArticulatedInertia<R>) -> Self {
        let matrix = to_matrix(inertia);
        let mut factor = Self::unset();
        let mut scaled = [[R::zero(); 6]; 6];
        for i in 0..6 {
            for j in 0..i {
                let mut sum = matrix[i][j];
                for k in 0..j {
                    sum -= scaled[i][k] * factor.lower[j][k];
                }
                scaled[i][j] = sum;
                factor.lower[i][j] = sum * factor.inverse_pivots[j];
            }
            let mut pivot = matrix[i][i];
            for k in 0..i {
                pivot -= scaled[i][k] * factor.lower[i][k];
            }
            factor.inverse_pivots[i] = R::one() / pivot;
        }
        factor
    }

    #[inline]
    pub fn solve(&self, right: Wrench<R>) -> Twist<R> {
        let (m, f) = (right.moment, right.force);
        let mut x = [m.x, m.y, m.z, f.x, f.y, f.z];
        for i in 1..6 {
            for k in 0..i {
                x[i] -= self.lower[i][k] * x[k];
            }
        }
        for i in 0..6 {
            x[i] = x[i] * self.inverse_pivots[i];
        }
        for i in (0..5).rev() {
            for k in i + 1..6 {
                x[i] -= self.lower[k][i] * x[k];
            }
        }
        Twist { angular: Vec3::new(x[0], x[1], x[2]), linear: Vec3::new(x[3], x[4], x[5]) }
    }
}

impl BaseFactor<f64> {
    pub fn is_positive_definite(&self) -> bool {
        self.inverse_pivots.iter().all(|&p| p > 0.0 && p.is_finite())
    }
}

/// The lower triangle of the 6×6 matrix, moments first.
#[inline]
fn to_matrix<R: Real>(inertia: &ArticulatedInertia<R>) -> [[R; 6]; 6] {
    let angular = inertia.angular.to_matrix().rows.map(Vec3::to_array);
    let below = inertia.coupling.transpose().rows.map(Vec3::to_array);
    let linear = inertia.linear.to_matrix().rows.map(Vec3::to_array);
    let mut matrix = [[R::zero(); 6]; 6];
    for i in 0..3 {
        matrix[i][..3].copy_from_slice(&angular[i]);
        matrix[i + 3][..3].copy_from_slice(&below[i]);
        matrix[i + 3][3..].copy_from_slice(&linear[i]);
    }
    matrix
}
