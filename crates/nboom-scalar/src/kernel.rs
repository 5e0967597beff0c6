use crate::code::Code;
use crate::compiled::{Compiled, OneState, Portable};
use crate::{InstructionSet, Routine};

/// What a routine runs on: a number of one state, or of several side by side.
pub trait Numbers: Copy + PartialEq {
    /// The routine in its forms.
    type Forms<T: Routine>: Compiled<Number = Self>;

    /// One number in every state.
    fn splat(value: f64) -> Self;

    /// Whether it is a finite number in every state.
    fn is_finite(&self) -> bool;

    /// [`Routine::prepare`] of every state.
    fn prepare<T: Routine>(parameters: &[Self], constants: &mut [Self]);
}

impl Numbers for f64 {
    type Forms<T: Routine> = OneState<T>;

    fn splat(value: f64) -> Self {
        value
    }

    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }

    fn prepare<T: Routine>(parameters: &[Self], constants: &mut [Self]) {
        T::prepare_for_one(parameters, constants);
    }
}

/// A routine on one state.
pub type Kernel = RoutineOn<f64>;

/// A routine on numbers `N`, in the form that is fastest on this processor: a [`Kernel`] or a
/// [`Batch`](crate::Batch).
#[derive(Clone, Copy, Debug)]
pub struct RoutineOn<N> {
    /// What an evaluation writes: `accelerations`, `equations`, `inverse_dynamics`, `right_side` or `stresses`.
    pub result: &'static str,
    /// Topology, for example `S2_P`.
    pub topology: &'static str,
    /// Formulation, for example `articulated`; none of stresses.
    pub formulation: &'static str,
    /// What the routine assumes: parameter numbers and their values.
    pub assumptions: &'static [(usize, f64)],
    /// Whether an external wrench on the main body is taken into account.
    pub external: bool,
    /// How many numbers describe a satellite.
    pub parameters: usize,
    /// How many prepared constants there are.
    pub constants: usize,
    /// How many numbers describe a state.
    pub coordinates: usize,
    /// How many numbers an evaluation writes.
    pub outputs: usize,
    /// Whether one state by itself fills registers, equal appendages side by side.
    pub in_packs: bool,
    /// Instruction set in use: `avx512`, `avx2` or `portable`.
    pub instructions: &'static str,
    pub(crate) code: Code<N>,
}

impl<N: Numbers> RoutineOn<N> {
    /// The routine `T` on this processor.
    pub fn of<T: Routine>() -> Self {
        Self::with::<T>(InstructionSet::of_this_processor())
            .expect("the processor has what it is found to have")
    }

    /// The routine `T` in code for an instruction set, if this processor has it.
    pub fn with<T: Routine>(instructions: InstructionSet) -> Option<Self> {
        Some(Self {
            result: T::RESULT,
            topology: T::TOPOLOGY,
            formulation: T::FORMULATION,
            assumptions: T::ASSUMPTIONS,
            external: T::EXTERNAL,
            parameters: T::PARAMETERS,
            constants: T::CONSTANTS,
            coordinates: T::COORDINATES,
            outputs: T::OUTPUTS,
            in_packs: T::IN_PACKS,
            instructions: instructions.name(),
            code: Code::of::<T>(instructions)?,
        })
    }

    /// Whether both are forms of one generated routine, or of routines that differ in their name alone.
    pub fn is_of_same_routine<M>(&self, other: &RoutineOn<M>) -> bool {
        let what = [self.result, self.topology, self.formulation];
        let sizes = [self.parameters, self.constants, self.coordinates, self.outputs];
        // Forms of one routine mostly have these at one place, and there are hundreds.
        let assume_alike = std::ptr::eq(self.assumptions, other.assumptions)
            || self.assumptions == other.assumptions;
        sizes == [other.parameters, other.constants, other.coordinates, other.outputs]
            && self.external == other.external
            && assume_alike
            && what == [other.result, other.topology, other.formulation]
    }

    /// Whether these parameters are finite numbers, and those that the routine assumes.
    pub fn accepts(&self, parameters: &[N]) -> bool {
        parameters.len() == self.parameters
            && self.assumptions.iter().all(|&(i, value)| parameters[i] == N::splat(value))
            && parameters.iter().all(|parameter| parameter.is_finite())
    }

    /// Computes the constants that depend on parameters alone.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn prepare(&self, parameters: &[N], constants: &mut [N]) {
        self.code.prepare(parameters, constants);
    }

    /// Computes what the routine is for.
    ///
    /// # Panics
    /// When a slice does not have the length given above.
    pub fn evaluate(&self, constants: &[N], coordinates: &[N], outputs: &mut [N]) {
        self.code.evaluate(constants, coordinates, outputs);
    }
}
