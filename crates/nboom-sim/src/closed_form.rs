use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{
    Coordinates, Formulation, HingeCoordinates, Recognised, recognise, symmetric,
};
use nboom_model::{HingeLabel, Scene};
use nboom_scalar::{Vec3, Wrench};

/// A closed form fitted to a scene in one mode.
#[derive(Clone, Debug)]
pub(crate) struct ClosedForm {
    formulation: Formulation,
    /// `None` for a tree that is not made of chains and paddles, which `symmetric` alone covers.
    recognised: Option<Recognised>,
    coordinates: Coordinates<f64>,
    /// For each hinge of the coordinates, its link.
    links: Vec<usize>,
    torques: Vec<f64>,
}

/// A formulation is written for chains and paddles, and the mode is not made of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "formulation {formulation} does not cover hinge {hinge}, which belongs neither to a chain nor \
     to a paddle"
)]
pub struct NotCovered {
    /// The formulation.
    pub formulation: Formulation,
    /// The first hinge that it does not cover.
    pub hinge: HingeLabel,
}

impl ClosedForm {
    /// The closed form of what `dynamics` computes in its mode.
    ///
    /// # Errors
    /// When the formulation does not cover it.
    pub fn fit(
        scene: &Scene,
        dynamics: &Recursive<f64>,
        formulation: Formulation,
    ) -> Result<Self, NotCovered> {
        let tree = dynamics.tree();
        formulation.covers(tree).map_err(|link| NotCovered {
            formulation,
            hinge: scene.label(tree.links[link].hinge),
        })?;
        let recognised = recognise(tree).ok();
        let in_tree_order = || (0..tree.links.len()).collect();
        let links = recognised.as_ref().map_or_else(in_tree_order, |found| found.links.clone());
        let hinges = vec![HingeCoordinates { beta: 0.0, tau: 0.0, torque: 0.0 }; links.len()];
        let coordinates = Coordinates {
            omega: Vec3::zero(),
            external: dynamics.external().unwrap_or(Wrench::zero()),
            hinges,
        };
        let torques = vec![0.0; links.len()];
        Ok(Self { formulation, recognised, coordinates, links, torques })
    }

    /// The formulation.
    pub fn formulation(&self) -> Formulation {
        self.formulation
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
        x.omega = motion.omega_body;
        for (hinge, &j) in x.hinges.iter_mut().zip(&self.links) {
            let (beta, tau, torque) = (motion.beta[j], motion.tau[j], self.torques[j]);
            *hinge = HingeCoordinates { beta, tau, torque };
        }
        let found = match &self.recognised {
            Some(Recognised { topology, parameters, .. }) => {
                self.formulation.solve(topology, parameters, x)
            }
            None => symmetric::solve_tree(dynamics.tree(), x),
        };
        out.omega_dot_body = found.main.angular;
        out.origin_body = found.main.linear;
        for (&tau_dot, &j) in found.tau_dot.iter().zip(&self.links) {
            out.tau_dot[j] = tau_dot;
        }
    }
}
