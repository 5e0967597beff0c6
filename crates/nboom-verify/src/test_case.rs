use nboom_dynamics::Recursive;
use nboom_formulation::{
    Coordinates, Embedding, Forces, Formulation, HingeCoordinates, Layout, NoPlace, Recognised,
    Uncovered, recognise,
};
use nboom_model::{HingeState, Mode, Scene, Topology, WeldedTree};
use nboom_scalar::{Kernel, Real};
use nboom_sim::{Fit, NoRoutine, Options, Repertoire, Selection};
use serde::Serialize;

use crate::VerifyError;
use crate::code::ComparedCode;
use crate::dense::Dense;
use crate::label::Label;
use crate::random::Rng;
use crate::random_state::RandomState;

/// Code that does not cover a test case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotCovered {
    /// `generic` or `generated`.
    pub path: &'static str,
    /// The formulation; none where it is all of the path.
    pub formulation: Option<&'static str>,
    /// Why not.
    pub why: String,
}

/// A scene with its thrust on, all hinges free or some held, and random states of it. No force acts along a
/// line, except with [`with_lines_pushing`](Self::with_lines_pushing).
#[derive(Clone, Debug)]
pub struct TestCase {
    scene: Scene,
    seed: u64,
    /// For each hinge of the scene, the angle at which it is held.
    held: Vec<Option<f64>>,
    lines_push: bool,
    states: Vec<RandomState>,
    dynamics: Recursive<f64>,
    recognised: Result<Recognised, Uncovered>,
}

impl TestCase {
    /// `states` random states of `scene`, all hinges free, the same for the same `seed` everywhere.
    /// Angles are of any size; rates are as large as the scene's initial angular rate, or of order
    /// 1 where it has none.
    ///
    /// # Errors
    /// [`VerifyError::NotFinite`] where a parameter that routines take overflows.
    pub fn new(scene: Scene, states: usize, seed: u64) -> Result<Self, VerifyError> {
        Self::new_unless(&|| false, scene, states, seed)
    }

    /// The [same](Self::new) unless it is `interrupted`, which it asks at each state.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`VerifyError::Interrupted`].
    pub fn new_unless(
        interrupted: &dyn Fn() -> bool,
        scene: Scene,
        states: usize,
        seed: u64,
    ) -> Result<Self, VerifyError> {
        let free = vec![None; scene.bodies.len()];
        Self::in_mode(interrupted, scene, free, states, seed, &mut Rng::new(seed))
    }

    /// Random states of `scene` with random hinges, at least one, held at random angles: a test case
    /// for each of the states. Empty for a scene without hinges.
    ///
    /// # Errors
    /// [`VerifyError::NotFinite`] where a parameter that routines take overflows.
    pub fn with_held_hinges(
        scene: &Scene,
        states: usize,
        seed: u64,
    ) -> Result<Vec<Self>, VerifyError> {
        Self::each_with_held_hinges(scene, states, seed).collect()
    }

    /// The same [test cases](Self::with_held_hinges), each made when it is asked for.
    pub fn each_with_held_hinges(
        scene: &Scene,
        states: usize,
        seed: u64,
    ) -> impl ExactSizeIterator<Item = Result<Self, VerifyError>> {
        let hinges = scene.bodies.len();
        let states = if hinges > 0 { states } else { 0 };
        let mut dice = Rng::new(!seed);
        (0..states).map(move |_| {
            let surely = dice.below(hinges);
            let mut held = |i| {
                let angle = |dice: &mut Rng| scene.coordinate_scale(i) * dice.angle();
                (dice.below(2) == 0 || i == surely).then(|| angle(&mut dice))
            };
            let held = (0..hinges).map(&mut held).collect();
            Self::in_mode(&|| false, scene.clone(), held, 1, seed, &mut dice)
        })
    }

