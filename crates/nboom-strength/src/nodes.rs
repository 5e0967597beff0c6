//! Polynomials on [0, 1] through values at Chebyshev points, which are dense towards both ends.

use std::f64::consts::PI;

/// Points of the first pass, those with even numbers among [`FINE`].
pub(crate) const COARSE: usize = 5;
/// Points of the second pass.
pub(crate) const FINE: usize = 9;

/// Where the fine points are, from 0 to 1.
pub(crate) fn places() -> [f64; FINE] {
    std::array::from_fn(place::<FINE>)
}

fn place<const N: usize>(k: usize) -> f64 {
    let half = 0.5 * PI * k as f64 / (N - 1) as f64;
    half.sin().powi(2)
}

/// Matrices from `N` values to the coefficients of the polynomials through them.
#[derive(Clone, Debug)]
pub(crate) struct Basis<const N: usize> {
    /// Row i has the contribution of each value to coefficient i in Bernstein's basis.
    pub bernstein: [[f64; N]; N],
    /// The contribution of each value to the last two coefficients in Chebyshev's basis.
    pub tail: [[f64; N]; 2],
}

impl<const N: usize> Basis<N> {
    pub fn new() -> Self {
        let degree = N - 1;
        let at = |k: usize| std::array::from_fn(|i| bernstein(degree, i, place::<N>(k)));
        let end = |k: usize| if k == 0 || k == degree { 0.5 } else { 1.0 };
        let cosine = |j: usize, k: usize| (PI * (j * k) as f64 / degree as f64).cos();
        let chebyshev = |j: usize| {
            std::array::from_fn(|k| 2.0 / degree as f64 * end(j) * end(k) * cosine(j, k))
        };
        Self {
            bernstein: inverse(std::array::from_fn(at)),
            tail: [chebyshev(degree - 1), chebyshev(degree)],
        }
    }

    /// A sum of `values` with the weights of a row.
    pub fn weigh<const M: usize>(row: &[f64; N], values: &[[f64; M]; N]) -> [f64; M] {
        let mut sum = [0.0; M];
        for (weight, value) in row.iter().zip(values) {
            sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
        }
        sum
    }

    /// The coefficients in Bernstein's basis of the polynomials through `values`.
    pub fn coefficients<const M: usize>(&self, values: &[[f64; M]; N]) -> [[f64; M]; N] {
        self.bernstein.map(|row| Self::weigh(&row, values))
    }

    /// The last two coefficients in Chebyshev's basis, but for their signs.
    pub fn tails<const M: usize>(&self, values: &[[f64; M]; N]) -> [[f64; M]; 2] {
        self.tail.map(|row| Self::weigh(&row, values))
    }
}

/// Coefficient `i` in Bernstein's basis of 32n x (1 − x), which bounds what a polynomial of degree `n`
/// leaves out, as a share of its [`Basis::tails`]: that vanishes at both ends.
///
/// Of a term a T₍ₙ₊ₘ₎ of Chebyshev's series it leaves out a (T₍ₙ₊ₘ₎ − T₍ₙ₋ₘ₎) = −2a sin nϑ sin mϑ, where
/// cos ϑ = 2x − 1: at most 8nm |a| x (1 − x). If coefficients fall to half from one to the next, all
/// terms leave out four times as much as the first, whose a is among the tails.
pub(crate) fn share_left_out(n: usize, i: usize) -> f64 {
    (32 * i * (n - i)) as f64 / (n - 1) as f64
}

