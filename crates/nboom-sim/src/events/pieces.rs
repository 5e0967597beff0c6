//! Which piece holds of all that has several.

use nboom_dynamics::Recursive;
use nboom_elements::Coordinate;
use nboom_model::{Mode, Scene};
use nboom_scalar::Number;

/// Puts into `mode` the pieces that hold at `time` of what acts from outside, of a prescribed motion of the main
/// body, and of the speeds of rotors \[T\]. Returns whether others held before.
pub fn set_pieces_at_time(mode: &mut Mode, scene: &Scene, time: f64) -> bool {
    let mut changed = put(&mut mode.drive, scene.base.piece_at(time));
    for (piece, external) in mode.externals.iter_mut().zip(&scene.externals) {
        changed |= put(piece, external.course.piece_at(time));
    }
    for (piece, rotor) in mode.rotors.iter_mut().zip(&scene.rotors) {
        changed |= put(piece, rotor.speed.piece_at(time));
    }
    changed
}

/// Puts into `mode` the pieces of force laws that hold where the hinges are at `beta` and go at `tau`, all of the
/// scene's \[rad, L; rad/T, L/T\]; at a bound the one below. `dynamics` is in a mode in which the same hinges are free.
/// Returns whether others held before.
pub fn set_pieces_at_motion<R: Number>(
    mode: &mut Mode,
    dynamics: &Recursive<R>,
    [beta, tau]: [&[R]; 2],
) -> bool {
    let mut changed = false;
    let free = dynamics.free_hinges();
    for (piece, element) in mode.pieces.iter_mut().zip(dynamics.elements().switched()) {
        let value = match element.coordinate {
            Coordinate::Length(line) => {
                dynamics.line_length(line, |j| [beta[free[j]], R::zero()]).squared.sqrt()
            }
            Coordinate::Angle(hinge) => beta[hinge],
            Coordinate::Rate(hinge) => tau[hinge],
        };
        changed |= put(piece, element.piece_at(value));
    }
    changed
}

fn put(place: &mut usize, piece: usize) -> bool {
    std::mem::replace(place, piece) != piece
}
