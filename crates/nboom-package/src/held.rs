//! A scene while hinges are held, as a scene of its own.

use nboom_codegen::held;
use nboom_model::{Body, Hinge, Link, MassProperties, Member, Mount, Rotor, Scene, WeldedTree};
use nboom_scalar::RigidInertia;

use crate::PackageError;

/// The scene's bodies with the hinges that are not `free` welded, held at angles around `angle`.
///
/// # Errors
/// [`PackageError::Welded`] where numbers of a welded body overflow.
pub(crate) fn welded(scene: &Scene, free: &[bool], angle: f64) -> Result<Scene, PackageError> {
    let tree = held(scene, free, angle);
    let mut description = (**scene).clone();
    description.rotors = tree_rotors(scene, &tree);
    description.main_body = mass_properties(without_rotors(tree.main, &description.rotors, None));
    let rotors = description.rotors.clone();
    let body = |(j, link): (usize, &Link<f64>)| Body {
        inboard: link.inboard,
        mount: Mount { point: link.point, rot_inboard_from_hinge: link.rot_inboard_at_zero },
        joint: link.joint,
        axis: link.axis,
        mass_properties: mass_properties(without_rotors(link.inertia, &rotors, Some(j))),
        tip: scene.bodies[link.hinge].tip,
        hinge: without_events(&scene.bodies[link.hinge].hinge),
    };
    // Their hinges have other numbers now, or are welded.
    description.torque_tables.clear();
    description.couplings.clear();
    description.bodies = tree.links.iter().enumerate().map(body).collect();
    Scene::new(description)
        .map_err(|errors| PackageError::Welded { scene: scene.name.clone(), errors })
}

/// The rotors of a scene as those of the links of its `tree`.
fn tree_rotors(scene: &Scene, tree: &WeldedTree<f64>) -> Vec<Rotor> {
    let of_link = |rotor: &Rotor| match rotor.body.map(|body| tree.members[body]) {
        None => rotor.clone(),
        Some(Member { link, rot_link_from_body: rot, .. }) => {
            Rotor { body: link, axis: rot * rotor.axis, ..rotor.clone() }
        }
    };
    scene.rotors.iter().map(of_link).collect()
}

/// Mass properties without the inertia about their axes of the rotors in `link`, which a scene has
/// beside.
fn without_rotors(
    mut inertia: RigidInertia<f64>,
    rotors: &[Rotor],
    link: Option<usize>,
) -> RigidInertia<f64> {
    inertia.about_origin = inertia.about_origin - Rotor::inertia_of(rotors, link);
    inertia
}

/// What acts about a hinge. Its release may be by a hinge that is welded.
fn without_events(hinge: &Hinge) -> Hinge {
    Hinge { spring: hinge.spring, dashpot: hinge.dashpot, ..Hinge::free() }
}

fn mass_properties(body: RigidInertia<f64>) -> MassProperties {
    let inverse_mass = if body.mass > 0.0 { 1.0 / body.mass } else { 0.0 };
    let center = body.first_moment * inverse_mass;
    MassProperties::new(body.mass, center, body.seen_from(-center).about_origin)
}
