//! A torque tabulated over the angle of a hinge: as a linear spring where its points are on a line;
//! else by energy, and by runs with far smaller tolerance and in double-double.

use nboom::elements::Kind;
use nboom::model::{Dashpot, Scene, SceneDescription, Spring, TorqueTable};
use nboom::sim::{EventKind, Method, Nobody, Options, Path, Reference, Witness, simulate, trust};

use super::collect;
use super::log::{options, run};
use super::oscillators::scene;

const NO_SPRING: Spring = Spring { quadratic: 0.0, linear: 0.0, preload_angle: 0.0 };

fn with_table(spring: Spring, start: [f64; 2], end: f64, points: &[[f64; 2]]) -> SceneDescription {
    let mut scene = scene(spring, Dashpot::default(), start[0], start[1], end);
    scene.torque_tables = vec![TorqueTable { hinge: 0, points: points.to_vec() }];
    scene
}

/// A well with a step, a level part and steep walls, in which a hinge swings over all points.
fn curved() -> SceneDescription {
    let points = [[-0.9, 40.0], [-0.5, 3.0], [-0.1, 3.0], [0.0, -1.0], [0.45, -2.0], [0.7, -60.0]];
    with_table(NO_SPRING, [0.2, 5.0], 12.0, &points)
}

#[test]
fn points_on_a_line_are_a_spring() {
    let (start, end) = ([0.9, -0.5], 8.0);
    let spring = Spring { quadratic: 0.0, linear: -3.0, preload_angle: 0.4 };
    let points = [-0.8, -0.3, 0.1, 0.15, 0.6].map(|angle| [angle, -3.0 * (angle + 0.4)]);
    let tight = options(50, 1e-14);
    let by_spring = run(&scene(spring, Dashpot::default(), start[0], start[1], end), &tight);
    let by_table = run(&with_table(NO_SPRING, start, end, &points), &tight);
    assert!(by_table.events.len() > 10, "it passes points in both directions");
    for (a, b) in by_spring.samples.iter().zip(&by_table.samples) {
        assert!((a.beta[0] - b.beta[0]).abs() < 1e-12, "{}: {} {}", a.time, a.beta[0], b.beta[0]);
        assert!((a.tau[0] - b.tau[0]).abs() < 1e-12, "{}: {} {}", a.time, a.tau[0], b.tau[0]);
    }
}

#[test]
fn a_table_acts_beside_a_spring() {
    let whole = Spring { quadratic: 0.0, linear: -3.0, preload_angle: 0.0 };
    let share = Spring { linear: -1.0, ..whole };
    let start = [0.4, 0.0];
    let tight = options(20, 1e-14);
    let alone = run(&scene(whole, Dashpot::default(), start[0], start[1], 5.0), &tight);
    let both = run(&with_table(share, start, 5.0, &[[-0.1, 0.2], [0.2, -0.4]]), &tight);
    for (a, b) in alone.samples.iter().zip(&both.samples) {
        assert!((a.beta[0] - b.beta[0]).abs() < 1e-12, "{}", a.time);
    }
}

/// Each piece of a table is a law of generated right sides, on one state and on eight.
#[test]
fn tables_run_by_generated_code_as_by_the_recursion() {
    let scene = Scene::new(curved()).expect("a valid scene");
    for integrator in [Method::Dop853, Method::GaussLanes] {
        let [generated, generic] = [Path::Generated, Path::Generic].map(|path| {
            let kernels = nboom_routines::for_runs();
            let batches = nboom_routines::right_sides_of_eight();
            let options = Options { path, kernels, batches, integrator, ..options(100, 1e-12) };
            collect::run(&scene, &options)
        });
        let reason = &generated.1.selections[0].reason;
        assert!(reason.ends_with("whole right side, also of eight states"), "{reason}");
        assert_eq!(generated.0.happenings().len(), generic.0.happenings().len());
        assert!(generated.1.conservation.energy < 1e-10);
        for (a, b) in generated.0.samples.iter().zip(&generic.0.samples) {
            // Both take the same steps and differ by rounding, which each of some fifty walls magnifies.
            assert!((a.beta[0] - b.beta[0]).abs() < 1e-11, "{integrator}, {}", a.time);
        }
    }
}

#[test]
fn energy_is_kept_over_points_at_the_tolerance() {
    for rtol in [1e-6, 1e-9, 1e-12] {
        let log = run(&curved(), &options(100, rtol));
        assert!(log.of_kind(EventKind::Rise(Kind::TorqueTable)).len() > 20);
        assert!(log.of_kind(EventKind::Fall(Kind::TorqueTable)).len() > 20);
        // A few hundred steps of one sign.
        let residual = log.summary.conservation.energy;
        assert!(residual < 300.0 * rtol, "{rtol:e}: {residual:e}");
    }
}

#[test]
fn steps_that_pass_points_are_as_good_as_their_tolerance() {
    let reference = run(&curved(), &options(60, 1e-13));
    for rtol in [1e-6, 1e-9] {
        let log = run(&curved(), &options(60, rtol));
        for (a, b) in log.samples.iter().zip(&reference.samples) {
            // Some 400 steps, whose errors the swing carries along as phase.
            let off = (a.beta[0] - b.beta[0]).abs().max(0.1 * (a.tau[0] - b.tau[0]).abs());
            assert!(off < 1000.0 * rtol, "{rtol:e}: {off:e} at {}", a.time);
        }
    }
}

#[test]
fn a_run_in_double_double_passes_the_same_points() {
    let scene = Scene::new(curved()).expect("a valid scene");
    let options = Options { rtol: 1e-9, atol: 1e-10, ..Options::default() };
    let mut witness = Witness::new();
    simulate(&scene, &options, &mut witness).expect("it runs to its end");
    let truth = Reference::DoubleDouble;
    let said = trust(&scene, &options, &witness, truth, &mut Nobody).expect("the reference runs");
    assert!(said.same_events);
    for digits in &said.end {
        assert!(digits.difference < 1e-6, "{digits:?}");
    }
}
