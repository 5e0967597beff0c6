use nboom_scalar::{Mat3, Real, Sym3, Vec3};

use crate::Scene;

/// Inertia of a paddle about its mass centre as [`MotionSlips`](crate::MotionSlips) can have it:
/// turned by R_y(α₂) R_x(α₁), while the paddle itself turns by R_x(α₁) R_y(α₂).
///
/// Unless both hinges are held, it is the tensor of no rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misturned<R> {
    rot_main_from_appendage: Mat3<R>,
    /// In the order in which they stand.
    paddle_and_arm: [Turn<R>; 2],
    inertia: Sym3<R>,
}

/// The rotation of one hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Turn<R> {
    axis: Vec3<R>,
    /// Of a hinge that is held.
    angle: R,
    /// Of a hinge that is free.
    link: Option<usize>,
}

impl<R: Real> Misturned<R> {
    /// Of the body `paddle`, hinged to `arm`. `beta` has the angle of every hinge of the scene;
    /// `link` tells the link of a hinge that is free.
    pub(crate) fn new(
        scene: &Scene,
        [paddle, arm]: [usize; 2],
        beta: &[R],
        link: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let turn = |i: usize| {
            let axis = Vec3::constant(scene.bodies[i].axis);
            Turn { axis, angle: beta[i], link: link(i) }
        };
        Self {
            rot_main_from_appendage: Mat3::constant(scene.bodies[arm].mount.rot_inboard_from_hinge),
            paddle_and_arm: [turn(paddle), turn(arm)],
            inertia: Sym3::constant(scene.bodies[paddle].mass_properties.inertia),
        }
    }

    /// The tensor at the angles `beta` of the links \[rad\], main-body axes.
    #[inline]
    pub fn inertia(&self, beta: &[R]) -> Sym3<R> {
        let by =
            |turn: &Turn<R>| Mat3::about_axis(turn.axis, turn.link.map_or(turn.angle, |j| beta[j]));
        let [paddle, arm] = &self.paddle_and_arm;
        self.inertia.rotated(&(self.rot_main_from_appendage * by(paddle) * by(arm)))
    }
}
