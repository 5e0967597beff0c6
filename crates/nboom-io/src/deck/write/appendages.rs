//! The appendages of a scene as those of a deck, along axes of a deck's segments.

use std::ops::Range;

use nboom_model::{Body, Scene};
use nboom_scalar::{Mat3, Vec3};

use super::obstacle::{DeckDefect, Obstacles};

/// Departure from a direction, or from a line relative to a distance, that counts as rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// An appendage of a deck.
pub(super) struct DeckAppendage {
    pub is_paddle: bool,
    /// First hinge point from O, main-body axes.
    pub point: Vec3<f64>,
    /// Columns are the appendage axes, main-body axes.
    pub axes: Mat3<f64>,
    pub segments: Vec<DeckSegment>,
}

/// A body as a segment of a deck.
pub(super) struct DeckSegment {
    /// Index of the body in the scene.
    pub body: usize,
    /// Columns are the segment axes, body axes.
    pub axes: Mat3<f64>,
    /// To the next hinge, or to the outer end.
    pub length: f64,
}

/// The appendages in the order of a deck, paddles last. What no deck can say is among the obstacles.
pub(super) fn find(scene: &Scene, obstacles: &mut Obstacles<'_>) -> Vec<DeckAppendage> {
    let starts: Vec<usize> =
        (0..scene.bodies.len()).filter(|&i| scene.bodies[i].inboard.is_none()).collect();
    let ends = starts.iter().skip(1).copied().chain([scene.bodies.len()]);
    let branches = starts.iter().zip(ends).map(|(&start, end)| start..end);
    let mut found: Vec<DeckAppendage> =
        branches.filter_map(|bodies| appendage(scene, bodies, obstacles)).collect();
    found.sort_by_key(|appendage| appendage.is_paddle);
    found
}

fn appendage(
    scene: &Scene,
    range: Range<usize>,
    obstacles: &mut Obstacles<'_>,
) -> Option<DeckAppendage> {
    let before = obstacles.found.len();
    for i in range.clone() {
        let outboard = range.clone().filter(|&j| scene.bodies[j].inboard == Some(i));
        let names: Vec<String> = outboard.map(|j| obstacles.name(j)).collect();
        if names.len() > 1 {
            obstacles.add(i, "on", DeckDefect::Branches(names.join(", ")));
        }
    }
    if obstacles.found.len() > before {
        return None;
    }
    let bodies = &scene.bodies[range.clone()];
    let is_paddle = bodies.len() == 2 && !scene.adds_to_inboard_angle(range.start + 1);
    check_axes(bodies, range.start, is_paddle, obstacles);
    if obstacles.found.len() > before {
        return None;
    }
    let segments = segments(bodies, range.start, is_paddle);
    check_places(bodies, &segments, is_paddle, obstacles);
    let mount = bodies[0].mount;
    let axes = mount.rot_inboard_from_hinge * segments[0].axes;
    Some(DeckAppendage { is_paddle, point: mount.point, axes, segments })
}

/// Reports hinge axes that are neither parallel, as in a chain, nor those of an arm and its paddle.
fn check_axes(bodies: &[Body], first: usize, is_paddle: bool, obstacles: &mut Obstacles<'_>) {
    for (j, pair) in bodies.windows(2).enumerate() {
        let (inboard, axis) = (pair[0].axis, pair[1].mount.rot_inboard_from_hinge * pair[1].axis);
        let departure = if is_paddle { inboard.dot(axis).abs() } else { (axis - inboard).norm() };
        if departure > ROUNDING {
            let degrees = inboard.cross(axis).norm().atan2(inboard.dot(axis)).to_degrees();
            let expected = match bodies.len() {
                2 => "0, as in a chain, or 90 for a paddle",
                _ => "0: hinge axes of a chain are parallel, and a paddle hangs on a single arm",
            };
            let degrees = (degrees * 1e6).round() / 1e6;
            obstacles.add(first + j + 1, "hinge.axis", DeckDefect::Axis { degrees, expected });
        }
    }
}

fn segments(bodies: &[Body], first: usize, is_paddle: bool) -> Vec<DeckSegment> {
    // Components along each body's axes into those along the first one's, at angle zero.
    let mut to_first = Mat3::identity();
    let turns: Vec<Mat3<f64>> = (bodies.iter().enumerate())
        .map(|(j, body)| {
            if j > 0 {
                to_first = to_first * body.mount.rot_inboard_from_hinge;
            }
            to_first
        })
        .collect();
    let own = axes_of_first(bodies, &turns, is_paddle);
    let segment = |j: usize| {
        let axes = turns[j].transpose() * own;
        let end = bodies.get(j + 1).map_or(bodies[j].tip, |next| next.mount.point);
        let length = axes.column(1).dot(end).max(0.0);
        DeckSegment { body: first + j, axes, length }
    };
    (0..bodies.len()).map(segment).collect()
}

/// The segment axes of an appendage's first body: along its hinge axis, and towards what comes next.
fn axes_of_first(bodies: &[Body], turns: &[Mat3<f64>], is_paddle: bool) -> Mat3<f64> {
    let axis = bodies[0].axis;
    let hinges = bodies.iter().zip(turns).skip(1);
    let mut towards: Vec<Vec3<f64>> = if is_paddle {
        hinges.map(|(body, &turn)| turn * body.axis).collect()
    } else {
        let inboard = turns.iter();
        hinges.zip(inboard).map(|((body, _), &turn)| turn * body.mount.point).collect()
    };
    let ends = bodies.last().zip(turns.last());
    towards.extend(ends.map(|(body, &turn)| turn * body.tip));
    // Of two unit vectors one is across the axis.
    towards.extend([Vec3::unit_y(), Vec3::unit_z()]);
    let across = towards.into_iter().find_map(|way| {
        let across = way - axis * axis.dot(way);
        let (length, whole) = (across.norm(), way.norm());
        (length > 1e-6 * whole).then(|| across.map(|c| c / length))
    });
    let across = across.unwrap_or_else(Vec3::unit_y);
    Mat3::from_columns(axis, across, axis.cross(across))
}

/// Reports hinges that are not where a straight appendage has them.
fn check_places(
    bodies: &[Body],
    segments: &[DeckSegment],
    is_paddle: bool,
    obstacles: &mut Obstacles<'_>,
) {
    for (body, pair) in bodies.iter().skip(1).zip(segments.windows(2)) {
        let [aside, ahead, off] = pair[0].axes.transpose_mul(body.mount.point).to_array();
        let most = ROUNDING * body.mount.point.norm();
        let is_aside = aside.abs() > most;
        let defect = match (is_aside, off.abs() > most || ahead < 0.0) {
            (false, false) => continue,
            _ if is_paddle => DeckDefect::OffArm,
            (true, _) => DeckDefect::Aside(aside),
            (false, true) => DeckDefect::Bent((off.atan2(ahead).to_degrees() * 1e6).round() / 1e6),
        };
        obstacles.add(pair[1].body, "hinge.at", defect);
    }
}
