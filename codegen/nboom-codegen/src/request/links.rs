//! Which hinge of a scene a link of its code is.

use nboom_model::{HingeLabel, Scene};

use crate::request::CodegenError;
use crate::request::scene::welded;

/// The links of code for a scene with all hinges free: each as code counts it, by the order of the topology, and then
/// the scene's hinge.
///
/// # Errors
/// When a body is not rigid, carries a rotor or is one of too many.
pub fn links(scene: &Scene) -> Result<Vec<[HingeLabel; 2]>, CodegenError> {
    let recognised = welded(scene, &vec![true; scene.bodies.len()], 0.0)?;
    let shapes = recognised.topology.shapes().iter().enumerate();
    let in_code = shapes.flat_map(|(appendage, shape)| {
        (0..shape.hinges()).map(move |link| HingeLabel::new(appendage, link))
    });
    let hinges = recognised.links.iter().map(|&hinge| scene.label(hinge));
    Ok(in_code.zip(hinges).map(|(link, hinge)| [link, hinge]).collect())
}
