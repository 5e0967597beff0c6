use nboom_scalar::{Mat3, Vec3};

use super::BodyDraft;
use crate::Body;

/// A body several times, evenly about an axis through O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeat {
    /// How often, the first one where the draft has it; at least 1.
    pub count: usize,
    /// Unit vector along the axis, main-body axes; copies follow each other by the right hand.
    pub about: Vec3<f64>,
}

/// Share of its distance by which a point may miss an axis that it is on.
const ON_AXIS: f64 = 1e-9;

impl Repeat {
    /// Turns copy number `copy`, from 0, of a body into its place: its hinge if it is on the main body,
    /// and its kick-off spring's end there.
    pub(super) fn place(&self, copy: usize, is_on_main_body: bool, body: &mut Body) {
        let turn = self.turn(copy);
        if is_on_main_body {
            let mount = &mut body.mount;
            mount.point = turn * mount.point;
            mount.rot_inboard_from_hinge = turn * mount.rot_inboard_from_hinge;
        }
        if let Some(spring) = &mut body.hinge.kick_off {
            spring.main_body_point = turn * spring.main_body_point;
        }
    }

    /// The rotation of a copy; quarter turns have exact sines.
    fn turn(&self, copy: usize) -> Mat3<f64> {
        let Self { count, about } = *self;
        let (copy, quarters) = (copy % count, 4 * (copy % count));
        if copy == 0 {
            return Mat3::identity();
        }
        let (s, c) = if quarters.is_multiple_of(count) {
            [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarters / count]
        } else {
            (std::f64::consts::TAU * copy as f64 / count as f64).sin_cos()
        };
        // Rodrigues' formula.
        let along = about.outer(about);
        let across = Mat3::identity() + along * -1.0;
        along + across * c + Mat3::skew(about) * s
    }

    /// Whether a copy of the body lies where the body does; of one without mass, which fills no place, whether it
    /// is the same again: its copies turn about the same axis.
    pub(super) fn overlaps(&self, body: &BodyDraft) -> bool {
        let point = body.mount.point;
        let rot = body.mount.rot_inboard_from_hinge;
        let is_on_axis = |point: Vec3<f64>| {
            self.about.cross(point).norm() <= ON_AXIS * point.norm().max(f64::MIN_POSITIVE)
        };
        let of_body = if body.mass_properties.mass == 0.0 {
            [rot * body.axis; 2]
        } else {
            [body.tip, body.mass_properties.center_of_mass].map(|place| point + rot * place)
        };
        self.count > 1 && is_on_axis(point) && of_body.into_iter().all(is_on_axis)
    }
}
