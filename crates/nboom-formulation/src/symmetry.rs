use nboom_model::Topology;
use nboom_scalar::RoutineOn;

use crate::parameters::Layout;

/// How the mass of a satellite's bodies is spread, of which a routine may make use: what is zero then takes no
/// operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Symmetry {
    /// That of the report's decks: every mass centre and every next hinge on its segment's η axis, every inertia
    /// along the segment axes, O at the main body's mass centre.
    Principal,
    /// The plane ηζ divides each link of a chain into halves that mirror each other, as it does booms and panels,
    /// also those held at any angle to each other: the first moment along ξ and the products of inertia with ξ are
    /// zero. Nothing is assumed of the main body.
    Mirrored,
    /// Any.
    General,
}

/// Numbers of the main body that are zero about its principal axes through its mass centre: first moment, products
/// of inertia.
const PRINCIPAL_MAIN_BODY: [usize; 6] = [1, 2, 3, 7, 8, 9];

/// Numbers of a link that are zero where the plane ηζ mirrors it: first moment along ξ, products of inertia with ξ.
const OUT_OF_PLANE: [usize; 3] = [1, 7, 8];

/// Numbers of a mirrored link that are zero where its mass centre and the next hinge are on the η axis and its
/// inertia is along the segment axes: first moment along ζ, product of inertia ηζ, way along ζ.
const IN_PLANE: [usize; 3] = [3, 9, 11];

impl Symmetry {
    /// The most special one first.
    pub const ALL: [Self; 3] = [Self::Principal, Self::Mirrored, Self::General];

    /// `principal`, `mirrored` or `general`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Principal => "principal",
            Self::Mirrored => "mirrored",
            Self::General => "general",
        }
    }

    /// The parameters that are zero, by their numbers in [`Layout`]. Nothing is known of limbs.
    pub fn zeros(self, topology: &Topology) -> Vec<usize> {
        let of_links = |places: &[usize]| -> Vec<usize> {
            let of_link = |link: usize| places.iter().map(move |at| link + at);
            Layout::links(topology).into_iter().flat_map(of_link).collect()
        };
        let [out_of_plane, in_plane] = [OUT_OF_PLANE, IN_PLANE].map(|places| of_links(&places));
        match self {
            Self::Principal => [PRINCIPAL_MAIN_BODY.to_vec(), out_of_plane, in_plane].concat(),
            Self::Mirrored => out_of_plane,
            Self::General => Vec::new(),
        }
    }
}

/// What a routine assumes of a satellite: `baked` all of it; the name of the most special [`Symmetry`] whose zeros it
/// assumes; or `general`.
pub fn assumptions_in_a_word<N>(routine: &RoutineOn<N>) -> &'static str {
    if !routine.assumptions.is_empty() && routine.assumptions.len() == routine.parameters {
        return "baked";
    }
    let Ok(topology) = routine.topology.parse::<Topology>() else { return "general" };
    let assumes = |at: &usize| routine.assumptions.contains(&(*at, 0.0));
    let is_assumed = |symmetry: &Symmetry| {
        let zeros = symmetry.zeros(&topology);
        !zeros.is_empty() && zeros.iter().all(assumes)
    };
    Symmetry::ALL.into_iter().find(is_assumed).unwrap_or(Symmetry::General).name()
}
