use nboom_formulation::{Formulation, Layout, RightSideLayout, Symmetry};
use nboom_model::{Shape, Topology};

use crate::request::{CodegenError, Output};

/// The most hinges that `articulated` is generated for, as loops.
pub const HINGE_LIMIT: usize = Topology::MOST_HINGES;

/// The most hinges that any other formulation is traced for: its code is one straight line.
pub const STRAIGHT_HINGE_LIMIT: usize = 100;

/// How freely generated code may rearrange arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// Every value is that of the closed form on the same scalar.
    Exact,
    /// Products and sums are fused where the scalar can round once.
    Fast,
}

impl Level {
    /// `exact` or `fast`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Fast => "fast",
        }
    }
}

/// What to generate.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Name of the type that implements the routine, a Rust identifier.
    pub name: String,
    /// Path of the crate `nboom_scalar` where the code will stand.
    pub scalar_path: String,
    /// The satellite's appendages.
    pub topology: Topology,
    /// The closed form that is traced.
    pub formulation: Formulation,
    /// What an evaluation writes.
    pub output: Output,
    /// Parameters that the code assumes to have these values; `None` stays a runtime value.
    pub assumptions: Vec<Option<f64>>,
    /// Whether anything acts on the main body from outside.
    pub external: bool,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
    /// Whether the code is compiled for eight states at once, too, which takes compilers long.
    pub on_eight_states: bool,
}

impl Request {
    /// Code for a topology with all parameters at run time, without external wrench:
    /// accelerations by `articulated`.
    pub fn new(name: &str, topology: Topology, level: Level) -> Self {
        let assumptions = vec![None; Layout::parameters(&topology)];
        Self {
            name: name.to_owned(),
            scalar_path: "::nboom_scalar".to_owned(),
            topology,
            formulation: Formulation::Articulated,
            output: Output::Accelerations,
            assumptions,
            external: false,
            level,
            on_eight_states: false,
        }
    }

    /// Code that also takes an external wrench on the main body.
    pub fn with_external_wrench(mut self) -> Self {
        self.external = true;
        if self.output == Output::RightSide {
            self.assumptions[RightSideLayout::external(&self.topology)].fill(None);
        }
        self
    }

    /// Code by another formulation.
    pub fn by(mut self, formulation: Formulation) -> Self {
        self.formulation = formulation;
        self
    }

    /// Code for the matrix and the right side that the formulation solves.
    pub fn for_equations(mut self) -> Self {
        self.output = Output::Equations;
        self.assumptions.truncate(Layout::parameters(&self.topology));
        self
    }

    /// Code for inverse dynamics: from ω, ω̇, a_O and β, τ, τ̇ of each hinge to the wrench on the main body
    /// and the hinge torques.
    pub fn for_inverse_dynamics(mut self) -> Self {
        self.output = Output::InverseDynamics;
        self.assumptions.truncate(Layout::parameters(&self.topology));
        self.external = true;
        self
    }

    /// Code for the right side of the differential equations of a mode, in the order of
    /// [`RightSideLayout`]. Hinge laws are handed in, and so is an external wrench if accelerations
    /// take one; lines are assumed not to push, hinges not to be coupled, and rotors to rest.
    pub fn for_right_side(mut self) -> Self {
        self.output = Output::RightSide;
        let topology = &self.topology;
        self.assumptions.truncate(Layout::parameters(topology));
        self.assumptions.resize(RightSideLayout::parameters(topology), None);
        if !self.external {
            self.assumptions[RightSideLayout::external(topology)].fill(Some(0.0));
        }
        for place in 0..RightSideLayout::lines(topology) {
            self.assumptions[RightSideLayout::coefficients(topology, place)].fill(Some(0.0));
        }
        self.assumptions[RightSideLayout::spin(topology)].fill(Some(0.0));
        for hinge in 0..topology.hinges() {
            let strength = RightSideLayout::strength(topology, hinge);
            strength.into_iter().for_each(|at| self.assumptions[at] = Some(0.0));
        }
        self
    }

    /// Code for a right side that is compiled for eight states at once, too.
    pub fn on_eight_states(mut self) -> Self {
        self.on_eight_states = true;
        self
    }

    /// Code for a right side each of whose links may be pushed by so many lines, up to
    /// [`RightSideLayout::LINES_OF_LINK`].
    pub fn with_lines(mut self, of_link: usize) -> Self {
        for place in 0..of_link * self.topology.hinges() {
            self.assumptions[RightSideLayout::coefficients(&self.topology, place)].fill(None);
        }
        self
    }

    /// Code for a right side whose main body may carry rotors.
    pub fn with_rotors(mut self) -> Self {
        self.assumptions[RightSideLayout::spin(&self.topology)].fill(None);
        self
    }

    /// Code for a right side each of whose hinges may be coupled with the one inboard of it.
    pub fn with_couplings(mut self) -> Self {
        for hinge in 0..self.topology.hinges() {
            let strength = RightSideLayout::strength(&self.topology, hinge);
            strength.into_iter().for_each(|at| self.assumptions[at] = None);
        }
        self
    }

    /// Whether a line may push a link.
    pub(crate) fn has_lines(&self) -> bool {
        let mut places = 0..RightSideLayout::lines(&self.topology);
        self.output == Output::RightSide && places.any(|place| self.may_push(place))
    }

