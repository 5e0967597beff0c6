use std::cell::RefCell;

use crate::compiled::{EightStates, Portable};
use crate::kernel::Numbers;
use crate::{Pair, Routine, RoutineOn};

/// A number of each of eight states, placed so that one load fills a register.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Eight(pub [f64; 8]);

impl Eight {
    /// One number in every state.
    pub fn splat(value: f64) -> Self {
        Self([value; 8])
    }

    /// The sum of products, halves added to halves.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> f64 {
        let products: [f64; 8] = std::array::from_fn(|i| self.0[i] * other.0[i]);
        let pairs: [f64; 4] = std::array::from_fn(|i| products[i] + products[i + 4]);
        (pairs[0] + pairs[2]) + (pairs[1] + pairs[3])
    }
}

/// Eight scalars without any vector instructions.
pub(crate) type PortableEight = Pair<Pair<Pair<f64>>>;

/// A routine on eight states of one topology at once.
///
/// The numbers of the eight states lie side by side: the first [`Eight`] of the coordinates has
/// the first coordinate of each state. Each state has parameters of its own as well. Nothing
/// goes from one state to another. Results are those of [`Kernel`](crate::Kernel) to rounding:
/// products and sums are fused wherever the processor can, and sines come from a polynomial,
/// but sums over appendages may be in another order.
pub type Batch = RoutineOn<Eight>;

impl Numbers for Eight {
    type Forms<T: Routine> = EightStates<T>;

    fn splat(value: f64) -> Self {
        Self::splat(value)
    }

    fn is_finite(&self) -> bool {
        self.0.iter().all(|number| number.is_finite())
    }

    fn prepare<T: Routine>(parameters: &[Self], constants: &mut [Self]) {
        one_by_one([parameters], constants, |[parameters], out| {
            T::prepare_for_one(parameters, out)
        });
    }
}

thread_local! {
    /// Room for the numbers of one state, so that evaluations allocate nothing.
    static ROOM: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
}

/// Computes what is found for each of eight states, one after the other.
pub(crate) fn one_by_one<const N: usize>(
    of_eight: [&[Eight]; N],
    out: &mut [Eight],
    compute: impl Fn([&[f64]; N], &mut [f64]),
) {
    ROOM.with_borrow_mut(|room| {
        let all: usize = of_eight.iter().map(|numbers| numbers.len()).sum();
        room.resize(all + out.len(), 0.0);
        let (inputs, found) = room.split_at_mut(all);
        for lane in 0..8 {
            let numbers = of_eight.iter().copied().flatten();
            inputs.iter_mut().zip(numbers).for_each(|(one, all)| *one = all.0[lane]);
            let mut rest = &*inputs;
            let of_one = of_eight.map(|numbers| {
                let (first, others) = rest.split_at(numbers.len());
                rest = others;
                first
            });
            compute(of_one, found);
            out.iter_mut().zip(&*found).for_each(|(all, one)| all.0[lane] = *one);
        }
    });
}
