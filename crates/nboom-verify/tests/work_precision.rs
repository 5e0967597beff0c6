//! Run time against error: what is run, and that errors are those of the runs.

use nboom_model::{MassProperties, Scene, SceneDescription};
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::Method;
use nboom_verify::{TimedRun, WorkPrecision};

/// A rigid body without symmetry, which all code covers.
fn measured() -> WorkPrecision {
    let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 2.0, 2.5));
    let mut description = SceneDescription::at_rest("top", body, 2.0);
    description.initial.omega_body = Vec3::new(0.3, 2.0, 0.1);
    let scene = Scene::new(description).expect("a physical body");
    WorkPrecision::measure(&scene, &[], 1e-3).expect("free spin is easy")
}

#[test]
fn errors_fall_with_the_tolerance_and_series_run_once() {
    let found = measured();
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
    assert!(csv.starts_with("path,formulation,integrator,rtol,error,microseconds,evaluations\n"));
    let table = found.table();
    assert!(table.contains("\nrecorded any taylor "), "{table}");
    let picture = found.picture();
    assert!(picture.contains(">recorded any taylor<"), "{picture}");
    assert!(picture.contains(">generic momentum dop853<"), "{picture}");
}
