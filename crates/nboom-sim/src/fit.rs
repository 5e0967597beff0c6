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

/// About how long an evaluation of a routine takes, in nanoseconds on the machine of
/// `benches/README.md`; only comparisons matter.
///
/// Straight lines take the hinges one after the other. Loops take equal appendages side by side,
/// as many as a register holds.
fn duration(topology: &Topology, instructions: &str) -> usize {
    let groups = topology.groups();
    if topology.hinges() <= 16 && groups.iter().all(|&(_, count)| count < 4) {
        return 20 + 36 * topology.hinges();
    }
    let link = |count: usize| match instructions {
        "avx512" => 70 * (count / 8) + 50 * (count % 8 / 4 + count % 4),
        "avx2" => 60 * (count / 4) + 50 * (count % 4),
        _ => 50 * count,
    };
    let sweeps = groups.into_iter().map(|(shape, count)| shape.hinges() * link(count));
    45 + sweeps.sum::<usize>()
}

/// The same of the recursion.
fn duration_of_recursion(topology: &Topology) -> usize {
    60 + 110 * topology.hinges()
}

impl Fit {
    /// The routine that a run takes for a mode in which something acts on the main body from
    /// outside or nothing does (`external`): of those that `options` allow and that compute what
    /// is wanted, the one that is probably fastest; then the one with fewest virtual links, then
    /// one of `articulated`, then the most specialised. `None` if there is none.
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
            && duration(&outer, kernel.instructions) < duration_of_recursion(inner);
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
            Reverse(duration(self.embedding.outer(), self.kernel.instructions)),
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
    fn a_mode_is_embedded_only_where_registers_make_that_pay() {
        let of = |name: &str| name.parse::<Topology>().expect("a topology");
        let pays = |inner, outer, instructions| {
            duration(&of(outer), instructions) < duration_of_recursion(&of(inner))
        };
        for (inner, outer, on) in [
            ("S4", "4xS5", &["avx512", "avx2"][..]),
            ("3xS5_S4", "4xS5", &["avx512", "avx2", "portable"]),
            ("10xS1", "20xS5", &["avx512"]),
            ("S45", "S100", &[]),
            ("S50", "S100", &["avx512", "avx2", "portable"]),
        ] {
            for instructions in ["avx512", "avx2", "portable"] {
                let expected = on.contains(&instructions);
                assert_eq!(pays(inner, outer, instructions), expected, "{inner} {instructions}");
            }
        }
    }
}
