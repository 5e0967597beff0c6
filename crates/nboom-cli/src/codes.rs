//! All code that computes accelerations of a scene whose hinges are all free: the recursion,
//! the closed forms and the generated routines, on the same random states.

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{
    Coordinates, Formulation, HingeCoordinates, Layout, Recognised, recognise, symmetric,
};
use nboom_model::{HingeState, Mode, Scene};
use nboom_scalar::{Kernel, Twist, Vec3, Wrench};

use crate::random::Dice;

/// Which code it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label {
    pub path: &'static str,
    pub formulation: &'static str,
    /// `principal` where it takes facts about a scene for granted, else `general`.
    pub facts: &'static str,
    pub instructions: &'static str,
}

impl Label {
    fn generic(formulation: &'static str) -> Self {
        Self { path: "generic", formulation, facts: "general", instructions: "portable" }
    }

    fn generated(kernel: &Kernel) -> Self {
        Self {
            path: "generated",
            formulation: kernel.formulation,
            facts: if kernel.pinned.is_empty() { "general" } else { "principal" },
            instructions: kernel.instructions,
        }
    }

    /// Path, formulation and facts.
    pub fn words(&self) -> String {
        format!("{} {} ({})", self.path, self.formulation, self.facts)
    }

    /// Path, formulation, facts and instructions in columns.
    pub fn columns(&self) -> String {
        let Self { path, formulation, facts, instructions } = self;
        format!("{path:<10} {formulation:<12} {facts:<10} {instructions:<13}")
    }
}

/// The head of [`Label::columns`].
pub(crate) fn head() -> String {
    let [path, formulation, facts, instructions] = ["path", "formulation", "facts", "instructions"];
    Label { path, formulation, facts, instructions }.columns()
}

/// One random state: rates and angles, in the order of the tree's links.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub omega: Vec3<f64>,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
}

impl State {
    /// Angles of all hinges, and rates as large as the scene's or else 1.
    fn random(dice: &mut Dice, hinges: usize, rate: f64) -> Self {
        let mut rates =
            |count: usize| -> Vec<f64> { (0..count).map(|_| dice.between(-rate, rate)).collect() };
        let (omega, tau) = (rates(3), rates(hinges));
        let half_turn = std::f64::consts::PI;
        let beta = (0..hinges).map(|_| dice.between(-half_turn, half_turn)).collect();
        Self { omega: Vec3::new(omega[0], omega[1], omega[2]), beta, tau }
    }

    pub fn motion(&self) -> Motion<'_, f64> {
        Motion { omega_body: self.omega, beta: &self.beta, tau: &self.tau }
    }
}

/// A scene with all hinges free, its thrust on and its kick-off springs disengaged, and random
/// states of it.
pub(crate) struct Subject {
    pub scene: Scene,
    pub dynamics: Recursive<f64>,
    pub states: Vec<State>,
    recognised: Result<Recognised, usize>,
}

