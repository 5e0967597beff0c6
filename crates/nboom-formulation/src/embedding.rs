//! A satellite inside a topology that has more hinges, for code that exists for that topology
//! alone.
//!
//! The additional links are **virtual**: they have no mass, sit at the tips of chains or in
//! appendages of their own, and have nothing but a moment of inertia [`VIRTUAL`] about their
//! hinges, by which `articulated` divides. They exert nothing on their inboard hinges, so they do
//! not change the accelerations of the real satellite.

use nboom_model::{Shape, Topology};
use nboom_scalar::{Mat3, RigidInertia, Sym3, Vec3};

use crate::chain::ChainLink;
use crate::parameters::{Layout, Parameters, write_link, write_links, write_place, write_rigid};

/// A virtual link's moment of inertia about its hinge, 2⁻⁴⁰⁰.
///
/// Any pivot will do for an elimination that carries nothing inboard, but a rotor of moment J
/// that is carried along resists with a gyroscopic moment of J ω², whatever its mass. Here it is
/// lost in rounding; squares and inverses are normal numbers all the same.
const VIRTUAL: f64 = f64::from_bits((1023 - 400) << 52);

/// Which appendage of an outer topology each appendage of an inner one is.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    outer: Topology,
    /// For each inner appendage, the outer one.
    branches: Vec<usize>,
    /// For each inner hinge, the outer one.
    hinges: Vec<usize>,
    /// For each inner hinge, its place among the outer hinges.
    places: Vec<usize>,
    /// The numbers of the outer satellite on which nothing depends, ascending, and what each is unless it is assumed.
    arbitrary: Vec<(usize, f64)>,
}

impl Embedding {
    /// Places the inner topology in the outer one: each chain, the longest first, in the shortest
    /// chain that is left and long enough; each paddle in a paddle, each limb in an equal one. `None` if
    /// one is left over; then no other placement has room for all. No limb is virtual.
    pub fn new(inner: &Topology, outer: &Topology) -> Option<Self> {
        let mut left: Vec<usize> = (0..outer.shapes().len()).collect();
        let mut take = |shape: &Shape| {
            let of = |&branch: &usize| &outer.shapes()[branch];
            let holds = |branch: &usize| holds(of(branch), shape);
            let least = left.iter().copied().filter(holds).min_by_key(|branch| of(branch).hinges());
            left.retain(|&branch| Some(branch) != least);
            least
        };
        let branches = inner.shapes().iter().map(&mut take).collect::<Option<Vec<usize>>>()?;
        if left.iter().any(|&branch| matches!(outer.shapes()[branch], Shape::Limb(_))) {
            return None;
        }
        let outer_places = Layout::places(outer);
        let firsts = first_hinges(outer);
        let of_branch = |(&branch, shape): (&usize, &Shape)| {
            let first = firsts[branch];
            first..first + shape.hinges()
        };
        let hinges: Vec<usize> = branches.iter().zip(inner.shapes()).flat_map(of_branch).collect();
        let places = hinges.iter().map(|&hinge| outer_places[hinge]).collect();
        let arbitrary = arbitrary(inner, outer, &branches);
        Some(Self { outer: outer.clone(), branches, hinges, places, arbitrary })
    }

    /// The outer topology.
    pub fn outer(&self) -> &Topology {
        &self.outer
    }

    /// For each inner hinge, in the order of the inner topology, the outer one, in the order of the
    /// outer topology.
    pub fn hinges(&self) -> &[usize] {
        &self.hinges
    }

    /// For each inner hinge, in the order of the inner topology, its place among the outer hinges
    /// as [`Layout::places`] has it.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// How many links are virtual.
    pub fn virtual_links(&self) -> usize {
        self.outer.hinges() - self.places.len()
    }

