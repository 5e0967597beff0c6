use nboom_scalar::{Eight, Work, vectorised};

use crate::Window;

/// Errors of the end of a step, by the last two Legendre coefficients of h u̇.
///
/// The end errs by about the square of the polynomial's error. The last coefficient tells that but
/// where it happens to vanish: coefficients fall by about seven from one to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndErrors<'a> {
    /// What makes these coefficients of K.
    pub last_terms: &'a [Eight; 2],
    /// K.
    pub slopes: &'a [Eight],
    /// The step, which knows the variables and their natural sizes.
    pub window: &'a Window,
    /// One over the error allowed.
    pub per_tolerance: &'a [f64],
}

impl EndErrors<'_> {
    /// Of an evaluated variable, in units of the tolerance.
    #[inline(always)]
    pub fn of(&self, i: usize) -> f64 {
        let [last, before] = self.last_terms;
        let (last, before) = (last.dot(&self.slopes[i]), before.dot(&self.slopes[i]));
        let square = last * last + before * before / (FALL * FALL);
        let magnitude = self.window.sizes[i] + self.window.state[i].abs();
        square * self.per_tolerance[i] / (SHARE * magnitude)
    }

    /// The sum over these variables.
    pub fn sum(&self, variables: &[usize]) -> f64 {
        let mut sum = 0.0;
        vectorised(Sum { errors: self, variables, sum: &mut sum });
        sum
    }
}

struct Sum<'a> {
    errors: &'a EndErrors<'a>,
    variables: &'a [usize],
    sum: &'a mut f64,
}

impl Work for Sum<'_> {
    #[inline(always)]
    fn carry_out(self) {
        for &i in self.variables {
            *self.sum += self.errors.of(i);
        }
    }
}

const FALL: f64 = 7.0;
/// Set by trials, so that errors inside steps are within about ten tolerances.
const SHARE: f64 = 0.0065;
