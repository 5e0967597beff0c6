//! Lines along which forces act: their lengths and rates.

use nboom::dynamics::Recursive;
use nboom::scalar::Dual;

use crate::forward_dynamics::cases;
use crate::random_scene::{Moment, moment, spring};
use crate::support::numbers;

#[test]
fn lengths_are_those_of_the_reference() {
    let mut compared = 0;
    for case in cases() {
        let dynamics = case.dynamics();
        let lengths = numbers(&case.expected["kick_extension"]);
        let free = dynamics.free_hinges();
        for (i, body) in case.scene.bodies.iter().enumerate() {
            if body.hinge.kick_off.is_none() {
                continue;
            }
            let line = spring(&case.scene.bodies, i);
            let squared = dynamics.line_length_squared(line, |j| case.beta[free[j]]);
            // Coordinates of a few lengths, each a sum of products rounded once.
            assert!((squared.sqrt() - lengths[i]).abs() < 1e-13 * (1.0 + lengths[i]), "body {i}");
            compared += 1;
        }
    }
    assert!(compared > 10);
}

#[test]
fn lengths_by_their_path_are_those_by_poses_and_rates_their_derivatives() {
    let mut circles = 0;
    for seed in 0..60 {
        let Moment { scene, mode, beta, tau, .. } = moment(6, seed, 0.3);
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &beta);
        let free = dynamics.free_hinges().to_vec();
        let of_free = |j: usize| [beta[free[j]], tau[free[j]]];
        let free_beta: Vec<f64> = (0..free.len()).map(|j| of_free(j)[0]).collect();
        let mut by_poses = vec![0.0; dynamics.elements().lines().len()];
        dynamics.line_lengths_squared(&free_beta, &mut by_poses);
        for (line, expected) in by_poses.into_iter().enumerate() {
            let found = dynamics.line_length(line, of_free);
            // The way to the end is as long as the bodies on it, of a few lengths.
            assert!((found.squared - expected).abs() < 1e-12 * (1.0 + expected), "{seed}, {line}");
            if let Some(circle) = dynamics.line_circle(line) {
                let (sin, cos) = free_beta[circle.position].sin_cos();
                let squared = circle.mean + circle.along_cos * cos + circle.along_sin * sin;
                assert!((squared - expected).abs() < 1e-12 * (1.0 + expected), "{seed}, {line}");
                circles += 1;
            }
            let moving = |j: usize| Dual { value: of_free(j)[0], derivative: of_free(j)[1] };
            let derivative = dynamics.line_length_squared(line, moving);
            let error = (found.squared_rate - derivative.derivative).abs();
            assert!(
                error < 1e-12 * (1.0 + derivative.derivative.abs()),
                "{seed}, {line}: {error:e}"
            );
        }
    }
    assert!(circles > 10, "{circles}");
}
