//! Accelerations, mass matrix and forcing of a scene with the same hinges held, at any states.

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{
    Coordinates, Formulation, HingeCoordinates, Recognised, Uncovered, recognise, symmetric,
};
use nboom_model::Scene;
use nboom_scalar::{Batch, Quaternion, Twist, Vec3};
use nboom_sim::{Form, NoRoutine, Options, Path, Repertoire};

use crate::at_state::AtState;
use crate::routine::{LANES, Routine};

/// Code for the equations of motion of a scene, the same at all states.
#[derive(Clone)]
pub(crate) struct Evaluator {
    at_state: AtState,
    code: Code,
    torques: Vec<f64>,
    found: Accelerations<f64>,
}

#[derive(Clone)]
enum Code {
    Recursion,
    ClosedForm { formulation: Formulation, recognised: Option<Box<Recognised>> },
    Routine(Box<Routine>),
}

/// One state: rates, angles and torques of the free hinges in the scene's order.
#[derive(Clone, Copy)]
pub(crate) struct State<'a> {
    pub omega: Vec3<f64>,
    pub beta: &'a [f64],
    pub tau: &'a [f64],
    /// Torques beside those of the scene.
    pub added: Option<&'a [f64]>,
}

/// Eight states, one after the other in each list.
#[derive(Clone, Copy)]
pub(crate) struct EightStates<'a> {
    pub omega: &'a [f64],
    pub beta: &'a [f64],
    pub tau: &'a [f64],
    /// As those of a state.
    pub added: Option<&'a [f64]>,
}

/// Where accelerations go: a row for each state.
pub(crate) struct Found<'a> {
    pub omega_dot: &'a mut [f64],
    pub origin: &'a mut [f64],
    pub tau_dot: &'a mut [f64],
}

impl Found<'_> {
    /// The rows of state number `i`.
    pub fn row(&mut self, i: usize, free: usize) -> [&mut [f64]; 3] {
        let vector = 3 * i..3 * i + 3;
        let Self { omega_dot, origin, tau_dot } = self;
        [
            &mut omega_dot[vector.clone()],
            &mut origin[vector],
            &mut tau_dot[i * free..(i + 1) * free],
        ]
    }
}

/// Why a formulation has no equations, and which have some.
const NO_EQUATIONS: &str =
    "it never forms a mass matrix; report, relative, symmetric or recursive expected";