    /// Whether the line at a place of a right side may push.
    pub(crate) fn may_push(&self, place: usize) -> bool {
        let mut coefficients = RightSideLayout::coefficients(&self.topology, place);
        coefficients.any(|at| self.assumptions[at] != Some(0.0))
    }

    /// The hinges of a right side that may be coupled with the one inboard of them.
    pub(crate) fn coupled(&self) -> impl Iterator<Item = usize> {
        let inboard = self.topology.inboard_hinges().into_iter().enumerate();
        let is_coupled = |&(hinge, inboard): &(usize, Option<usize>)| {
            self.output == Output::RightSide && inboard.is_some() && self.may_couple(hinge)
        };
        inboard.filter(is_coupled).map(|(hinge, _)| hinge)
    }

    /// Whether a hinge may be coupled with the one inboard of it.
    pub(crate) fn has_couplings(&self) -> bool {
        self.coupled().next().is_some()
    }

    /// Whether a hinge that is not one of a chain may be coupled with the one inboard of it: loops have no step for that.
    pub(crate) fn couples_beyond_chains(&self) -> bool {
        let of_hinges = self.topology.shapes().iter();
        let is_of_chain: Vec<bool> = of_hinges
            .flat_map(|shape| std::iter::repeat_n(matches!(shape, Shape::Chain(_)), shape.hinges()))
            .collect();
        self.coupled().any(|hinge| !is_of_chain[hinge])
    }

    /// Whether a right side may have a coupling at the place of this hinge.
    pub(crate) fn may_couple(&self, hinge: usize) -> bool {
        let mut strength = RightSideLayout::strength(&self.topology, hinge).into_iter();
        strength.any(|at| self.assumptions[at] != Some(0.0))
    }

    /// Whether it assumes that the main body is held.
    pub(crate) fn holds_main_body(&self) -> bool {
        let held = Layout::held_main().into_iter().map(Some);
        self.assumptions[..Layout::MAIN].iter().copied().eq(held)
    }

    /// Whether its sweeps can be emitted as loops.
    pub(crate) fn has_loops(&self) -> bool {
        self.formulation == Formulation::Articulated && self.output != Output::InverseDynamics
    }

    /// Assumes every parameter: code for one satellite.
    ///
    /// `parameters` are the numbers that `nboom_formulation::Parameters::write` gives, and for a right
    /// side those of `nboom_formulation::Forces::write` after them.
    pub fn baked(mut self, parameters: &[f64]) -> Self {
        self.assumptions = parameters.iter().copied().map(Some).collect();
        self
    }

    /// Assumes this of the satellite.
    pub fn with_symmetry(mut self, symmetry: Symmetry) -> Self {
        symmetry.zeros(&self.topology).into_iter().for_each(|at| self.assumptions[at] = Some(0.0));
        self
    }

    /// Code for a main body that is held, as on a test rig: the external wrench is that which holds it.
    pub fn with_held_main_body(mut self) -> Self {
        let held = Layout::held_main().into_iter().map(Some);
        self.assumptions.splice(..Layout::MAIN, held);
        self
    }

    /// # Errors
    /// When this does not describe a routine.
    pub(crate) fn check(&self) -> Result<(), CodegenError> {
        let Self { name, topology, formulation, output, assumptions, .. } = self;
        check_name(name)?;
        let of_topology = || topology.to_string();
        let (found, expected) = (assumptions.len(), output.parameters(topology));
        if found != expected {
            return Err(CodegenError::Parameters { topology: of_topology(), found, expected });
        }
        let limit = if self.has_loops() { HINGE_LIMIT } else { STRAIGHT_HINGE_LIMIT };
        let (links, formulation) = (topology.hinges(), *formulation);
        if links > limit {
            let topology = of_topology();
            return Err(CodegenError::TooLarge { topology, formulation, links, limit });
        }
        if !formulation.takes(topology) {
            return Err(CodegenError::NoLimbs { topology: of_topology(), formulation });
        }
        if *output == Output::Equations && !formulation.has_equations() {
            return Err(CodegenError::NoEquations { topology: of_topology(), formulation });
        }
        if *output == Output::InverseDynamics && formulation != Formulation::Articulated {
            return Err(CodegenError::NoInverse { topology: of_topology(), formulation });
        }
        let takes_free = matches!(output, Output::Equations | Output::InverseDynamics);
        if takes_free && self.holds_main_body() {
            let (topology, output) = (of_topology(), *output);
            return Err(CodegenError::HeldMainBody { topology, output });
        }
        let bad = |(number, value): (usize, &Option<f64>)| {
            value.filter(|value| !value.is_finite()).map(|value| (number, value))
        };
        match assumptions.iter().enumerate().find_map(bad) {
            Some((number, value)) => {
                Err(CodegenError::NotFinite { topology: of_topology(), number, value })
            }
            None => Ok(()),
        }
    }
}

/// Names of types that generated code uses itself, beside variables, whose names begin with small letters.
pub(crate) const USED: [&str; 5] = ["Copy", "Isa", "Pack", "Real", "Routine"];

/// # Errors
/// When the type of a routine cannot be named so; a raw identifier cannot be part of a module's
/// name.
pub(crate) fn check_name(name: &str) -> Result<(), CodegenError> {
    let is_used = name.starts_with(|first: char| first.is_lowercase()) || USED.contains(&name);
    if is_used || name.starts_with("r#") || syn::parse_str::<syn::Ident>(name).is_err() {
        return Err(CodegenError::Name(name.to_owned()));
    }
    Ok(())
}