impl Subject {
    pub fn new(scene: Scene, states: usize, seed: u64) -> Self {
        let hinges = scene.bodies.len();
        let mode = Mode {
            hinges: vec![HingeState::Free; hinges],
            kick_off: vec![false; hinges],
            thrust: scene.thrust.is_some(),
        };
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &vec![0.0; hinges]);
        let mut dice = Dice::new(seed);
        let of_scene = scene.initial.omega_body.norm();
        let rate = if of_scene > 0.0 { of_scene } else { 1.0 };
        let states = (0..states).map(|_| State::random(&mut dice, hinges, rate)).collect();
        let recognised = recognise(dynamics.tree());
        Self { scene, dynamics, states, recognised }
    }

    /// The recursion, which covers any scene.
    pub fn recursion(&self) -> (Label, Code<'_>) {
        let code = Code::Recursion {
            dynamics: Box::new(self.dynamics.clone()),
            states: &self.states,
            found: Accelerations::for_hinges(self.scene.bodies.len()),
        };
        (Label::generic("recursive"), code)
    }

    /// All other code that covers the scene.
    pub fn others(&self) -> Vec<(Label, Code<'_>)> {
        let form = |form: Formulation| Some((Label::generic(form.name()), self.form(form)?));
        let mut codes: Vec<_> = Formulation::ALL.into_iter().filter_map(form).collect();
        if let Ok(recognised) = &self.recognised {
            let states: Vec<Vec<f64>> = self
                .coordinates(&recognised.links)
                .map(|state| state.write(&recognised.topology))
                .collect();
            let routine =
                |kernel| (Label::generated(kernel), Code::routine(kernel, recognised, &states));
            codes.extend(self.kernels(recognised).map(routine));
        }
        codes
    }

    /// What does not cover the scene, a line for each, and why.
    pub fn not_covered(&self) -> Vec<String> {
        let line = |path: &str, name: &str, why: String| format!("{path:<10} {name:<12} {why}");
        let mut lines = Vec::new();
        for form in Formulation::ALL {
            if let Err(link) = form.covers(self.dynamics.tree()) {
                lines.push(line("generic", form.name(), self.hinge_not_covered(link)));
            }
        }
        match &self.recognised {
            Err(link) => lines.push(line("generated", "", self.hinge_not_covered(*link))),
            Ok(recognised) if self.kernels(recognised).next().is_none() => {
                let why = format!("not covered: no routine for topology {}", recognised.topology);
                lines.push(line("generated", "", why));
            }
            Ok(_) => {}
        }
        lines
    }

    fn hinge_not_covered(&self, link: usize) -> String {
        let hinge = self.dynamics.tree().links[link].hinge;
        format!("not covered: hinge {}", self.scene.label(hinge))
    }

    fn form(&self, formulation: Formulation) -> Option<Code<'_>> {
        match &self.recognised {
            Ok(recognised) => {
                let states = self.coordinates(&recognised.links).collect();
                Some(Code::ClosedForm { formulation, recognised, states })
            }
            Err(_) => (formulation == Formulation::Symmetric).then(|| {
                let links: Vec<usize> = (0..self.scene.bodies.len()).collect();
                Code::Tree { subject: self, states: self.coordinates(&links).collect() }
            }),
        }
    }

    /// The stock routines that take the scene.
    fn kernels(&self, recognised: &Recognised) -> impl Iterator<Item = &'static Kernel> {
        let topology = recognised.topology.to_string();
        let parameters = recognised.parameters.write();
        let external = self.dynamics.external().is_some();
        nboom_routines::all().iter().filter(move |kernel| {
            kernel.topology == topology
                && (kernel.external || !external)
                && kernel.accepts(&parameters)
        })
    }

    /// The states with the forces that act in them, hinges in the order of these links.
    fn coordinates(&self, links: &[usize]) -> impl Iterator<Item = Coordinates<f64>> {
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
}

/// Code with the states it takes.
pub(crate) enum Code<'a> {
    Recursion {
        dynamics: Box<Recursive<f64>>,
        states: &'a [State],
        found: Accelerations<f64>,
    },
    ClosedForm {
        formulation: Formulation,
        recognised: &'a Recognised,
        states: Vec<Coordinates<f64>>,
    },
    /// `symmetric` for a tree that is not made of chains and paddles.
    Tree {
        subject: &'a Subject,
        states: Vec<Coordinates<f64>>,
    },
    Routine {
        kernel: &'a Kernel,
        recognised: &'a Recognised,
        constants: Vec<f64>,
        states: Vec<Vec<f64>>,
        found: Vec<f64>,
    },
}

impl<'a> Code<'a> {
    fn routine(kernel: &'a Kernel, recognised: &'a Recognised, states: &[Vec<f64>]) -> Self {
        let mut constants = vec![0.0; kernel.constants];
        kernel.prepare(&recognised.parameters.write(), &mut constants);
        let found = vec![0.0; kernel.outputs];
        Self::Routine { kernel, recognised, constants, states: states.to_vec(), found }
    }

