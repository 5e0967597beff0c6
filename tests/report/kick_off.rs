//! The original's kick-off springs, which did not act on paddles, at the third printed block.
//!
//! The paddle's first hinge shows them only together with the paddle's inertia, which the original
//! turned in the wrong order.

use nboom::model::HingeState::{Free, Unreleased};
use nboom::model::Scene;
use nboom::strength::Slip::{self, PaddleInertia, PaddleKickOff};
use nboom::strength::Slips;

use crate::collect::{detail, run, tight};
use crate::sample_run::scene_at;

/// The arm's hinge, in the order of the deck.
const ARM: usize = 2;

/// β̈ of the arm with these slips, in degrees.
fn acceleration(scene: &Scene, slips: &[Slip]) -> f64 {
    let slips: Slips = slips.iter().copied().collect();
    let (found, _) = run(&slips.scene(scene.clone()), &tight(1));
    detail(&found.samples[0]).beta_ddot[ARM].to_degrees()
}

#[test]
fn leave_paddles_alone() {
    let right = scene_at(0.019_028_37, &[Free, Unreleased, Free, Unreleased]);
    let printed = -3316.5;
    let found = acceleration(&right, &[PaddleKickOff, PaddleInertia]);
    // The original's motion up to here was another, by 1e-4 in ω, whose square this goes with.
    assert!((found - printed).abs() < 1.0, "{found}");
    for slips in [&[][..], &[PaddleInertia], &[PaddleKickOff]] {
        let off = (acceleration(&right, slips) - printed).abs();
        assert!(off > 3.0, "{off}");
    }
}