impl Evaluator {
    /// Code for `scene`, whose hinges are free but those that are held at an angle, chosen as a run with
    /// these options chooses it; batches are those of accelerations.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn new(
        scene: &Scene,
        held: &[Option<f64>],
        options: &Options,
        batches: &[Batch],
    ) -> Result<Self, String> {
        let at_state = AtState::new(scene, held);
        let code = Code::choose(scene, &at_state, options, batches)?;
        let free = at_state.recursion().free_hinges().len();
        let found = Accelerations::for_hinges(free);
        Ok(Self { at_state, code, torques: vec![0.0; free], found })
    }

    /// The free hinges, in the scene's order.
    pub fn free_hinges(&self) -> &[usize] {
        self.at_state.recursion().free_hinges()
    }

    /// `generated` or `generic`, the formulation, and what more there is to say.
    pub fn about(&self) -> (&'static str, &'static str, String) {
        match &self.code {
            Code::Recursion => ("generic", Form::Recursive.name(), String::new()),
            Code::ClosedForm { formulation, .. } => ("generic", formulation.name(), String::new()),
            Code::Routine(routine) => {
                ("generated", routine.formulation(), routine.reason().to_owned())
            }
        }
    }

    /// Says at which attitude, if not at the usual one, and when the next states are.
    pub fn set_outside(&mut self, attitude: Option<Quaternion<f64>>, time: f64) {
        self.at_state.set_outside(attitude, time);
    }

    /// Whether gravity on a main body that is held is as at this attitude.
    pub fn holds_at(&self, attitude: &Quaternion<f64>) -> bool {
        self.at_state.holds_at(attitude)
    }

    /// Writes the accelerations of a state, which has number `i`: ω̇ and a_O without gravity, main-body axes,
    /// and τ̇.
    pub fn accelerations(&mut self, state: &State<'_>, out: &mut Found<'_>, i: usize) {
        let Self { at_state, code, torques, found } = self;
        let recursion = at_state.at([state.beta, state.tau]);
        let [omega_dot, origin, tau_dot] = out.row(i, torques.len());
        let motion = Motion { omega_body: state.omega, beta: state.beta, tau: state.tau };
        match code {
            Code::Recursion => {
                let add = |_: &[usize], torques: &mut [f64]| add(state.added, torques);
                recursion.accelerations_with(add, &motion, found);
                omega_dot.copy_from_slice(&found.omega_dot_body.to_array());
                origin.copy_from_slice(&found.origin_body.to_array());
                tau_dot.copy_from_slice(&found.tau_dot);
            }
            Code::ClosedForm { formulation, recognised } => {
                recursion.hinge_forces(&motion, torques);
                add(state.added, torques);
                let x = coordinates(recursion, recognised.as_deref(), &motion, torques);
                let solution = match recognised {
                    Some(of) => formulation.solve(&of.topology, &of.parameters, &x),
                    None => symmetric::solve_tree(recursion.tree(), &x),
                };
                let Twist { angular, linear } = solution.main;
                omega_dot.copy_from_slice(&angular.to_array());
                origin.copy_from_slice(&linear.to_array());
                for (k, &found) in solution.tau_dot.iter().enumerate() {
                    tau_dot[link(recognised.as_deref(), k)] = found;
                }
            }
            Code::Routine(routine) => {
                recursion.hinge_forces(&motion, torques);
                add(state.added, torques);
                routine.accelerations(recursion, &motion, torques, [omega_dot, origin, tau_dot]);
            }
        }
        self.hold(out, i);
    }

    /// Writes the accelerations of eight states at once, the first of which has number `first`, if there is
    /// code that does.
    pub fn accelerations_of_eight(
        &mut self,
        states: &EightStates<'_>,
        out: &mut Found<'_>,
        first: usize,
    ) -> bool {
        match &mut self.code {
            Code::Routine(routine) => {
                let found = routine.accelerations_of_eight(&mut self.at_state, states, out, first);
                (first..first + LANES).filter(|_| found).for_each(|i| self.hold(out, i));
                found
            }
            _ => false,
        }
    }

    /// Sets the accelerations of a main body that is held, of state number `i`, to what they are but for rounding.
    fn hold(&self, out: &mut Found<'_>, i: usize) {
        if let Some(held) = self.at_state.recursion().tree().held {
            let [omega_dot, origin, _] = out.row(i, self.torques.len());
            omega_dot.copy_from_slice(&held.angular.to_array());
            origin.copy_from_slice(&held.linear.to_array());
        }
    }

    /// Writes the matrix, row by row, and the right side of the formulation in a state, with O at the inertial
    /// origin and hinges in the scene's order. What holds a main body is in the right side.
    ///
    /// # Errors
    /// Why the formulation forms none, and which do.
    pub fn equations(
        &mut self,
        state: &State<'_>,
        matrix: &mut [f64],
        right: &mut [f64],
    ) -> Result<(), &'static str> {
        let Self { at_state, code, torques, found } = self;
        let recursion = at_state.at([state.beta, state.tau]);
        let motion = Motion { omega_body: state.omega, beta: state.beta, tau: state.tau };
        let (formulation, recognised) = match code {
            Code::ClosedForm { formulation, recognised } => (*formulation, recognised.as_deref()),
            Code::Recursion | Code::Routine(_) => {
                recursion.equations(&motion, matrix, right);
                add(state.added, &mut right[6..]);
                if recursion.tree().held.is_some() {
                    let add = |_: &[usize], torques: &mut [f64]| add(state.added, torques);
                    recursion.accelerations_with(add, &motion, found);
                    recursion.hold(found);
                    hold(found, matrix, right);
                }
                return Ok(());
            }
        };
        if recursion.tree().held.is_some() {
            return Err("the main body is held, and it is for free ones; recursive expected");
        }
        recursion.hinge_forces(&motion, torques);
        add(state.added, torques);
        let x = coordinates(recursion, recognised, &motion, torques);
        let (rows, forcing) = match recognised {
            Some(of) => match formulation.equations(&of.topology, &of.parameters, &x) {
                Some(found) => (found.matrix, found.forcing),
                None => return Err(NO_EQUATIONS),
            },
            None => {
                let tree = recursion.tree();
                (symmetric::tree_mass_matrix(tree, &x), symmetric::tree_forcing(tree, &x))
            }
        };
        let size = right.len();
        let place = |k: usize| if k < 6 { k } else { 6 + link(recognised, k - 6) };
        for i in 0..size {
            right[place(i)] = forcing[i];
            for j in 0..size {
                matrix[place(i) * size + place(j)] = rows[i * size + j];
            }
        }
        Ok(())
    }
}

