//! Closed forms against the recursive path, which shares only spatial algebra with them.

use nboom::dynamics::{Accelerations, Motion};
use nboom::formulation::{Coordinates, Formulation, HingeCoordinates, recognise};
use nboom::model::WeldedTree;
use nboom::scalar::{Vec3, Wrench};

use crate::forward_dynamics::cases;
use crate::support::relative_error;

#[test]
fn articulated_gives_the_accelerations_of_the_recursive_path() {
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let motion = Motion { omega_body: case.omega, beta: &beta, tau: &tau };
        let mut expected = Accelerations::for_hinges(beta.len());
        dynamics.accelerations(&motion, &mut expected);

        let tree = WeldedTree::new(&case.scene, &case.mode, &case.beta);
        let recognised = recognise(&tree).expect("chains and paddles");
        let mut torques = vec![0.0; beta.len()];
        dynamics.hinge_forces(&motion, &mut torques);
        let hinge =
            |&j: &usize| HingeCoordinates { beta: beta[j], tau: tau[j], torque: torques[j] };
        let external = crate::random_scene::thrust(&case.scene, &case.mode);
        let coordinates = Coordinates {
            omega: case.omega,
            external: external.map_or(Wrench::zero(), |t| Wrench::of_force(t.point, t.amount)),
            hinges: recognised.links.iter().map(hinge).collect(),
        };
        let found = Formulation::Articulated.solve(
            &recognised.topology,
            &recognised.parameters,
            &coordinates,
        );
        let flat =
            |omega: Vec3<f64>, origin: Vec3<f64>| [omega.to_array(), origin.to_array()].concat();
        let mut all_found = flat(found.main.angular, found.main.linear);
        let mut all_expected = flat(expected.omega_dot_body, expected.origin_body);
        all_found.extend(&found.tau_dot);
        all_expected.extend(recognised.links.iter().map(|&j| expected.tau_dot[j]));
        let error = relative_error(&all_found, &all_expected, 0.0);
        assert!(error < 1e-12, "case {id}: {error:e}");
    }
}
