use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{
    Coordinates, Formulation, HingeCoordinates, Parameters, Solution, Uncovered, Why, articulated,
    recognise, symmetric,
};
use nboom_model::{HingeLabel, Scene, Topology, WeldedTree};
use nboom_scalar::{Real, Vec3, Wrench};

/// A closed form fitted to a scene in one mode, over any scalar.
#[derive(Clone, Debug)]
pub(crate) struct ClosedForm<R> {
    formulation: Formulation,
    /// `None` for a tree that `symmetric` alone covers: what is not made of chains, paddles and limbs.
    recognised: Option<(Topology, Parameters<R>)>,
    coordinates: Coordinates<R>,
    /// For each hinge of the coordinates, its link.
    links: Vec<usize>,
    torques: Vec<R>,
}

/// A formulation is written for other trees than that of the mode.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotCovered {
    /// It does not take what is on a hinge.
    #[error("formulation {formulation} does not cover hinge {hinge}, {}", in_words(*why))]
    Hinge {
        /// The formulation.
        formulation: Formulation,
        /// The first hinge that it does not cover.
        hinge: HingeLabel,
        /// Why not.
        why: Why,
    },
    /// Something of the whole scene has no place in it.
    #[error("formulation {formulation} does not cover {what}")]
    Scene {
        /// The formulation.
        formulation: Formulation,
        /// What has no place.
        what: &'static str,
    },
}

/// Why a hinge is not covered, as words behind it.
fn in_words(why: Why) -> String {
    match why {
        Why::Shape => "which belongs neither to a chain nor to a paddle of rigid bodies".to_owned(),
        Why::Links => format!("whose appendage {why}"),
        Why::NotRigid | Why::Rotor => format!("whose body {why}"),
    }
}

/// What in `scene` keeps momenta from standing for rates.
pub(crate) fn without_momenta(scene: &Scene) -> Option<&'static str> {
    // The reaction of what holds it changes them.
    let held = scene.base.is_held().then_some("a main body that is held");
    // The momenta of rotors are not counted.
    let rotors = (!scene.rotors.is_empty()).then_some("rotors");
    // Where it turns or holds a hinge, rates tell and not momenta.
    let friction = scene.hinges_with_friction().next().map(|_| "friction");
    let has_stops = scene.bodies.iter().any(|body| !body.hinge.stops.is_none());
    held.or(rotors).or(friction).or(has_stops.then_some("stops"))
}

impl<R: Real> ClosedForm<R> {
    /// The closed form for the mode of `tree`.
    ///
    /// # Errors
    /// When the formulation does not cover it.
    pub fn fit(
        scene: &Scene,
        tree: &WeldedTree<f64>,
        formulation: Formulation,
    ) -> Result<Self, NotCovered> {
        if let Some(what) = without_momenta(scene).filter(|_| formulation == Formulation::Momentum)
        {
            return Err(NotCovered::Scene { formulation, what });
        }
        formulation.covers(tree).map_err(|Uncovered { link, why }| NotCovered::Hinge {
            formulation,
            hinge: scene.label(tree.links[link].hinge),
            why,
        })?;
        let recognised = recognise(tree).ok().filter(|found| formulation.takes(&found.topology));
        let in_tree_order = || (0..tree.links.len()).collect();
        let links = recognised.as_ref().map_or_else(in_tree_order, |found| found.links.clone());
        let recognised = recognised.map(|found| {
            let parameters = found.parameters.write().into_iter().map(R::constant);
            let parameters = Parameters::read(&found.topology, parameters);
            (found.topology, parameters)
        });
        let at_rest = HingeCoordinates { beta: R::zero(), tau: R::zero(), torque: R::zero() };
        let coordinates = Coordinates {
            omega: Vec3::zero(),
            external: Wrench::zero(),
            hinges: vec![at_rest; links.len()],
        };
        let torques = vec![R::zero(); links.len()];
        Ok(Self { formulation, recognised, coordinates, links, torques })
    }

    /// The formulation.
    pub fn formulation(&self) -> Formulation {
        self.formulation
    }

    /// As [`accelerations`](ClosedForm::accelerations), of a form fitted as [`Formulation::Articulated`], so that no
    /// other is compiled over `R`.
    pub fn articulated_accelerations(
        &mut self,
        dynamics: &mut Recursive<R>,
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
    ) {
        debug_assert_eq!(self.formulation, Formulation::Articulated);
        self.accelerations_by(dynamics, motion, out, |recognised, _, x| {
            let (topology, parameters) = recognised.expect("articulated fits what is recognised");
            articulated::solve(topology, parameters, x)
        });
    }

    /// Writes the accelerations that `solve` finds for what was recognised, or else for the tree.
    fn accelerations_by(
        &mut self,
        dynamics: &mut Recursive<R>,
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
        solve: impl FnOnce(
            Option<&(Topology, Parameters<R>)>,
            &WeldedTree<R>,
            &Coordinates<R>,
        ) -> Solution<R>,
    ) {
        dynamics.hinge_forces(motion, &mut self.torques);
        let x = &mut self.coordinates;
        x.omega = motion.omega_body;
        x.external = dynamics.acting_on_main_body(motion.omega_body);
        for (hinge, &j) in x.hinges.iter_mut().zip(&self.links) {
            let (beta, tau, torque) = (motion.beta[j], motion.tau[j], self.torques[j]);
            *hinge = HingeCoordinates { beta, tau, torque };
        }
        let found = solve(self.recognised.as_ref(), dynamics.tree(), x);
        out.omega_dot_body = found.main.angular;
        out.origin_body = found.main.linear;
        for (&tau_dot, &j) in found.tau_dot.iter().zip(&self.links) {
            out.tau_dot[j] = tau_dot;
        }
    }
}

impl ClosedForm<f64> {
    /// Accelerations of the mode it was fitted to: ω̇, a_O without gravity, τ̇.
    pub fn accelerations(
        &mut self,
        dynamics: &mut Recursive<f64>,
        motion: &Motion<'_, f64>,
        out: &mut Accelerations<f64>,
    ) {
        let formulation = self.formulation;
        self.accelerations_by(dynamics, motion, out, |recognised, tree, x| match recognised {
            Some((topology, parameters)) => formulation.solve(topology, parameters, x),
            None => symmetric::solve_tree(tree, x),
        });
    }
}