impl Code {
    fn choose(
        scene: &Scene,
        at_state: &AtState,
        options: &Options,
        batches: &[Batch],
    ) -> Result<Self, String> {
        let (recursion, pushed) = (at_state.recursion(), at_state.may_act_on_main_body());
        let recognised = recognise(recursion.tree());
        let library = || match options.formulation {
            None | Some(Form::Recursive) => Ok(Self::Recursion),
            Some(Form::Closed(formulation)) => {
                formulation.covers(recursion.tree()).map_err(|Uncovered { link, .. }| {
                    let hinge = scene.label(recursion.tree().links[link].hinge);
                    format!("formulation {formulation} does not cover hinge {hinge}")
                })?;
                let takes = |found: &Recognised| formulation.takes(&found.topology);
                let recognised = recognise(recursion.tree()).ok().filter(takes).map(Box::new);
                Ok(Self::ClosedForm { formulation, recognised })
            }
        };
        if options.path == Path::Generic || options.formulation == Some(Form::Recursive) {
            return library();
        }
        let fit = recognised.as_ref().ok().and_then(|recognised| {
            let fit = Repertoire::new(options).best(recognised, pushed)?;
            Some((recognised, fit))
        });
        match (fit, recognised.as_ref()) {
            (Some((recognised, fit)), _) => {
                Ok(Self::Routine(Box::new(Routine::new(&fit, recognised, batches))))
            }
            (None, Ok(recognised)) if options.path == Path::Generated => {
                Err(NoRoutine::because(recognised, pushed, options).to_string())
            }
            (None, Err(&why)) if options.path == Path::Generated => {
                Err(NoRoutine::of_tree(why, scene, recursion.tree(), options.formulation)
                    .to_string())
            }
            (None, _) => library(),
        }
    }
}

/// Adds to the right side what holds a main body in the motion with the accelerations that were `found`.
fn hold(found: &Accelerations<f64>, matrix: &[f64], right: &mut [f64]) {
    let of_main = [found.origin_body, found.omega_dot_body].into_iter().flat_map(Vec3::to_array);
    let accelerations: Vec<f64> = of_main.chain(found.tau_dot.iter().copied()).collect();
    let rows = matrix.chunks(accelerations.len());
    for (force, row) in right[..6].iter_mut().zip(rows) {
        *force = row.iter().zip(&accelerations).map(|(entry, of)| entry * of).sum();
    }
}

pub(crate) fn add(added: Option<&[f64]>, torques: &mut [f64]) {
    let added = added.into_iter().flatten();
    torques.iter_mut().zip(added).for_each(|(torque, added)| *torque += added);
}

/// The free hinge that is number `k` of a closed form.
fn link(recognised: Option<&Recognised>, k: usize) -> usize {
    recognised.map_or(k, |recognised| recognised.links[k])
}

fn coordinates(
    recursion: &Recursive<f64>,
    recognised: Option<&Recognised>,
    motion: &Motion<'_, f64>,
    torques: &[f64],
) -> Coordinates<f64> {
    let hinge = |k: usize| {
        let j = link(recognised, k);
        HingeCoordinates { beta: motion.beta[j], tau: motion.tau[j], torque: torques[j] }
    };
    let external = recursion.acting_on_main_body(motion.omega_body);
    let hinges = (0..torques.len()).map(hinge).collect();
    Coordinates { omega: motion.omega_body, external, hinges }
}
