//! The original's kick-off springs, which did not act on paddles, at the third printed block.

use nboom::model::HingeState::{Free, Unreleased};
use nboom::model::Scene;
use nboom::strength::{Slip, Slips};

use crate::collect::{detail, run, tight};
use crate::sample_run::scene_at;

/// β̈ of the first hinges of boom and paddle, in degrees.
fn accelerations(scene: &Scene) -> [f64; 2] {
    let (found, _) = run(scene, &tight(1));
    let beta_ddot = &detail(&found.samples[0]).beta_ddot;
    [0, 2].map(|i: usize| beta_ddot[i].to_degrees())
}

#[test]
fn leave_paddles_alone() {
    let scene = || scene_at(0.019_028_37, &[Free, Unreleased, Free, Unreleased]);
    let slips: Slips = [Slip::PaddleKickOff].into_iter().collect();
    let ([boom, right], [other, found]) =
        (accelerations(&scene()), accelerations(&slips.scene(scene())));
    // Five digits are printed.
    let printed = -3316.5;
    assert!((found - printed).abs() < 0.1, "{found}");
    assert!((right - printed).abs() > 3.0, "{right}");
    // The boom's spring still pushes: without it this would be some hundreds.
    assert!((boom - other).abs() < 1.0, "{boom}, {other}");
}
