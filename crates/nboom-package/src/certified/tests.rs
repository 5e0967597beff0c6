use nboom_codegen::{Level, Numbers};
use nboom_model::{
    Appendage, Body, Hinge, Joint, MassProperties, Mount, SceneDescription, Segment,
};
use nboom_scalar::{Sym3, Vec3};

mod held;

use super::*;

const OUTPUTS: [Output; 4] =
    [Output::Accelerations, Output::Equations, Output::InverseDynamics, Output::RightSide];

fn one_boom() -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let boom = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
    let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
    let mut description = SceneDescription::at_rest("one boom", hub, 1.0);
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    Scene::new(description).expect("the bodies are physical")
}

/// Bodies without a preferred axis across z, each on the one before by a hinge about z.
fn alike(inertia: [f64; 3], links: usize) -> Scene {
    let [x, y, z] = inertia;
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(x, y, z));
    let mut description = SceneDescription::at_rest("alike", hub, 1.0);
    let body = |i: usize| Body {
        inboard: i.checked_sub(1),
        mount: Mount::at(Vec3::zero()),
        joint: Joint::Revolute,
        axis: Vec3::unit_z(),
        mass_properties: MassProperties::new(3.0, Vec3::zero(), Sym3::diagonal(2.0, 2.0, 1.0)),
        tip: Vec3::zero(),
        hinge: Hinge::free(),
    };
    description.bodies = (0..links).map(body).collect();
    Scene::new(description).expect("the bodies are physical")
}

/// What is certified of code with the scene's numbers in it, one of them off by this share.
fn with_number_off(
    scene: &Scene,
    output: Output,
    (number, share): (usize, f64),
) -> Result<Certified, PackageError> {
    let request = Request::of_scene(scene, Numbers::Baked, Level::Exact);
    let request = request.expect("code is generated for it");
    let mut request = match output {
        Output::InverseDynamics => request.for_inverse_dynamics(),
        Output::RightSide => request.right_side_of(scene).expect("it has a place for what acts"),
        _ => Request { output, ..request.by(Formulation::Symmetric) },
    };
    let number = request.assumptions[number].as_mut().expect("it is built in");
    *number *= 1.0 + share;
    Certified::new(scene, &request, None)
}

/// Asserts that code is certified which is right, and none that is off by a share of a number.
fn is_found(scene: &Scene, number: usize) {
    for output in OUTPUTS {
        let right = with_number_off(scene, output, (number, 0.0));
        let right = right.unwrap_or_else(|error| panic!("{output:?}: {error}"));
        assert!(right.tolerance() < TOLERANCE);
        for share in [2e-9, 1e-3] {
            let wrong = with_number_off(scene, output, (number, share)).err();
            let Some(PackageError::Deviation { deviation, tolerance, .. }) = wrong else {
                panic!("{output:?}, {share:e}: certified, or {wrong:?}")
            };
            assert!(deviation > tolerance, "{output:?}: {deviation:e}");
        }
    }
}

#[test]
fn code_that_computes_something_else_is_not_certified() {
    // The mass of the boom, which is a thirtieth of the whole.
    is_found(&one_boom(), Layout::MAIN + Layout::BRANCH);
}

/// What is zero in every motion is rounding, and rounding is not compared with itself.
#[test]
fn code_of_spheres_and_tops_is_certified_and_only_if_it_is_right() {
    let (sphere, top) = ([30.0; 3], [30.0, 30.0, 20.0]);
    for (inertia, links) in [(sphere, 0), (top, 0), (sphere, 2), (top, 2)] {
        // The main body's inertia about x.
        is_found(&alike(inertia, links), 4);
    }
}

/// Equations that are all too large, or one of them, have the same solution.
#[test]
fn equations_are_compared_number_by_number() {
    let scene = one_boom();
    for formulation in [Formulation::Report, Formulation::Relative, Formulation::Symmetric] {
        let request = Request::of_scene(&scene, Numbers::RunTime, Level::Exact);
        let request = request.expect("code is generated for it").by(formulation).for_equations();
        let cases = [TestCase::new(scene.clone(), 5, SEED).expect("states with accelerations")];
        let (graph, inputs) = (trace(&request), inputs(&cases[0], &request));
        let right = equations(&graph, &request, &cases).expect("a comparison");
        assert!(right < TOLERANCE, "{formulation}: {right:e}");
        let off = |change: &dyn Fn(&mut Vec<f64>)| {
            let of_state = |i: usize| {
                let mut found = graph.evaluate(&inputs[i].concat());
                change(&mut found);
                found
            };
            certify_equations(&cases[0], formulation, of_state).expect("a comparison")
        };
        assert!(off(&|_| {}) < TOLERANCE);
        assert!(off(&|all| all.iter_mut().for_each(|number| *number *= 2.0)) > 0.1);
        // The row of the hinge, of seven.
        let row = |all: &mut Vec<f64>| (42..49).chain([55]).for_each(|at| all[at] *= 1.0 + 1e-6);
        assert!(off(&row) > 1e-8, "{formulation}");
        assert!(off(&|all| all.truncate(55)).is_infinite());
    }
}
