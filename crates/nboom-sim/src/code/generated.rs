use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{Layout, Recognised, Uncovered, Why};
use nboom_model::{HingeLabel, Scene, WeldedTree};
use nboom_scalar::{Kernel, Vec3};

use crate::code::fit::{Fit, Repertoire};
use crate::options::{Form, Options};

/// A generated routine fitted to a scene in one mode.
#[derive(Clone, Debug)]
pub(crate) struct Generated {
    fit: Fit,
    constants: Vec<f64>,
    /// Whether the constants are those of the fit: where a right side does all, nothing asks for them.
    is_prepared: bool,
    coordinates: Vec<f64>,
    outputs: Vec<f64>,
    hinges: Vec<HingeNumbers>,
    torques: Vec<f64>,
}

/// Where the numbers of one free hinge stand in a state and in the accelerations.
#[derive(Clone, Copy, Debug)]
struct HingeNumbers {
    in_state: [usize; 3],
    in_output: usize,
}

/// Why no routine fits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoRoutine {
    /// A body is not rigid or carries a rotor, or an appendage is too large.
    #[error("no {}: what hinge {hinge} carries {why}", routine(.form))]
    Tree {
        /// The formulation asked for.
        form: Option<Form>,
        /// The first such hinge.
        hinge: HingeLabel,
        /// What it is.
        why: Why,
    },
    /// No routine is for the mode's topology, and none is for a larger one that it fits into and
    /// that is not too large for it.
    #[error("no {} for topology {topology}", routine(.form))]
    Topology {
        /// The formulation asked for.
        form: Option<Form>,
        /// The mode's topology.
        topology: String,
    },
    /// Routines for the mode's topology assume what does not hold.
    #[error("no {} for topology {topology} fits: {unmet}", routine(.form))]
    Unmet {
        /// The formulation asked for.
        form: Option<Form>,
        /// The mode's topology.
        topology: String,
        /// What does not hold first, of the routine with the fewest assumptions that fail.
        unmet: Unmet,
    },
}

/// An assumption of a routine that does not hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unmet {
    /// Something acts on the main body from outside.
    #[error("it assumes that nothing acts on the main body from outside")]
    External,
    /// A parameter has another value.
    #[error("{parameter} is {found}, and {assumed} is assumed")]
    Parameter {
        /// Which one, in words.
        parameter: String,
        /// The value assumed.
        assumed: f64,
        /// Its value in the mode.
        found: f64,
    },
    /// A parameter is too large for a number.
    #[error("{parameter} is {found}, and finite numbers are assumed")]
    NotFinite {
        /// Which one, in words.
        parameter: String,
        /// Its value in the mode.
        found: f64,
    },
}

impl NoRoutine {
    /// Why none fits the tree of a mode of `scene`, which is not made of chains and paddles.
    pub fn of_tree(
        Uncovered { link, why }: Uncovered,
        scene: &Scene,
        tree: &WeldedTree<f64>,
        form: Option<Form>,
    ) -> Self {
        Self::Tree { form, hinge: scene.label(tree.links[link].hinge), why }
    }

    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Tree { form: Some(Form::Recursive), .. }
            | Self::Topology { form: Some(Form::Recursive), .. }
            | Self::Unmet { form: Some(Form::Recursive), .. } => "the recursion is library code",
            Self::Tree { .. } => "the generic path computes it",
            Self::Topology { .. } | Self::Unmet { .. } => {
                "routines can be generated, or the generic path used"
            }
        }
    }

    /// Why none of the routines that `options` allow fits a mode of chains and paddles, in which
    /// something acts on the main body from outside or nothing does (`external`).
    pub fn because(recognised: &Recognised, external: bool, options: &Options) -> Self {
        let (form, topology) = (options.formulation, recognised.topology.to_string());
        let parameters = recognised.parameters.write();
        let unmet = |kernel: &Kernel| -> Vec<Unmet> {
            let wrench = (external && !kernel.external).then_some(Unmet::External);
            let wrong = kernel.assumptions.iter().filter(|&&(i, assumed)| parameters[i] != assumed);
            let parameter = |&(i, assumed): &(usize, f64)| Unmet::Parameter {
                parameter: Layout::name(&recognised.topology, i),
                assumed,
                found: parameters[i],
            };
            let infinite = parameters.iter().enumerate().filter(|(_, found)| !found.is_finite());
            let not_finite = |(i, &found): (usize, &f64)| Unmet::NotFinite {
                parameter: Layout::name(&recognised.topology, i),
                found,
            };
            let wrong = wrong.map(parameter).chain(infinite.map(not_finite));
            wrench.into_iter().chain(wrong).collect()
        };
        let asked_for = options.kernels.iter().filter(|kernel| {
            (kernel.topology == topology && kernel.parameters == parameters.len())
                && form.is_none_or(|form| kernel.formulation == form.name())
        });
        let least = asked_for.map(unmet).min_by_key(Vec::len);
        match least.and_then(|unmet| unmet.into_iter().next()) {
            Some(unmet) => Self::Unmet { form, topology, unmet },
            None => Self::Topology { form, topology },
        }
    }
}

