use std::sync::Arc;

use nboom_dynamics::Recursive;
use nboom_formulation::{Forces, Recognised, RightSideLayout};
use nboom_scalar::{Batch, Eight, Kernel, Numbers, RoutineOn};

use crate::code::fit::{Fit, Repertoire};

/// A generated right side fitted to a scene in one mode: the rates of change of attitude, ω, β and τ in
/// one call, on numbers `N` of one state or of several side by side.
#[derive(Clone, Debug)]
pub(crate) struct RightSide<N> {
    routine: RoutineOn<N>,
    constants: Vec<N>,
    /// For each free hinge, the routine's; none where they are the same.
    hinges: Option<Arc<[usize]>>,
    /// Hinges of the routine.
    all_hinges: usize,
    coordinates: Vec<N>,
    rates: Vec<N>,
}

/// The right side of a mode, on one state and, where there is such code, on eight.
pub(crate) struct RightSides {
    pub of_one: RightSide<f64>,
    batch: Option<Batch>,
}

impl RightSides {
    /// The best routines of `repertoire` for what acts in the mode of `dynamics`, whose tree was
    /// `recognised`. `None` if there is none.
    pub fn fit(
        dynamics: &Recursive<f64>,
        recognised: &Recognised,
        repertoire: &mut Repertoire,
        batches: &[Batch],
    ) -> Option<Self> {
        let forces = Forces::of(dynamics.elements(), dynamics.tree(), recognised)?;
        let fit = repertoire.right_side(recognised, &forces)?;
        let mut hinges = vec![0; recognised.links.len()];
        for (&link, &hinge) in recognised.links.iter().zip(fit.embedding.hinges()) {
            hinges[link] = hinge;
        }
        let batch = batches.iter().find(|batch| batch.is_of_same_routine(&fit.kernel)).copied();
        Some(Self { of_one: RightSide::new(fit.kernel, &fit, &hinges), batch })
    }

    /// Whether there is code for eight states.
    pub fn take_eight(&self) -> bool {
        self.batch.is_some()
    }

    /// The right side on eight states of the scene, if there is such code.
    pub fn of_eight(&self) -> Option<RightSide<Eight>> {
        self.batch.map(|batch| self.of_one.on(batch))
    }

    /// Whether `eight` is for any scenes with the right side of this one.
    pub fn are_in(&self, eight: &RightSide<Eight>) -> bool {
        let Self { of_one, batch } = self;
        batch.is_some_and(|batch| batch.is_of_same_routine(&eight.routine))
            && of_one.hinges == eight.hinges
    }

    /// Makes a lane of `eight`, which they [are in](Self::are_in), that of their scene.
    pub fn write_to(&self, lane: usize, eight: &mut RightSide<Eight>) {
        for (numbers, &of_one) in eight.constants.iter_mut().zip(&self.of_one.constants) {
            numbers.0[lane] = of_one;
        }
    }
}

impl RightSide<f64> {
    fn new(routine: Kernel, fit: &Fit, hinges: &[usize]) -> Self {
        let all_hinges = fit.embedding.outer().hinges();
        let differ = !hinges.iter().copied().eq(0..all_hinges);
        Self {
            constants: fit.constants(),
            hinges: differ.then(|| hinges.into()),
            all_hinges,
            coordinates: vec![0.0; routine.coordinates],
            rates: vec![0.0; routine.outputs],
            routine,
        }
    }

    /// The same on eight states.
    fn on(&self, batch: Batch) -> RightSide<Eight> {
        let zeros = |count| vec![Eight::default(); count];
        RightSide {
            constants: self.constants.iter().copied().map(Eight::splat).collect(),
            hinges: self.hinges.clone(),
            all_hinges: self.all_hinges,
            coordinates: zeros(batch.coordinates),
            rates: zeros(batch.outputs),
            routine: batch,
        }
    }
}

impl RightSide<Eight> {
    /// Makes the lanes from this one on those of the first scene.
    pub fn repeat_first_from(&mut self, lane: usize) {
        for numbers in &mut self.constants {
            let first = numbers.0[0];
            numbers.0[lane..].fill(first);
        }
    }
}

impl<N: Numbers> RightSide<N> {
    /// Writes the rates of attitude, ω, β and τ at `y`, which begins with these, to the beginning of
    /// `dy`, and anything to the rest; returns the power of the parts of the hinge torques that depend on
    /// rates.
    pub fn write(&mut self, y: &[N], dy: &mut [N]) -> N {
        let Self { routine, constants, hinges, all_hinges, coordinates, rates } = self;
        let first = RightSideLayout::STATE;
        let power = first + 2 * *all_hinges;
        let Some(hinges) = hinges else {
            if let Some(dy) = dy.get_mut(..=power) {
                // What belongs in the place of the power is not written yet.
                routine.evaluate(constants, &y[..power], dy);
                return dy[power];
            }
            routine.evaluate(constants, &y[..power], rates);
            dy.copy_from_slice(&rates[..power]);
            return rates[power];
        };
        let end = first + 2 * hinges.len();
        coordinates[..first].copy_from_slice(&y[..first]);
        let (of_beta, of_tau) = y[first..end].split_at(hinges.len());
        for (&hinge, (beta, tau)) in hinges.iter().zip(of_beta.iter().zip(of_tau)) {
            coordinates[first + hinge] = *beta;
            coordinates[first + *all_hinges + hinge] = *tau;
        }
        routine.evaluate(constants, coordinates, rates);
        dy[..first].copy_from_slice(&rates[..first]);
        let (of_beta, of_tau) = dy[first..end].split_at_mut(hinges.len());
        for (&hinge, (beta, tau)) in hinges.iter().zip(of_beta.iter_mut().zip(of_tau)) {
            *beta = rates[first + hinge];
            *tau = rates[first + *all_hinges + hinge];
        }
        rates[power]
    }
}
