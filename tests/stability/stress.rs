//! Scenes under stress, and what every run of them owes.

use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, MassProperties, Mount, Scene, SceneDescription,
    Segment,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Nobody, Options, Path, Reference, Summary, Witness, simulate, trust};

use crate::collect::{Collected, run};

/// Errors allowed in a step, unless a test says otherwise.
pub const RTOL: f64 = 1e-11;

pub fn options(samples: usize) -> Options {
    Options { samples, rtol: RTOL, atol: 1e-13, ..Options::default() }
}

/// By the recursion, and by generated routines.
pub fn both(options: &Options) -> [Options; 2] {
    let kernels = nboom_routines::all();
    [
        Options { path: Path::Generic, ..*options },
        Options { path: Path::Generated, kernels, ..*options },
    ]
}

/// A hinge that starts free.
pub fn free(angle: f64, rate: f64) -> Hinge {
    Hinge { start: HingeStart { angle, rate, state: HingeState::Free }, ..Hinge::free() }
}

/// A ball with its mass centre this far from its hinge.
pub fn ball(mass: f64, arm: f64, moment: f64) -> MassProperties {
    let inertia = Sym3::diagonal(moment, moment, moment);
    MassProperties::new(mass, Vec3::unit_y() * arm, inertia)
}

/// A hub with a chain of segments of length 1, hinged at `point`.
pub fn chain(
    hub: MassProperties,
    point: Vec3<f64>,
    segments: &[(MassProperties, Hinge)],
    end_time: f64,
) -> SceneDescription {
    let mut description = SceneDescription::at_rest("stress", hub, end_time);
    let segment = |&(mass_properties, hinge)| Segment { length: 1.0, mass_properties, hinge };
    description.attach(&Appendage::Regular {
        mount: Mount::at(point),
        segments: segments.iter().map(segment).collect(),
    });
    description
}

pub fn checked(description: SceneDescription) -> Scene {
    Scene::new(description).expect("a physical scene")
}

/// Runs the scene; momentum and energy may drift by as much as its steps may err, each by `rtol`
/// of the largest variable and all in the same sense, times `condition`; the norm of the attitude
/// is put back after each step, and dense output errs like a step.
pub fn conserving(scene: &Scene, options: &Options, condition: f64) -> (Collected, Summary) {
    let (found, summary) = run(scene, options);
    let allowed = (summary.steps_accepted as f64 + 10.0) * options.rtol * condition;
    let kept = summary.conservation;
    let norm = |q: &nboom::scalar::Quaternion<f64>| q.scalar.hypot(q.vector.norm());
    let off = found.samples.iter().map(|s| (norm(&s.attitude) - 1.0).abs()).fold(0.0, f64::max);
    println!(
        "{}: {} steps, {kept:?}, norm {off:.1e}, allowed {allowed:.1e}",
        summary.selections[0].path, summary.steps_accepted
    );
    // Translation is known in closed form; some roundings for each body.
    let rounding = 1e-15 * (10.0 + scene.bodies.len() as f64);
    assert!(kept.linear_momentum.is_some_and(|off| off < rounding), "{kept:?}");
    assert!(kept.angular_momentum.is_some_and(|off| off < allowed), "{kept:?}, {allowed:e}");
    assert!(kept.energy < allowed, "{kept:?}, {allowed:e}");
    assert!(off < 10.0 * options.rtol, "norm {off:e}");
    (found, summary)
}

/// The largest difference in the final angles and rates from a run a thousand times tighter,
/// and whether both have the same events.
pub fn error(scene: &Scene, options: &Options) -> (f64, bool) {
    let mut witness = Witness::new();
    simulate(scene, options, &mut witness).expect("it runs to its end");
    let reference = Reference::TighterTolerance;
    let found =
        trust(scene, options, &witness, reference, &mut Nobody).expect("the tighter run, too");
    let of_interest = found.end.iter().filter(|d| !["rho", "v"].contains(&d.quantity));
    let worst = of_interest.map(|d| d.difference).fold(0.0, f64::max);
    println!("error {worst:.1e}, same events: {}", found.same_events);
    (worst, found.same_events)
}
