//! Booms straight and folded back, and chains that crack like a whip.

use std::f64::consts::PI;

use nboom::model::{Hinge, MassProperties, Scene};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Method, Options, Path};

use crate::stress::{ball, both, chain, checked, conserving, error, free, options};

/// A rod along y with its hinge at one end.
fn rod(mass: f64) -> MassProperties {
    let across = mass / 12.0;
    let inertia = Sym3::diagonal(across, 1e-3 * mass, across);
    MassProperties::new(mass, Vec3::unit_y() * 0.5, inertia)
}

/// A hub with three rods at these angles, nudged out of them by the hub's turning.
fn posed(angles: [f64; 3]) -> Scene {
    let segments = angles.map(|angle| (rod(1.0), free(angle, 0.0)));
    let mut scene = chain(ball(10.0, 0.0, 5.0), Vec3::unit_y() * 0.6, &segments, 3.0);
    scene.initial.omega_body = Vec3::new(0.2, 0.1, 0.3);
    checked(scene)
}

#[test]
fn straight_and_folded_booms_are_no_singular_postures() {
    for angles in [[0.0; 3], [0.0, PI, 0.0], [0.0, PI, PI], [PI, PI, PI], [PI, -PI, PI]] {
        let scene = posed(angles);
        for options in both(&options(20)) {
            conserving(&scene, &options, 10.0);
            let (off, _) = error(&scene, &options);
            // Some fifty steps; a departure from a fold grows less than 100-fold.
            assert!(off < 50.0 * 100.0 * options.rtol, "{angles:?}: {off:e}");
        }
    }
}

/// A chain of rods thrown by its first hinge: the bend runs outwards and the tip cracks.
fn whip(segments: usize, end_time: f64) -> Scene {
    let hinge = |i: usize| -> Hinge {
        match i {
            0 => free(0.0, 3.0),
            _ => free(0.1 * (i as f64 * 0.7).sin(), 0.0),
        }
    };
    // Masses fall off towards the tip, which makes it fast.
    let taper = |i: usize| 0.9_f64.powi(i as i32);
    let parts: Vec<_> = (0..segments).map(|i| (rod(taper(i)), hinge(i))).collect();
    checked(chain(ball(50.0, 0.0, 50.0), Vec3::unit_y(), &parts, end_time))
}

/// Follows a whip; returns the error against a tighter run.
fn crack(segments: usize, end_time: f64, integrator: Method, rtol: f64) -> f64 {
    let options = Options { path: Path::Generic, integrator, rtol, ..options(20) };
    let scene = whip(segments, end_time);
    let (found, _) = conserving(&scene, &options, 10.0);
    let fastest = found.samples.iter().flat_map(|s| &s.sigma).fold(0.0_f64, |m, s| m.max(s.abs()));
    println!("{segments}: fastest {fastest:.1}");
    // It does crack: a segment turns faster than the first one was thrown.
    assert!(fastest > 6.0, "{fastest}");
    error(&scene, &options).0
}

#[test]
fn a_whip_of_30_segments_cracks_and_keeps_its_energy() {
    let crack = |integrator, rtol| crack(30, 3.0, integrator, rtol);
    let (loose, tight) = (crack(Method::Dop853, 1e-8), crack(Method::Dop853, 1e-11));
    // The motion magnifies errors, but those that are allowed only: they fall with rtol.
    assert!(tight < 0.02 * loose && tight < 1e-5, "{loose:e}, {tight:e}");
    // Nor does it magnify those of other methods more, whose errors are not in proportion to rtol.
    let magnification = loose / 1e-8;
    for rtol in [1e-8, 1e-11] {
        let error = crack(Method::Auto, rtol);
        assert!(error < magnification * rtol, "{rtol:e}: {error:e}");
    }
}

#[test]
#[ignore = "long; figures in docs/accuracy.md"]
fn a_whip_of_100_segments_keeps_its_energy() {
    let early = whip(100, 0.1);
    let options = Options { path: Path::Generic, rtol: 1e-10, ..options(20) };
    let (off, _) = error(&early, &options);
    let (_, summary) = conserving(&early, &options, 10.0);
    // Until the bend has run on, errors are magnified less than 1000-fold.
    assert!(off < summary.steps_accepted as f64 * 1000.0 * options.rtol, "{off:e}");
    // Then the motion is chaotic: what stays known is what is conserved.
    crack(100, 1.0, options.integrator, options.rtol);
}
