use nboom_formulation::{Formulation, NoPlace, Why};
use nboom_model::Scene;
use nboom_sections::SectionError;

use crate::request::Output;
use crate::request::routine::USED;

/// Why nothing was generated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CodegenError {
    /// The name of the type is not one, or generated code uses it itself.
    #[error("routine `{0}`: a Rust identifier expected that begins with a capital and is none of {used}", used = USED.join(", "))]
    Name(String),
    /// The path of the scalar crate is not one.
    #[error("routine `{name}`: `{path}` found, the path of the crate nboom_scalar expected")]
    Path {
        /// The routine.
        name: String,
        /// What was given.
        path: String,
    },
    /// Assumed parameters do not fit the topology.
    #[error("topology {topology}: {found} parameters found, {expected} expected")]
    Parameters {
        /// The topology.
        topology: String,
        /// How many were given.
        found: usize,
        /// How many it has.
        expected: usize,
    },
    /// An assumed parameter is infinite or not a number.
    #[error("topology {topology}: parameter {number} is {value}, a finite number expected")]
    NotFinite {
        /// The topology.
        topology: String,
        /// Which parameter, from 0.
        number: usize,
        /// Its value.
        value: f64,
    },
    /// The topology has more links than code is generated for.
    #[error(
        "topology {topology}, formulation {formulation}: {links} hinges found, at most {limit} \
         expected"
    )]
    TooLarge {
        /// The topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
        /// Its hinges.
        links: usize,
        /// The most that is generated.
        limit: usize,
    },
    /// A straight line would be too long for a compiler, or the steps of limbs that are all different would be.
    #[error(
        "topology {topology}, formulation {formulation}: the evaluation takes {operations} \
         operations, at most {limit} expected; only accelerations and right sides by articulated are \
         emitted as loops, and only joints that are alike share a step"
    )]
    Budget {
        /// The topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
        /// Additions, multiplications and divisions of an evaluation, or of the steps.
        operations: usize,
        /// The most that is emitted.
        limit: usize,
    },
    /// Lines push links, or hinges of other appendages than chains are coupled, of a satellite whose code is loops.
    #[error(
        "topology {topology}: the evaluation with lines that push links, or coupled hinges that are not of a chain, \
         takes more than {limit} operations; only without them it is emitted as loops"
    )]
    StraightAlone {
        /// The topology.
        topology: String,
        /// The most operations that are emitted.
        limit: usize,
    },
    /// A number of a scene is infinite or not a number.
    #[error("routine `{name}`: {value} found among the scene's numbers, finite ones expected")]
    Number {
        /// The routine.
        name: String,
        /// Its value.
        value: f64,
    },
    /// Loads and stresses of a scene would be too long a line for a compiler.
    #[error("routine `{name}`: {operations} operations found, at most {limit} expected")]
    Length {
        /// The routine.
        name: String,
        /// Additions, multiplications and divisions of an evaluation.
        operations: usize,
        /// The most that is emitted.
        limit: usize,
    },
    /// The section of a station is not one.
    #[error("segment {segment}, station {station}: {source}")]
    Section {
        /// The segment.
        segment: String,
        /// The station, from 1.
        station: usize,
        /// What is wrong with it.
        source: SectionError,
    },
    /// The formulation has no matrix and no right side.
    #[error(
        "topology {topology}, formulation {formulation}: it forms no equations; accelerations, or \
         report, relative or symmetric expected"
    )]
    NoEquations {
        /// The topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
    },
    /// Inverse dynamics is not a matter of this formulation.
    #[error(
        "topology {topology}, formulation {formulation}: inverse dynamics found; only articulated has it"
    )]
    NoInverse {
        /// The topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
    },
    /// Equations and inverse dynamics are those of a main body that moves by its own mass properties.
    #[error(
        "topology {topology}: {} of a main body that is held found; ask for those of a free one, which \
         give what holds it too", output.name()
    )]
    HeldMainBody {
        /// The topology.
        topology: String,
        /// What was asked for.
        output: Output,
    },
    /// Equations and inverse dynamics take the mass of a main body that is held, and it has none.
    #[error(
        "scene {scene}: main body without mass found; equations and inverse dynamics are those with it free, a mass \
         expected"
    )]
    NoMass {
        /// The scene.
        scene: String,
    },
    /// The formulation takes chains and paddles alone.
    #[error(
        "topology {topology}: of limbs, formulation {formulation} has none; articulated or symmetric \
         expected"
    )]
    NoLimbs {
        /// The topology.
        topology: String,
        /// The formulation.
        formulation: Formulation,
    },
    /// Something acts on a scene that a right side has no place for.
    #[error("scene {scene}: {place}: {what} found, for which a right side has no place")]
    NoPlace {
        /// The scene.
        scene: String,
        /// Which of the scene, with its body or hinges.
        place: String,
        /// What acts.
        what: NoPlace,
    },
    /// A scene has a body that is not rigid or carries a rotor, or an appendage of too many links.
    #[error("scene {scene}: code is not generated for what hinge {hinge} carries, which {why}")]
    NotCovered {
        /// The scene.
        scene: String,
        /// The first hinge that does not.
        hinge: String,
        /// What keeps it out.
        why: Why,
    },
}

impl CodegenError {
    /// Something acts on this scene that a right side has no place for.
    pub fn no_place(scene: &Scene, what: NoPlace) -> Self {
        Self::NoPlace { scene: scene.name.clone(), place: what.in_scene(scene), what }
    }
}