    /// ω̇, a_O, then τ̇ in the order of the tree's links, in state `i`.
    pub fn accelerations(&mut self, i: usize) -> Vec<f64> {
        match self {
            Self::Recursion { dynamics, states, found } => {
                dynamics.accelerations(&states[i].motion(), found);
                let Accelerations { omega_dot_body, origin_body, tau_dot } = found;
                let main = Twist { angular: *omega_dot_body, linear: *origin_body };
                flat(main, tau_dot, 0..tau_dot.len())
            }
            Self::ClosedForm { formulation, recognised, states } => {
                let Recognised { topology, parameters, links } = recognised;
                let found = formulation.solve(topology, parameters, &states[i]);
                flat(found.main, &found.tau_dot, links.iter().copied())
            }
            Self::Tree { subject, states } => {
                let found = symmetric::solve_tree(subject.dynamics.tree(), &states[i]);
                flat(found.main, &found.tau_dot, 0..found.tau_dot.len())
            }
            Self::Routine { kernel, recognised, constants, states, found } => {
                kernel.evaluate(constants, &states[i], found);
                let vector = |at: usize| Vec3::new(found[at], found[at + 1], found[at + 2]);
                let main = Twist { angular: vector(0), linear: vector(3) };
                let places = Layout::places(&recognised.topology);
                let tau_dot: Vec<f64> =
                    places.iter().map(|place| found[Layout::OUTPUT + place]).collect();
                flat(main, &tau_dot, recognised.links.iter().copied())
            }
        }
    }
}

/// Accelerations in one list, τ̇ of a hinge where its link says.
fn flat(main: Twist<f64>, tau_dot: &[f64], links: impl Iterator<Item = usize>) -> Vec<f64> {
    let mut all = [main.angular.to_array(), main.linear.to_array()].concat();
    all.resize(6 + tau_dot.len(), 0.0);
    for (tau_dot, link) in tau_dot.iter().zip(links) {
        all[6 + link] = *tau_dot;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_model::{
        Appendage, Body, Hinge, MassProperties, Mount, SceneDescription, Segment, Thrust,
    };
    use nboom_scalar::Sym3;

    /// A boom of two segments, and a third one on the first: no chain.
    fn fork() -> Scene {
        let body =
            MassProperties::new(1.0, Vec3::new(0.1, 0.5, 0.2), Sym3::diagonal(1.0, 1.2, 1.4));
        let segment = Segment { length: 1.0, mass_properties: body, hinge: Hinge::free() };
        let mut description = SceneDescription::at_rest("fork", body, 1.0);
        let (force, point) = (Vec3::unit_x(), Vec3::unit_y());
        description.thrust = Some(Thrust { force, point, on: 0.0, off: 1.0 });
        let (mount, segments) = (Mount::at(Vec3::unit_z()), vec![segment; 2]);
        description.attach(&Appendage::Regular { mount, segments });
        let axis = Vec3::unit_z();
        description.bodies.push(Body { inboard: Some(0), axis, ..description.bodies[1] });
        Scene::new(description).expect("the bodies are physical")
    }

    #[test]
    fn a_tree_is_covered_by_the_recursion_and_symmetric_alone() {
        let subject = Subject::new(fork(), 10, 1);
        let (_, mut recursion) = subject.recursion();
        let mut others = subject.others();
        let [(label, symmetric)] = &mut others[..] else { panic!("one other code") };
        assert_eq!(label.words(), "generic symmetric (general)");
        for i in 0..10 {
            let (expected, found) = (recursion.accelerations(i), symmetric.accelerations(i));
            let off = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-11 && expected.len() == 9, "state {i}: {off:e}");
        }
        let lines = subject.not_covered();
        assert_eq!(lines.len(), 5, "{lines:?}");
        assert!(lines.iter().all(|line| line.contains("not covered: hinge 1,")), "{lines:?}");
    }

    #[test]
    fn states_are_as_fast_as_the_scene() {
        let mut description = SceneDescription::clone(&fork());
        description.initial.omega_body = Vec3::unit_y() * 1e-3;
        let subject = Subject::new(Scene::new(description).expect("as before"), 50, 1);
        let rates = subject.states.iter().flat_map(|state| &state.tau);
        assert!(rates.clone().all(|rate| rate.abs() <= 1e-3) && rates.count() == 150);
    }
}