fn routine(form: &Option<Form>) -> String {
    form.map_or_else(|| "routine".to_owned(), |form| format!("{form} routine"))
}

impl Generated {
    /// The best routine of `repertoire` for what `dynamics` computes in its mode, whose tree was
    /// `recognised` or not.
    ///
    /// # Errors
    /// Why none does.
    pub fn fit(
        scene: &Scene,
        dynamics: &Recursive<f64>,
        recognised: Result<&Recognised, Uncovered>,
        repertoire: &mut Repertoire,
        options: &Options,
    ) -> Result<Self, NoRoutine> {
        let (form, tree) = (options.formulation, dynamics.tree());
        let recognised = recognised.map_err(|why| NoRoutine::of_tree(why, scene, tree, form))?;
        let external = dynamics.acts_on_main_body();
        let fit = repertoire
            .best(recognised, external)
            .ok_or_else(|| NoRoutine::because(recognised, external, options))?;
        let mut generated = Self {
            constants: vec![0.0; fit.kernel.constants],
            is_prepared: false,
            coordinates: vec![0.0; fit.kernel.coordinates],
            outputs: vec![0.0; fit.kernel.outputs],
            torques: vec![0.0; recognised.links.len()],
            hinges: vec![HingeNumbers { in_state: [0; 3], in_output: 0 }; recognised.links.len()],
            fit,
        };
        generated.place(recognised);
        Ok(generated)
    }

    /// Takes the numbers of another satellite in the same mode, if the same routine is the best there.
    pub fn renew(
        &mut self,
        dynamics: &Recursive<f64>,
        recognised: &Recognised,
        repertoire: &mut Repertoire,
    ) -> bool {
        let external = dynamics.acts_on_main_body();
        let is_same = repertoire.renew(&mut self.fit, recognised, external);
        if is_same {
            self.is_prepared = false;
            // Something may have acted on the main body where nothing does now.
            self.coordinates.fill(0.0);
            self.place(recognised);
        }
        is_same
    }

    /// Notes where the numbers of each link stand.
    fn place(&mut self, recognised: &Recognised) {
        for (&link, (in_state, in_output)) in recognised.links.iter().zip(self.fit.hinges()) {
            self.hinges[link] = HingeNumbers { in_state, in_output };
        }
    }

    /// The routine, and how the mode fits it.
    pub fn routine(&self) -> &Fit {
        &self.fit
    }

    /// Accelerations of the mode it was fitted to: ω̇, a_O without gravity, τ̇.
    pub fn accelerations(
        &mut self,
        dynamics: &mut Recursive<f64>,
        motion: &Motion<'_, f64>,
        out: &mut Accelerations<f64>,
    ) {
        if !self.is_prepared {
            self.fit.write_constants(&mut self.constants);
            self.is_prepared = true;
        }
        dynamics.hinge_forces(motion, &mut self.torques);
        let x = &mut self.coordinates;
        x[..3].copy_from_slice(&motion.omega_body.to_array());
        if dynamics.acts_on_main_body() {
            let external = dynamics.acting_on_main_body(motion.omega_body);
            x[3..6].copy_from_slice(&external.moment.to_array());
            x[6..9].copy_from_slice(&external.force.to_array());
        }
        for (j, place) in self.hinges.iter().enumerate() {
            let [beta, tau, torque] = place.in_state;
            (x[beta], x[tau], x[torque]) = (motion.beta[j], motion.tau[j], self.torques[j]);
        }
        self.fit.kernel.evaluate(&self.constants, x, &mut self.outputs);
        let vector =
            |at: usize| Vec3::new(self.outputs[at], self.outputs[at + 1], self.outputs[at + 2]);
        out.omega_dot_body = vector(0);
        out.origin_body = vector(3);
        for (tau_dot, place) in out.tau_dot.iter_mut().zip(&self.hinges) {
            *tau_dot = self.outputs[place.in_output];
        }
    }
}
