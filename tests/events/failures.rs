//! Scenes that cannot be followed to the end say where and why, and keep what came before.

use std::io;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use nboom::model::{
    Appendage, Course, Dashpot, External, ExternalAxes, ExternalKind, Gravity, Hinge, HingeLabel,
    HingeStart, HingeState, KickOffSpring, MassProperties, Mount, Release, Scene, SceneDescription,
    Segment, Spring,
};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::{Feeds, Options, Recorder, SimError, Snapshot, simulate};

use crate::collect::{Collected, tight, try_run};
use crate::rotors::{description, free, oscillating, scene};

const FIRST: HingeLabel = HingeLabel::new(0, 0);
const SECOND: HingeLabel = HingeLabel::new(1, 0);

fn failure(scene: &Scene, options: &Options) -> (Collected, SimError) {
    let (collected, result) = try_run(scene, options);
    let failure = result.expect_err("this scene has no end");
    assert!(failure.summary.end_time < scene.end_time);
    (collected, failure.error)
}

#[test]
fn a_segment_without_inertia_is_named() {
    let mut description = description(&[free(0.0, 1.0)], 1.0);
    // A point mass on its own hinge axis.
    let mass_properties = MassProperties::new(1.0, Vec3::zero(), Sym3::zero());
    let segment = Segment { length: 1.0, mass_properties, hinge: Hinge::free() };
    let mount = Mount::at(Vec3::zero());
    description.attach(&Appendage::Regular { mount, segments: vec![segment] });
    let scene = Scene::new(description).expect("a point mass is a body");
    let (_, error) = failure(&scene, &tight(1));
    let SimError::SingularMassMatrix { time, hinge } = &error else { panic!("{error}") };
    assert_eq!((*time, hinge), (0.0, &Some(SECOND)));
    assert!(error.to_string().contains("2,1") || error.to_string().contains("2"), "{error}");
}

