//! What a deck must say to be read as given numbers, to the last bit where there is such a number.

use nboom_scalar::{Mat3, Vec3};

use crate::angles::{in_degrees, rotation_from_degrees};

/// How many neighbours of a number are tried on either side.
const NEIGHBOURS: i32 = 5;

/// Degrees that are read as these radians, but for rounding.
pub(super) fn degrees(radians: f64) -> f64 {
    in_degrees(radians).unwrap_or_else(|| radians.to_degrees())
}

/// ψ, θ, φ in degrees of the rotation R_x(ψ) R_y(θ) R_x(φ), with few digits if it can have them. Of all
/// ways to say it, the one with the least `miss`, as the reader finds it.
pub(super) fn euler_degrees(
    rotation: &Mat3<f64>,
    miss: impl Fn(&Mat3<f64>) -> f64 + Copy,
) -> Vec3<f64> {
    let [x, y, z] = rotation.rows;
    let sine = y.x.hypot(z.x);
    let psi = if sine == 0.0 { 0.0 } else { y.x.atan2(-z.x) };
    let theta = sine.atan2(x.x);
    // What is left when the first two turns are undone has (0, cos φ, −sin φ) in its second row.
    let row = y * psi.cos() + z * psi.sin();
    let phi = (-row.z).atan2(row.y);
    let [psi, theta, phi] = [psi, theta, phi].map(f64::to_degrees);
    let ways = [[psi, theta, phi], [psi + 180.0, -theta, phi + 180.0]];
    let rounded = |angle: f64| (angle * 1e9).round() / 1e9;
    let ways = ways.into_iter().flat_map(|angles| [angles.map(rounded), angles]);
    let turned = |[psi, theta, phi]: [f64; 3], [one, two]: [f64; 2]| {
        // Adding zero makes negative zeros positive.
        Vec3::new(turned_by(psi, one) + 0.0, theta + 0.0, turned_by(phi, two) + 0.0)
    };
    let turns = [[0.0, 0.0], [360.0, 0.0], [0.0, 360.0], [360.0, 360.0]];
    let all = ways.flat_map(|angles| turns.map(|turns| turned(angles, turns)));
    let of_angles = |angles: &Vec3<f64>| miss(&rotation_from_degrees(angles.x, angles.y, angles.z));
    let best = all.min_by(|a, b| of_angles(a).total_cmp(&of_angles(b)));
    nearest(best.unwrap_or_else(Vec3::zero), |angles| of_angles(&angles))
}

/// As [`euler_degrees`] of axes, by their entries.
pub(super) fn euler_degrees_of_axes(axes: &Mat3<f64>) -> Vec3<f64> {
    euler_degrees(axes, |read| (*read - *axes).rows.map(Vec3::norm).into_iter().fold(0.0, f64::max))
}

/// The angle from −180 up to 180, or one turn on if it is negative then.
fn turned_by(degrees: f64, turn: f64) -> f64 {
    let once = if degrees > 180.0 { degrees - 360.0 } else { degrees };
    if once < 0.0 { once + turn } else { once }
}

/// The vector with the least miss among this one and its neighbours, from which it differs by rounding.
pub(super) fn nearest(guess: Vec3<f64>, miss: impl Fn(Vec3<f64>) -> f64) -> Vec3<f64> {
    let (mut best, mut least) = (guess, miss(guess));
    let neighbour = |number: f64, steps: i32| {
        let step = if steps < 0 { f64::next_down } else { f64::next_up };
        // Zero is meant where it stands.
        (0..steps.abs()).fold(number, |number, _| if number == 0.0 { number } else { step(number) })
    };
    let steps = || -NEIGHBOURS..=NEIGHBOURS;
    let all = steps().flat_map(|i| steps().flat_map(move |j| steps().map(move |k| [i, j, k])));
    for [i, j, k] in all {
        if least == 0.0 {
            break;
        }
        let other = Vec3::new(neighbour(guess.x, i), neighbour(guess.y, j), neighbour(guess.z, k));
        let missed = miss(other);
        if missed < least {
            (best, least) = (other, missed);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_a_deck_are_found_again() {
        for angles in
            [[0.0, 90.0, 0.0], [270.0, 90.0, 0.0], [45.5, -30.0, 200.0], [0.0, 180.0, 12.0]]
        {
            let [psi, theta, phi] = angles;
            let rotation = rotation_from_degrees(psi, theta, phi);
            let found = euler_degrees_of_axes(&rotation);
            assert_eq!(rotation_from_degrees(found.x, found.y, found.z), rotation, "{angles:?}");
        }
    }

    /// Near θ = 0 only the sum of the other two angles is well determined.
    #[test]
    fn every_rotation_is_met_but_for_rounding() {
        for i in 0..400 {
            let t = f64::from(i);
            let theta = if i % 2 == 0 { 1e-9 * t } else { 1.3 * t };
            let rotation = Mat3::from_euler_121(0.7 * t, theta, 2.9 * t);
            let found = euler_degrees_of_axes(&rotation);
            let read = rotation_from_degrees(found.x, found.y, found.z);
            let miss = (read - rotation).rows.map(|row| row.norm());
            // Angles of up to a turn are rounded by 4e-16 rad each.
            assert!(miss.into_iter().all(|miss| miss < 3e-15), "{i}: {miss:?}");
        }
    }
}
