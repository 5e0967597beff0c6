use nboom_scalar::{Eight, EightNumbers, WorkOnEight, in_registers};

use crate::System;

/// States side by side and their derivatives: for each variable one number of each state.
#[derive(Clone, Debug, Default)]
pub(crate) struct SideBySide {
    /// The states.
    pub values: Vec<Eight>,
    /// f at the values, but of [integrals](System::rate_of).
    pub derivatives: Vec<Eight>,
    /// One state and its derivative, for systems that take one at a time.
    pub argument: Vec<f64>,
    pub derivative: Vec<f64>,
}

impl SideBySide {
    pub fn resize(&mut self, size: usize) {
        for buffer in [&mut self.values, &mut self.derivatives] {
            buffer.clear();
            buffer.resize(size, Eight::default());
        }
        for buffer in [&mut self.argument, &mut self.derivative] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
    }

    /// Evaluates the derivatives of the first `count` states, which are at `times`; what the others hold
    /// is evaluated with them where the system takes eight at once.
    pub fn evaluate(&mut self, system: &mut dyn System, times: &Eight, count: usize) {
        let Self { values, derivatives, argument, derivative } = self;
        if system.derivatives(times, values, derivatives) {
            return;
        }
        for (lane, &time) in times.0[..count].iter().enumerate() {
            for (one, of_all) in argument.iter_mut().zip(&*values) {
                *one = of_all.0[lane];
            }
            system.derivative(time, argument, derivative);
            for (of_all, one) in derivatives.iter_mut().zip(&*derivative) {
                of_all.0[lane] = *one;
            }
        }
    }
}

/// How variables follow from derivatives.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables {
    /// Those whose derivatives are evaluated.
    pub evaluated: Vec<usize>,
    /// Those whose derivative is such a variable, each with that.
    pub integrals: Vec<(usize, usize)>,
    /// For each evaluated variable its integral, if there is one.
    pub integral_of: Vec<Option<usize>>,
    /// Further ones whose derivatives are evaluated, on which nothing depends.
    pub quadratures: Vec<usize>,
}

impl Variables {
    /// Of `size` variables, of which those after the first `dependent` ones are quadratures.
    pub fn assign(&mut self, system: &dyn System, size: usize, dependent: usize) {
        let Self { evaluated, integrals, quadratures, .. } = self;
        evaluated.clear();
        integrals.clear();
        quadratures.clear();
        for i in 0..size {
            match system.rate_of(i) {
                Some(rate) => integrals.push((i, rate)),
                None if i < dependent => evaluated.push(i),
                None => quadratures.push(i),
            }
        }
        debug_assert!(integrals.iter().all(|(_, rate)| evaluated.contains(rate)));
        self.integral_of.clear();
        self.integral_of.resize(self.evaluated.len(), None);
        for &(i, rate) in &self.integrals {
            if let Ok(at) = self.evaluated.binary_search(&rate) {
                debug_assert_eq!(self.integral_of[at], None, "two integrals of one variable");
                self.integral_of[at] = Some(i);
            }
        }
    }
}

/// A matrix with a row for each stage, by its columns, so that a product goes over all rows at once.
pub(crate) type Columns<const N: usize> = [Eight; N];

/// The columns of a matrix in registers.
#[inline(always)]
pub(crate) fn load<R: EightNumbers, const N: usize>(columns: &Columns<N>) -> [R; N] {
    std::array::from_fn(|j| R::load(&columns[j]))
}

/// The product of a matrix and a vector.
#[inline(always)]
pub(crate) fn product<R: EightNumbers, const N: usize>(columns: &[R; N], x: &[f64; N]) -> R {
    let mut sum = R::zero();
    for j in 0..N {
        sum = columns[j].mul_add(R::constant(x[j]), sum);
    }
    sum
}

/// Writes the products of a matrix and each of these vectors.
pub(crate) fn multiply(matrix: &Columns<8>, vectors: &[Eight], products: &mut [Eight]) {
    in_registers(Multiply { matrix, vectors, products });
}

struct Multiply<'a> {
    matrix: &'a Columns<8>,
    vectors: &'a [Eight],
    products: &'a mut [Eight],
}

impl WorkOnEight for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let matrix = load::<R, 8>(self.matrix);
        for (found, vector) in self.products.iter_mut().zip(self.vectors) {
            product(&matrix, &vector.0).store(found);
        }
    }
}
