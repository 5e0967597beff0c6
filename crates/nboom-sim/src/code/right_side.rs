use nboom_dynamics::Recursive;
use nboom_formulation::{Forces, Recognised, RightSideLayout};
use nboom_model::WeldedTree;
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
    /// ω̇ of a main body that is held.
    held: Option<[N; 3]>,
}

/// The right side of a mode, on one state and, where there is such code, on eight.
pub(crate) struct RightSides {
    fit: Fit,
    /// What acts in the mode.
    forces: Forces<f64>,
    pub of_one: RightSide<f64>,
    batch: Option<Batch>,
    /// Made when an integrator asks for it.
    of_eight: Option<RightSide<Eight>>,
    /// Whether the numbers for eight states are those of the fit.
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
        let forces = Forces::of(dynamics.elements(), dynamics.tree(), recognised).ok()?;
        let fit = repertoire.right_side(recognised, &forces)?;
        let batch = batches.iter().find(|batch| batch.is_of_same_routine(&fit.kernel)).copied();
        let of_one = RightSide::new(fit.kernel, &fit);
        let mut sides =
            Self { of_one, batch, of_eight: None, eight_are_prepared: false, fit, forces };
        sides.prepare(dynamics.tree(), recognised);
        Some(sides)
    }

    /// Takes the numbers of another satellite in the same mode, if the same routines are the best there.
    pub fn renew(
        &mut self,
        dynamics: &Recursive<f64>,
        recognised: &Recognised,
        repertoire: &mut Repertoire,
    ) -> bool {
        let Self { fit, forces, .. } = self;
        let set = forces.set(dynamics.elements(), dynamics.tree(), recognised);
        let is_same = set.is_ok() && repertoire.renew_right_side(fit, recognised, forces);
        if is_same {
            self.prepare(dynamics.tree(), recognised);
        }
        is_same
    }

    /// Takes the numbers of the fit to a mode whose tree was `recognised`.
    fn prepare(&mut self, tree: &WeldedTree<f64>, recognised: &Recognised) {
        let Self { fit, of_one, eight_are_prepared, .. } = self;
        fit.write_constants(&mut of_one.constants);
        of_one.place(recognised, fit);
        of_one.held = tree.held.map(|held| held.angular.to_array());
        *eight_are_prepared = false;
    }

    /// Whether there is code for eight states.
    pub fn takes_eight(&self) -> bool {
        self.batch.is_some()
    }

    /// Whether lanes are better filled by the states of as many scenes: where there is code for them, unless that for
    /// one state fills registers with equal appendages.
    pub fn suits_lanes(&self) -> bool {
        self.takes_eight() && !self.of_one.routine.in_packs
    }

    /// That on eight states, if there is one.
    pub fn of_eight(&mut self) -> Option<&mut RightSide<Eight>> {
        let Self { fit, of_one, batch, of_eight, eight_are_prepared, .. } = self;
        let batch = (*batch)?;
        let of_eight = of_eight.get_or_insert_with(|| RightSide::new(batch, fit));
        if !*eight_are_prepared {
            of_eight.hinges.clone_from(&of_one.hinges);
            of_eight.are_same = of_one.are_same;
            of_eight.held = of_one.held.map(|omega_dot| omega_dot.map(Eight::splat));
            let numbers = of_eight.constants.iter_mut().zip(&of_one.constants);
            numbers.for_each(|(eight, &one)| *eight = Eight::splat(one));
            *eight_are_prepared = true;
        }
        Some(of_eight)
    }

    /// One on eight states of as many scenes with the right side of this one; none if there is no such code.
    pub fn of_eight_scenes(&self) -> Option<RightSide<Eight>> {
        let made = self.batch.map(|batch| RightSide::new(batch, &self.fit));
        let Self { of_one: RightSide { hinges, are_same, .. }, .. } = self;
        made.map(|made| RightSide { hinges: hinges.clone(), are_same: *are_same, ..made })
    }

    /// Whether `eight` may have a [lane](Self::write_to) for this scene.
    pub fn are_like(&self, eight: &RightSide<Eight>) -> bool {
        let is_same = |batch: &Batch| batch.is_of_same_routine(&eight.routine);
        self.of_one.hinges.iter().eq(&eight.hinges) && self.batch.as_ref().is_some_and(is_same)
    }

    /// Makes a lane of `eight`, which is [like](Self::are_like) this one, that of this scene.
    pub fn write_to(&self, lane: usize, eight: &mut RightSide<Eight>) {
        for (numbers, &of_one) in eight.constants.iter_mut().zip(&self.of_one.constants) {
            numbers.0[lane] = of_one;
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
            held: None,
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
        let power = self.write_as_computed(y, dy);
        if let Some(omega_dot) = self.held {
            dy[RightSideLayout::OMEGA].copy_from_slice(&omega_dot);
        }
        power
    }

    fn write_as_computed(&mut self, y: &[N], dy: &mut [N]) -> N {
        let Self { routine, constants, hinges, are_same, all_hinges, coordinates, rates, .. } =
            self;
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
