//! Limbs by the closed form `articulated` against the recursion, which knows none.

use std::f64::consts::FRAC_PI_2;

use nboom::formulation::{Formulation, Parameters, Recognised};
use nboom::model::{Base, Gravity, LimbJoint, MassProperties, Scene, SceneDescription, Shape};
use nboom::scalar::{Mat3, Sym3, Vec3};

use crate::formulations::assert_same_equations;
use crate::random_scene::{Rng, description, moment_of};
use crate::satellites::{Satellite, exact, flat};
use crate::support::relative_error;

const TREES: u64 = 3000;

/// A random tree with what real ones have: axes parallel to inboard ones, frames that stand along each other,
/// and links without mass that carry others.
pub fn tree(seed: u64) -> Scene {
    // A massless link that moves nothing else of mass is not physical, and of slides along each other with
    // nothing of mass between them one is too many.
    let is_regular = |scene: &Scene| (1.0..1e14).contains(&in_motion(scene, seed).condition());
    let with = Scene::new(description_of(seed, 0.15)).ok().filter(is_regular);
    with.unwrap_or_else(|| Scene::new(description_of(seed, 0.0)).expect("all bodies have mass"))
}

/// A tree in a random state, some of its joints held.
pub fn satellite(seed: u64) -> Satellite {
    in_motion(&tree(seed), seed)
}

/// A tree on a rig, in a random state under gravity.
pub fn satellite_on_a_rig(seed: u64) -> Satellite {
    let mut rig = description_of(seed, 0.0);
    rig.base = Base::Fixed;
    (rig.initial.omega_body, rig.initial.velocity_inertial) = (Vec3::zero(), Vec3::zero());
    rig.gravity = Some(Gravity { acceleration: 3.0, up: Vec3::unit_y() });
    in_motion(&Scene::new(rig).expect("all bodies have mass"), seed)
}

fn in_motion(tree: &Scene, seed: u64) -> Satellite {
    Satellite::of_moment(&moment_of(tree.clone(), seed, 0.2))
}

fn description_of(seed: u64, massless: f64) -> SceneDescription {
    let dice = &mut Rng::new(seed ^ 0x11b3);
    let bodies = 1 + dice.below(14);
    let mut scene = description(bodies, seed);
    let is_aligned = dice.chance(0.5);
    for i in 0..bodies {
        if is_aligned {
            let body = &mut scene.bodies[i];
            body.mount.rot_inboard_from_hinge = quarter_turns(dice);
            body.axis = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()][dice.below(3)];
        }
        let Some(inboard) = scene.bodies[i].inboard else { continue };
        if dice.chance(0.4) {
            let axis = scene.bodies[inboard].axis;
            let body = &mut scene.bodies[i];
            body.axis = body.mount.rot_inboard_from_hinge.transpose_mul(axis);
        }
        if dice.chance(massless) {
            let inboard = &mut scene.bodies[inboard].mass_properties;
            (inboard.mass, inboard.inertia) = (0.0, Sym3::zero());
        }
    }
    scene
}

fn quarter_turns(dice: &mut Rng) -> Mat3<f64> {
    let mut turn = |axis| Mat3::about_axis(axis, FRAC_PI_2 * dice.below(4) as f64);
    turn(Vec3::unit_x()) * turn(Vec3::unit_y())
}

#[test]
fn limbs_accelerate_as_the_recursion_says() {
    let (mut kinds, mut massless) = ([0; 3], 0);
    for seed in 0..TREES {
        let satellite = satellite(seed);
        massless += satellite.tree.links.iter().filter(|link| link.inertia.mass == 0.0).count();
        let recognised = satellite.recognised();
        let coordinates = satellite.coordinates_of(&recognised);
        let expected = satellite.expected(&recognised.links);
        let Recognised { topology, parameters, .. } = &recognised;
        let allowed = satellite.allowed();
        for formulation in [Formulation::Articulated, Formulation::Symmetric] {
            let found = formulation.solve(topology, parameters, &coordinates);
            let error = relative_error(&flat(&found), &expected, 0.0);
            assert!(error < allowed, "seed {seed}, {topology}, {formulation}: {error:e}");
        }
        for shape in topology.shapes() {
            let Shape::Limb(limb) = shape else { continue };
            for link in limb.links() {
                kinds[match link.joint {
                    LimbJoint::Revolute => 0,
                    LimbJoint::Parallel => 1,
                    LimbJoint::Prismatic => 2,
                }] += 1;
            }
        }
    }
    assert!(kinds.iter().all(|&count| count > 1000) && massless > 500, "{kinds:?} {massless}");
}

/// Limbs at the ends of masts that are thousands of times as long as their links. Their hinges are moved along themselves,
/// where that changes neither how they turn nor what they carry.
#[test]
fn limbs_far_out_are_as_accurate_as_the_recursion() {
    let mut limbs = 0;
    for seed in 0..1000 {
        let mut scene = description_of(seed, 0.0);
        scene.main_body = MassProperties::new(1e3, Vec3::zero(), Sym3::diagonal(1e3, 2e3, 3e3));
        for body in scene.bodies.iter_mut().filter(|body| body.inboard.is_none()) {
            let axis = body.mount.rot_inboard_from_hinge * body.axis;
            body.mount.point += axis * 3e3;
        }
        let moment = moment_of(Scene::new(scene).expect("all bodies have mass"), seed, 0.2);
        let satellite = Satellite::of_moment(&moment);
        let recognised = satellite.recognised();
        let Recognised { topology, parameters, links, .. } = &recognised;
        let truth: Vec<f64> = exact(&moment, links).iter().map(|number| number.to_f64()).collect();
        let of_recursion = relative_error(&satellite.expected(links), &truth, 0.0);
        let coordinates = satellite.coordinates_of(&recognised);
        for formulation in [Formulation::Articulated, Formulation::Symmetric] {
            let found = formulation.solve(topology, parameters, &coordinates);
            let error = relative_error(&flat(&found), &truth, 0.0);
            let allowed = 1e-13 + 100.0 * of_recursion;
            assert!(
                error < allowed,
                "seed {seed}, {topology}, {formulation}: {error:e}, {of_recursion:e}"
            );
        }
        limbs += usize::from(topology.has_limbs());
    }
    assert!(limbs > 500, "{limbs}");
}

#[test]
fn numbers_of_limbs_read_back() {
    for seed in 0..300 {
        let Recognised { topology, parameters, .. } = satellite(seed).recognised();
        let numbers = parameters.write();
        assert_eq!(numbers.len(), nboom::formulation::Layout::parameters(&topology));
        assert_eq!(Parameters::read(&topology, numbers), parameters);
    }
}

#[test]
fn symmetric_has_the_matrix_and_right_side_of_the_recursion() {
    for seed in 0..TREES {
        assert_same_equations(&satellite(seed), &format!("seed {seed}"));
    }
}
