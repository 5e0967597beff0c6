//! Mass ratios, flat bodies and hinge axes that are nearly parallel.

use nboom::model::{MassDefect, MassProperties, ModelError, Spring};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Options, Path};

use crate::collect::run;
use crate::stress::{RTOL, ball, both, chain, checked, conserving, error, free, options};

/// A boom on a spring, hinged in the hub's mass centre: the hub is then a point mass on the boom
/// and a rotor, and β swings harmonically whatever the ratio of masses.
#[test]
fn a_boom_swings_harmonically_at_any_ratio_of_masses() {
    let (arm, stiffness_of_reduced, start) = (0.5, 4.0, 0.3_f64);
    for exponent in [-9, -6, -3, 0, 3, 6, 9] {
        let mass = 10.0_f64.powi(exponent);
        let (hub_moment, boom_moment) = (2.0, 0.1 * mass);
        let seen = boom_moment + mass / (1.0 + mass) * arm * arm;
        let reduced = hub_moment * seen / (hub_moment + seen);
        let mut hinge = free(start, 0.0);
        let linear = -stiffness_of_reduced * reduced;
        hinge.spring = Spring { quadratic: 0.0, linear, preload_angle: 0.0 };
        let boom = (ball(mass, arm, boom_moment), hinge);
        let scene = checked(chain(ball(1.0, 0.0, hub_moment), Vec3::zero(), &[boom], 10.0));
        for options in both(&options(50)) {
            let (found, summary) = run(&scene, &options);
            let off = found
                .samples
                .iter()
                .map(|s| (s.beta[0] - start * (stiffness_of_reduced.sqrt() * s.time).cos()).abs());
            let worst = off.fold(0.0, f64::max);
            // Each step errs by rtol; no digits are lost to the ratio of masses.
            let allowed = summary.steps_accepted as f64 * RTOL;
            println!("1e{exponent}: {worst:.1e} of {allowed:.1e}");
            assert!(worst < allowed, "1e{exponent}: {worst:e} of {allowed:e}");
            let kept = summary.conservation;
            println!("{kept:?}");
            assert!(kept.energy < allowed, "{kept:?}");
            // The velocity of a heavy boom is the small difference of that of the light hub and
            // of that from the hub.
            let rounding = 1e-15 * mass.max(1.0);
            assert!(kept.linear_momentum.is_some_and(|off| off < rounding), "{kept:?}");
            assert!(kept.angular_momentum.is_some_and(|off| off < allowed + rounding), "{kept:?}");
        }
    }
}

/// A hub with three segments of these mass properties, turning about all axes.
fn tumbling(bodies: [MassProperties; 3]) -> nboom::model::SceneDescription {
    let [a, b, c] = bodies;
    let segments = [(a, free(0.4, 0.1)), (b, free(-0.7, 0.2)), (c, free(0.5, -0.3))];
    let point = Vec3::new(0.1, 0.6, 0.2);
    let mut scene = chain(ball(10.0, 0.1, 5.0), point, &segments, 5.0);
    scene.initial.omega_body = Vec3::new(0.2, -0.3, 0.5);
    scene
}

#[test]
fn flat_bodies_at_the_limit_of_the_triangle_inequality_are_followed() {
    let flat = |excess: f64| {
        let inertia = Sym3::diagonal(0.07, 0.13, (0.07 + 0.13) * (1.0 + excess));
        MassProperties::new(1.0, Vec3::unit_y() * 0.5, inertia)
    };
    for excess in [0.0, f64::EPSILON, 4.0 * f64::EPSILON, 0.9e-9] {
        let scene = checked(tumbling([flat(excess); 3]));
        for options in both(&options(20)) {
            conserving(&scene, &options, 10.0);
            let (off, _) = error(&scene, &options);
            // About a hundred steps, and the motion is regular.
            assert!(off < 100.0 * 10.0 * RTOL, "{off:e}");
        }
    }
    let refused = nboom::model::Scene::new(tumbling([flat(2e-9); 3])).expect_err("no body");
    let triangle =
        |e: &ModelError| matches!(e, ModelError::Mass { defect: MassDefect::Triangle(_), .. });
    assert!(refused.len() == 3 && refused.iter().all(triangle), "{refused:?}");
}

#[test]
fn axes_a_nanoradian_apart_move_like_parallel_ones() {
    let mut scene = tumbling([ball(1.0, 0.5, 0.1); 3]);
    let options = Options { path: Path::Generic, ..options(20) };
    let (parallel, _) = conserving(&checked(scene.clone()), &options, 10.0);
    for angle in [1e-12_f64, 0.9e-9, 1.1e-9, 1e-8] {
        for body in &mut scene.bodies[1..] {
            body.axis = Vec3::new(angle.cos(), angle.sin(), 0.0);
        }
        let (skew, summary) = conserving(&checked(scene.clone()), &options, 10.0);
        let apart =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let (a, b) = (parallel.last(), skew.last());
        let off = apart(&a.beta, &b.beta).max(apart(&a.tau, &b.tau));
        // A change of the equations by `angle` grows with time, here to less than 100-fold in 5
        // time units with rates below 1; below it both runs' steps err.
        let allowed = 100.0 * angle + 20.0 * summary.steps_accepted as f64 * RTOL;
        println!("{angle:e}: {off:.1e} of {allowed:.1e}");
        assert!(off < allowed, "{angle:e}: {off:e} of {allowed:e}");
        // What is told as sums along the chain is so on one side of 1e-9 only.
        let sums = (b.alpha[1] - b.beta[0] - b.beta[1]).abs() < 1e-15;
        assert_eq!(sums, angle < 1e-9, "{angle:e}");
    }
}
