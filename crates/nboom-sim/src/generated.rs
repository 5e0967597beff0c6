use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::recognise;
use nboom_model::{HingeLabel, Scene};
use nboom_scalar::Vec3;

use crate::fit::Fit;
use crate::options::{Form, Options};

/// A generated routine fitted to a scene in one mode.
#[derive(Clone, Debug)]
pub(crate) struct Generated {
    fit: Fit,
    constants: Vec<f64>,
    coordinates: Vec<f64>,
    outputs: Vec<f64>,
    hinges: Vec<Place>,
    torques: Vec<f64>,
}

/// Where the numbers of one free hinge stand in a state and in the accelerations.
#[derive(Clone, Copy, Debug)]
struct Place {
    in_state: [usize; 3],
    in_output: usize,
}

/// Why no routine fits.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoRoutine {
    /// The mode is not made of chains and paddles.
    #[error("no {}: hinge {hinge} belongs neither to a chain nor to a paddle", routine(.form))]
    Tree {
        /// The formulation asked for.
        form: Option<Form>,
        /// The first hinge that does not.
        hinge: HingeLabel,
    },
    /// The mode's topology fits into that of no routine which takes nothing for granted that does
    /// not hold and is not too large for it.
    #[error("no {} for topology {topology}", routine(.form))]
    Topology {
        /// The formulation asked for.
        form: Option<Form>,
        /// The mode's topology.
        topology: String,
    },
}

fn routine(form: &Option<Form>) -> String {
    form.map_or_else(|| "routine".to_owned(), |form| format!("{form} routine"))
}

impl Generated {
    /// The routine that [`Fit::best`] finds for what `dynamics` computes in its mode.
    ///
    /// # Errors
    /// Why none does.
    pub fn fit(
        scene: &Scene,
        dynamics: &Recursive<f64>,
        options: &Options,
    ) -> Result<Self, NoRoutine> {
        let (form, tree) = (options.formulation, dynamics.tree());
        let recognised = recognise(tree)
            .map_err(|link| NoRoutine::Tree { form, hinge: scene.label(tree.links[link].hinge) })?;
        let fit =
            Fit::best(&recognised, dynamics.external().is_some(), options).ok_or_else(|| {
                NoRoutine::Topology { form, topology: recognised.topology.to_string() }
            })?;
        let mut hinges = vec![Place { in_state: [0; 3], in_output: 0 }; recognised.links.len()];
        for (&link, (in_state, in_output)) in recognised.links.iter().zip(fit.hinges()) {
            hinges[link] = Place { in_state, in_output };
        }
        Ok(Self {
            constants: fit.constants(),
            coordinates: vec![0.0; fit.kernel.coordinates],
            outputs: vec![0.0; fit.kernel.outputs],
            torques: vec![0.0; hinges.len()],
            hinges,
            fit,
        })
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
        dynamics.hinge_forces(motion, &mut self.torques);
        let x = &mut self.coordinates;
        x[..3].copy_from_slice(&motion.omega_body.to_array());
        if let Some(external) = dynamics.external() {
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
