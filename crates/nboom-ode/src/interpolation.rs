use crate::bernstein::Bernstein;

/// Degree of the polynomials through given values.
const DEGREE: usize = 7;

/// The polynomial of degree 7 through values at eight fixed points of [0, 1].
#[derive(Clone, Debug)]
pub struct Interpolation {
    points: [f64; DEGREE + 1],
    from_values: [[f64; DEGREE + 1]; DEGREE + 1],
}

impl Interpolation {
    /// Prepares the interpolation.
    pub fn new() -> Self {
        let angle = |i: usize| std::f64::consts::PI * i as f64 / DEGREE as f64;
        let points = std::array::from_fn(|i| 0.5 - 0.5 * angle(i).cos());
        Self { points, from_values: inverse(points.map(basis_at)) }
    }

    /// Where values are needed: Chebyshev points with both ends.
    pub fn points(&self) -> [f64; DEGREE + 1] {
        self.points
    }

    /// The polynomial with these values at the points.
    pub fn through(&self, values: &[f64; DEGREE + 1]) -> Bernstein {
        let dot = |row: &[f64; DEGREE + 1]| row.iter().zip(values).map(|(a, v)| a * v).sum();
        let coefficients: [f64; DEGREE + 1] = std::array::from_fn(|j| dot(&self.from_values[j]));
        Bernstein::new(&coefficients)
    }
}

impl Default for Interpolation {
    fn default() -> Self {
        Self::new()
    }
}

fn basis_at(x: f64) -> [f64; DEGREE + 1] {
    let mut values = [0.0; DEGREE + 1];
    values[0] = 1.0;
    for degree in 1..=DEGREE {
        for j in (0..=degree).rev() {
            let from_left = if j > 0 { values[j - 1] * x } else { 0.0 };
            values[j] = values[j] * (1.0 - x) + from_left;
        }
    }
    values
}

/// Gauss-Jordan; the basis at distinct points is regular and totally positive, so pivots in
/// order are safe.
fn inverse(mut m: [[f64; DEGREE + 1]; DEGREE + 1]) -> [[f64; DEGREE + 1]; DEGREE + 1] {
    let mut inverse = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j)));
    for p in 0..=DEGREE {
        let pivot = m[p][p];
        for j in 0..=DEGREE {
            m[p][j] /= pivot;
            inverse[p][j] /= pivot;
        }
        let (pivot_row, inverse_row) = (m[p], inverse[p]);
        for i in (0..=DEGREE).filter(|&i| i != p) {
            let factor = m[i][p];
            for j in 0..=DEGREE {
                m[i][j] -= factor * pivot_row[j];
                inverse[i][j] -= factor * inverse_row[j];
            }
        }
    }
    inverse
}