    /// The numbers of the outer satellite, in the order of [`Parameters::write`], for `inner` of
    /// the inner topology.
    ///
    /// Nothing depends on some of these numbers: where a virtual appendage sits, how it is turned,
    /// and the way to a virtual hinge. They have their values in `assumptions` (parameter numbers
    /// and values) if they are there; otherwise nothing is turned and all points coincide.
    pub fn parameters(&self, inner: &Parameters<f64>, assumptions: &[(usize, f64)]) -> Vec<f64> {
        let mut numbers = Vec::with_capacity(Layout::parameters(&self.outer));
        self.write_parameters(inner, assumptions, &mut numbers);
        numbers
    }

    /// Writes the numbers of [`parameters`](Self::parameters) to `numbers`, in place of what is there.
    pub fn write_parameters(
        &self,
        inner: &Parameters<f64>,
        assumptions: &[(usize, f64)],
        numbers: &mut Vec<f64>,
    ) {
        numbers.clear();
        write_rigid(&inner.main, numbers);
        for (number, shape) in self.outer.shapes().iter().enumerate() {
            let real = self.branches.iter().position(|&branch| branch == number);
            let real = real.map(|of_inner| &inner.branches[of_inner]);
            let (rot, point) = real.map_or((Mat3::identity(), Vec3::zero()), |real| {
                (real.rot_body_from_appendage, real.point)
            });
            write_place(&rot, point, numbers);
            if let Some(real) = real.filter(|real| real.mounts.is_some()) {
                write_links(real, numbers);
                continue;
            }
            for place in 0..shape.hinges() {
                let real = real.and_then(|real| real.links.get(place).copied());
                write_link(&real.unwrap_or_else(|| virtual_link(shape, place)), numbers);
            }
        }
        self.assume(assumptions, numbers);
    }

    /// Takes to `numbers`, which were [written](Self::write_parameters) under other assumptions, these.
    pub fn assume(&self, assumptions: &[(usize, f64)], numbers: &mut [f64]) {
        if self.arbitrary.is_empty() {
            return;
        }
        for &(at, value) in &self.arbitrary {
            numbers[at] = value;
        }
        let is_arbitrary = |&&(at, _): &&(usize, f64)| {
            self.arbitrary.binary_search_by_key(&at, |&(other, _)| other).is_ok()
        };
        for &(at, value) in assumptions.iter().filter(is_arbitrary) {
            numbers[at] = value;
        }
    }
}

/// The numbers of the outer satellite on which nothing depends, if inner appendages are these `branches` of it, each
/// with what it is where nothing is turned and all points coincide.
fn arbitrary(inner: &Topology, outer: &Topology, branches: &[usize]) -> Vec<(usize, f64)> {
    let mut real = vec![0; outer.shapes().len()];
    for (&branch, of_inner) in branches.iter().zip(inner.shapes()) {
        real[branch] = of_inner.hinges();
    }
    let mut place = Vec::with_capacity(Layout::BRANCH);
    write_place(&Mat3::identity(), Vec3::zero(), &mut place);
    let (mut arbitrary, mut end) = (Vec::new(), Layout::MAIN);
    for (shape, real) in outer.shapes().iter().zip(real) {
        if real == 0 {
            arbitrary.extend((end..).zip(place.iter().copied()));
        }
        end += Layout::BRANCH;
        for link in 0..shape.hinges() {
            end += Layout::link(shape, link);
            if link + 1 >= real && shape.hinges() > real {
                arbitrary.extend((end - Layout::WAY..end).map(|at| (at, 0.0)));
            }
        }
    }
    arbitrary
}

/// Whether an appendage can be filled up to the outer one.
fn holds(outer: &Shape, inner: &Shape) -> bool {
    match (outer, inner) {
        (Shape::Chain(outer), Shape::Chain(inner)) => outer >= inner,
        (outer, inner) => outer == inner,
    }
}

/// The number of each appendage's first hinge, appendage by appendage.
fn first_hinges(topology: &Topology) -> Vec<usize> {
    let before = |first: &mut usize, shape: &Shape| {
        let this = *first;
        *first += shape.hinges();
        Some(this)
    };
    topology.shapes().iter().scan(0, before).collect()
}

