use nboom_dynamics::Recursive;
use nboom_formulation::{Forces, Recognised, RightSideLayout};
use nboom_scalar::{Batch, Eight, Numbers, RoutineOn};

use crate::code::fit::{Fit, Repertoire};

/// A generated right side fitted to a scene in one mode: the rates of change of attitude, ω, β and τ in
/// one call, on numbers `N` of one state or of several side by side.
#[derive(Clone, Debug)]
pub(crate) struct RightSide<N> {
    routine: RoutineOn<N>,
    constants: Vec<N>,
    /// For each free hinge, the routine's.
    hinges: Vec<usize>,
    /// Whether these are the same, in the same order.
    are_same: bool,
    /// Hinges of the routine.
    all_hinges: usize,
    coordinates: Vec<N>,
    rates: Vec<N>,
}

/// The right side of a mode, on one state and, where there is such code, on eight.
pub(crate) struct RightSides {
    fit: Fit,
    pub of_one: RightSide<f64>,
    of_eight: Option<RightSide<Eight>>,
    /// Whether the numbers for eight states are those of the fit; not all integrators ask for them.
    eight_are_prepared: bool,
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
        let of_eight = batches.iter().find(|batch| batch.is_of_same_routine(&fit.kernel));
        let mut sides = Self {
            of_eight: of_eight.map(|batch| RightSide::new(*batch, &fit)),
            of_one: RightSide::new(fit.kernel, &fit),
            eight_are_prepared: false,
            fit,
        };
        sides.prepare(recognised);
        Some(sides)
    }

    /// Takes the numbers of another satellite in the same mode, if the same routines are the best there.
    pub fn renew(
        &mut self,
        dynamics: &Recursive<f64>,
        recognised: &Recognised,
        repertoire: &mut Repertoire,
    ) -> bool {
        let forces = Forces::of(dynamics.elements(), dynamics.tree(), recognised);
        let is_same = forces
            .is_some_and(|forces| repertoire.renew_right_side(&mut self.fit, recognised, &forces));
        if is_same {
            self.prepare(recognised);
        }
        is_same
    }

    /// Takes the numbers of the fit to a mode whose tree was `recognised`.
    fn prepare(&mut self, recognised: &Recognised) {
        let Self { fit, of_one, of_eight, eight_are_prepared } = self;
        fit.write_constants(&mut of_one.constants);
        of_one.place(recognised, fit);
        if let Some(of_eight) = of_eight {
            of_eight.place(recognised, fit);
        }
        *eight_are_prepared = false;
    }

    /// Whether there is code for eight states.
    pub fn takes_eight(&self) -> bool {
        self.of_eight.is_some()
    }

    /// That on eight states, if there is one.
    pub fn of_eight(&mut self) -> Option<&mut RightSide<Eight>> {
        let Self { of_one, of_eight, eight_are_prepared, .. } = self;
        let of_eight = of_eight.as_mut()?;
        if !*eight_are_prepared {
            let numbers = of_eight.constants.iter_mut().zip(&of_one.constants);
            numbers.for_each(|(eight, &one)| *eight = Eight::splat(one));
            *eight_are_prepared = true;
        }
        Some(of_eight)
    }
}

impl<N: Numbers> RightSide<N> {
    /// With room for the numbers of a mode.
    fn new(routine: RoutineOn<N>, fit: &Fit) -> Self {
        let zeros = |count| vec![N::splat(0.0); count];
        let hinges = fit.embedding.hinges().to_vec();
        let all_hinges = fit.embedding.outer().hinges();
        Self {
            constants: zeros(routine.constants),
            hinges,
            are_same: false,
            all_hinges,
            coordinates: zeros(routine.coordinates),
            rates: zeros(routine.outputs),
            routine,
        }
    }

    /// Notes where the numbers of each link stand.
    fn place(&mut self, recognised: &Recognised, fit: &Fit) {
        for (&link, &hinge) in recognised.links.iter().zip(fit.embedding.hinges()) {
            self.hinges[link] = hinge;
        }
        self.are_same = self.hinges.iter().copied().eq(0..self.all_hinges);
    }

    /// Writes the rates of attitude, ω, β and τ at `y`, which begins with these, to the beginning of
    /// `dy`, and anything to the rest; returns the power of the parts of the hinge torques that depend on
    /// rates.
    pub fn write(&mut self, y: &[N], dy: &mut [N]) -> N {
        let Self { routine, constants, hinges, are_same, all_hinges, coordinates, rates } = self;
        let first = RightSideLayout::STATE;
        let power = first + 2 * *all_hinges;
        if *are_same {
            if let Some(dy) = dy.get_mut(..=power) {
                // What belongs in the place of the power is not written yet.
                routine.evaluate(constants, &y[..power], dy);
                return dy[power];
            }
            routine.evaluate(constants, &y[..power], rates);
            dy.copy_from_slice(&rates[..power]);
            return rates[power];
        }
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
