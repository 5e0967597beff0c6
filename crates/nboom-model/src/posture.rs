use nboom_scalar::{Mat3, Vec3};

use crate::{Hinge, HingeState, Mode, Scene, WeldedTree};

/// Where every hinge and every body's outer end is at given hinge angles, from O, main-body axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    /// One for each hinge of the scene.
    pub hinges: Vec<HingePlace>,
}

/// One hinge and the body outboard of it, from O, main-body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingePlace {
    /// The hinge.
    pub point: Vec3<f64>,
    /// Unit vector along its axis.
    pub axis: Vec3<f64>,
    /// The body's x, y and z axes, as columns.
    pub body_axes: Mat3<f64>,
    /// The outer end of the body.
    pub tip: Vec3<f64>,
    /// The body's point of the kick-off spring; the hinge where there is none.
    pub kick_off: Vec3<f64>,
}

impl Posture {
    /// The posture of `scene` at these hinge angles \[rad\], one for each hinge.
    pub fn new(scene: &Scene, angles: &[f64]) -> Self {
        let held = vec![HingeState::Locked; scene.bodies.len()];
        let mode = Mode { hinges: held, ..Mode::at_start(scene) };
        let tree = WeldedTree::new(scene, &mode, angles);
        let hinges = scene.bodies.iter().zip(&tree.members).map(|(body, member)| {
            let (point, rot) = (member.point, member.rot_link_from_body);
            let kick_off = body.hinge.kick_off.map_or(Vec3::zero(), |spring| spring.body_point);
            HingePlace {
                point,
                axis: rot * body.axis,
                body_axes: rot,
                tip: point + rot * body.tip,
                kick_off: point + rot * kick_off,
            }
        });
        Self { hinges: hinges.collect() }
    }

    /// As the scene starts.
    pub fn at_start(scene: &Scene) -> Self {
        let angles: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
        Self::new(scene, &angles)
    }

    /// With all lock angles reached; hinges that never lock, or never move, as they start.
    pub fn locked(scene: &Scene) -> Self {
        let hinges = scene.bodies.iter().map(|body| &body.hinge);
        let of_hinge = |hinge: &Hinge| {
            hinge.lock_angle.filter(|_| hinge.can_turn()).unwrap_or(hinge.start.angle)
        };
        let angles: Vec<f64> = hinges.map(of_hinge).collect();
        Self::new(scene, &angles)
    }
}
