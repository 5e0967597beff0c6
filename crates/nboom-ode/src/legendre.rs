//! Legendre polynomials.

/// P₀, P₁, … at x.
#[inline(always)]
pub(crate) fn legendre<const N: usize>(x: f64) -> [f64; N] {
    let mut values = [1.0; N];
    values[1] = x;
    for k in 1..N - 1 {
        let n = k as f64;
        values[k + 1] = ((2.0 * n + 1.0) * x * values[k] - n * values[k - 1]) / (n + 1.0);
    }
    values
}

/// Bernstein coefficients of P_k(2x − 1), as a polynomial of degree N − 1, which k does not exceed.
pub(crate) fn bernstein_of_legendre<const N: usize>(k: usize) -> [f64; N] {
    let mut found = [0.0; N];
    let mut coefficient = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    // (−1)^(k−i) C(k, i) of degree k.
    for i in 0..=k {
        found[i] = coefficient;
        coefficient *= -((k - i) as f64) / (i + 1) as f64;
    }
    for degree in k + 1..N {
        for i in (1..=degree).rev() {
            let share = i as f64 / degree as f64;
            found[i] = share * found[i - 1] + (1.0 - share) * found[i];
        }
    }
    found
}