#[test]
fn a_spring_beyond_all_numbers_fails_with_time_and_hinge() {
    let huge = Hinge {
        spring: Spring { quadratic: 0.0, linear: 1e300, preload_angle: 0.1 },
        ..Hinge::free()
    };
    let (_, error) = failure(&scene(&[free(0.0, 1.0), huge], 1.0), &tight(1));
    match error {
        SimError::NotFinite { time, hinge } | SimError::StepUnderflow { time, hinge, .. } => {
            assert!((0.0..1e-10).contains(&time), "{time}");
            assert_eq!(hinge, Some(SECOND));
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_kick_off_spring_beyond_all_numbers_fails_with_time_and_hinge() {
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.0, 1.0, 0.0),
        body_point: Vec3::new(0.0, 0.8, 0.0),
        coefficients: [1e300; 4],
        limit_length: 1.0,
    });
    let hinge = Hinge { kick_off, ..free(0.3, 0.0) };
    let (_, error) = failure(&scene(&[hinge], 1.0), &tight(1));
    match error {
        SimError::NotFinite { time, .. } | SimError::StepUnderflow { time, .. } => {
            assert!((0.0..1e-10).contains(&time), "{time}");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn energies_beyond_all_numbers_fail_at_their_time() {
    // Squares of speeds from 1.3e154 on are no numbers: at once, or when a fall has lasted as long.
    let mut thrown = description(&[free(0.0, 1.0)], 1.0);
    thrown.initial.velocity_inertial = Vec3::new(1e200, 0.0, 0.0);
    let mut falls = description(&[free(0.0, 1.0)], 4.0);
    falls.gravity = Some(Gravity { acceleration: 1e154, up: Vec3::unit_y() });
    let samples = 100;
    for (description, earliest, latest) in [(thrown, 0.0, 0.0), (falls, 0.1, 1.38)] {
        let scene = Scene::new(description).expect("all numbers are finite");
        let (kept, error) = failure(&scene, &tight(samples));
        let SimError::Overflow { time, hinge: None, .. } = error else { panic!("{error}") };
        assert!((earliest..=latest).contains(&time), "{error}");
        let rows = kept.samples.iter();
        assert!(rows.clone().all(|row| row.time < time && row.kinetic_energy.is_finite()));
        assert_eq!(rows.count(), (time * samples as f64 / scene.end_time).round() as usize);
    }
}

#[test]
fn a_kick_off_spring_without_length_is_named() {
    // Both ends at one point, at the start, and when its hinge is released; the turn brings
    // rounding in.
    let point = Vec3::new(0.1, 0.7, 0.2);
    let kick_off = |angle: f64| KickOffSpring {
        main_body_point: Mat3::about_axis(Vec3::unit_x(), angle) * point,
        body_point: point,
        coefficients: [2.0, 0.0, 0.0, 0.0],
        limit_length: 1.0,
    };
    for angle in [0.0, 0.3, -2.0] {
        let starts_free = Hinge { kick_off: Some(kick_off(angle)), ..free(angle, 1.0) };
        let start = HingeStart { angle, rate: 0.0, state: HingeState::Unreleased };
        let waits = Hinge { start, release: Release::Time(0.25), ..starts_free };
        for (hinge, when) in [(starts_free, 0.0), (waits, 0.25)] {
            let (_, error) = failure(&scene(&[free(0.0, 1.0), hinge], 1.0), &tight(1));
            let SimError::NoDirection { time, hinge, .. } = &error else { panic!("{error}") };
            assert_eq!((*time, hinge), (when, &SECOND));
            assert!(error.to_string().contains("hinge 2,1: its kick-off spring"), "{error}");
        }
    }
}

#[test]
fn options_that_no_run_can_have_are_refused() {
    let defaults = Options::default();
    let with_rtol = |rtol| Options { rtol, ..defaults };
    let with_atol = |atol| Options { atol, ..defaults };
    let with_max_step = |max_step| Options { max_step, ..defaults };
    let rtols = [1e-18, 1e-300, 0.0, -1e-9, f64::NAN, f64::INFINITY, 1.0, 10.0].map(with_rtol);
    let atols = [0.0, -1e-9, f64::NAN, f64::INFINITY].map(with_atol);
    let steps = [0.0, -0.1, f64::NAN].map(with_max_step);
    let samples = [Options { samples: 0, ..defaults }];
    for (name, options) in [
        ("relative error", &rtols[..]),
        ("absolute error", &atols),
        ("longest step", &steps),
        ("output intervals", &samples),
    ] {
        for options in options {
            let (_, error) = failure(&scene(&[free(0.0, 1.0)], 1.0), options);
            let SimError::Option(refused) = error else { panic!("{error}") };
            assert_eq!(refused.option, name);
            assert!(refused.to_string().contains("expected"), "{refused}");
        }
    }
}

#[test]
fn a_runaway_ends_at_its_pole() {
    // τ̇ = τ² from τ = 1: τ = 1/(1 − t).
    let dashpot = Dashpot { rate_quadratic: crate::rotors::REDUCED, ..Dashpot::default() };
    let hinge = Hinge { dashpot, ..free(0.0, 1.0) };
    let (found, error) = failure(&scene(&[hinge], 2.0), &tight(5));
    let SimError::Runaway { time, runaway } = error else { panic!("{error}") };
    assert!((time - 1.0).abs() < 1e-2, "{time}");
    assert_eq!((runaway.hinge, runaway.feeds), (FIRST, Feeds::Dashpot));
    // The output times before the pole are kept; one at the pole would be by chance.
    let times: Vec<f64> = found.samples.iter().map(|sample| sample.time).collect();
    assert_eq!(times, [0.0, 0.4, 0.8]);
    for sample in &found.samples {
        let expected = 1.0 / (1.0 - sample.time);
        assert!((sample.tau[0] - expected).abs() < 1e-10, "{}", sample.time);
    }
}

#[test]
fn too_many_steps_are_too_many() {
    let options = Options { max_steps: 7, ..tight(100) };
    let (found, error) = failure(&scene(&[oscillating(free(0.0, 1.0), 50.0, 0.0)], 9.0), &options);
    let SimError::StepsUsedUp { time, steps, by } = error else { panic!("{error}") };
    assert_eq!((steps, by), (7, "max_steps"));
    assert!(time > 0.0 && time < 9.0);
    let before = found.samples.iter().filter(|sample| sample.time <= time).count();
    assert_eq!(before, found.samples.len());
    assert_eq!(before, (time / 0.09) as usize + 1);
}

struct Full(usize);

impl Recorder for Full {
    fn sample(&mut self, _: &Snapshot) -> io::Result<()> {
        self.0 -= 1;
        if self.0 == 0 { Err(io::Error::from(io::ErrorKind::StorageFull)) } else { Ok(()) }
    }
}

#[test]
fn a_recorder_that_refuses_ends_the_run() {
    let result = simulate(&scene(&[free(0.0, 1.0)], 1.0), &tight(10), &mut Full(4));
    let error = result.expect_err("the fourth row is refused").error;
    let SimError::Record { time, source } = error else { panic!("{error}") };
    assert_eq!(source.kind(), io::ErrorKind::StorageFull);
    assert!((time - 0.3).abs() < 1e-15);
}

/// Runs a scene that may chatter; it must come to some end within a minute.
fn ends(scene: Scene) -> Result<(), SimError> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(Box::new(try_run(&scene, &tight(1)).1)).is_ok());
    let result = receiver.recv_timeout(Duration::from_secs(60)).expect("the run hangs");
    result.map(|_| ()).map_err(|failure| failure.error)
}

/// A spring that pushes outward within its limit against one that pulls back, so that the boom
/// is thrown back and forth across the limit; the dashpot makes the throws ever shorter.
fn thrown(start_angle: f64, damping: f64, end_time: f64) -> Scene {
    let kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.0, 1.0, 0.0),
        body_point: Vec3::new(0.0, 1.0, 0.0),
        coefficients: [2.0, 0.0, 0.0, 0.0],
        // |x| = 2 sin(β/2): the limit is at β = 1.
        limit_length: 2.0 * 0.5_f64.sin(),
    });
    let hinge = Hinge {
        kick_off,
        spring: Spring { quadratic: 0.0, linear: -1.0, preload_angle: 0.0 },
        dashpot: Dashpot { rate_linear: -damping, ..Dashpot::default() },
        ..free(start_angle, 0.0)
    };
    scene(&[hinge], end_time)
}

