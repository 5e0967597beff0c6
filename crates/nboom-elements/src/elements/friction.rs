use nboom_model::{Mode, Scene};

use crate::{EventName, Names};

/// What friction is called.
pub(crate) const NAMES: Names = Names {
    name: "friction",
    rise: EventName {
        in_files: "turn_up",
        in_listing: "MOTION TURNS UPWARD AGAINST FRICTION AT HINGE",
    },
    fall: EventName {
        in_files: "turn_down",
        in_listing: "MOTION TURNS DOWNWARD AGAINST FRICTION AT HINGE",
    },
    line: None,
};

/// Each hinge with friction, and the torque of its friction, λ = −F sgn τ (docs/equations.md, Friction), in the
/// direction of motion that `mode` has: positive in piece 0, in which the hinge moves down, negative in piece 1, in which it moves up, and none in piece 2, in which it
/// is at rest.
pub fn friction_torques<'a>(
    scene: &'a Scene,
    mode: &'a Mode,
) -> impl Iterator<Item = (usize, f64)> + use<'a> {
    let pieces = &mode.pieces[scene.friction_pieces()];
    scene.hinges_with_friction().zip(pieces).map(|(hinge, &piece)| {
        let friction = scene.bodies[hinge].hinge.friction;
        (hinge, [friction, -friction, 0.0][piece])
    })
}
