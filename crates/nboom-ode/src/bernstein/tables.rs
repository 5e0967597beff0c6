use super::HIGHEST;

/// Most terms of dense output.
const TERMS: usize = 7;

/// For each number of terms, Bernstein coefficients of x, x(1−x), x²(1−x), x²(1−x)², …:
/// xᵃ(1−x)ᵇ of degree n has C(n−a−b, j−a) / C(n, j) at index j.
pub(super) const TERM_COEFFICIENTS: [[[f64; TERMS + 1]; TERMS]; TERMS + 1] = {
    let mut tables = [[[0.0; TERMS + 1]; TERMS]; TERMS + 1];
    let mut degree = 1;
    while degree <= TERMS {
        let mut term = 0;
        while term < degree {
            let (a, b) = (term / 2 + 1, term.div_ceil(2));
            let mut j = a;
            while j <= degree - b {
                tables[degree][term][j] = binomial(degree - a - b, j - a) / binomial(degree, j);
                j += 1;
            }
            term += 1;
        }
        degree += 1;
    }
    tables
};

/// C(n, k) up to the highest degree.
pub(super) const BINOMIALS: [[f64; HIGHEST + 1]; HIGHEST + 1] = {
    let mut tables = [[0.0; HIGHEST + 1]; HIGHEST + 1];
    let mut n = 0;
    while n <= HIGHEST {
        let mut k = 0;
        while k <= n {
            tables[n][k] = binomial(n, k);
            k += 1;
        }
        n += 1;
    }
    tables
};

/// C(n, k).
pub(super) const fn binomial(n: usize, k: usize) -> f64 {
    let mut value = 1.0;
    let mut i = 0;
    while i < k {
        value = value * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    value
}
