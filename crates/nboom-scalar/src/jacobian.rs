use std::marker::PhantomData;
use std::ops::Range;

use crate::{Dual, Eight, EightNumbers, Routine, WorkOnEight, in_vector_registers};

/// Directions of differentiation that one evaluation takes at once.
const DIRECTIONS: usize = 8;

/// Evaluates a routine with the exact derivatives of its outputs with respect to some of its coordinates,
/// torques among them, at constant parameters.
///
/// Writes the outputs to `outputs`, and to `derivatives` for each output a row with one entry for each of
/// the coordinates `by`. An evaluation on dual numbers takes eight coordinates at once, in the vector
/// registers of this processor, or one where it has none.
///
/// # Panics
/// When `constants`, `coordinates` or `outputs` are not as many as the routine's, when `by` is beyond the
/// coordinates, or when `derivatives` has no room for each output and coordinate.
///
/// ```
/// use nboom_scalar::{Isa, Real, Routine, jacobian};
/// struct Pendulum;
/// impl Routine for Pendulum {
/// #   const RESULT: &'static str = "accelerations";
/// #   const TOPOLOGY: &'static str = "S1";
/// #   const FORMULATION: &'static str = "articulated";
/// #   const ASSUMPTIONS: &'static [(usize, f64)] = &[];
/// #   const EXTERNAL: bool = false;
///     const PARAMETERS: usize = 1;
///     const CONSTANTS: usize = 1;
///     const COORDINATES: usize = 2;
///     const OUTPUTS: usize = 1;
/// #   fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) { constants.copy_from_slice(parameters); }
///     fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
///         out[0] = x[1] - k[0] * x[0].sin_cos().0;
///     }
/// #   fn evaluate_packed<I: Isa>(k: &[f64], x: &[f64], out: &mut [f64]) { Self::evaluate::<f64>(k, x, out); }
/// }
/// let (mut acceleration, mut derivatives) = ([0.0], [0.0; 2]);
/// jacobian::<Pendulum>(&[9.81], &[0.5, 0.1], 0..2, &mut acceleration, &mut derivatives);
/// assert!((derivatives[0] + 9.81 * 0.5_f64.cos()).abs() < 1e-14);
/// assert_eq!(derivatives[1], 1.0);
/// ```
pub fn jacobian<T: Routine>(
    constants: &[f64],
    coordinates: &[f64],
    by: Range<usize>,
    outputs: &mut [f64],
    derivatives: &mut [f64],
) {
    assert!(by.end <= coordinates.len(), "derivatives are by coordinates");
    assert!(derivatives.len() == outputs.len() * by.len(), "room for each derivative");
    let directions =
        Directions::<T> { constants, coordinates, by, outputs, derivatives, of: PhantomData };
    in_vector_registers(directions).unwrap_or_else(Directions::one_by_one);
}

/// All directions, as many at once as registers hold.
struct Directions<'a, T> {
    constants: &'a [f64],
    coordinates: &'a [f64],
    by: Range<usize>,
    outputs: &'a mut [f64],
    derivatives: &'a mut [f64],
    of: PhantomData<T>,
}

impl<T: Routine> Directions<'_, T> {
    /// Without vector registers code for eight would be eight times as long.
    fn one_by_one(self) {
        let Self { constants, coordinates, by, outputs, derivatives, .. } = self;
        T::evaluate(constants, coordinates, outputs);
        let known = |&value: &f64| Dual::constant(value);
        let constants: Vec<Dual<f64>> = constants.iter().map(known).collect();
        let mut point: Vec<Dual<f64>> = coordinates.iter().map(known).collect();
        let mut found = vec![Dual::constant(0.0); outputs.len()];
        for (column, i) in by.clone().enumerate() {
            point[i].derivative = 1.0;
            T::evaluate(&constants, &point, &mut found);
            point[i].derivative = 0.0;
            for (row, of_output) in found.iter().enumerate() {
                derivatives[row * by.len() + column] = of_output.derivative;
            }
        }
    }
}

impl<T: Routine> WorkOnEight for Directions<'_, T> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { constants, coordinates, by, outputs, derivatives, .. } = self;
        let known = |&value: &f64| Dual::constant(R::constant(value));
        let constants: Vec<Dual<R>> = constants.iter().map(known).collect();
        let mut point: Vec<Dual<R>> = coordinates.iter().map(known).collect();
        let mut found = vec![Dual::constant(R::zero()); outputs.len()];
        // Without any direction the outputs are wanted all the same.
        for first in by.clone().step_by(DIRECTIONS).chain(by.is_empty().then_some(by.start)) {
            let directions = first..by.end.min(first + DIRECTIONS);
            for (lane, i) in directions.clone().enumerate() {
                let mut along = Eight::splat(0.0);
                along.0[lane] = 1.0;
                point[i].derivative = R::load(&along);
            }
            T::evaluate(&constants, &point, &mut found);
            for i in directions.clone() {
                point[i].derivative = R::zero();
            }
            for (row, of_output) in found.iter().enumerate() {
                let [mut value, mut derivative] = [Eight::splat(0.0); 2];
                of_output.value.store(&mut value);
                of_output.derivative.store(&mut derivative);
                outputs[row] = value.0[0];
                let start = row * by.len() + (first - by.start);
                derivatives[start..start + directions.len()]
                    .copy_from_slice(&derivative.0[..directions.len()]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Isa, Real};

    /// x² y, x / y and k x.
    struct Three;

    impl Routine for Three {
        const RESULT: &'static str = "accelerations";
        const TOPOLOGY: &'static str = "M";
        const FORMULATION: &'static str = "articulated";
        const ASSUMPTIONS: &'static [(usize, f64)] = &[];
        const EXTERNAL: bool = false;
        const PARAMETERS: usize = 1;
        const CONSTANTS: usize = 1;
        const COORDINATES: usize = 2;
        const OUTPUTS: usize = 3;

        fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
            constants.copy_from_slice(parameters);
        }

        fn evaluate<R: Real>(k: &[R], x: &[R], out: &mut [R]) {
            out.copy_from_slice(&[x[0] * x[0] * x[1], x[0] / x[1], k[0] * x[0]]);
        }

        fn evaluate_packed<I: Isa>(k: &[f64], x: &[f64], out: &mut [f64]) {
            Self::evaluate(k, x, out);
        }
    }

    #[test]
    fn one_direction_after_the_other_gives_the_same() {
        for by in [0..0, 0..1, 1..2, 0..2] {
            let (mut outputs, mut derivatives) = ([0.0; 3], vec![0.0; 3 * by.len()]);
            Directions::<Three> {
                constants: &[0.5],
                coordinates: &[3.0, 2.0],
                by: by.clone(),
                outputs: &mut outputs,
                derivatives: &mut derivatives,
                of: PhantomData,
            }
            .one_by_one();
            assert_eq!(outputs, [18.0, 1.5, 1.5]);
            let all = [[12.0, 9.0], [0.5, -0.75], [0.5, 0.0]];
            let expected: Vec<f64> = all.iter().flat_map(|row| row[by.clone()].to_vec()).collect();
            assert_eq!(derivatives, expected);
            let mut at_once = vec![0.0; 3 * by.len()];
            jacobian::<Three>(&[0.5], &[3.0, 2.0], by, &mut outputs, &mut at_once);
            assert_eq!((outputs, at_once), ([18.0, 1.5, 1.5], expected));
        }
    }
}
