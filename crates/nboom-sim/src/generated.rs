use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{Layout, recognise};
use nboom_model::WeldedTree;
use nboom_scalar::{Kernel, Vec3};

/// A generated routine fitted to a scene in one mode.
#[derive(Clone, Debug)]
pub(crate) struct Generated {
    kernel: Kernel,
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
    #[error("hinge number {hinge} belongs neither to a chain nor to a paddle")]
    Tree {
        /// The first hinge that does not, from 1.
        hinge: usize,
    },
    /// No routine has the mode's topology and takes nothing for granted that does not hold.
    #[error("no routine for topology {topology}")]
    Topology {
        /// The mode's topology.
        topology: String,
    },
}

impl Generated {
    /// The most specialised of `kernels` that fits what `dynamics` computes in its mode.
    ///
    /// # Errors
    /// Why none does.
    pub fn fit(dynamics: &Recursive<f64>, kernels: &[Kernel]) -> Result<Self, NoRoutine> {
        let tree: &WeldedTree<f64> = dynamics.tree();
        let recognised = recognise(tree)
            .map_err(|link| NoRoutine::Tree { hinge: tree.links[link].hinge + 1 })?;
        let topology = recognised.topology.to_string();
        let parameters = recognised.parameters.write();
        let external = dynamics.external().is_some();
        let fits = |kernel: &&Kernel| {
            kernel.topology == topology
                && (kernel.external || !external)
                && kernel.accepts(&parameters)
        };
        let best = kernels.iter().filter(fits).max_by_key(|kernel| kernel.pinned.len());
        let Some(&kernel) = best else { return Err(NoRoutine::Topology { topology }) };
        let mut constants = vec![0.0; kernel.constants];
        kernel.prepare(&parameters, &mut constants);
        let places = Layout::places(&recognised.topology);
        let place_of = |place| Place {
            in_state: Layout::hinge_in_state(&recognised.topology, place),
            in_output: Layout::OUTPUT + place,
        };
        let mut hinges = vec![Place { in_state: [0; 3], in_output: 0 }; places.len()];
        for (&link, place) in recognised.links.iter().zip(places) {
            hinges[link] = place_of(place);
        }
        Ok(Self {
            constants,
            coordinates: vec![0.0; kernel.coordinates],
            outputs: vec![0.0; kernel.outputs],
            torques: vec![0.0; hinges.len()],
            hinges,
            kernel,
        })
    }

    /// The routine.
    pub fn kernel(&self) -> &Kernel {
        &self.kernel
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
        self.kernel.evaluate(&self.constants, x, &mut self.outputs);
        let vector =
            |at: usize| Vec3::new(self.outputs[at], self.outputs[at + 1], self.outputs[at + 2]);
        out.omega_dot_body = vector(0);
        out.origin_body = vector(3);
        for (tau_dot, place) in out.tau_dot.iter_mut().zip(&self.hinges) {
            *tau_dot = self.outputs[place.in_output];
        }
    }
}