    /// One random state of `scene` with hinges held at these angles.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn held_at(scene: Scene, held: Vec<Option<f64>>, seed: u64) -> Result<Self, VerifyError> {
        Self::in_mode(&|| false, scene, held, 1, seed, &mut Rng::new(seed))
    }

    fn in_mode(
        interrupted: &dyn Fn() -> bool,
        scene: Scene,
        held: Vec<Option<f64>>,
        states: usize,
        seed: u64,
        dice: &mut Rng,
    ) -> Result<Self, VerifyError> {
        let of_scene = scene.initial.omega_body.norm();
        let rate = if of_scene > 0.0 { of_scene } else { 1.0 };
        let free = (0..held.len()).filter(|&i| held[i].is_none());
        let sizes: Vec<f64> = free.map(|i| scene.coordinate_scale(i)).collect();
        let state = |_| match interrupted() {
            true => Err(VerifyError::Interrupted),
            false => Ok(RandomState::random(dice, &sizes, rate)),
        };
        let states = (0..states).map(state).collect::<Result<_, _>>()?;
        let dynamics = recursive(&scene, &held, false);
        let recognised = recognise(dynamics.tree());
        if let Ok(recognised) = &recognised {
            require_finite(recognised)?;
        }
        Ok(Self { scene, seed, held, lines_push: false, states, dynamics, recognised })
    }

    /// The same with all kick-off springs pushing, whatever their lengths.
    pub fn with_lines_pushing(self) -> Self {
        let dynamics = recursive(&self.scene, &self.held, true);
        Self { lines_push: true, dynamics, ..self }
    }

    /// The same with so many of its states at most, the first ones.
    pub fn with_first_states(mut self, most: usize) -> Self {
        self.states.truncate(most);
        self
    }

    /// Whether there are accelerations in each state, so that code is worth timing.
    ///
    /// # Errors
    /// [`VerifyError::NoReference`] with the first state in which nothing has inertia in a direction that is free.
    pub fn check_regular(&self) -> Result<(), VerifyError> {
        let mut recursion = self.dynamics.clone();
        for (i, RandomState { beta, .. }) in self.states.iter().enumerate() {
            if let Some(singularity) = recursion.singularity(beta) {
                let hinge = singularity.hinge().map(|hinge| self.scene.label(hinge));
                return Err(VerifyError::NoReference { state: i + 1, hinge });
            }
        }
        Ok(())
    }

    /// For each hinge of the scene, the angle at which it is held.
    pub fn held(&self) -> &[Option<f64>] {
        &self.held
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What the states were drawn from.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The states.
    pub fn states(&self) -> &[RandomState] {
        &self.states
    }

    /// Topology and parameters as routines take them, where the scene has them.
    pub fn recognised(&self) -> Option<&Recognised> {
        self.recognised.as_ref().ok()
    }

    /// The recursion on any scalar, in the test case's mode.
    pub(crate) fn recursive<R: Real>(&self) -> Recursive<R> {
        recursive(&self.scene, &self.held, self.lines_push)
    }

    /// What acts, as right sides take it; `None` where the scene has no topology.
    ///
    /// # Errors
    /// What right sides have no place for.
    pub fn forces(&self) -> Option<Result<Forces<f64>, NoPlace>> {
        let recognised = self.recognised()?;
        Some(Forces::of(self.dynamics.elements(), self.dynamics.tree(), recognised))
    }

    /// The states as closed forms take them, hinges in the order of [`Self::links`].
    pub fn coordinates(&self) -> impl Iterator<Item = Coordinates<f64>> {
        self.coordinates_in(self.links())
    }

    fn coordinates_in(&self, links: Vec<usize>) -> impl Iterator<Item = Coordinates<f64>> {
        let mut dynamics = self.dynamics.clone();
        self.states.iter().map(move |state| {
            let RandomState { omega, beta, tau } = state;
            let mut torque = vec![0.0; beta.len()];
            dynamics.hinge_forces(&state.motion(), &mut torque);
            let hinge =
                |&j: &usize| HingeCoordinates { beta: beta[j], tau: tau[j], torque: torque[j] };
            let external = dynamics.acting_on_main_body(*omega);
            Coordinates { omega: *omega, external, hinges: links.iter().map(hinge).collect() }
        })
    }

    /// The free hinges, numbered in the scene's order, in the order in which closed forms take them:
    /// that of the topology, or where there is none the scene's own.
    pub fn links(&self) -> Vec<usize> {
        match &self.recognised {
            Ok(recognised) => recognised.links.clone(),
            Err(_) => (0..self.tree().links.len()).collect(),
        }
    }

    /// The recursion, which covers any scene.
    pub fn recursion(&self) -> ComparedCode<'_> {
        ComparedCode::recursion(&self.dynamics, &self.states)
    }

    /// All code that covers the test case: the recursion first, then the whole mass matrix, factored,
    /// then closed forms, then those of `kernels` that compute accelerations of its topology and accept its parameters, and the one
    /// that a run takes where that is of a larger topology.
    ///
    /// # Errors
    /// [`VerifyError::Sizes`] where one of these is wrong about its sizes.
    pub fn codes(
        &self,
        kernels: &'static [Kernel],
    ) -> Result<Vec<(Label, ComparedCode<'_>)>, VerifyError> {
        let states: Vec<_> = self.coordinates().collect();
        let dense = ComparedCode::Dense {
            dense: Box::new(Dense::new(&self.dynamics)),
            states: &self.states,
        };
        let mut codes = vec![(Label::RECURSION, self.recursion()), (Label::DENSE, dense)];
        let Some(recognised) = self.recognised() else {
            let states = self.coordinates_in((0..self.tree().links.len()).collect()).collect();
            let code = ComparedCode::Tree { tree: self.dynamics.tree(), states };
            codes.push((Label::generic(Formulation::Symmetric.name()), code));
            return Ok(codes);
        };
        let takes = |formulation: &Formulation| formulation.takes(&recognised.topology);
        for formulation in Formulation::ALL.into_iter().filter(takes) {
            let code = ComparedCode::ClosedForm { formulation, recognised, states: states.clone() };
            codes.push((Label::generic(formulation.name()), code));
        }
        let outputs = Layout::outputs(&recognised.topology);
        let mut fits = self.fitting(kernels, outputs)?;
        if let Some(fit) = self.taken(kernels).filter(|fit| fit.embedding.virtual_links() > 0) {
            fits.push(with_sizes(fit, Layout::outputs)?);
        }
        let routine =
            |fit: Fit| (Label::generated(&fit), ComparedCode::routine(fit, recognised, &states));
        codes.extend(fits.into_iter().map(routine));
        Ok(codes)
    }

    /// What does not cover the scene, and why.
    pub fn not_covered(&self, kernels: &'static [Kernel]) -> Vec<NotCovered> {
        match &self.recognised {
            Err(why) => {
                let hinge = self.dynamics.tree().links[why.link].hinge;
                let why = format!("hinge {}", self.scene.label(hinge));
                let generic = Formulation::ALL.into_iter().filter_map(|formulation| {
                    formulation.covers(self.dynamics.tree()).err()?;
                    Some((Selection::GENERIC, Some(formulation.name())))
                });
                let all = generic.chain([(Selection::GENERATED, None)]);
                let line = |(path, formulation)| NotCovered { path, formulation, why: why.clone() };
                all.map(line).collect()
            }
            Ok(recognised) => {
                let why = || {
                    NoRoutine::because(recognised, self.is_pushed(), &choosing_from(kernels))
                        .to_string()
                };
                let generated =
                    self.taken(kernels).is_none().then(|| (Selection::GENERATED, None, why()));
                let generic = Formulation::ALL.into_iter().filter_map(|formulation| {
                    formulation.covers(self.tree()).err()?;
                    let why = format!("limbs of topology {}", recognised.topology);
                    Some((Selection::GENERIC, Some(formulation.name()), why))
                });
                let line = |(path, formulation, why)| NotCovered { path, formulation, why };
                generic.chain(generated).map(line).collect()
            }
        }
    }

    /// The routine that a run takes in the test case's mode.
    fn taken(&self, kernels: &'static [Kernel]) -> Option<Fit> {
        Repertoire::new(&choosing_from(kernels)).best(self.recognised()?, self.is_pushed())
    }

    /// Whether something acts on the main body from outside.
    fn is_pushed(&self) -> bool {
        self.dynamics.acts_on_main_body()
    }

    /// Those of `kernels` that are of the test case's topology and accept its parameters, each of
    /// which gives this many numbers.
    pub(crate) fn fitting(
        &self,
        kernels: &[Kernel],
        expected_outputs: usize,
    ) -> Result<Vec<Fit>, VerifyError> {
        let Some(recognised) = self.recognised() else { return Ok(Vec::new()) };
        let Recognised { topology, parameters, .. } = recognised;
        let parameters = parameters.write();
        let fits = |kernel: &&Kernel| {
            kernel.topology == topology.to_string()
                && (kernel.external || !self.is_pushed())
                && kernel.accepts(&parameters)
        };
        let as_it_is = |kernel: &Kernel| Fit {
            kernel: *kernel,
            embedding: Embedding::new(topology, topology).expect("a topology is in itself").into(),
            parameters: parameters.clone(),
        };
        let fitting = kernels.iter().filter(fits).map(as_it_is);
        fitting.map(|fit| with_sizes(fit, |_| expected_outputs)).collect()
    }

    /// The tree of the scene's bodies, held hinges welded.
    pub(crate) fn tree(&self) -> &WeldedTree<f64> {
        self.dynamics.tree()
    }
}

