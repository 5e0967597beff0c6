use nboom_dynamics::{Accelerations, Recursive};
use nboom_expr::{Expr, Graph};
use nboom_formulation::Formulation;
use nboom_model::{Mode, Scene, Thrust, WeldedTree};
use nboom_scalar::{Real, Vec3};

use crate::closed_form::ClosedForm;
use crate::equations::motion;
use crate::layout::Layout;
use crate::rates::Rates;
use crate::state::State;

/// What the equations of a mode compute: its variables and the time in, their rates out. They do
/// not branch, so that one recording holds for the whole mode.
///
/// Of all code for the accelerations, the articulated closed form has the smallest graph; where
/// it does not cover the mode, the recursion is recorded. All compute the same ones.
pub(crate) fn graph(
    scene: &Scene,
    mode: &Mode,
    origin: &State,
    layout: Layout,
    thrust: Option<Thrust>,
    gravity: Vec3<f64>,
) -> Graph {
    Graph::trace(layout.len() + 1, |inputs| {
        let (y, t) = (&inputs[..layout.len()], inputs[layout.len()]);
        let mut dynamics = Recursive::new(scene);
        let beta: Vec<Expr> = origin.beta.iter().map(|&angle| Expr::constant(angle)).collect();
        dynamics.set_mode(mode, &beta);
        let mut accelerations = Accelerations::for_hinges(layout.free);
        let motion = motion(&layout, &mut dynamics, y);
        let tree = WeldedTree::new(scene, mode, &origin.beta);
        match ClosedForm::fit(scene, &tree, dynamics.external(), Formulation::Articulated) {
            Ok(mut form) => form.accelerations(&mut dynamics, &motion, &mut accelerations),
            Err(_) => dynamics.accelerations(&motion, &mut accelerations),
        }
        let since = t - Expr::constant(origin.time);
        let free_fall = Vec3::constant(origin.center.velocity) + Vec3::constant(gravity) * since;
        let mut rates = vec![Expr::zero(); layout.len()];
        let of_mode = Rates::new(scene, layout, dynamics.free_hinges(), thrust);
        of_mode.write(&mut dynamics, (&motion, &accelerations), free_fall, y, &mut rates);
        rates
    })
}
