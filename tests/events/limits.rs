//! Springs at their limit length and hinges on their lock angle, at rest, on booms that stand
//! askew: there rounding decides nothing. Which way they first move follows from the
//! accelerations alone.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::model::{
    Appendage, Hinge, HingeStart, HingeState, KickOffSpring, MassProperties, Mode, Mount, Scene,
    SceneDescription, Segment, Spring,
};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::EventKind;

use crate::collect::{DISENGAGES, run, tight, try_run};
use crate::support::json_scene;

/// A boom of two segments, mounted askew on a spinning body that is not symmetric.
fn askew(turn: f64, hinges: [Hinge; 2], end_time: f64) -> SceneDescription {
    let hub = Sym3 { xx: 110.0, yy: 88.0, zz: 74.0, xy: 10.0, xz: 16.0, yz: 30.0 };
    let main_body = MassProperties::new(100.0, Vec3::new(0.02, -0.03, -0.03), hub);
    let mut description = SceneDescription::at_rest("askew", main_body, end_time);
    description.initial.omega_body = Vec3::new(0.39, 0.68 - turn, -0.57);
    let inertia = Sym3 { xx: 0.17, yy: 0.16, zz: 0.16, xy: 0.03, xz: 0.03, yz: 0.01 };
    let segments = hinges
        .into_iter()
        .map(|hinge| Segment {
            length: 1.2,
            mass_properties: MassProperties::new(1.2, Vec3::new(0.01, 0.34, -0.05), inertia),
            hinge,
        })
        .collect();
    let mount = Mount {
        point: Vec3::new(0.12, 0.41, 0.55),
        rot_inboard_from_hinge: Mat3::from_euler_121(-0.85 + turn, 2.37, -0.49 * turn),
    };
    description.attach(&Appendage::Regular { mount, segments });
    description
}

fn held() -> Hinge {
    let start = HingeStart { angle: 0.4, rate: 0.0, state: HingeState::Locked };
    Hinge { start, ..Hinge::free() }
}

fn at(angle: f64) -> Hinge {
    Hinge { start: HingeStart { angle, ..Hinge::free().start }, ..Hinge::free() }
}

/// Second derivative of the spring's squared length at rest, while it pushes and while not.
fn lengthening(scene: &Scene, pushing: bool) -> f64 {
    let mut mode = Mode::at_start(scene);
    mode.pieces[0] = usize::from(!pushing);
    let beta = [scene.bodies[0].hinge.start.angle];
    let mut dynamics = Recursive::<f64>::new(scene);
    dynamics.set_mode(&mode, &[beta[0], scene.bodies[1].hinge.start.angle]);
    let motion = Motion { omega_body: scene.initial.omega_body, beta: &beta, tau: &[0.0] };
    let mut found = Accelerations::for_hinges(1);
    dynamics.accelerations(&motion, &mut found);
    // At rest the length's second derivative is what its rate would be at rates τ̇.
    let as_rate = Motion { tau: &found.tau_dot, ..motion };
    dynamics.line_length(0, |j| [as_rate.beta[j], as_rate.tau[j]]).squared_rate
}

/// The scene with a spring that starts exactly at its limit length.
fn at_limit(turn: f64, force: f64) -> Scene {
    let spring = |limit_length| KickOffSpring {
        main_body_point: Vec3::new(0.3, 0.2, -0.1),
        body_point: Vec3::new(0.05, 0.4, 0.1),
        coefficients: [force, -0.3, 0.0, 0.0],
        limit_length,
    };
    let with = |limit| {
        let hinge = Hinge { kick_off: Some(spring(limit)), ..at(-2.7 + turn) };
        Scene::new(askew(turn, [hinge, held()], 0.02)).expect("a valid scene")
    };
    let scene = with(1.0);
    let beta = [scene.bodies[0].hinge.start.angle];
    let motion = Motion { omega_body: scene.initial.omega_body, beta: &beta, tau: &[0.0] };
    let length = Recursive::<f64>::new(&scene).line_length(0, |j| [motion.beta[j], motion.tau[j]]);
    with(length.squared.sqrt())
}

#[test]
fn a_spring_at_rest_at_its_limit_goes_the_way_it_is_accelerated() {
    let (mut outward, mut inward) = (0, 0);
    for i in 0..120 {
        let scene = at_limit(f64::from(i) * 0.05, if i % 2 == 0 { 2.0 } else { 0.4 });
        let (on, off) = (lengthening(&scene, true), lengthening(&scene, false));
        // Where the spring pushes it out and the rest pulls it in, it may stay and chatter.
        let (found, _) = try_run(&scene, &tight(1));
        let kinds: Vec<EventKind> = found.events.iter().map(|(event, _)| event.kind).collect();
        if on > 1e-6 && off > 1e-6 {
            outward += 1;
            assert_eq!(kinds, [DISENGAGES, EventKind::End], "case {i}");
        } else if on < -1e-6 && off < -1e-6 {
            inward += 1;
            assert_eq!(kinds, [EventKind::End], "case {i}");
        }
    }
    assert!(outward > 20 && inward > 20, "{outward} {inward}");
}

#[test]
fn a_hinge_at_rest_on_its_lock_angle_leaves_it_and_locks_when_it_returns() {
    let mut returned = 0;
    for i in 0..20 {
        let turn = f64::from(i) * 0.3;
        // A preloaded spring takes the hinge away and swings it back.
        let spring = Spring { quadratic: 0.0, linear: -6.0, preload_angle: -1.0 };
        let hinge = Hinge { spring, lock_angle: Some(0.2), ..at(0.2) };
        let scene = Scene::new(askew(turn, [hinge, held()], 6.0)).expect("a valid scene");
        let (found, _) = run(&scene, &tight(400));
        let lock = found.events.iter().find(|(event, _)| event.kind == EventKind::LockUp);
        let Some((lock, _)) = lock else { continue };
        returned += 1;
        // A sample every hundredth of the way, however soon it returns.
        let close = scene.ending_at(lock.time).expect("a time after the start");
        let (found, _) = run(&close, &tight(100));
        let angles = found.samples.iter().filter(|s| s.time > 0.0 && s.time < lock.time);
        let moved: Vec<f64> = angles.map(|s| s.beta[0] - 0.2).collect();
        assert!(moved.len() > 10, "case {i}: it locks at {}", lock.time);
        assert!(moved.iter().all(|m| m.signum() == moved[0].signum()), "case {i}");
    }
    assert!(returned >= 5, "{returned} swing back before the end");
}

#[test]
fn output_times_hold_the_state_after_the_events_before_them_at_loose_tolerance() {
    // At this tolerance dense output puts the lock-ups a little later than the motion does, and
    // with so many output times some lie between.
    let data = crate::support::data("scenes/s10_symmetric_lock.json");
    let scene = json_scene::scene(&data, 2.5);
    let options = nboom::sim::Options { rtol: 1e-3, atol: 1e-3, samples: 40_000, ..tight(1) };
    let (found, _) = run(&scene, &options);
    let locks = found.events.iter().filter(|(event, _)| event.kind == EventKind::LockUp);
    let locks: Vec<_> = locks.map(|(event, _)| (event.time, event.hinge)).collect();
    assert_eq!(locks.len(), 2);
    for (time, hinge) in locks {
        let hinge = hinge.expect("a lock-up has a hinge");
        for sample in &found.samples {
            let locked = sample.hinges[hinge] == HingeState::Locked;
            assert_eq!(locked, sample.time >= time - 1e-11, "t {}", sample.time);
        }
    }
}
