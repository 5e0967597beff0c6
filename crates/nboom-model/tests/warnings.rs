//! Signs and geometry that nobody means, told before a run; and what is meant, which is not.

use std::f64::consts::{FRAC_PI_2, PI};

use nboom_model::{
    Appendage, Coupling, Course, Dashpot, External, Hinge, HingeLabel, HingeState, KickOffSpring,
    MassProperties, ModelWarning, Mount, Posture, Release, Scene, SceneDescription, Segment,
    Spring, TorqueTable,
};
use nboom_scalar::{Mat3, Sym3, Vec3};

const FIRST: HingeLabel = HingeLabel::new(0, 0);

fn body() -> MassProperties {
    MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0))
}

/// A chain with these hinges and lengths, its first hinge one length along the body's y axis.
fn chain(hinges: &[(Hinge, f64)]) -> Scene {
    Scene::new(description(hinges)).expect("a scene")
}

fn description(hinges: &[(Hinge, f64)]) -> SceneDescription {
    let mut description = SceneDescription::at_rest("chain", body(), 1.0);
    let segment =
        |&(hinge, length): &(Hinge, f64)| Segment { length, mass_properties: body(), hinge };
    let segments = hinges.iter().map(segment).collect();
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    description
}

fn one(hinge: Hinge) -> Vec<ModelWarning> {
    chain(&[(hinge, 1.0)]).warnings()
}

fn from_to(start: f64, lock: f64) -> Hinge {
    let mut hinge = Hinge { lock_angle: Some(lock), ..Hinge::free() };
    hinge.start.angle = start;
    hinge
}

fn spring(quadratic: f64, linear: f64, preload_angle: f64) -> Spring {
    Spring { quadratic, linear, preload_angle }
}

#[test]
fn a_dashpot_that_feeds_energy_at_every_rate() {
    let dashpot = |rate_linear| Dashpot { rate_linear, ..Dashpot::default() };
    let hinge = from_to(1.0, 0.0);
    assert_eq!(one(Hinge { dashpot: dashpot(-0.5), ..hinge }), []);
    assert_eq!(
        one(Hinge { dashpot: dashpot(0.5), ..hinge })[0].to_string(),
        "dashpot of hinge 1,1 feeds energy: a torque of 0.5 for each unit of rate, along the motion, found, one \
         against it expected"
    );
}

#[test]
fn a_coupling_that_feeds_energy() {
    let coupled = |damping| {
        let mut description = description(&[(Hinge::free(), 1.0), (Hinge::free(), 1.0)]);
        let (hinges, is_mutual) = ([0, 1], true);
        let coupling =
            Coupling { hinges, ratio: 1.0, stiffness: 0.0, rest: 0.0, damping, is_mutual };
        description.couplings.push(coupling);
        Scene::new(description).expect("a scene").warnings()
    };
    assert_eq!(coupled(3.0), []);
    assert_eq!(
        coupled(-3.0)[0].to_string(),
        "coupling of hinges 1,1 and 1,2 feeds energy: damping -3.0 found, no negative one expected"
    );
}

/// Power q₁τ³ + q₂τ² is above zero for τ of the sign of q₁ beyond |q₂/q₁|.
#[test]
fn a_dashpot_that_feeds_energy_at_great_rates() {
    let dashpot = Dashpot { rate_quadratic: 0.2, rate_linear: -0.5, ..Dashpot::default() };
    let warned =
        |beyond| [ModelWarning::DashpotFeeds { hinge: FIRST, coefficient: (0.2, 2), beyond }];
    assert_eq!(one(Hinge { dashpot, ..from_to(0.0, 1.0) }), warned(2.5));
    assert_eq!(one(Hinge { dashpot, ..Hinge::free() }), warned(2.5));
    // It turns the other way, in which the squared rate damps as well.
    assert_eq!(one(Hinge { dashpot, ..from_to(1.0, 0.0) }), []);
    let mut held = from_to(0.0, 1.0);
    held.start.state = HingeState::Locked;
    assert!(!one(Hinge { dashpot, ..held }).contains(&warned(2.5)[0]));
    (held.start.state, held.release) = (HingeState::Unreleased, Release::Never);
    assert_eq!(one(Hinge { dashpot, ..held }), []);
}

