//! Hinges with strong dashpots, whose equations are stiff.

use nboom::model::{Hinge, HingeState, Release, Scene, SceneDescription};
use nboom::sim::{Method, Options, Snapshot, Summary};

use crate::catalog::Reference;
use crate::collect::run;
use crate::compare::compare;

/// The chain of three hinges, each one changed.
fn chain(change: impl Fn(&mut Hinge)) -> Scene {
    let reference = Reference::load("s03_chain3_general");
    let mut description = SceneDescription::clone(&reference.scene());
    for body in &mut description.bodies {
        change(&mut body.hinge);
    }
    Scene::new(description).expect("hinges may be changed")
}

/// Hinges whose dashpots have this constant.
fn damped(constant: f64) -> Scene {
    chain(|hinge| {
        hinge.dashpot.rate_linear = -constant;
        hinge.start.rate = 0.0;
    })
}

fn run_with(integrator: Method, scene: &Scene) -> (Snapshot, Summary) {
    let options = Options { integrator, samples: 20, rtol: 1e-9, ..Options::default() };
    let (found, summary) = run(scene, &options);
    println!("{integrator}: {summary:?}");
    (found.last().clone(), summary)
}

/// Largest difference of angles, rates and attitude.
fn difference(a: &Snapshot, b: &Snapshot) -> f64 {
    let rates = (a.omega_body - b.omega_body).norm();
    let attitude = (a.attitude.to_matrix() * b.attitude.to_matrix().transpose()).rows;
    let turn = (attitude[0].y.abs() + attitude[1].z.abs() + attitude[2].x.abs()).max(rates);
    let hinges = a.beta.iter().chain(&a.tau).zip(b.beta.iter().chain(&b.tau));
    hinges.map(|(a, b)| (a - b).abs()).fold(turn, f64::max)
}

#[test]
fn implicit_and_explicit_agree_on_a_stiff_chain() {
    let scene = damped(3e3);
    let (implicit, cheap) = run_with(Method::Radau5, &scene);
    let (explicit, dear) = run_with(Method::Dop853, &scene);
    let found = difference(&implicit, &explicit);
    println!("{found:e}");
    assert!(found < 1e-7, "{found:e}");
    // A Jacobian is worth as many evaluations as there are variables, which are 14.
    assert!(
        dear.evaluations > 20 * cheap.evaluations,
        "{} {}",
        dear.evaluations,
        cheap.evaluations
    );
}

#[test]
fn a_dashpot_of_1e8_holds_like_a_latch() {
    let (found, summary) = run_with(Method::Radau5, &damped(1e8));
    let (held, _) = run_with(
        Method::Dop853,
        &chain(|hinge| {
            hinge.start.state = HingeState::Unreleased;
            hinge.start.rate = 0.0;
            hinge.release = Release::Never;
        }),
    );
    // What yields is torque times time over the constant; torques are near 3, the time is 5.
    let yielded = difference(&found, &held);
    println!("{yielded:e}");
    assert!(summary.evaluations < 2000, "{}", summary.evaluations);
    assert!((1e-8..1e-6).contains(&yielded), "{yielded:e}");
    // Residuals at output times are those of dense output, 0.1 · 1e-9^(2/3) in each variable.
    let residuals = summary.conservation;
    assert!(residuals.laws().all(|(_, residual)| residual < 1e-7), "{residuals:?}");
}

#[test]
fn implicit_runs_agree_with_the_references() {
    for (reference, integrator) in [Method::Radau5, Method::Radau9, Method::Radau13]
        .into_iter()
        .flat_map(|integrator| Reference::all().map(move |reference| (reference, integrator)))
    {
        let samples = reference.intervals();
        let options =
            Options { integrator, samples, rtol: 1e-11, atol: 1e-12, ..Options::default() };
        let (found, summary) = run(&reference.scene(), &options);
        let deviation = compare(&found, &reference);
        println!(
            "{integrator}, {}: {deviation}, {} evaluations",
            reference.name, summary.evaluations
        );
        // States are read from dense output, events are reached by steps.
        assert!(deviation.states < 1e-8, "{}: {deviation}", reference.name);
        let at_events = deviation.times.max(deviation.impulses);
        assert!(at_events < 1e-9, "{}: {deviation}", reference.name);
    }
}
