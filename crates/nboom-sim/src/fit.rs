use std::cmp::Reverse;

use nboom_formulation::{Embedding, Formulation, Layout, Recognised};
use nboom_model::Topology;
use nboom_scalar::Kernel;

use crate::options::Options;

/// A generated routine that computes the accelerations of a mode, and how the mode is embedded in
/// the routine's topology.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The routine.
    pub kernel: Kernel,
    /// The mode's topology in the routine's.
    pub embedding: Embedding,
    /// The numbers of the satellite that the routine prepares, [`Kernel::parameters`] of them.
    pub parameters: Vec<f64>,
}

/// A larger routine is taken if it has at most this many steps for each of the mode's hinges: the
/// recursion takes about 110 ns for a hinge, routines at most 55 ns for a step
/// (`benches/README.md`).
const STEPS_OF_A_HINGE: usize = 2;

/// Links that the sweeps of a routine take one after the other: equal appendages go side by side,
/// in packs of eight, four, two and one.
fn steps(topology: &Topology) -> usize {
    let packs = |count: usize| count / 8 + (count % 8).count_ones() as usize;
    topology.groups().into_iter().map(|(shape, count)| shape.hinges() * packs(count)).sum()
}

impl Fit {
    /// The routine that a run takes for a mode in which something acts on the main body from
    /// outside or nothing does (`external`): of those that `options` allow and that compute what
    /// is wanted, the one with fewest steps; then the one with fewest virtual links, then one of
    /// `articulated`, then the most specialised. `None` if there is none.
    pub fn best(recognised: &Recognised, external: bool, options: &Options) -> Option<Self> {
        let allowed = |kernel: &&Kernel| {
            options.formulation.is_none_or(|form| kernel.formulation == form.name())
                && (kernel.external || !external)
        };
        let kernels = options.kernels.iter().filter(allowed);
        kernels.filter_map(|kernel| Self::of(kernel, recognised)).max_by_key(Self::preference)
    }

    fn of(kernel: &Kernel, recognised: &Recognised) -> Option<Self> {
        let (inner, outer) = (&recognised.topology, kernel.topology.parse::<Topology>().ok()?);
        let may_embed = kernel.formulation == Formulation::Articulated.name()
            && steps(&outer) <= STEPS_OF_A_HINGE * inner.hinges();
        if *inner != outer && !may_embed {
            return None;
        }
        let embedding = Embedding::new(inner, &outer)?;
        let parameters = embedding.parameters(&recognised.parameters, kernel.pinned);
        let fit = Self { kernel: *kernel, embedding, parameters };
        kernel.accepts(&fit.parameters).then_some(fit)
    }

    fn preference(&self) -> (Reverse<usize>, Reverse<usize>, bool, usize) {
        let Kernel { formulation, pinned, .. } = self.kernel;
        let articulated = formulation == Formulation::Articulated.name();
        (
            Reverse(steps(self.embedding.outer())),
            Reverse(self.embedding.virtual_links()),
            articulated,
            pinned.len(),
        )
    }

    /// What the routine prepares of the satellite, [`Kernel::constants`] numbers.
    pub fn constants(&self) -> Vec<f64> {
        let mut constants = vec![0.0; self.kernel.constants];
        self.kernel.prepare(&self.parameters, &mut constants);
        constants
    }

    /// For each hinge of the mode's topology, where β, τ and torque stand in the routine's
    /// coordinates and τ̇ in its outputs. All else that belongs to hinges stays zero.
    pub fn hinges(&self) -> impl Iterator<Item = ([usize; 3], usize)> {
        let outer = self.embedding.outer();
        let places = self.embedding.places().iter();
        places.map(|&place| (Layout::hinge_in_state(outer, place), Layout::OUTPUT + place))
    }

    /// Why this code runs, for example
    /// `routine for 4xS5, 1 of 20 links virtual, avx512 code`.
    pub fn reason(&self) -> String {
        let Kernel { topology, instructions, .. } = self.kernel;
        let links = self.embedding.outer().hinges();
        match self.embedding.virtual_links() {
            0 => format!("routine for {topology}, {instructions} code"),
            n => {
                format!("routine for {topology}, {n} of {links} links virtual, {instructions} code")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_appendages_share_steps() {
        let steps_of = |name: &str| steps(&name.parse().expect("a topology"));
        let names = ["M", "S5", "S2_P", "4xS5", "3xS5_S4", "20xS5"];
        assert_eq!(names.map(steps_of), [0, 5, 4, 5, 14, 15]);
    }
}