#[test]
fn a_spring_without_an_angle_of_rest() {
    let hinge = from_to(1.0, 2.0);
    assert_eq!(one(Hinge { spring: spring(0.0, -3.0, -2.0), ..hinge }), []);
    // From rest at 0.25 it is pushed to the lock angle, ever harder.
    let found = one(Hinge { spring: spring(0.0, 3.0, -0.25), ..hinge });
    let stiffness = 3.0;
    let warning = ModelWarning::SpringWithoutRest { hinge: FIRST, stiffness, away_from: 0.25 };
    assert_eq!(found, [warning]);
    // The dashpot's angle terms are springs too.
    let dashpot = Dashpot { angle_linear: 1.0, ..Dashpot::default() };
    assert_eq!(one(Hinge { spring: spring(0.0, -3.0, -2.0), dashpot, ..hinge }), []);
    let dashpot = Dashpot { angle_linear: 4.0, ..Dashpot::default() };
    assert_eq!(one(Hinge { spring: spring(0.0, -3.0, -2.0), dashpot, ..hinge }).len(), 1);
}

/// Torque β² − (β + 1): at rest at one of its roots (1 ± √5)/2, beyond the other it drives on.
#[test]
fn a_quadratic_spring_that_drives_on() {
    let quadratic = Hinge {
        spring: spring(1.0, 0.0, 0.0),
        dashpot: Dashpot { angle_linear: -1.0, preload_angle: 1.0, ..Dashpot::default() },
        ..Hinge::free()
    };
    let starting = |angle: f64| {
        let mut hinge = quadratic;
        hinge.start.angle = angle;
        hinge
    };
    let drives_on = |hinge| {
        one(hinge).iter().any(|warning| matches!(warning, ModelWarning::SpringDrivesOn { .. }))
    };
    let summit = 0.5 * (1.0 + 5.0_f64.sqrt());
    assert!(!drives_on(starting(summit - 0.01)));
    assert!(drives_on(starting(summit + 0.01)));
    // The potential −β³/3 + β²/2 + β has the summit's value again where (β − summit)² (β + s) is
    // zero: s = 2 summit − 3/2.
    let as_high = 1.5 - 2.0 * summit;
    assert!(!drives_on(starting(as_high + 0.01)));
    assert!(drives_on(starting(as_high - 0.01)));
    // A lock angle on the way stops it, one behind does not.
    let start = summit + 0.01;
    assert!(!drives_on(Hinge { lock_angle: Some(4.0), ..starting(start) }));
    assert!(drives_on(Hinge { lock_angle: Some(0.0), ..starting(start) }));
}

