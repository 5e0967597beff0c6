//! A scene while hinges are held, as a scene of its own.

use nboom_codegen::held;
use nboom_model::{Body, Hinge, Link, MassProperties, Mount, Scene};
use nboom_scalar::RigidInertia;

use crate::PackageError;

/// The scene's bodies with the hinges that are not `free` welded, held at angles around `angle`.
///
/// # Errors
/// [`PackageError::Welded`] where numbers of a welded body overflow.
pub(crate) fn welded(scene: &Scene, free: &[bool], angle: f64) -> Result<Scene, PackageError> {
    let tree = held(scene, free, angle);
    let mut description = (**scene).clone();
    description.main_body = mass_properties(tree.main);
    let body = |link: &Link<f64>| Body {
        inboard: link.inboard,
        mount: Mount { point: link.point, rot_inboard_from_hinge: link.rot_inboard_at_zero },
        joint: link.joint,
        axis: link.axis,
        mass_properties: mass_properties(link.inertia),
        tip: scene.bodies[link.hinge].tip,
        hinge: without_events(&scene.bodies[link.hinge].hinge),
    };
    // Their hinges have other numbers now, or are welded.
    description.torque_tables.clear();
    description.couplings.clear();
    description.bodies = tree.links.iter().map(body).collect();
    Scene::new(description)
        .map_err(|errors| PackageError::Welded { scene: scene.name.clone(), errors })
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
