//! Dashpots up to 1e8, whose equations are stiff.

use nboom::model::{Dashpot, Spring};
use nboom::scalar::Vec3;
use nboom::sim::{Method, Options};

use crate::collect::run;
use crate::stress::{ball, both, chain, checked, free, options};

const HUB: f64 = 4.0;
const BOOM: f64 = 1.0;
const REDUCED: f64 = HUB * BOOM / (HUB + BOOM);
const STIFFNESS: f64 = 2.0;

/// β of μ β̈ = −c β̇ − k β from β(0) = `start` at rest, overdamped.
fn creep(start: f64, damping: f64, t: f64) -> f64 {
    let half = damping / (2.0 * REDUCED);
    let fast = half + (half * half - STIFFNESS / REDUCED).sqrt();
    // The product of the two is k/μ; their difference would lose all digits.
    let slow = STIFFNESS / REDUCED / fast;
    start * (fast * (-slow * t).exp() - slow * (-fast * t).exp()) / (fast - slow)
}

#[test]
fn hinges_creep_as_their_dashpots_let_them() {
    let start = 0.3;
    for damping in [1e1, 1e2, 1e4, 1e6, 1e8] {
        let mut hinge = free(start, 0.0);
        hinge.spring = Spring { quadratic: 0.0, linear: -STIFFNESS, preload_angle: 0.0 };
        hinge.dashpot = Dashpot { rate_linear: -damping, ..Dashpot::default() };
        let segments = [(ball(2.0, 0.0, BOOM), hinge)];
        let scene = checked(chain(ball(2.0, 0.0, HUB), Vec3::zero(), &segments, 5.0));
        let implicit = Options { integrator: Method::Radau5, rtol: 1e-9, ..options(1) };
        for options in both(&implicit) {
            let (found, summary) = run(&scene, &options);
            let off = (found.last().beta[0] - creep(start, damping, 5.0)).abs();
            let allowed = summary.steps_accepted as f64 * options.rtol;
            println!(
                "{damping:e}: {off:.1e} of {allowed:.1e}, {} steps, {:?}",
                summary.steps_accepted, summary.conservation
            );
            assert!(off < allowed, "{damping:e}: {off:e} of {allowed:e}");
            // What the dashpot takes does not decide on steps, but is as good as the motion.
            assert!(summary.conservation.energy < allowed, "{:?}", summary.conservation);
            // The transient of 1e-8 is not followed by as many steps.
            assert!(summary.steps_accepted < 1000, "{}", summary.steps_accepted);
        }
    }
}