#[test]
fn a_chain_that_folds_back_onto_itself() {
    let texts = |angles: &[f64], lengths: &[f64]| -> Vec<String> {
        let hinges = angles.iter().map(|&angle| from_to(0.5, angle));
        let hinges: Vec<_> = hinges.zip(lengths.iter().copied()).collect();
        chain(&hinges).warnings().iter().map(ModelWarning::to_string).collect()
    };
    let folded = |hinge: &str, inboard: &str, lock: &str| {
        format!(
            "segment {hinge}, locked at {lock} deg, lies folded back on segment {inboard}; at 0 deg it \
             is straight"
        )
    };
    assert_eq!(texts(&[PI, 0.0, FRAC_PI_2], &[1.0; 3]), [""; 0]);
    assert_eq!(texts(&[0.0, PI], &[1.0, 0.3]), [folded("1,2", "1,1", "180")]);
    assert_eq!(texts(&[0.0, 3.0 * PI], &[1.0, 0.3]), [folded("1,2", "1,1", "540")]);
    assert_eq!(texts(&[0.0, 0.0, -PI], &[1.0; 3]), [folded("1,3", "1,2", "-180")]);
    // Nothing of no length lies on anything.
    assert_eq!(texts(&[0.0, PI], &[1.0, 0.0]), [""; 0]);
    // A triangle and a square close on themselves, a square with a longer side does not.
    let third = 2.0 * PI / 3.0;
    let closed = |hinge: &str| {
        format!("with all hinges locked the outer end of segment {hinge} is back at hinge 1,1")
    };
    assert_eq!(texts(&[0.2, third, third], &[2.0; 3]), [closed("1,3")]);
    assert_eq!(texts(&[0.2, FRAC_PI_2, FRAC_PI_2, FRAC_PI_2], &[2.0; 4]), [closed("1,4")]);
    assert_eq!(texts(&[0.2, FRAC_PI_2, FRAC_PI_2, FRAC_PI_2], &[2.0, 2.0, 2.5, 2.0]), [""; 0]);
}

#[test]
fn what_is_stowed_folded_or_has_no_lock_angle_is_not_told() {
    let mut folded = from_to(PI, 0.0);
    assert_eq!(chain(&[(from_to(1.0, 0.0), 1.0), (folded, 1.0)]).warnings(), []);
    folded.lock_angle = None;
    assert_eq!(chain(&[(from_to(1.0, 0.0), 1.0), (folded, 1.0)]).warnings(), []);
    (folded.start.state, folded.lock_angle) = (HingeState::Locked, Some(PI));
    assert_eq!(chain(&[(from_to(1.0, 0.0), 1.0), (folded, 1.0)]).warnings(), []);
}

/// A boom of 2 and one of 1 about the body's z axis, from (3, 0, 0) on: stowed at 90 and 180 degrees,
/// locked at 0 and 90. A paddle's axis is its arm's.
#[test]
fn places_of_hinges_axes_and_outer_ends() {
    let (x, y, z) = (Vec3::unit_x(), Vec3::<f64>::unit_y(), Vec3::unit_z());
    // Appendage axes: the hinge axis along z, the straight boom along x.
    let mount = Mount { point: x * 3.0, rot_inboard_from_hinge: Mat3::from_columns(z, x, y) };
    let boom = |start, lock, length| Segment {
        length,
        mass_properties: body(),
        hinge: from_to(start, lock),
    };
    let mut description = SceneDescription::at_rest("two", body(), 1.0);
    let segments = vec![boom(FRAC_PI_2, 0.0, 2.0), boom(PI, FRAC_PI_2, 1.0)];
    description.attach(&Appendage::Regular { mount, segments });
    let (arm, paddle) = (boom(FRAC_PI_2, 0.0, 2.0), boom(0.3, 0.4, 5.0));
    description.attach(&Appendage::Paddle { mount, arm, paddle });
    let scene = Scene::new(description).expect("a scene");
    let (stowed, locked) = (Posture::at_start(&scene), Posture::locked(&scene));
    let near = |found: Vec3<f64>, expected: Vec3<f64>| (found - expected).norm() < 1e-14;
    let check = |posture: &Posture, i: usize, point, axis, tip| {
        let found = &posture.hinges[i];
        assert!(near(found.point, point), "{i}: {found:?}");
        assert!(near(found.axis, axis), "{i}: {found:?}");
        assert!(near(found.tip, tip), "{i}: {found:?}");
    };
    check(&stowed, 0, x * 3.0, z, x * 3.0 + y * 2.0);
    check(&stowed, 1, x * 3.0 + y * 2.0, z, x * 3.0 + y);
    check(&locked, 0, x * 3.0, z, x * 5.0);
    check(&locked, 1, x * 5.0, z, x * 5.0 + y);
    check(&stowed, 3, x * 3.0 + y * 2.0, y, x * 3.0 + y * 7.0);
    check(&locked, 3, x * 5.0, x, x * 10.0);
}

