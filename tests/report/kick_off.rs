//! The original's kick-off springs, which did not act on paddles, at the third printed block.
//!
//! The paddle's first hinge shows them only together with the paddle's inertia, which the original
//! turned in the wrong order. At one instant, before the paddle is released, that is another body.

use nboom::model::HingeState::{Free, Unreleased};
use nboom::model::{Scene, SceneDescription};
use nboom::scalar::{Mat3, Vec3};
use nboom::strength::{Slip, Slips};

use crate::collect::{detail, run, tight};
use crate::sample_run::scene_at;

/// Of hinges, in the order of the deck.
const ARM: usize = 2;
const PADDLE: usize = 3;

/// β̈ of the arm, in degrees.
fn acceleration(scene: &Scene) -> f64 {
    let (found, _) = run(scene, &tight(1));
    detail(&found.samples[0]).beta_ddot[ARM].to_degrees()
}

/// The scene with the paddle's inertia turned by R_y(α₂) R_x(α₁) instead of R_x(α₁) R_y(α₂).
fn with_turned_inertia(scene: &Scene) -> Scene {
    let mut bodies = scene.bodies.clone();
    let [arm, paddle] = [ARM, PADDLE].map(|i| bodies[i].hinge.start.angle);
    let about_x = Mat3::about_axis(Vec3::unit_x(), arm);
    let about_y = Mat3::about_axis(Vec3::unit_y(), paddle);
    let undone = (about_x * about_y).transpose() * (about_y * about_x);
    let inertia = &mut bodies[PADDLE].mass_properties.inertia;
    *inertia = inertia.rotated(&undone);
    let description = SceneDescription { bodies, ..(**scene).clone() };
    Scene::new(description).expect("a turned body is a body")
}

#[test]
fn leave_paddles_alone() {
    let right = scene_at(0.019_028_37, &[Free, Unreleased, Free, Unreleased]);
    let slips: Slips = [Slip::PaddleKickOff].into_iter().collect();
    let printed = -3316.5;
    let found = acceleration(&slips.scene(with_turned_inertia(&right)));
    // The original's motion up to here was another, by 1e-4 in ω, whose square this goes with.
    assert!((found - printed).abs() < 1.0, "{found}");
    for other in [&right, &with_turned_inertia(&right), &slips.scene(right.clone())] {
        let off = (acceleration(other) - printed).abs();
        assert!(off > 3.0, "{off}");
    }
}
