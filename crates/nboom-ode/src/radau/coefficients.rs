//! Coefficients of the method of Radau IIA with three stages: Hairer and Wanner, Solving
//! Ordinary Differential Equations II, 2nd ed., Section IV.8; decimals from their RADAU5.

use faer::c64;

use crate::Radau;
use crate::method::Description;

/// The row of [`Method`](crate::Method)'s table.
pub(crate) const DESCRIPTION: Description = Description {
    name: "radau5",
    about: "implicit Runge-Kutta 5(3), for stiff hinges and latches",
    order: |_| 5,
    dense_order: |_| 3,
    keeps_invariants: false,
    stepper: |tolerance| Box::new(Radau::new(tolerance)),
};

const SQRT_6: f64 = 2.449_489_742_783_178;

/// Times of the stages, in steps.
pub(super) const C: [f64; 3] = [(4.0 - SQRT_6) / 10.0, (4.0 + SQRT_6) / 10.0, 1.0];

/// The real eigenvalue of A⁻¹: 30 / (6 + ∛81 − ∛9).
pub(super) const REAL: f64 = 3.637_834_252_744_496;

/// One of the complex eigenvalues of A⁻¹.
pub(super) const COMPLEX: c64 = c64::new(2.681_082_873_627_752_3, 3.050_430_199_247_410_5);

/// From the variables in which A⁻¹ is block diagonal to stages.
pub(super) const T: [[f64; 3]; 3] = [
    [9.123_239_487_089_294e-2, -0.141_255_295_020_954_2, -3.002_919_410_514_742_5e-2],
    [0.241_717_932_707_107, 0.204_129_352_293_799_94, 0.382_942_112_757_261_9],
    [0.966_048_182_615_093, 1.0, 0.0],
];

/// The inverse of [`T`].
pub(super) const T_INVERSE: [[f64; 3]; 3] = [
    [4.325_579_890_063_155, 0.339_199_251_815_809_84, 0.541_770_539_935_874_9],
    [-4.178_718_591_551_905, -0.327_682_820_761_062_4, 0.476_623_554_500_550_44],
    [-0.502_872_634_945_786_9, 2.571_926_949_855_605, -0.596_039_204_828_224_9],
];

/// Weights of the stages in the error estimate.
pub(super) const ERROR: [f64; 3] =
    [-(13.0 + 7.0 * SQRT_6) / 3.0, (-13.0 + 7.0 * SQRT_6) / 3.0, -1.0 / 3.0];

/// A matrix times a column.
pub(super) fn times(matrix: &[[f64; 3]; 3], x: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}
