use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_elements::{Commands, Reach};
use nboom_expr::{Expr, Graph};
use nboom_formulation::Formulation;
use nboom_model::{Mode, RotorMotion, Scene, WeldedTree};
use nboom_scalar::{Real, Vec3};

use crate::code::closed_form::ClosedForm;
use crate::equations::layout::VariableLayout;
use crate::equations::rates::Rates;
use crate::equations::variables::{Variables, carrying_acceleration};

/// What the equations of a mode compute: its variables and the time in, their rates out. They do
/// not branch, so that one recording holds for the whole mode.
///
/// Of all code for the accelerations, the articulated closed form has the smallest graph; where
/// it does not cover the mode, the recursion is recorded. All compute the same ones.
pub(crate) fn graph(
    scene: &Scene,
    mode: &Mode,
    commands: &Commands,
    variables: &Variables<f64>,
) -> Graph {
    let Variables { layout, origin, .. } = variables;
    Graph::trace(layout.len() + 1, |inputs| {
        let (y, t) = (&inputs[..layout.len()], inputs[layout.len()]);
        let mut dynamics = Recursive::new(scene);
        let beta: Vec<Expr> = origin.beta.iter().map(|&angle| Expr::constant(angle)).collect();
        dynamics.set_mode(mode, &beta);
        if commands.reach() != Reach::Nothing {
            dynamics.command(commands);
        }
        let at_start = Expr::constant(origin.time);
        dynamics.spin_from(at_start, origin.rotors.iter().map(RotorMotion::of_constant));
        let tree = WeldedTree::new(scene, mode, &origin.beta);
        let mut form = ClosedForm::fit(scene, &tree, Formulation::Articulated).ok();
        let velocity = Vec3::constant(origin.carried().velocity);
        let carried = velocity + carrying_acceleration(scene, mode) * (t - at_start);
        rates(scene, *layout, &mut dynamics, y, (t, carried), &mut |dynamics, motion, out| {
            match &mut form {
                Some(form) => form.articulated_accelerations(dynamics, motion, out),
                None => by_recursion(dynamics, motion, out),
            }
        })
    })
}

/// The graph of the rates by the recursion, without rounding, for any state that the mode begins
/// in. The time counts from that state; the angle of every hinge, the velocity of what is
/// [carried](crate::equations::state::State::carried), the time and the speeds of the rotors in it
/// are further inputs, after the time.
pub(crate) fn exact_graph(scene: &Scene, mode: &Mode, layout: VariableLayout) -> Graph {
    let (hinges, rotors) = (scene.bodies.len(), scene.rotors.len());
    Graph::trace_exactly(layout.len() + 1 + hinges + 4 + rotors, |inputs| {
        let (y, rest) = inputs.split_at(layout.len());
        let (since, beta, v) = (rest[0], &rest[1..=hinges], &rest[hinges + 1..]);
        let mut dynamics = Recursive::new(scene);
        dynamics.set_mode(mode, beta);
        let turning = scene.rotors.iter().zip(&mode.rotors).zip(&v[4..]);
        dynamics.spin_from(
            v[3],
            turning.map(|((rotor, &piece), &speed)| {
                let acceleration = rotor.speed.acceleration(piece);
                RotorMotion { speed, acceleration }
            }),
        );
        let at_start = Vec3::new(v[0], v[1], v[2]);
        let carried = at_start + carrying_acceleration(scene, mode) * since;
        rates(scene, layout, &mut dynamics, y, (v[3] + since, carried), &mut by_recursion)
    })
}

/// Records accelerations. It is `dyn`, so that all around it is compiled once: over `Expr` that takes long, and it
/// runs once a mode.
type RecordAccelerations<'a> =
    dyn FnMut(&mut Recursive<Expr>, &Motion<'_, Expr>, &mut Accelerations<Expr>) + 'a;

#[inline(never)]
fn by_recursion(
    dynamics: &mut Recursive<Expr>,
    motion: &Motion<'_, Expr>,
    out: &mut Accelerations<Expr>,
) {
    dynamics.accelerations(motion, out);
}

/// The rates of the variables `y` at a time, at which what is carried has a velocity, where
/// `accelerate` computes the accelerations.
fn rates(
    scene: &Scene,
    layout: VariableLayout,
    dynamics: &mut Recursive<Expr>,
    y: &[Expr],
    at: (Expr, Vec3<Expr>),
    accelerate: &mut RecordAccelerations<'_>,
) -> Vec<Expr> {
    let mut rates = vec![Expr::zero(); layout.len()];
    Rates::new(scene, layout).write(dynamics, accelerate, at, y, &mut rates);
    rates
}
