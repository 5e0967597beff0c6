//! A simulator that runs again and again: what it has prepared changes nothing.

use nboom::model::{Base, Gravity, Scene, SceneDescription, TorqueTable};
use nboom::ode::Method;
use nboom::scalar::{Quaternion, Vec3};
use nboom::sim::{Options, Simulator, Summary};

use crate::catalog::Reference;
use crate::collect::{Collected, run, tight};

fn next_run(simulator: &mut Simulator) -> (Collected, Summary) {
    let mut found = Collected::default();
    let summary = simulator.run(&mut found).expect("reference scenes run");
    (found, summary.clone())
}

/// Every number of every sample and event, and what the run says of itself.
fn assert_same(found: &(Collected, Summary), expected: &(Collected, Summary), name: &str) {
    assert_eq!(found.0.samples, expected.0.samples, "{name}");
    assert_eq!(found.0.events, expected.0.events, "{name}");
    assert_eq!(found.1, expected.1, "{name}");
}

fn options() -> [Options; 2] {
    [
        tight(20),
        Options {
            kernels: nboom_routines::for_runs(),
            batches: nboom_routines::right_sides_of_eight(),
            ..tight(20)
        },
    ]
}

#[test]
fn every_run_of_a_simulator_is_that_of_a_new_one() {
    for reference in Reference::all() {
        for options in options() {
            let expected = run(&reference.scene(), &options);
            let mut simulator = Simulator::new(&reference.scene(), options);
            for _ in 0..3 {
                assert_same(&next_run(&mut simulator), &expected, reference.name);
            }
        }
    }
}

#[test]
fn a_simulator_can_be_sent_to_another_thread() {
    fn sent<T: Send>(_: &T) {}
    let reference = Reference::all().next().expect("there are scenes");
    sent(&Simulator::new(&reference.scene(), Options::default()));
}

#[test]
fn every_method_begins_anew() {
    for reference in Reference::all().filter(|r| r.name.starts_with("s0")) {
        for integrator in Method::ALL {
            let options = Options { integrator, rtol: 1e-6, atol: 1e-9, ..tight(5) };
            let scene = reference.scene();
            let scene = scene.ending_at(0.3 * scene.end_time).expect("a time");
            let expected = run(&scene, &options);
            let mut simulator = Simulator::new(&scene, options);
            for _ in 0..2 {
                let name = format!("{}, {integrator}", reference.name);
                assert_same(&next_run(&mut simulator), &expected, &name);
            }
        }
    }
}

/// Scenes that each differ from it in one thing.
fn scenes_beside(scene: &Scene) -> Vec<Scene> {
    let changes: [&dyn Fn(&mut SceneDescription); 11] = [
        &|s| s.initial.omega_body.x += 0.25,
        &|s| s.end_time *= 0.75,
        &|s| s.bodies.iter_mut().for_each(|body| body.hinge.start.angle += 0.1),
        &|s| s.main_body.mass *= 2.0,
        // What acts along inertial axes, and a main body that is held against gravity.
        &|s| s.initial.attitude = Quaternion { scalar: 0.8, vector: Vec3::unit_y() * 0.6 },
        &|s| s.bodies.iter_mut().for_each(|body| body.hinge.kick_off = None),
        &|s| s.bodies.iter_mut().for_each(|body| body.hinge.spring.linear *= 0.5),
        &|s| s.externals.iter_mut().for_each(|thrust| thrust.amount = thrust.amount * 1.5),
        &|s| s.externals.truncate(1),
        &|s| s.gravity.iter_mut().for_each(|gravity| gravity.acceleration *= 0.5),
        &|s| {
            let table = TorqueTable { hinge: 0, points: vec![[-10.0, 0.0], [10.0, 1.0]] };
            s.torque_tables.extend((!s.bodies.is_empty()).then_some(table));
        },
    ];
    let changed = |change: &&dyn Fn(&mut SceneDescription)| {
        let mut changed = SceneDescription::clone(scene);
        change(&mut changed);
        Scene::new(changed).expect("a physical scene")
    };
    changes.iter().map(changed).collect()
}