#[test]
fn a_boom_at_rest_between_two_springs_does_not_hang() {
    for start in [1.0, 1.0 - 1e-15, 1.0 + 1e-15] {
        match ends(thrown(start, 0.0, 0.1)) {
            Ok(()) => {}
            Err(SimError::Chatter { time, hinge, events, within, .. }) => {
                assert!((0.0..=0.1).contains(&time) && within < 1e-8 && events >= 1000);
                assert_eq!(hinge, Some(FIRST));
            }
            Err(other) => panic!("{start}: {other}"),
        }
    }
}

#[test]
fn throws_that_die_away_slowly_are_followed_to_the_end() {
    for damping in [0.5, 2.0] {
        assert!(ends(thrown(0.5, damping, 5.0)).is_ok(), "{damping}");
    }
}

/// Throws shorten so that their number grows as exp(1.7 t): long before the end there are more
/// than any run can follow.
#[test]
fn throws_that_die_away_fast_do_not_hang() {
    let result = ends(thrown(0.5, 4.0, 50.0));
    let Err(SimError::EventsUsedUp { time, hinge, .. }) = result else { panic!("{result:?}") };
    assert!(time < 50.0);
    assert_eq!(hinge, Some(FIRST));
}

/// Events that are never many within a ten-thousandth of the span, or only after some hundred
/// thousand of them: throws that do not shorten, and throws whose number grows as exp(0.8 t).
#[test]
fn the_events_of_a_run_are_bounded_in_number() {
    for (start, damping, end_time) in [(1.0 - 1e-8, 0.0, 100.0), (0.5, 1.0, 50.0)] {
        let options = Options { max_events: 2000, ..tight(1) };
        let (found, error) = failure(&thrown(start, damping, end_time), &options);
        let SimError::EventsUsedUp { time, hinge, events, .. } = error else { panic!("{error}") };
        assert_eq!((events, found.events.len(), hinge), (2000, 2000, Some(FIRST)));
        assert_eq!(time, found.events[1999].0.time);
        // Nowhere were there a thousand within a ten-thousandth of the span.
        assert!(time > 20.0 * 1e-4 * end_time, "{time}");
    }
}

/// However finely a push is tabulated, its points are no events.
#[test]
fn a_finely_tabulated_push_is_no_chatter() {
    let mut description = SceneDescription::clone(&scene(&[free(0.0, 0.1)], 1e5));
    let points = (0..3000).map(|i| [f64::from(i) * 1e-3, f64::from(i % 2)]);
    description.externals.push(External {
        body: None,
        kind: ExternalKind::Torque,
        amount: Vec3::unit_x() * 1e-3,
        axes: ExternalAxes::Body,
        point: Vec3::zero(),
        course: Course::Table(points.collect()),
    });
    let scene = Scene::new(description).expect("bodies are physical");
    ends(scene).expect("it runs to its end");
}

/// A boom that creeps to the limit against a dashpot which leaves it no throw worth the name.
#[test]
fn a_boom_that_creeps_to_a_limit_length_does_not_hang() {
    for damping in [20.0, 100.0] {
        let result = ends(thrown(0.9, damping, 500.0));
        let Err(SimError::Chatter { time, hinge, .. }) = result else { panic!("{result:?}") };
        // The way of 0.1 takes 0.1 · damping at a torque of about 1; then it is given up soon.
        assert!(time < 0.2 * damping + 1.0, "{time}");
        assert_eq!(hinge, Some(FIRST));
    }
}

#[test]
fn a_slender_rod_that_turns_about_itself_is_named_however_it_stands() {
    for turn in 0..12 {
        let mut description = description(&[free(0.0, 1.0)], 1.0);
        let rod = MassProperties::new(1.0, Vec3::unit_y(), Sym3::diagonal(0.3, 0.0, 0.3));
        let arm = MassProperties::new(1.0, Vec3::unit_y(), Sym3::diagonal(0.3, 0.1, 0.3));
        let segment = |mass_properties| Segment {
            length: 1.0,
            mass_properties,
            hinge: Hinge {
                start: HingeStart { angle: 0.7, ..Hinge::free().start },
                ..Hinge::free()
            },
        };
        let angle = f64::from(turn) * 0.5;
        let mount = Mount {
            point: Vec3::new(0.3, 0.1, -0.2),
            rot_inboard_from_hinge: Mat3::from_euler_121(angle, 1.0 + angle, -2.0 * angle),
        };
        let (arm, paddle) = (segment(arm), segment(rod));
        description.attach(&Appendage::Paddle { mount, arm, paddle });
        let scene = Scene::new(description).expect("a rod is a body");
        let (_, error) = failure(&scene, &tight(1));
        let SimError::SingularMassMatrix { hinge, .. } = error else { panic!("{turn}: {error}") };
        assert_eq!(hinge.map(|label| label.to_string()).as_deref(), Some("2,2"));
    }
}
