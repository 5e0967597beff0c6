//! Limbs too large for a straight line, and limbs of which equal parts go side by side: generated code, compiled and
//! run, against the closed form and the recursion.

#[path = "../../../tests/support/random_scene.rs"]
mod random_scene;

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::elements::HingeLaw;
use nboom::formulation::{
    Coordinates, Forces, Formulation, HingeCoordinates, Layout, Recognised, RightSideLayout,
    Solution, recognise, right_side,
};
use nboom::model::{
    Body, Hinge, Joint, LimbJoint, Mount, Scene, SceneDescription, Shape, Spring, Topology,
};
use nboom::scalar::{Kernel, Routine, Twist, Vec3, Wrench};

use random_scene::Rng;

nboom::routine! { Snake: Trrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr, level = exact }
nboom::routine! { SnakeMoves: Trrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr, right_side }
nboom::routine! { Branching: "Trppr(pprprrpprrrsrpprr(rrs)(rp)(s))(pprprrpprrrsrpprr(rrs)(rp)(s))(pprprrpprrrsrpprr(rrs)(rp)(s))", external }
nboom::routine! { Three: 3xTrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr, external }
nboom::routine! { Torso: "Trrr(rrsrprr)(rrsrprr)(pr)", external }
nboom::routine! { TorsoMoves: "Trrr(rrsrprr)(rrsrprr)(pr)", right_side, external }
nboom::routine! { Hand: "Trr(rrprr)(rrprr)(rrprr)(rrprr)", level = exact }
nboom::routine! { OnOne: "Trr(rs)(rs)(r)(r)(r)", level = exact }
nboom::routine! { OnSeveral: "Tr(r(rr)(rr)(rr))(sr(rs)(rs))(s)", right_side, external }
nboom::routine! { Nine: "Trr(rs)(rs)(rs)(rs)(rs)(rs)(rs)(rs)(rs)", external }
nboom::routine! { Several: "Trr(rr(rs)(rs)(rs))(rr(rs)(rs)(rs))(r)_Tsr(rr)(rr)(rr)(rr)(rr)", external }

const STATES: usize = 20;

/// A main body with the limbs of a topology, every axis and every body anyhow.
fn scene(topology: &Topology) -> Scene {
    let dice = &mut Rng::new(5);
    let mut scene = SceneDescription::at_rest("limbs", dice.mass_properties(50.0, 1.5), 1.0);
    for shape in topology.shapes() {
        let Shape::Limb(limb) = shape else { panic!("{topology} has limbs alone") };
        let first = scene.bodies.len();
        for link in limb.links() {
            let inboard = link.inboard.map(|inboard| first + usize::from(inboard));
            let rot_inboard_from_hinge = dice.rotation();
            let axis = match (link.joint, inboard) {
                (LimbJoint::Parallel, Some(inboard)) => {
                    rot_inboard_from_hinge.transpose_mul(scene.bodies[inboard].axis)
                }
                _ => dice.direction(),
            };
            let joint = match link.joint {
                LimbJoint::Prismatic => Joint::Prismatic,
                LimbJoint::Revolute | LimbJoint::Parallel => Joint::Revolute,
            };
            let spring = Spring { quadratic: 0.0, linear: -3.0, preload_angle: 0.4 };
            scene.bodies.push(Body {
                inboard,
                mount: Mount { point: dice.vector(0.5), rot_inboard_from_hinge },
                joint,
                axis,
                mass_properties: dice.mass_properties(2.0, 0.8),
                tip: Vec3::zero(),
                hinge: Hinge { spring, ..Hinge::free() },
            });
        }
    }
    Scene::new(scene).expect("the bodies are physical")
}

/// A satellite in a state, with its accelerations by the recursion.
struct Case {
    recognised: Recognised,
    coordinates: Coordinates<f64>,
    expected: Vec<f64>,
}

