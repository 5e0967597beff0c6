//! What follows from the stages of steps that were taken side by side.

use nboom_scalar::{Eight, EightNumbers, WorkOnEight};

use super::EightSteps;
use crate::tableau::Row;

/// The weighted sum of the stages of one of `size` variables.
#[inline(always)]
pub(super) fn sum_of<R: EightNumbers>(
    stages: &[R],
    weights: Row,
    size: usize,
    variable: usize,
) -> R {
    let add = |sum, &(stage, weight): &(usize, f64)| {
        stages[stage * size + variable].mul_add(R::constant(weight), sum)
    };
    weights.iter().fold(R::zero(), add)
}

/// Estimated errors of the steps that were taken, and sums of squares.
pub(super) struct Estimates<'a>(pub &'a mut EightSteps);

impl WorkOnEight for Estimates<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let EightSteps { tableau, tolerance, size, controlled, stages, start, end, .. } = self.0;
        let EightSteps { sizes, before_end, errors, squares, .. } = self.0;
        let (stages, sizes): (&[R], &[R]) = (R::all(stages), R::all(sizes));
        let errors = R::all_mut(errors);
        for (i, error) in errors.iter_mut().enumerate() {
            *error = sum_of(stages, tableau.error, *size, i);
        }
        let [last, before_last] =
            [0, 1].map(|before| &stages[(tableau.stages - before) * *size..][..*size]);
        let [absolute, relative] = [tolerance.absolute, tolerance.relative].map(R::constant);
        let mut found = [R::zero(); 4];
        for i in 0..*controlled {
            let value = R::load(&larger(&start[i], &end[i]));
            let per_allowed = R::one() / (absolute * sizes[i] + relative * value);
            let per_size = R::one() / sizes[i];
            let lower = sum_of(stages, tableau.lower_error, *size, i);
            let slopes = last[i] - before_last[i];
            let arguments = R::load(&end[i]) - R::load(&before_end[i]);
            let shares = [
                errors[i] * per_allowed,
                lower * per_allowed,
                slopes * per_size,
                arguments * per_size,
            ];
            for (sum, share) in found.iter_mut().zip(shares) {
                *sum = share.mul_add(share, *sum);
            }
        }
        for (square, found) in squares.iter_mut().zip(found) {
            found.store(square);
        }
    }
}

/// The larger size of two numbers in each lane.
#[inline(always)]
fn larger(a: &Eight, b: &Eight) -> Eight {
    let mut sizes = Eight::default();
    for (size, (a, b)) in sizes.0.iter_mut().zip(a.0.iter().zip(&b.0)) {
        let (a, b) = (a.abs(), b.abs());
        *size = if a > b { a } else { b };
    }
    sizes
}

/// Terms of dense output of the steps that were taken.
pub(super) struct Dense<'a>(pub &'a mut EightSteps);

impl WorkOnEight for Dense<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let EightSteps { tableau, size, lengths, start, stages, end, dense, .. } = self.0;
        let (length, stages, dense) = (R::load(lengths), R::all(stages), R::all_mut(dense));
        let (start, end) = (R::all(start), R::all(end));
        for (i, terms) in dense.chunks_exact_mut(3 + tableau.dense.len()).enumerate() {
            let difference = end[i] - start[i];
            let [first, last] = [0, tableau.stages].map(|stage| length * stages[stage * *size + i]);
            terms[0] = difference;
            terms[1] = first - difference;
            terms[2] = difference + difference - (first + last);
            for (term, weights) in terms[3..].iter_mut().zip(tableau.dense) {
                *term = length * sum_of(stages, weights, *size, i);
            }
        }
    }
}
