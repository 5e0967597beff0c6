use nboom_dynamics::{Motion, Recursive};
use nboom_formulation::{
    Coordinates, Formulation, HingeCoordinates, Layout, Recognised, recognise,
};
use nboom_model::{HingeState, Mode, Scene, WeldedTree};
use nboom_scalar::{Kernel, Real, Vec3, Wrench};
use serde::Serialize;

use crate::VerifyError;
use crate::code::Code;
use crate::label::Label;
use crate::random::Dice;

/// One random state: rates and angles, in the order of the scene's hinges.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// ω, main-body axes \[rad/T\].
    pub omega: Vec3<f64>,
    /// β, any angle \[rad\].
    pub beta: Vec<f64>,
    /// τ \[rad/T\].
    pub tau: Vec<f64>,
}

impl State {
    /// Angles of all hinges, and rates up to `rate`.
    fn random(dice: &mut Dice, hinges: usize, rate: f64) -> Self {
        let mut rates =
            |count: usize| -> Vec<f64> { (0..count).map(|_| dice.between(-rate, rate)).collect() };
        let (omega, tau) = (rates(3), rates(hinges));
        let half_turn = std::f64::consts::PI;
        let beta = (0..hinges).map(|_| dice.between(-half_turn, half_turn)).collect();
        Self { omega: Vec3::new(omega[0], omega[1], omega[2]), beta, tau }
    }

    /// The state as the recursion takes it.
    pub fn motion(&self) -> Motion<'_, f64> {
        Motion { omega_body: self.omega, beta: &self.beta, tau: &self.tau }
    }
}

/// Code that does not cover a subject.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotCovered {
    /// `generic` or `generated`.
    pub path: &'static str,
    /// The formulation; none where it is all of the path.
    pub formulation: Option<&'static str>,
    /// Why not.
    pub why: String,
}

/// A scene with all hinges free, its thrust on and its kick-off springs disengaged, and random
/// states of it.
#[derive(Clone, Debug)]
pub struct Subject {
    scene: Scene,
    seed: u64,
    states: Vec<State>,
    dynamics: Recursive<f64>,
    recognised: Result<Recognised, usize>,
}

impl Subject {
    /// `states` random states of `scene`, the same for the same `seed` everywhere. Angles are of
    /// any size; rates are as large as the scene's initial angular rate, or of order 1 where it has
    /// none.
    ///
    /// # Errors
    /// [`VerifyError::NotFinite`] where a parameter that routines take overflows.
    pub fn new(scene: Scene, states: usize, seed: u64) -> Result<Self, VerifyError> {
        let hinges = scene.bodies.len();
        let of_scene = scene.initial.omega_body.norm();
        let rate = if of_scene > 0.0 { of_scene } else { 1.0 };
        let mut dice = Dice::new(seed);
        let states = (0..states).map(|_| State::random(&mut dice, hinges, rate)).collect();
        let dynamics = recursive(&scene);
        let recognised = recognise(dynamics.tree());
        if let Ok(recognised) = &recognised {
            require_finite(recognised)?;
        }
        Ok(Self { scene, seed, states, dynamics, recognised })
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
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// Topology and parameters as routines take them, where the scene is made of chains and
    /// paddles.
    pub fn recognised(&self) -> Option<&Recognised> {
        self.recognised.as_ref().ok()
    }

    /// The recursion on any scalar, in the subject's mode.
    pub(crate) fn recursive<R: Real>(&self) -> Recursive<R> {
        recursive(&self.scene)
    }

    /// The states as closed forms take them, hinges in the order of [`Self::links`].
    pub fn coordinates(&self) -> impl Iterator<Item = Coordinates<f64>> {
        let links = self.links();
        let external = self.dynamics.external().unwrap_or(Wrench::zero());
        let mut dynamics = self.dynamics.clone();
        self.states.iter().map(move |state| {
            let State { omega, beta, tau } = state;
            let mut torque = vec![0.0; beta.len()];
            dynamics.hinge_forces(&state.motion(), &mut torque);
            let hinge =
                |&j: &usize| HingeCoordinates { beta: beta[j], tau: tau[j], torque: torque[j] };
            Coordinates { omega: *omega, external, hinges: links.iter().map(hinge).collect() }
        })
    }

    /// The scene's hinges in the order in which closed forms take them: that of the topology,
    /// or where there is none the scene's own.
    pub fn links(&self) -> Vec<usize> {
        match &self.recognised {
            Ok(recognised) => recognised.links.clone(),
            Err(_) => (0..self.scene.bodies.len()).collect(),
        }
    }

    /// The recursion, which covers any scene.
    pub fn recursion(&self) -> Code<'_> {
        Code::recursion(&self.dynamics, &self.states)
    }

