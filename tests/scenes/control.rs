//! Control laws over all code that computes accelerations.

use nboom::model::Scene;
use nboom::scalar::{Vec3, Wrench};
use nboom::sim::{Commands, Control, Options, Path, Simulator, Snapshot, Summary};

use crate::catalog::Reference;
use crate::collect::{Collected, run, tight};

/// Torques about all hinges, and a wrench on the main body that comes and goes.
fn law(seen: &Snapshot, commands: &mut Commands) {
    let t = seen.time;
    for (i, torque) in commands.hinge_torques_mut().iter_mut().enumerate() {
        *torque = 0.1 * (9.0 * t + i as f64).sin() - 0.05 * seen.tau[i];
    }
    let pushes = (5.0 * t).sin() > 0.0;
    let (force, moment) = (Vec3::new(0.2, -0.1, 0.1), Vec3::new(-0.1, 0.05, 0.2));
    commands.main_body = if pushes { Wrench { moment, force } } else { Wrench::zero() };
}

fn controlled(simulator: &mut Simulator, scene: &Scene) -> (Collected, Summary) {
    let mut found = Collected::default();
    let period = (scene.end_time - scene.initial.time) / 50.0;
    let control = Control { period, law: &mut law };
    let summary = simulator.run_controlled(control, &mut found).expect("reference scenes run");
    (found, summary.clone())
}

/// The stock has routines of accelerations and whole right sides; the latter have no place for commands
/// and come back when there is no control law.
#[test]
fn routines_and_the_recursion_agree_under_control() {
    let stock = Options {
        kernels: nboom_routines::for_runs(),
        batches: nboom_routines::right_sides_of_eight(),
        ..tight(5)
    };
    for reference in Reference::all().filter(|r| r.name.starts_with("s0")) {
        let scene = reference.scene();
        let scene = scene.ending_at(0.3 * scene.end_time).expect("a time");
        let generic = Options { path: Path::Generic, ..tight(5) };
        let (expected, _) = controlled(&mut Simulator::new(&scene, generic), &scene);
        let mut simulator = Simulator::new(&scene, stock);
        for _ in 0..2 {
            let (found, summary) = controlled(&mut simulator, &scene);
            assert_eq!(summary.code().path, "generated", "{}", reference.name);
            let kept = summary.conservation;
            for (_, residual) in kept.laws() {
                assert!(residual < 1e-9, "{}: {kept:?}", reference.name);
            }
            let (found, expected) = (found.last(), expected.last());
            let pairs =
                found.beta.iter().zip(&expected.beta).chain(found.tau.iter().zip(&expected.tau));
            let rates = found.omega_body - expected.omega_body;
            let off = pairs.fold(rates.norm(), |worst, (a, b)| worst.max((a - b).abs()));
            // The tolerance is 1e-12, in some hundred steps.
            assert!(off < 1e-9, "{}: {off:e}", reference.name);
            let mut alone = Collected::default();
            simulator.run(&mut alone).expect("reference scenes run");
            let is_alone = alone.samples == run(&scene, &stock).0.samples;
            assert!(is_alone, "{}: something of the control is left", reference.name);
        }
    }
}
