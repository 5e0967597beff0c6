use std::cmp::Reverse;

use std::sync::{Arc, Mutex};

use nboom_formulation::{Embedding, Forces, Formulation, Layout, Recognised};
use nboom_model::{Limb, Shape, Topology};
use nboom_scalar::Kernel;

use crate::options::Options;

/// A generated routine that computes the accelerations of a mode, and how the mode is embedded in
/// the routine's topology.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The routine.
    pub kernel: Kernel,
    /// The mode's topology in the routine's.
    pub embedding: Arc<Embedding>,
    /// The numbers of the satellite that the routine prepares, [`Kernel::parameters`] of them.
    pub parameters: Vec<f64>,
}

/// About how long an evaluation of a routine takes, in nanoseconds on the machine of
/// `benches/README.md`; only comparisons matter.
///
/// Straight lines take the hinges one after the other. Loops take equal appendages side by side,
/// as many as a register holds; so do straight lines for equal limbs, and for equal parts of one.
fn duration(topology: &Topology, instructions: &str) -> usize {
    let side_by_side = |(shape, count): (Shape, usize)| match shape {
        Shape::Limb(limb) => count >= 2 || !limb.equal_parts().is_empty(),
        Shape::Chain(_) | Shape::Paddle => count >= 4,
    };
    if topology.hinges() <= 16 && !topology.groups().any(side_by_side) {
        return 20 + 36 * topology.hinges();
    }
    let widest = match instructions {
        "avx512" => 8,
        "avx2" => 4,
        _ => 1,
    };
    let limb_link = |count: usize| {
        let rest = count % widest;
        40 * (count / widest + rest / 4 + rest % 4 / 2 + rest % 2)
    };
    let limbs = |limb: &Limb, count: usize| {
        let links = limb.links().len();
        if count > 1 {
            return links * limb_link(count);
        }
        let parts = limb.equal_parts();
        let of_parts = parts.iter().map(|of| (of.part.links().len(), of.count));
        let trunk = of_parts.clone().fold(links, |rest, (links, count)| rest - links * count);
        of_parts.fold(trunk * limb_link(1), |sum, (links, count)| sum + links * limb_link(count))
    };
    let link = |count: usize| match instructions {
        "avx512" => 50 * (count / 8) + 35 * (count % 8 / 4) + 50 * (count % 4),
        "avx2" => 50 * (count / 4) + 50 * (count % 4),
        _ => 50 * count,
    };
    let sweeps = topology.groups().map(|(shape, count)| match &shape {
        Shape::Limb(limb) => limbs(limb, count),
        Shape::Chain(_) | Shape::Paddle => shape.hinges() * link(count),
    });
    45 + sweeps.sum::<usize>()
}

/// About how long an evaluation of the recursion takes, as [`duration`] counts. The hinges on the main body take
/// less than others.
fn duration_of_recursion(topology: &Topology) -> usize {
    let on_main_body = topology.shapes().len();
    60 + 80 * on_main_body + 110 * (topology.hinges() - on_main_body)
}

/// The routines that a run may take: the one that is probably fastest first, of equally fast ones
/// that with fewest links, then one of `articulated`, then the most specialised.
#[derive(Clone, Debug, Default)]
pub struct Repertoire {
    accelerations: Routines,
    right_sides: Routines,
}

/// Routines that simulators share, so that each topology is looked up once for all of them.
pub type SharedRepertoire = Arc<Mutex<Repertoire>>;

/// The routines with one kind of result, in order.
#[derive(Clone, Debug, Default)]
struct Routines {
    entries: Vec<Entry>,
    /// Those that take a topology, for each that has been asked for.
    taking: Vec<(Topology, Vec<Candidate>)>,
    /// Room for parameters.
    parameters: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Entry {
    kernel: Kernel,
    topology: Topology,
    duration: usize,
}

/// A routine that takes a topology, if it accepts the numbers.
#[derive(Clone, Debug)]
struct Candidate {
    kernel: Kernel,
    embedding: Arc<Embedding>,
}

/// The first candidate that accepts the numbers of a mode, and these.
struct Found<'a> {
    candidate: &'a Candidate,
    parameters: &'a [f64],
}

/// Topologies whose candidates are kept. Scenes have few.
const MOST_TOPOLOGIES: usize = 64;

impl Repertoire {
    /// The routines that `options` allow.
    pub fn new(options: &Options) -> Self {
        let of = |result| Routines::all(options, result);
        Self { accelerations: of("accelerations"), right_sides: of("right_side") }
    }

    /// The routines that `options` allow, to be shared by simulators with the same.
    pub fn shared(options: &Options) -> SharedRepertoire {
        Arc::new(Mutex::new(Self::new(options)))
    }

    /// The first routine that computes accelerations in a mode in which something acts on the
    /// main body from outside or nothing does (`external`). `None` if there is none.
    pub fn best(&mut self, recognised: &Recognised, external: bool) -> Option<Fit> {
        self.first(recognised, external).map(Found::fit)
    }

    /// Writes the numbers of another such mode to `fit`, if its routine is the [best](Self::best) there too.
    pub(crate) fn renew(&mut self, fit: &mut Fit, recognised: &Recognised, external: bool) -> bool {
        self.first(recognised, external).is_some_and(|found| found.renew(fit))
    }

    /// The first routine that computes all rates of change in a mode in which `forces` act. `None` if
    /// there is none.
    pub(crate) fn right_side(
        &mut self,
        recognised: &Recognised,
        forces: &Forces<f64>,
    ) -> Option<Fit> {
        self.first_right_side(recognised, forces).map(Found::fit)
    }