/// A virtual link at a place of an appendage.
fn virtual_link(shape: &Shape, place: usize) -> ChainLink<f64> {
    let axis = match (shape, place) {
        (Shape::Paddle, 1) => Vec3::unit_y(),
        _ => Vec3::unit_x(),
    };
    let about_origin = Sym3::outer(axis) * VIRTUAL;
    ChainLink { inertia: RigidInertia { about_origin, ..RigidInertia::zero() }, next: [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topology(name: &str) -> Topology {
        name.parse().expect("a topology")
    }

    fn embedding(inner: &str, outer: &str) -> Option<Embedding> {
        Embedding::new(&topology(inner), &topology(outer))
    }

    #[test]
    fn a_topology_is_in_itself_as_it_is() {
        for name in ["M", "S1", "P", "4xS5", "S5_2xS2_3xP", "S2_2xTr(rp)(s)_Ts"] {
            let found = embedding(name, name).expect("it is in itself");
            assert_eq!(found.places(), Layout::places(&topology(name)));
            assert_eq!(found.virtual_links(), 0);
            let numbers: Vec<f64> =
                (0..Layout::parameters(&topology(name))).map(|i| i as f64).collect();
            let inner = Parameters::read(&topology(name), numbers.clone());
            let assumptions: Vec<(usize, f64)> = (0..numbers.len()).map(|i| (i, -1.0)).collect();
            assert_eq!(found.parameters(&inner, &assumptions), numbers);
        }
    }

    #[test]
    fn each_chain_is_in_the_shortest_that_holds_it() {
        // The outer chains S4, S3, S1 have their hinges at 0 to 3, 4 to 6 and 7.
        let found = embedding("S3_S1", "S4_S3_S1").expect("it fits");
        assert_eq!((found.places(), found.virtual_links()), (&[4, 5, 6, 7][..], 4));
        // Hinges of equal appendages are side by side.
        let found = embedding("S2_S1_P", "2xS2_2xP").expect("it fits");
        assert_eq!((found.places(), found.virtual_links()), (&[0, 2, 1, 4, 6][..], 3));
    }

    #[test]
    fn what_does_not_fit_is_told() {
        for (inner, outer) in [
            ("S2", "S1"),
            ("2xS1", "S2"),
            ("P", "S2"),
            ("S1", "P"),
            ("S2", "P"),
            ("S3_S2", "S4_S1"),
            ("2xP", "4xS5_P"),
            ("S1", "M"),
            ("Tr", "Trr"),
            ("S1", "S1_Trr"),
            ("Trp", "S2"),
        ] {
            assert_eq!(embedding(inner, outer), None, "{inner} in {outer}");
        }
    }

    #[test]
    fn assumed_numbers_are_taken_where_nothing_depends_on_them_and_nowhere_else() {
        let (inner, outer) = (topology("S1"), topology("S2_P"));
        let numbers: Vec<f64> = (1..=Layout::parameters(&inner)).map(|i| i as f64).collect();
        let inner_parameters = Parameters::read(&inner, numbers.clone());
        let found = Embedding::new(&inner, &outer).expect("it fits");
        let count = Layout::parameters(&outer);
        let others: Vec<(usize, f64)> = (0..count).step_by(2).map(|i| (i, -2.0)).collect();
        let assumptions: Vec<(usize, f64)> = (0..count).map(|i| (i, -1.0)).collect();
        let taken: Vec<usize> = found
            .parameters(&inner_parameters, &assumptions)
            .iter()
            .enumerate()
            .filter_map(|(i, &number)| (number == -1.0).then_some(i))
            .collect();
        // Ways of both links of S2, place and attitude of P, ways of arm and paddle.
        let expected = (32..34).chain(44..46).chain(46..58).chain(68..70).chain(80..82);
        assert_eq!(taken, expected.collect::<Vec<_>>());
        assert_eq!(found.parameters(&inner_parameters, &[])[..32], numbers[..32]);
        // Nothing is left of what was assumed before.
        let mut again = found.parameters(&inner_parameters, &assumptions);
        for assumed in [&others[..], &[]] {
            found.assume(assumed, &mut again);
            assert_eq!(again, found.parameters(&inner_parameters, assumed));
        }
    }
}