/// Barycentric weights: their sum with the values at the fine points is the value at `x` of the
/// polynomial through these.
pub(crate) fn weights(places: &[f64; FINE], x: f64) -> [f64; FINE] {
    if let Some(here) = places.iter().position(|place| *place == x) {
        return std::array::from_fn(|k| if k == here { 1.0 } else { 0.0 });
    }
    let weight = |k: usize| {
        let size = if k == 0 || k == FINE - 1 { 0.5 } else { 1.0 };
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * size / (x - places[k])
    };
    let weights: [f64; FINE] = std::array::from_fn(weight);
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// The two halves of polynomials by their Bernstein coefficients (de Casteljau).
pub(crate) fn halves<const M: usize>(whole: &[[f64; M]; FINE]) -> [[[f64; M]; FINE]; 2] {
    let (mut left, mut right) = (*whole, *whole);
    for level in 1..FINE {
        for i in (level..FINE).rev() {
            left[i] = std::array::from_fn(|j| 0.5 * (left[i - 1][j] + left[i][j]));
        }
        for i in 0..FINE - level {
            right[i] = std::array::from_fn(|j| 0.5 * (right[i][j] + right[i + 1][j]));
        }
    }
    [left, right]
}

/// The values at `x` of polynomials by their Bernstein coefficients (de Casteljau).
pub(crate) fn value<const M: usize>(polynomials: &[[f64; M]; FINE], x: f64) -> [f64; M] {
    let mut mean = *polynomials;
    for level in 1..FINE {
        for i in 0..FINE - level {
            mean[i] = std::array::from_fn(|j| (1.0 - x) * mean[i][j] + x * mean[i + 1][j]);
        }
    }
    mean[0]
}

fn bernstein(degree: usize, i: usize, x: f64) -> f64 {
    let choose = (0..i).fold(1.0, |product, k| product * (degree - k) as f64 / (k + 1) as f64);
    choose * x.powi(i as i32) * (1.0 - x).powi((degree - i) as i32)
}

/// The inverse of a matrix that has one (Gauss, Jordan).
fn inverse<const N: usize>(mut matrix: [[f64; N]; N]) -> [[f64; N]; N] {
    let mut inverse: [[f64; N]; N] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for column in 0..N {
        let size = |row: &usize| matrix[*row][column].abs();
        let pivot = (column..N).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(column);
        matrix.swap(column, pivot);
        inverse.swap(column, pivot);
        let scale = 1.0 / matrix[column][column];
        matrix[column].iter_mut().for_each(|x| *x *= scale);
        inverse[column].iter_mut().for_each(|x| *x *= scale);
        for row in (0..N).filter(|row| *row != column) {
            let factor = matrix[row][column];
            for j in 0..N {
                matrix[row][j] -= factor * matrix[column][j];
                inverse[row][j] -= factor * inverse[column][j];
            }
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of degree eight.
    fn polynomial(x: f64) -> f64 {
        [0.3, -1.0, 2.0, 0.7, -4.0, 1.5, 2.2, -0.4, 0.9].iter().rev().fold(0.0, |p, c| p * x + c)
    }

    #[test]
    fn a_polynomial_comes_back_from_its_values() {
        let (basis, places) = (Basis::<FINE>::new(), places());
        let values = places.map(|x| [polynomial(x)]);
        let coefficients = basis.coefficients(&values);
        let [left, right] = halves(&coefficients);
        for i in 0..=20 {
            let x = f64::from(i) / 20.0;
            let expected = polynomial(x);
            let sum: f64 = weights(&places, x).iter().zip(&values).map(|(w, v)| w * v[0]).sum();
            let half = if x < 0.5 { value(&left, 2.0 * x) } else { value(&right, 2.0 * x - 1.0) };
            for found in [value(&coefficients, x)[0], sum, half[0]] {
                // Roundings, magnified by the inverse of the table of Bernstein's polynomials.
                assert!((found - expected).abs() < 1e-12, "{x}: {found} {expected}");
            }
        }
    }

    #[test]
    fn the_last_coefficients_of_chebyshev_are_those() {
        // T₇ + 3 T₈ on [−1, 1]; the points run from −1 to 1, so that odd ones change sign.
        let chebyshev = |x: f64| {
            let angle = (2.0 * x - 1.0).acos();
            [(7.0 * angle).cos() + 3.0 * (8.0 * angle).cos()]
        };
        let [[a], [b]] = Basis::<FINE>::new().tails(&places().map(chebyshev));
        assert!((a.abs() - 1.0).abs() < 1e-13 && (b - 3.0).abs() < 1e-13, "{a} {b}");
        let [[a], [b]] = Basis::<COARSE>::new().tails(&[[1.0], [2.0], [3.0], [2.0], [1.0]]);
        assert!(a.abs() < 1e-15 && b.abs() < 1.0, "{a} {b}");
    }

    /// Of a function whose coefficients in Chebyshev's basis fall to half from one to the next.
    fn check_what_is_left_out<const N: usize>() {
        let degree = N - 1;
        let curve = |x: f64| {
            let angle = (2.0 * x - 1.0).acos();
            let term = |m: usize| 0.5_f64.powi(m as i32) * ((degree + m) as f64 * angle).cos();
            (1..=degree).map(term).sum::<f64>()
        };
        let basis = Basis::<N>::new();
        let values: [[f64; 1]; N] = std::array::from_fn(|k| [curve(place::<N>(k))]);
        let coefficients = basis.coefficients(&values);
        let tails: f64 = basis.tails(&values).iter().map(|[tail]| tail.abs()).sum();
        let mut closest = 0.0_f64;
        for step in 1..1000 {
            let x = f64::from(step) / 1000.0;
            let sum = |c: &dyn Fn(usize) -> f64| -> f64 {
                (0..N).map(|i| c(i) * bernstein(degree, i, x)).sum()
            };
            let left_out = (curve(x) - sum(&|i| coefficients[i][0])).abs();
            closest = closest.max(left_out / (tails * sum(&|i| share_left_out(degree, i))));
        }
        // It is a bound, and not far from what it bounds.
        assert!(closest < 1.0 && closest > 0.7, "{closest}");
    }

    #[test]
    fn what_is_left_out_vanishes_at_the_ends() {
        check_what_is_left_out::<COARSE>();
        check_what_is_left_out::<FINE>();
    }
}