    /// Writes the numbers of another such mode to `fit`, if its routine is the first
    /// [there](Self::right_side) too.
    pub(crate) fn renew_right_side(
        &mut self,
        fit: &mut Fit,
        recognised: &Recognised,
        forces: &Forces<f64>,
    ) -> bool {
        self.first_right_side(recognised, forces).is_some_and(|found| found.renew(fit))
    }

    fn first(&mut self, recognised: &Recognised, external: bool) -> Option<Found<'_>> {
        let may_hold = |kernel: &Kernel| kernel.external || !external;
        self.accelerations.first(recognised, may_hold, |_, _| {})
    }

    fn first_right_side(
        &mut self,
        recognised: &Recognised,
        forces: &Forces<f64>,
    ) -> Option<Found<'_>> {
        let write = |embedding: &Embedding, numbers: &mut Vec<f64>| {
            forces.write_embedded(embedding, numbers);
        };
        self.right_sides.first(recognised, |_| true, write)
    }
}

impl Found<'_> {
    fn fit(self) -> Fit {
        let Self { candidate: Candidate { kernel, embedding }, parameters } = self;
        let embedding = Arc::clone(embedding);
        Fit { kernel: *kernel, embedding, parameters: parameters.to_vec() }
    }

    /// Writes the numbers to a fit of the same candidate; returns whether it is one.
    fn renew(self, fit: &mut Fit) -> bool {
        let is_same = Arc::ptr_eq(&self.candidate.embedding, &fit.embedding);
        if is_same {
            fit.parameters.copy_from_slice(self.parameters);
        }
        is_same
    }
}

impl Routines {
    /// Those for `result` that `options` allow.
    fn all(options: &Options, result: &str) -> Self {
        let allowed = |kernel: &&Kernel| {
            kernel.result == result
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
        Self { entries, ..Self::default() }
    }

    /// The first that takes a mode; `write` adds the parameters that follow those of the satellite.
    fn first(
        &mut self,
        recognised: &Recognised,
        may_take: impl Fn(&Kernel) -> bool,
        write: impl Fn(&Embedding, &mut Vec<f64>),
    ) -> Option<Found<'_>> {
        let of_topology = self.of(&recognised.topology);
        let Self { taking, parameters, .. } = self;
        let mut written = None;
        let may_take = |candidate: &&Candidate| may_take(&candidate.kernel);
        let candidate = taking[of_topology].1.iter().filter(may_take).find(|candidate| {
            let Candidate { kernel, embedding } = candidate;
            // Routines of one topology differ in what they assume.
            if written == Some(kernel.topology) {
                embedding.assume(kernel.assumptions, parameters);
            } else {
                embedding.write_parameters(&recognised.parameters, kernel.assumptions, parameters);
                write(embedding, parameters);
                written = Some(kernel.topology);
            }
            kernel.accepts(parameters)
        })?;
        Some(Found { candidate, parameters })
    }

    /// Where the candidates of a topology are kept.
    fn of(&mut self, topology: &Topology) -> usize {
        if let Some(known) = self.taking.iter().position(|(known, _)| known == topology) {
            return known;
        }
        if self.taking.len() == MOST_TOPOLOGIES {
            self.taking.clear();
        }
        let mut entries: Vec<&Entry> = self.entries.iter().collect();
        // One for this very topology is often also there for eight states, and the estimate is rough.
        entries
            .sort_by_key(|entry| entry.duration * if entry.topology == *topology { 1 } else { 2 });
        let candidates = entries.into_iter().filter_map(|entry| entry.candidate(topology));
        let candidates = candidates.collect();
        self.taking.push((topology.clone(), candidates));
        self.taking.len() - 1
    }
}

impl Entry {
    /// How it takes a topology, if it does and that pays.
    fn candidate(&self, topology: &Topology) -> Option<Candidate> {
        let may_embed = self.kernel.formulation == Formulation::Articulated.name()
            && self.duration < duration_of_recursion(topology);
        if !(may_embed || *topology == self.topology) {
            return None;
        }
        let embedding = Arc::new(Embedding::new(topology, &self.topology)?);
        Some(Candidate { kernel: self.kernel, embedding })
    }
}

impl Fit {
    /// What the routine prepares of the satellite, [`Kernel::constants`] numbers.
    pub fn constants(&self) -> Vec<f64> {
        let mut constants = vec![0.0; self.kernel.constants];
        self.write_constants(&mut constants);
        constants
    }

    /// Writes the [constants](Self::constants).
    pub(crate) fn write_constants(&self, constants: &mut [f64]) {
        self.kernel.prepare(&self.parameters, constants);
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
            ("8xS1", "20xS5", &[]),
            ("10xS1", "20xS5", &["avx512"]),
            ("S45", "S100", &[]),
            ("S50", "S100", &["avx512", "avx2", "portable"]),
            ("4xTrrp", "4xTrrp", &["avx512", "avx2", "portable"]),
            // Nine arms of a hub are two registers with AVX-512, three with AVX2, and nine links alone.
            ("Trrrr", "Trr(rr)(rr)(rr)(rr)(rr)(rr)(rr)(rr)(rr)", &["avx512", "avx2"]),
        ] {
            for instructions in ["avx512", "avx2", "portable"] {
                let expected = on.contains(&instructions);
                assert_eq!(pays(inner, outer, instructions), expected, "{inner} {instructions}");
            }
        }
    }
}