    /// All code that covers the scene: the recursion first, then closed forms, then those of
    /// `kernels` that compute accelerations of its topology and accept its parameters.
    ///
    /// # Errors
    /// [`VerifyError::Sizes`] where one of these is wrong about its sizes.
    pub fn codes(&self, kernels: &[Kernel]) -> Result<Vec<(Label, Code<'_>)>, VerifyError> {
        let states: Vec<_> = self.coordinates().collect();
        let mut codes = vec![(Label::RECURSION, self.recursion())];
        let Some(recognised) = self.recognised() else {
            let code = Code::Tree { tree: self.dynamics.tree(), states };
            codes.push((Label::generic(Formulation::Symmetric.name()), code));
            return Ok(codes);
        };
        for formulation in Formulation::ALL {
            let code = Code::ClosedForm { formulation, recognised, states: states.clone() };
            codes.push((Label::generic(formulation.name()), code));
        }
        let outputs = Layout::outputs(&recognised.topology);
        for kernel in self.fitting(kernels, outputs)? {
            codes.push((Label::generated(&kernel), Code::routine(kernel, recognised, &states)));
        }
        Ok(codes)
    }

    /// What does not cover the scene, and why.
    pub fn not_covered(&self, kernels: &[Kernel]) -> Vec<NotCovered> {
        match &self.recognised {
            Err(link) => {
                let hinge = self.dynamics.tree().links[*link].hinge;
                let why = format!("hinge {}", self.scene.label(hinge));
                let generic = Formulation::ALL.into_iter().filter_map(|formulation| {
                    formulation.covers(self.dynamics.tree()).err()?;
                    Some(("generic", Some(formulation.name())))
                });
                let all = generic.chain([("generated", None)]);
                let line = |(path, formulation)| NotCovered { path, formulation, why: why.clone() };
                all.map(line).collect()
            }
            Ok(recognised) if !kernels.iter().any(|kernel| self.fits(recognised, kernel)) => {
                let why = format!("no routine for topology {}", recognised.topology);
                vec![NotCovered { path: "generated", formulation: None, why }]
            }
            Ok(_) => Vec::new(),
        }
    }

    /// Those of `kernels` that take the scene, each of which gives this many numbers.
    pub(crate) fn fitting(
        &self,
        kernels: &[Kernel],
        expected_outputs: usize,
    ) -> Result<Vec<Kernel>, VerifyError> {
        let Some(recognised) = self.recognised() else { return Ok(Vec::new()) };
        let expected_coordinates = Layout::coordinates(&recognised.topology);
        let right = |kernel: Kernel| {
            let Kernel { topology, formulation, coordinates, outputs, .. } = kernel;
            if (coordinates, outputs) == (expected_coordinates, expected_outputs) {
                return Ok(kernel);
            }
            Err(VerifyError::Sizes {
                topology,
                formulation,
                coordinates,
                outputs,
                expected_coordinates,
                expected_outputs,
            })
        };
        let fitting = kernels.iter().filter(|kernel| self.fits(recognised, kernel));
        fitting.copied().map(right).collect()
    }

    fn fits(&self, recognised: &Recognised, kernel: &Kernel) -> bool {
        kernel.topology == recognised.topology.to_string()
            && (kernel.external || self.dynamics.external().is_none())
            && kernel.accepts(&recognised.parameters.write())
    }

    /// The tree of the scene's bodies, all hinges free.
    pub(crate) fn tree(&self) -> &WeldedTree<f64> {
        self.dynamics.tree()
    }
}

fn recursive<R: Real>(scene: &Scene) -> Recursive<R> {
    let hinges = scene.bodies.len();
    let mode = Mode {
        hinges: vec![HingeState::Free; hinges],
        kick_off: vec![false; hinges],
        thrust: scene.thrust.is_some(),
    };
    let mut dynamics = Recursive::new(scene);
    dynamics.set_mode(&mode, &vec![R::zero(); hinges]);
    dynamics
}

fn require_finite(recognised: &Recognised) -> Result<(), VerifyError> {
    let parameters = recognised.parameters.write();
    match parameters.iter().position(|parameter| !parameter.is_finite()) {
        None => Ok(()),
        Some(i) => Err(VerifyError::NotFinite {
            topology: recognised.topology.to_string(),
            number: i + 1,
            value: parameters[i],
        }),
    }
}