#[test]
fn what_a_table_adds_to_is_not_judged_alone() {
    let hinge = Hinge { spring: spring(0.0, 3.0, 0.0), ..Hinge::free() };
    let scene = chain(&[(hinge, 1.0), (hinge, 1.0)]);
    let mut description = SceneDescription::clone(&scene);
    let table = TorqueTable { hinge: 0, points: vec![[-1.0, 9.0], [1.0, -9.0]] };
    description.torque_tables.push(table);
    let with_table = Scene::new(description).expect("a scene");
    assert_eq!((scene.warnings().len(), with_table.warnings().len()), (2, 1));
}

#[test]
fn starts_and_releases_that_are_hardly_meant() {
    let told = |hinges: &[(Hinge, f64)]| -> Vec<String> {
        chain(hinges).warnings().iter().map(ModelWarning::to_string).collect()
    };
    let waiting = |angle| {
        let mut hinge = Hinge { release: Release::Angle { hinge: 0, angle }, ..from_to(0.3, 1.0) };
        hinge.start.state = HingeState::Unreleased;
        hinge
    };
    let quarter = from_to(FRAC_PI_2, 0.0);
    assert_eq!(told(&[(quarter, 1.0), (waiting(PI / 4.0), 1.0)]), Vec::<String>::new());
    assert_eq!(
        told(&[(quarter, 1.0), (waiting(0.75 * PI), 1.0)]),
        [
            "hinge 1,2 waits for 135 deg of hinge 1,1, which starts at 90 deg and locks at 0 deg, the other way"
        ]
    );
    assert_eq!(
        told(&[(from_to(90.0, 0.0), 1.0)]),
        ["hinge 1,1 starts at 5156.62 deg, 14.3 turns away from zero"]
    );
    assert_eq!(
        told(&[(from_to(0.5, 0.5), 1.0)]),
        ["hinge 1,1 starts free at its lock angle: it locks only when it comes back there"]
    );
    assert_eq!(
        told(&[(from_to(0.5, 0.5 + f64::EPSILON), 1.0)]),
        [
            "hinge 1,1 starts free 2.220446049250313e-16 from its lock angle: it locks at once if it moves there, else \
          only when it comes back"
        ]
    );
    let mut held = Hinge { release: Release::Time(0.5), ..from_to(0.5, 0.5) };
    held.start.state = HingeState::Unreleased;
    assert_eq!(
        told(&[(held, 1.0)]),
        [
            "hinge 1,1 is held until its release at its lock angle: it locks only when it comes back there"
        ]
    );
    let mut late = Hinge { release: Release::Time(2.0), ..quarter };
    late.start.state = HingeState::Unreleased;
    assert_eq!(
        told(&[(late, 1.0)]),
        ["hinge 1,1 is released at 2.0, after the end of the run at 1.0"]
    );
}

#[test]
fn masses_that_lose_digits() {
    let of = |main: f64, outer: f64| {
        let mut description = (*chain(&[(Hinge::free(), 1.0), (Hinge::free(), 1.0)])).clone();
        description.main_body.mass = main;
        description.bodies[1].mass_properties.mass = outer;
        Scene::new(description).expect("a scene").warnings()
    };
    assert_eq!(of(1.0, 0.99e9), []);
    assert_eq!(
        of(0.5, 1e14)[0].to_string(),
        "mass 100000000000000 of segment 1,2 beside mass 0.5 of main body found: as many of the 16 digits of a \
         motion may be lost as the masses differ by, about 14"
    );
    assert_eq!(of(1e12, 1.0).len(), 1);
}