/// What a run chooses from where nothing else is asked for.
fn choosing_from(kernels: &'static [Kernel]) -> Options {
    Options { kernels, ..Options::default() }
}

/// The routine, if it takes the numbers of a state and gives as many as there are.
fn with_sizes(fit: Fit, outputs: impl Fn(&Topology) -> usize) -> Result<Fit, VerifyError> {
    let Kernel { topology, formulation, coordinates, outputs: given, .. } = fit.kernel;
    let outer = fit.embedding.outer();
    let (expected_coordinates, expected_outputs) = (Layout::coordinates(outer), outputs(outer));
    if (coordinates, given) == (expected_coordinates, expected_outputs) {
        return Ok(fit);
    }
    Err(VerifyError::Sizes {
        topology,
        formulation,
        coordinates,
        outputs: given,
        expected_coordinates,
        expected_outputs,
    })
}

fn recursive<R: Real>(scene: &Scene, held: &[Option<f64>], lines_push: bool) -> Recursive<R> {
    let state = |angle: &Option<f64>| match angle {
        Some(_) => HingeState::Locked,
        None => HingeState::Free,
    };
    let mode = Mode {
        hinges: held.iter().map(state).collect(),
        externals: vec![1; scene.externals.len()],
        ..Mode::at_start(scene).with_kick_offs(scene, lines_push)
    };
    let beta: Vec<R> = held.iter().map(|angle| R::constant(angle.unwrap_or(0.0))).collect();
    let mut dynamics = Recursive::new(scene);
    dynamics.set_mode(&mode, &beta);
    dynamics
}

fn require_finite(recognised: &Recognised) -> Result<(), VerifyError> {
    let parameters = recognised.parameters.write();
    match parameters.iter().position(|parameter| !parameter.is_finite()) {
        None => Ok(()),
        Some(i) => Err(VerifyError::NotFinite {
            topology: recognised.topology.to_string(),
            parameter: Layout::name(&recognised.topology, i),
            value: parameters[i],
        }),
    }
}
