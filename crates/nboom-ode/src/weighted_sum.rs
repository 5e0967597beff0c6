use nboom_scalar::{Work, vectorised};

use crate::tableau::Row;

/// Sums are taken over whole numbers of this many variables, so that they stay in registers.
pub(crate) const BLOCK: usize = 8;

/// Writes `factor` times the weighted sum of stages to `out`; each stage is as long as `out`, a whole
/// number of [`BLOCK`]s.
pub(crate) fn sum_up(stages: &[f64], weights: Row, factor: f64, out: &mut [f64]) {
    vectorised(WeightedSum { stages, weights, factor, out });
}

struct WeightedSum<'a> {
    stages: &'a [f64],
    weights: Row,
    factor: f64,
    out: &'a mut [f64],
}

impl Work for WeightedSum<'_> {
    #[inline(always)]
    fn carry_out(self) {
        // Small systems are one piece, whose sums stay in registers.
        match self.out.len() {
            24 => self.in_pieces::<24>(),
            size if size % 32 == 0 => self.in_pieces::<32>(),
            size if size % 16 == 0 => self.in_pieces::<16>(),
            _ => self.in_pieces::<BLOCK>(),
        }
    }
}

impl WeightedSum<'_> {
    #[inline(always)]
    fn in_pieces<const N: usize>(self) {
        let Self { stages, weights, factor, out } = self;
        let stride = out.len();
        for (piece, out) in out.as_chunks_mut::<N>().0.iter_mut().enumerate() {
            let mut sums = [0.0; N];
            for &(j, weight) in weights {
                let of_stage = &stages[j * stride + piece * N..][..N];
                for (sum, value) in sums.iter_mut().zip(of_stage) {
                    *sum += weight * value;
                }
            }
            for (out, sum) in out.iter_mut().zip(sums) {
                *out = factor * sum;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_over_all_variables_whatever_their_number() {
        let weights: &[(usize, f64)] = &[(0, 0.3), (2, -1.7)];
        for size in (BLOCK..=12 * BLOCK).step_by(BLOCK) {
            let stages: Vec<f64> = (0..3 * size).map(|i| (i as f64).sin()).collect();
            let mut found = vec![f64::NAN; size];
            sum_up(&stages, weights, 0.7, &mut found);
            for (i, found) in found.into_iter().enumerate() {
                let expected = 0.7 * (0.3 * stages[i] - 1.7 * stages[2 * size + i]);
                // Products and sum are rounded once each.
                assert!((found - expected).abs() < 4.0 * f64::EPSILON, "{i} of {size}");
            }
        }
    }
}
