//! Run time against error: what is run, and that errors are those of the runs.

use nboom_model::{MassProperties, Scene, SceneDescription};
use nboom_scalar::{Mat3, Sym3, Vec3};
use nboom_sim::Method;
use nboom_verify::{TimedRun, WorkPrecision};

/// A rigid body without symmetry, which all code covers, for some time.
fn measured(center: Vec3<f64>, inertia: Sym3<f64>, omega: Vec3<f64>, end: f64) -> WorkPrecision {
    let body = MassProperties::new(1.0, center, inertia);
    let mut description = SceneDescription::at_rest("top", body, end);
    description.initial.omega_body = omega;
    let scene = Scene::new(description).expect("a physical body");
    WorkPrecision::measure(&scene, (&[], &[]), 1e-4).expect("free spin is easy")
}

/// About a principal axis through O and the mass centre, so that O stands still but for rounding; the
/// axis has no exact components along those of the body.
#[test]
fn rest_and_spin_about_one_axis_are_known_to_all_digits() {
    let turned = Mat3::about_axis(Vec3::unit_x(), 0.7) * Mat3::about_axis(Vec3::unit_y(), 1.1);
    let axis = turned * Vec3::unit_z();
    let inertia = Sym3::diagonal(1.0, 2.0, 2.5).rotated(&turned);
    for rate in [0.0, 2.0] {
        let found = measured(axis * 0.7, inertia, axis * rate, 0.5);
        // As for any motion.
        assert!(found.known_to < 1e-12, "{rate}: {:e}", found.known_to);
        let tight = found.runs.iter().filter(|run| run.rtol < 1e-11);
        for run in tight {
            assert!(run.error < 1e-9 && run.error_as_peers < 1e-9, "{rate}: {run:?}");
        }
    }
}

#[test]
fn errors_fall_with_the_tolerance_and_series_run_once() {
    let (center, omega) = (Vec3::new(0.1, 0.2, 0.7), Vec3::new(0.3, 2.0, 0.1));
    let found = measured(center, Sym3::diagonal(1.0, 2.0, 2.5), omega, 2.0);
    // Two methods on two derivations, some hundred steps of rounding each.
    assert!(found.known_to < 1e-12, "{:e}", found.known_to);
    let of = |path: &str, form: &str, integrator: Method| -> Vec<&TimedRun> {
        let same = |run: &&TimedRun| {
            (run.path, run.formulation, run.integrator) == (path, form, integrator)
        };
        found.runs.iter().filter(same).collect()
    };
    let curve = of("generic", "recursive", Method::Dop853);
    assert_eq!(curve.len(), 12, "1e-3 to 1e-14");
    for run in &curve {
        // Steps err by less than the tolerance each, and the motion magnifies that by little.
        assert!(run.error < 100.0 * run.rtol + found.known_to, "{run:?}");
        assert!(run.microseconds > 0.0 && run.microseconds.is_finite(), "{run:?}");
    }
    assert!(curve[0].error > 1e6 * curve[9].error, "{:e} {:e}", curve[0].error, curve[9].error);
    assert!(curve[9].evaluations > 2 * curve[0].evaluations);
    for form in ["report", "relative", "symmetric", "articulated", "momentum"] {
        assert_eq!(of("generic", form, Method::Dop853).len(), 12, "{form}");
    }
    let series: Vec<_> = found.runs.iter().filter(|run| run.integrator == Method::Taylor).collect();
    assert_eq!(series.len(), 12);
    assert!(series.iter().all(|run| run.path == "recorded"));

    let csv = found.csv();
    assert_eq!(csv.lines().count(), 1 + found.runs.len());
    assert!(csv.starts_with(
        "path,formulation,integrator,rtol,error,microseconds,evaluations,error_as_peers\n"
    ));
    for (row, run) in csv.lines().skip(1).zip(&found.runs) {
        let as_peers = row.rsplit(',').next().and_then(|cell| cell.parse::<f64>().ok());
        let told = as_peers.expect("a number in the last column");
        // Written with four digits.
        assert!((told - run.error_as_peers).abs() <= 1e-3 * run.error_as_peers, "{row}");
        // One quantity for all: its largest value is that of no smaller one.
        assert!(run.error_as_peers <= 4.0 * run.error + found.known_to, "{run:?}");
    }
    let table = found.table();
    assert!(table.contains("\nrecorded any taylor "), "{table}");
    let picture = found.picture();
    assert!(picture.contains(">recorded any taylor<"), "{picture}");
    assert!(picture.contains(">generic momentum dop853<"), "{picture}");
}
