//! What drives a hinge away from its lock angle where it starts.

use nboom_model::{
    Appendage, Coupling, Hinge, HingeLabel, HingeState, KickOffSpring, MassProperties,
    ModelWarning, Mount, Release, Scene, SceneDescription, Segment, Spring, TorqueTable,
};
use nboom_scalar::{Sym3, Vec3};

const FIRST: HingeLabel = HingeLabel::new(0, 0);

/// A chain of rods of length 1 on these hinges, the first one length along the body's y axis.
fn chain(hinges: &[Hinge]) -> SceneDescription {
    let mass_properties = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("chain", mass_properties, 1.0);
    let segment = |&hinge: &Hinge| Segment { length: 1.0, mass_properties, hinge };
    let segments = hinges.iter().map(segment).collect();
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    description
}

fn warnings(description: SceneDescription) -> Vec<ModelWarning> {
    Scene::new(description).expect("a scene").warnings()
}

fn one(hinge: Hinge) -> Vec<ModelWarning> {
    warnings(chain(&[hinge]))
}

fn from_to(start: f64, lock: f64) -> Hinge {
    let mut hinge = Hinge { lock_angle: Some(lock), ..Hinge::free() };
    hinge.start.angle = start;
    hinge
}

/// The torque -(β - rest).
fn spring(rest: f64) -> Spring {
    Spring { linear: -1.0, preload_angle: -rest, ..Spring::default() }
}

#[test]
fn a_spring_that_drives_away_from_the_lock_angle() {
    let away = |start, lock, rest: f64| {
        let found = one(Hinge { spring: spring(rest), ..from_to(start, lock) });
        found == [ModelWarning::DrivenFromLock { hinge: FIRST, start, lock }]
    };
    assert!(away(1.0, 0.0, 2.0) && away(-1.0, 0.0, -2.0) && away(0.0, 1.0, -0.1));
    assert!(!away(1.0, 0.0, -2.0) && !away(1.0, 0.0, 0.5));
    // At rest where it starts.
    assert!(!away(0.1 + 0.2, 1.0, 0.3));
}

/// A force of 5 along x at the outer end of a boom that stands along y turns it from z to y, against
/// its angle about x; one along z turns it along.
#[test]
fn a_kick_off_spring_may_turn_it_all_the_same() {
    let hinge = Hinge { spring: spring(2.0), ..from_to(1.0, 0.0) };
    let (y, z) = (1.0_f64.cos(), 1.0_f64.sin());
    let end = Vec3::new(0.0, 1.0 + y, z);
    let pushed_along = |direction: Vec3<f64>, force: f64| {
        let kick_off = KickOffSpring {
            main_body_point: end - direction,
            body_point: Vec3::unit_y(),
            coefficients: [force, 0.0, 0.0, 0.0],
            limit_length: 2.0,
        };
        one(Hinge { kick_off: Some(kick_off), ..hinge })
    };
    let inward = Vec3::new(0.0, z, -y);
    let warned = ModelWarning::DrivenFromLock { hinge: FIRST, start: 1.0, lock: 0.0 };
    // The spring's torque is 1, the force's its own size over an arm of 1.
    assert_eq!(pushed_along(inward, 1.5), []);
    assert_eq!(pushed_along(inward, 0.5), std::slice::from_ref(&warned));
    assert_eq!(pushed_along(inward * -1.0, 1.5), std::slice::from_ref(&warned));
    let force = -0.5;
    let pulls = ModelWarning::KickOffPulls { hinge: FIRST, force, length: 1.0 };
    let found = pushed_along(inward, force);
    assert_eq!(found[0], warned);
    assert_eq!(found[1].to_string().split(':').next(), pulls.to_string().split(':').next());
}