/// Satellites of one topology, in several states.
fn cases(name: &str) -> Vec<Case> {
    let topology: Topology = name.parse().expect("a topology");
    let scene = scene(&topology);
    let mut dynamics = Recursive::<f64>::new(&scene);
    let recognised = recognise(dynamics.tree()).expect("rigid bodies");
    assert_eq!(recognised.topology, topology);
    let dice = &mut Rng::new(6);
    let mut case = || {
        let numbers = |dice: &mut Rng, size: f64| -> Vec<f64> {
            (0..topology.hinges()).map(|_| dice.between(-size, size)).collect()
        };
        let (omega, beta, tau) = (dice.vector(1.0), numbers(dice, 3.0), numbers(dice, 1.0));
        let motion = Motion { omega_body: omega, beta: &beta, tau: &tau };
        let mut torques = vec![0.0; topology.hinges()];
        dynamics.hinge_forces(&motion, &mut torques);
        let mut found = Accelerations::for_hinges(topology.hinges());
        dynamics.accelerations(&motion, &mut found);
        let hinge =
            |&j: &usize| HingeCoordinates { beta: beta[j], tau: tau[j], torque: torques[j] };
        let hinges = recognised.links.iter().map(hinge).collect();
        let coordinates = Coordinates { omega, external: Wrench::zero(), hinges };
        let main = Twist { angular: found.omega_dot_body, linear: found.origin_body };
        let tau_dot = recognised.links.iter().map(|&j| found.tau_dot[j]).collect();
        let expected = Solution { main, tau_dot }.write(&topology);
        Case { recognised: recognised.clone(), coordinates, expected }
    };
    (0..STATES).map(|_| case()).collect()
}

fn near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    let scale = expected.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    let off = |(found, expected): (&f64, &f64)| (found - expected).abs() / scale;
    // A number that is none is not below any tolerance.
    let all_near = found.iter().zip(expected).all(|pair| off(pair) < tolerance);
    assert!(all_near && found.len() == expected.len(), "{what}: {found:?} {expected:?}");
}

fn is_the_closed_form<T: Routine>(is_exact: bool) {
    let kernel = Kernel::of::<T>();
    for Case { recognised, coordinates, expected } in cases(T::TOPOLOGY) {
        let Recognised { topology, parameters, .. } = &recognised;
        assert_eq!(T::PARAMETERS, Layout::parameters(topology));
        let state = coordinates.write(topology);
        let closed = Formulation::Articulated.solve(topology, parameters, &coordinates);
        let closed = closed.write(topology);
        let (mut constants, mut found) = (vec![0.0; T::CONSTANTS], vec![f64::NAN; T::OUTPUTS]);
        T::prepare(&parameters.write(), &mut constants);
        T::evaluate(&constants, &state, &mut found);
        if is_exact {
            assert_eq!(found, closed, "{topology}");
        }
        near(&found, &closed, 1e-12, "closed form");
        found.fill(f64::NAN);
        kernel.evaluate(&constants, &state, &mut found);
        near(&found, &closed, 1e-12, "closed form, this processor's code");
        near(&found, &expected, 1e-11, "recursion");
    }
}

#[test]
fn a_long_limb_has_the_bits_of_the_closed_form() {
    is_the_closed_form::<Snake>(true);
}

#[test]
fn a_large_tree_of_all_joints_accelerates_as_the_recursion_says() {
    is_the_closed_form::<Branching>(false);
}

#[test]
fn equal_large_limbs_are_taken_side_by_side() {
    is_the_closed_form::<Three>(false);
}

#[test]
fn equal_parts_of_a_limb_are_taken_side_by_side() {
    is_the_closed_form::<Torso>(false);
    is_the_closed_form::<Several>(false);
    is_the_closed_form::<Nine>(false);
}

#[test]
fn equal_parts_one_after_the_other_have_the_bits_of_the_closed_form() {
    is_the_closed_form::<Hand>(true);
    is_the_closed_form::<OnOne>(true);
}

#[test]
fn right_sides_of_limbs_are_those_of_the_equations() {
    is_of_the_equations::<SnakeMoves>();
    is_of_the_equations::<TorsoMoves>();
    is_of_the_equations::<OnSeveral>();
}

fn is_of_the_equations<T: Routine>() {
    let kernel = Kernel::of::<T>();
    let dice = &mut Rng::new(7);
    for Case { recognised, .. } in cases(T::TOPOLOGY) {
        let Recognised { topology, parameters, .. } = &recognised;
        let mut forces = Forces::none(topology.hinges());
        for law in &mut forces.laws {
            *law = HingeLaw::of_numbers([(); 7].map(|()| dice.between(-1.0, 1.0)));
        }
        let numbers = [parameters.write(), forces.write()].concat();
        let count = RightSideLayout::coordinates(topology);
        let y: Vec<f64> = (0..count).map(|_| dice.between(-1.0, 1.0)).collect();
        let expected = right_side(Formulation::Articulated, topology, parameters, &forces, &y);
        assert!(kernel.accepts(&numbers));
        let (mut constants, mut found) = (vec![0.0; T::CONSTANTS], vec![f64::NAN; T::OUTPUTS]);
        T::prepare(&numbers, &mut constants);
        T::evaluate(&constants, &y, &mut found);
        near(&found, &expected, 1e-12, "the equations");
        found.fill(f64::NAN);
        kernel.evaluate(&constants, &y, &mut found);
        near(&found, &expected, 1e-12, "the equations, this processor's code");
    }
}