#[test]
fn what_acts_at_no_time_of_the_run() {
    let pushed = |course: Course, amount: f64| {
        let mut description = description(&[(Hinge::free(), 1.0)]);
        (description.initial.time, description.end_time) = (1.0, 5.0);
        let thrust = External::thrust(Vec3::unit_x() * amount, Vec3::zero(), [0.0, 1.0]);
        description.externals = vec![External { course, ..thrust }];
        Scene::new(description).expect("a scene").warnings()
    };
    let pulse = |on, off| Course::Pulse { on, off };
    for (course, acts) in [
        (Course::ALWAYS, true),
        (pulse(0.0, 1.5), true),
        (pulse(4.0, 9.0), true),
        (pulse(0.0, 1.0), false),
        (pulse(5.0, 9.0), false),
        (pulse(2.0, 2.0), false),
        (Course::Table(vec![[0.0, 0.0], [2.0, 1.0]]), true),
        (Course::Table(vec![[6.0, 0.0], [7.0, 1.0]]), false),
    ] {
        assert_eq!(pushed(course.clone(), 2.0).is_empty(), acts, "{course:?}");
        assert_eq!(pushed(course, 0.0), [], "nothing that could act");
    }
    for (course, when) in [
        (pulse(5.0, 9.0), "from 5.0 to 9.0"),
        (pulse(6.0, f64::INFINITY), "from 6.0 on"),
        (pulse(f64::NEG_INFINITY, 0.5), "until 0.5"),
    ] {
        let expected = format!(
            "thrust on the main body acts at no time of the run: {when} found, a time between 1.0 and 5.0 expected"
        );
        assert_eq!(pushed(course, 2.0)[0].to_string(), expected);
    }
}

#[test]
fn a_kick_off_spring_that_cannot_push() {
    // Its ends are on the main body's y axis and at the tip of the first body, which starts along y.
    let with = |at: f64, limit_length: f64, lock: Option<f64>| {
        let spring = KickOffSpring {
            main_body_point: Vec3::unit_y() * at,
            body_point: Vec3::unit_y(),
            coefficients: [1.0, 0.0, 0.0, 0.0],
            limit_length,
        };
        one(Hinge { kick_off: Some(spring), lock_angle: lock, ..Hinge::free() })
    };
    let told =
        |warnings: Vec<ModelWarning>| warnings.iter().map(ToString::to_string).collect::<Vec<_>>();
    // From 0 to 2: longer at the start; at a right angle it is √2 long.
    let never = "kick-off spring of hinge 1,1 pushes neither at the start nor with all hinges locked: its length \
                 is 2.0 at the start, and it pushes up to 1.0";
    assert_eq!(told(with(0.0, 1.0, Some(FRAC_PI_2))), [never]);
    assert_eq!(told(with(0.0, 1.5, Some(FRAC_PI_2))), Vec::<String>::new(), "it pushes there");
    assert_eq!(told(with(0.0, 1.0, None)), Vec::<String>::new(), "nobody knows where it comes to");
    let meet = "the ends of the kick-off spring of hinge 1,1 meet at the start: its force has no direction, and a run \
                stops once the hinge is free";
    assert_eq!(told(with(2.0, 1.0, None)), [meet]);
}

#[test]
fn friction_that_holds_a_hinge_against_its_spring_is_told() {
    // The spring exerts 1.5 at the start.
    let hinge = |friction| Hinge { spring: spring(0.0, -3.0, -0.5), friction, ..from_to(0.0, 1.0) };
    let warns = |hinge: Hinge| {
        let found = one(hinge);
        found.iter().any(|warning| matches!(warning, ModelWarning::FrictionHolds { .. }))
    };
    assert!(warns(hinge(1.5)) && warns(hinge(2.0)) && !warns(hinge(1.4)) && !warns(hinge(0.0)));
    let mut moving = hinge(2.0);
    moving.start.rate = 0.1;
    assert!(!warns(moving));
    // Nothing drives it.
    assert!(!warns(Hinge { friction: 2.0, ..from_to(0.0, 1.0) }));
    let told = one(hinge(2.0))[0].to_string();
    assert!(told.contains("2.0 against a torque of 1.5"), "{told}");
}