#[test]
fn another_scene_leaves_nothing_of_the_one_before() {
    for reference in Reference::all() {
        let scene = reference.scene();
        for options in options() {
            let expected = run(&scene, &options);
            let mut simulator = Simulator::new(&scene, options);
            let mut assert_runs_as_new = |scene: &Scene, expected: &(Collected, Summary)| {
                simulator.set_scene(scene);
                assert_same(&next_run(&mut simulator), expected, reference.name);
            };
            assert_runs_as_new(&scene, &expected);
            for other in scenes_beside(&scene) {
                assert_runs_as_new(&other, &run(&other, &options));
                assert_runs_as_new(&scene, &expected);
            }
        }
    }
}

#[test]
fn a_held_main_body_is_held_in_the_attitude_of_its_scene() {
    let reference = Reference::all().find(|r| r.name.starts_with("s08")).expect("a scene");
    let mut scene = SceneDescription::clone(&reference.scene());
    scene.base = Base::Fixed;
    scene.gravity = Some(Gravity { up: Vec3::unit_z(), acceleration: 9.81 });
    scene.initial.omega_body = Vec3::zero();
    scene.initial.velocity_inertial = Vec3::zero();
    let turned = Quaternion { scalar: 0.8, vector: Vec3::unit_x() * 0.6 };
    let mut other = scene.clone();
    other.initial.attitude = turned;
    let [scene, other] = [scene, other].map(|s| Scene::new(s).expect("a physical scene"));
    let mut simulator = Simulator::new(&scene, tight(5));
    let first = next_run(&mut simulator);
    simulator.set_scene(&other);
    let expected = run(&other, &tight(5));
    assert_ne!(first.0.samples, expected.0.samples);
    assert_same(&next_run(&mut simulator), &expected, reference.name);
}

/// A rig that holds the main body still: nothing acts on that without gravity, but for what holds it.
#[test]
fn a_held_main_body_forgets_what_gravity_asked_for() {
    for reference in Reference::all() {
        let held = |acceleration| {
            let mut scene = SceneDescription::clone(&reference.scene());
            scene.base = Base::Fixed;
            scene.gravity = Some(Gravity { up: Vec3::unit_z(), acceleration });
            (scene.initial.omega_body, scene.initial.velocity_inertial) =
                (Vec3::zero(), Vec3::zero());
            scene.externals.clear();
            Scene::new(scene).expect("a physical scene")
        };
        let scenes = [9.81, 0.0].map(held);
        for options in options() {
            let mut simulator = Simulator::new(&scenes[0], options);
            for scene in [&scenes[0], &scenes[1], &scenes[0]] {
                simulator.set_scene(scene);
                assert_same(&next_run(&mut simulator), &run(scene, &options), reference.name);
            }
        }
    }
}

/// Errors of a travel are relative to its stroke, which follows from where the slide starts.
#[test]
fn slides_that_start_elsewhere_have_other_strokes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/mast.toml");
    let scene = nboom::io::read_scene(path.as_ref()).expect("an example").scene;
    let mut nearer = SceneDescription::clone(&scene);
    let slides = nearer.bodies.iter_mut().filter(|body| body.joint.slides());
    slides.for_each(|body| {
        body.hinge.start.angle +=
            0.9 * (body.hinge.lock_angle.unwrap_or(1.0) - body.hinge.start.angle)
    });
    let nearer = Scene::new(nearer).expect("a physical scene");
    let options = Options { rtol: 1e-6, ..tight(5) };
    let mut simulator = Simulator::new(&nearer, options);
    for scene in [&nearer, &scene, &nearer] {
        simulator.set_scene(scene);
        assert_same(&next_run(&mut simulator), &run(scene, &options), "mast");
    }
}
