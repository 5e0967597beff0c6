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

/// What [`Kernel::result`] says of routines that a run may take.
const ACCELERATIONS: &str = "accelerations";

/// The routines that a run may take: the one that is probably fastest first, of equally fast ones
/// that with fewest links, then one of `articulated`, then the most specialised.
#[derive(Clone, Debug)]
pub struct Repertoire {
    entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
struct Entry {
    kernel: Kernel,
    topology: Topology,
    duration: usize,
}

impl Repertoire {
    /// The routines that `options` allow.
    pub fn new(options: &Options) -> Self {
        let allowed = |kernel: &&Kernel| {
            kernel.result == ACCELERATIONS
                && options.formulation.is_none_or(|form| kernel.formulation == form.name())
        };
        let entry = |kernel: &Kernel| {
            let topology = kernel.topology.parse::<Topology>().ok()?;
            let duration = duration(&topology, kernel.instructions);
            Some(Entry { kernel: *kernel, topology, duration })
        };
        let mut entries: Vec<Entry> =
            options.kernels.iter().filter(allowed).filter_map(entry).collect();
        entries.sort_by_key(|entry| {
            let articulated = entry.kernel.formulation == Formulation::Articulated.name();
            let assumptions = Reverse(entry.kernel.assumptions.len());
            (entry.duration, entry.topology.hinges(), !articulated, assumptions)
        });
        Self { entries }
    }

    /// The first routine that computes what is wanted in a mode in which something acts on the
    /// main body from outside or nothing does (`external`). `None` if there is none.
    pub fn best(&self, recognised: &Recognised, external: bool) -> Option<Fit> {
        let most = duration_of_recursion(&recognised.topology);
        let may_hold = |entry: &&Entry| {
            let may_embed = entry.kernel.formulation == Formulation::Articulated.name()
                && entry.duration < most;
            (entry.kernel.external || !external)
                && (may_embed || recognised.topology == entry.topology)
        };
        self.entries.iter().filter(may_hold).find_map(|entry| entry.fit(recognised))
    }
}

impl Entry {
    fn fit(&self, recognised: &Recognised) -> Option<Fit> {
        let embedding = Embedding::new(&recognised.topology, &self.topology)?;
        let parameters = embedding.parameters(&recognised.parameters, self.kernel.assumptions);
        let fit = Fit { kernel: self.kernel, embedding, parameters };
        self.kernel.accepts(&fit.parameters).then_some(fit)
    }
}

impl Fit {
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
