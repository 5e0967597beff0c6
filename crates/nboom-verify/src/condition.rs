/// Sweeps after which Jacobi's rotations have long converged.
const MOST_SWEEPS: usize = 40;

/// The condition of a positive definite matrix, given row by row, when its rows and columns are
/// scaled so that the diagonal is 1; infinite where it is not positive definite.
pub(crate) fn condition(matrix: &[f64]) -> f64 {
    let n = matrix.len().isqrt();
    let diagonal = |i: usize| matrix[i * n + i];
    if !(0..n).all(|i| diagonal(i) > 0.0) {
        return f64::INFINITY;
    }
    let scaled = |i: usize, j: usize| matrix[i * n + j] / (diagonal(i) * diagonal(j)).sqrt();
    let mut a: Vec<f64> = (0..n * n).map(|at| scaled(at / n, at % n)).collect();
    diagonalise(&mut a, n);
    let values = || (0..n).map(|i| a[i * n + i]);
    let least = values().fold(f64::INFINITY, f64::min);
    let largest = values().fold(0.0, f64::max);
    if least > 0.0 { largest / least } else { f64::INFINITY }
}

/// Jacobi's rotations until what is off the diagonal is rounding beside it.
fn diagonalise(a: &mut [f64], n: usize) {
    for _ in 0..MOST_SWEEPS {
        let mut turned = false;
        for p in 0..n {
            for q in p + 1..n {
                let rounding = f64::EPSILON * (a[p * n + p] * a[q * n + q]).abs().sqrt();
                if a[p * n + q].abs() > rounding {
                    rotate(a, n, p, q);
                    turned = true;
                }
            }
        }
        if !turned {
            return;
        }
    }
}

/// The rotation of rows and columns `p` and `q` that makes their entry zero.
fn rotate(a: &mut [f64], n: usize, p: usize, q: usize) {
    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * a[p * n + q]);
    let t = 1.0_f64.copysign(theta) / (theta.abs() + theta.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    for k in 0..n {
        let (kp, kq) = (a[k * n + p], a[k * n + q]);
        (a[k * n + p], a[k * n + q]) = (c * kp - s * kq, s * kp + c * kq);
    }
    for k in 0..n {
        let (pk, qk) = (a[p * n + k], a[q * n + k]);
        (a[p * n + k], a[q * n + k]) = (c * pk - s * qk, s * pk + c * qk);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_matrices_whose_condition_is_known() {
        // Scaled to diagonal 1 and 0.5 beside it: 1.5 and 0.5.
        assert!((condition(&[4.0, 3.0, 3.0, 9.0]) - 3.0).abs() < 1e-14);
        // 2 + 2 cos(k π / 4), halved.
        let expected = (2.0 + 2.0_f64.sqrt()) / (2.0 - 2.0_f64.sqrt());
        let found = condition(&[2.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
        assert!((found - expected).abs() < 1e-13, "{found}");
        assert!((condition(&[3.0]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn of_what_is_not_positive_definite() {
        for matrix in [[1.0, 2.0, 2.0, 1.0], [0.0, 0.0, 0.0, 1.0], [f64::NAN, 0.0, 0.0, 1.0]] {
            assert!(condition(&matrix).is_infinite());
        }
    }
}