/// What drives the first hinge, which starts at 1 and locks at 0, away from there beside a spring of torque 1.
#[test]
fn all_that_acts_at_the_start_is_judged_together() {
    let pushed = Hinge { spring: spring(2.0), ..from_to(1.0, 0.0) };
    let driven = |first: Hinge, second: Hinge, change: &dyn Fn(&mut SceneDescription)| {
        let mut description = chain(&[first, second]);
        change(&mut description);
        warnings(description).contains(&ModelWarning::DrivenFromLock {
            hinge: FIRST,
            start: 1.0,
            lock: 0.0,
        })
    };
    let table = |torque: f64| {
        move |scene: &mut SceneDescription| {
            let points = vec![[0.0, torque], [2.0, torque]];
            scene.torque_tables.push(TorqueTable { hinge: 0, points });
        }
    };
    let (bare, other) = (from_to(1.0, 0.0), from_to(1.5, 0.0));
    assert!(driven(bare, other, &table(0.1)) && !driven(bare, other, &table(-0.1)));
    assert!(driven(pushed, other, &table(-0.9)) && !driven(pushed, other, &table(-1.1)));
    assert!(!driven(pushed, other, &table(-1.0)), "it is at rest");
    // Towards the angle of the other hinge, 1.5, or that less 1.
    let coupled = |hinges, stiffness, rest, is_mutual| {
        move |scene: &mut SceneDescription| {
            let (ratio, damping) = (1.0, 0.0);
            scene.couplings.push(Coupling { hinges, ratio, stiffness, rest, damping, is_mutual });
        }
    };
    for hinges in [[0, 1], [1, 0]] {
        let rest = if hinges == [0, 1] { -1.0 } else { 1.0 };
        assert!(driven(bare, other, &coupled(hinges, 0.1, 0.0, true)));
        assert!(!driven(bare, other, &coupled(hinges, 0.1, rest, true)));
        assert!(driven(pushed, other, &coupled(hinges, 1.9, rest, true)));
        assert!(!driven(pushed, other, &coupled(hinges, 2.1, rest, true)));
    }
    // One that acts on the first alone pulls with -k (1.5 - rest).
    assert!(driven(bare, other, &coupled([0, 1], 0.1, 1.6, false)));
    assert!(!driven(bare, other, &coupled([0, 1], 0.1, 1.4, false)));
    assert!(!driven(bare, other, &coupled([1, 0], 0.1, 9.0, false)));
    // Until its release the other hinge may have moved.
    let waits = |hinge: Hinge| {
        let mut hinge = Hinge { release: Release::Time(0.5), ..hinge };
        hinge.start.state = HingeState::Unreleased;
        hinge
    };
    let mut held = other;
    held.start.state = HingeState::Locked;
    assert!(!driven(waits(bare), other, &coupled([0, 1], 0.1, 0.0, true)));
    assert!(driven(waits(bare), held, &coupled([0, 1], 0.1, 0.0, true)));
    assert!(driven(waits(bare), other, &table(0.1)));
}

#[test]
fn a_kick_off_spring_of_any_body_outboard_may_push_the_wrong_way() {
    // From the main body to the end of the second body of a straight chain, which is pushed along z.
    let kick_off = |force: f64| {
        let body_point = Vec3::unit_y();
        let main_body_point = Vec3::new(0.0, 3.0, -1.0);
        let coefficients = [force, 0.0, 0.0, 0.0];
        Some(KickOffSpring { main_body_point, body_point, coefficients, limit_length: 2.0 })
    };
    let driven = |lock: f64, outer: Hinge| {
        let found = warnings(chain(&[from_to(0.0, lock), outer]));
        found.iter().filter(|one| matches!(one, ModelWarning::DrivenFromLock { .. })).count()
    };
    let outer = |lock| Hinge { kick_off: kick_off(2.0), ..from_to(0.0, lock) };
    assert_eq!(driven(1.0, outer(1.0)), 0);
    assert_eq!(driven(-1.0, outer(1.0)), 1);
    assert_eq!(driven(-1.0, outer(-1.0)), 2);
    // What waits for its release is pushed otherwise by then, unless the other hinge stays.
    let mut waits = Hinge { release: Release::Time(0.5), ..outer(-1.0) };
    waits.start.state = HingeState::Unreleased;
    assert_eq!(driven(1.0, waits), 0);
    let mut held = from_to(0.0, 1.0);
    held.start.state = HingeState::Locked;
    let found = warnings(chain(&[held, waits]));
    assert!(found.iter().any(|one| matches!(one, ModelWarning::DrivenFromLock { .. })));
}
