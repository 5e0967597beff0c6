//! Motions that are fed without end are given up by what they gain, with hinge and cause, long before
//! their steps are used up; others go on to the end. Counts of steps, not clocks, say when.

use std::cell::Cell;

use nboom::model::{
    Base, Coupling, Dashpot, Gravity, Hinge, HingeLabel, ModelWarning, Rotor, RotorSpeed, Scene,
    SceneDescription, Spring, TorqueTable,
};
use nboom::scalar::Vec3;
use nboom::sim::{Event, Feeds, Options, Recorder, Runaway, SimError, Snapshot, Summary, simulate};

use crate::collect::{run, try_run};
use crate::random_scene::conservative;
use crate::rotors::{REDUCED, description, free, growing, locking_at, oscillating, scene};

const FIRST: HingeLabel = HingeLabel::new(0, 0);
const SECOND: HingeLabel = HingeLabel::new(1, 0);

/// Some seconds' worth in any profile; all of these went on for a hundred times as many.
const FEW: usize = 30_000;

fn given_up(scene: &Scene) -> (HingeLabel, Feeds, Summary) {
    let options = Options { samples: 1, ..Options::default() };
    let failure = try_run(scene, &options).1.expect_err("it has no end");
    let SimError::Runaway { time, runaway: Runaway { hinge, feeds, growth } } = failure.error
    else {
        panic!("{}", failure.error)
    };
    assert!(growth > 1e4 && time < scene.end_time, "{growth:e} at {time}");
    let summary = *failure.summary;
    let steps = summary.steps_accepted + summary.steps_rejected;
    println!("{steps} steps, {growth:.1e} at {time}");
    assert!(steps < FEW, "{steps} steps");
    (hinge, feeds, summary)
}

/// τ grows as exp(2 t), and with it the number of steps for each unit of time.
#[test]
fn a_dashpot_of_the_wrong_sign() {
    for growth in [1e-3, 1.0, 1e3] {
        let (hinge, feeds, _) =
            given_up(&scene(&[free(0.3, 0.1), growing(free(0.0, 1.0), growth)], 1e4 / growth));
        assert_eq!((hinge, feeds), (SECOND, Feeds::Dashpot));
    }
}

/// A swing that a dashpot of the wrong sign drives up.
#[test]
fn a_swing_of_the_wrong_damping() {
    let hinge = growing(oscillating(free(0.1, 0.0), 3.0, 0.0), 0.3);
    let (hinge, feeds, _) = given_up(&scene(&[hinge], 1e5));
    assert_eq!((hinge, feeds), (FIRST, Feeds::Dashpot));
}

/// τ̇ = τ² and β̈ = β², whose poles are reached in finite time.
#[test]
fn torques_that_grow_as_squares() {
    let dashpot = Dashpot { rate_quadratic: 0.8, ..Dashpot::default() };
    let (hinge, feeds, _) = given_up(&scene(&[Hinge { dashpot, ..free(0.0, 1.0) }], 1e6));
    assert_eq!((hinge, feeds), (FIRST, Feeds::Dashpot));
    let spring = Spring { quadratic: 0.8, linear: 0.0, preload_angle: 0.0 };
    let (hinge, feeds, _) =
        given_up(&scene(&[free(0.0, 1.0), Hinge { spring, ..free(0.5, 0.0) }], 1e6));
    assert_eq!((hinge, feeds), (SECOND, Feeds::Spring));
}

/// A spring that pushes away from its rest, weak and strong.
#[test]
fn a_spring_of_the_wrong_sign() {
    for linear in [1e-6, 1.0, 1e6] {
        let spring = Spring { quadratic: 0.0, linear, preload_angle: 0.1 };
        let end_time = 1e4 / linear.sqrt();
        let (hinge, feeds, _) = given_up(&scene(&[Hinge { spring, ..free(0.0, 0.0) }], end_time));
        assert_eq!((hinge, feeds), (FIRST, Feeds::Spring));
    }
}

/// A table whose last points rise goes on rising.
#[test]
fn a_torque_table_that_pushes_away() {
    let mut scene = description(&[free(0.1, 0.0)], 1e4);
    scene.torque_tables.push(TorqueTable { hinge: 0, points: vec![[0.0, 0.0], [0.1, 5.0]] });
    let (hinge, feeds, _) = given_up(&Scene::new(scene).expect("rotors are bodies"));
    assert_eq!((hinge, feeds), (FIRST, Feeds::Table));
}

/// Where a hinge has both, that is told which feeds more, and not the one that holds back.
#[test]
fn of_spring_and_table_the_one_that_feeds() {
    let linear = |linear| Hinge {
        spring: Spring { quadratic: 0.0, linear, preload_angle: 0.0 },
        ..free(0.1, 0.0)
    };
    let by_dashpot =
        Hinge { dashpot: Dashpot { angle_linear: 40.0, ..Dashpot::default() }, ..free(0.1, 0.0) };
    let (rising, falling) = ([[0.0, 0.0], [0.1, 5.0]], [[0.0, 0.0], [0.1, -1.0]]);
    for (points, hinge, cause) in [
        (rising, linear(-40.0), Feeds::Table),
        (rising, linear(20.0), Feeds::Table),
        (rising, linear(90.0), Feeds::Spring),
        (falling, linear(20.0), Feeds::Spring),
        (falling, by_dashpot, Feeds::Spring),
    ] {
        let mut scene = description(&[hinge], 1e4);
        scene.torque_tables.push(TorqueTable { hinge: 0, points: points.to_vec() });
        let (hinge, feeds, _) = given_up(&Scene::new(scene).expect("rotors are bodies"));
        assert_eq!((hinge, feeds), (FIRST, cause), "{points:?}");
    }
}

/// What a table does beyond its ends is told before the run, of hinges that come there and of no others.
#[test]
fn tables_that_drive_hinges_on_are_warned_of() {
    let rising = [[0.0, 0.0], [0.1, 5.0]];
    let level = [[0.0, 1.0], [1.0, 1.0]];
    let well = [[-1.0, 3.0], [0.0, 0.0], [1.0, -3.0], [2.0, 1.0]];
    let falling = [[0.0, 0.0], [0.1, -5.0]];
    let squared = |hinge: Hinge, quadratic: f64| Hinge {
        spring: Spring { quadratic, linear: 0.0, preload_angle: 0.0 },
        ..hinge
    };
    let pulled = |hinge: Hinge, linear: f64| Hinge {
        spring: Spring { quadratic: 0.0, linear, preload_angle: 0.0 },
        ..hinge
    };
    let mut warned = 0;
    for (points, hinge) in [
        (&rising[..], free(0.1, 0.0)),
        (&rising, free(-0.1, 0.0)),
        (&rising, locking_at(free(0.1, 0.0), 0.5)),
        (&rising, locking_at(free(0.1, 0.0), -0.5)),
        (&[[0.0, -5.0], [0.1, 0.0]], free(0.0, 0.0)),
        (&[[-1.0, 2.0], [1.0, -2.0]], free(0.5, 0.0)),
        (&level, free(0.5, 0.0)),
        // Its end is beyond a hill that is too high from here, but not from there.
        (&well, free(0.5, 0.0)),
        (&well, free(-1.0, 0.0)),
        (&well, free(-2.0, 0.0)),
        (&well, free(3.0, 0.0)),
        // A spring is stiffer than the end of the table, or is not.
        (&rising, pulled(free(0.2, 0.0), -60.0)),
        (&rising, pulled(free(0.2, 0.0), -40.0)),
        (&level, pulled(free(0.5, 0.0), 1.0)),
        // The square of a spring drives one way and holds the other, whatever the table.
        (&rising, squared(free(0.1, 0.0), 1.0)),
        (&rising, squared(free(0.1, 0.0), -1.0)),
        (&rising, locking_at(squared(free(0.1, 0.0), 1.0), 0.5)),
        (&falling, squared(free(0.1, 0.0), 1.0)),
        (&falling, squared(free(60.0, 0.0), 1.0)),
        (&level, squared(free(0.5, 0.0), -10.0)),
        (&level, squared(free(-0.5, 0.0), -10.0)),
    ] {
        let mut scene = description(&[hinge], 20.0);
        scene.torque_tables.push(TorqueTable { hinge: 0, points: points.to_vec() });
        let scene = Scene::new(scene).expect("rotors are bodies");
        let (found, result) = try_run(&scene, &Options { samples: 1, ..Options::default() });
        let is_far = result.is_err() || found.last().beta[0].abs() > 1e3;
        let is_told = |warning: &ModelWarning| {
            matches!(
                warning,
                ModelWarning::TableDrivesOn { hinge: FIRST, .. }
                    | ModelWarning::SpringDrivesOn { hinge: FIRST, .. }
            )
        };
        let told = scene.warnings();
        assert_eq!(told.iter().any(is_told), is_far, "{points:?} from {:?}: {told:?}", hinge.start);
        warned += usize::from(is_far);
    }
    assert_eq!(warned, 11);
}

/// In space and with other hinges about: one hinge of a random tree feeds.
#[test]
fn one_wrong_sign_in_a_tree() {
    for seed in 0..6 {
        let mut description = conservative(3, seed);
        description.end_time = 1e4;
        for body in &mut description.bodies {
            body.hinge.spring.quadratic = 0.0;
            body.hinge.dashpot.angle_quadratic = 0.0;
        }
        description.bodies[1].hinge.dashpot.rate_linear = 2.0;
        let scene = Scene::new(description).expect("a physical scene");
        let (hinge, feeds, _) = given_up(&scene);
        assert_eq!((hinge, feeds), (scene.label(1), Feeds::Dashpot), "{seed}");
    }
}

/// Energy that grows ten-million-fold is followed where the end is near: τ = exp(t).
#[test]
fn a_growing_motion_with_an_end_is_followed() {
    let end = 8.5;
    let (found, summary) = run(&scene(&[growing(free(0.0, 1.0), 0.5)], end), &Options::default());
    let growth = found.last().kinetic_energy / found.samples[0].kinetic_energy;
    assert!(growth > 1e7, "{growth:e}");
    let off = (found.last().tau[0] / end.exp() - 1.0).abs();
    assert!(off < summary.steps_accepted as f64 * 1e-9, "{off:e}");
    // Its end is told of, though it was reached.
    let Some(Runaway { hinge, feeds, growth: told }) = summary.runaway else {
        panic!("{summary:?}")
    };
    assert_eq!((hinge, feeds), (FIRST, Feeds::Dashpot));
    assert!((told / growth - 1.0).abs() < 1e-6, "{told:e}, {growth:e}");
    // Ten times its rate is a hundred times its energy.
    let (_, summary) = run(&scene(&[growing(free(0.0, 1.0), 0.5)], 2.3), &Options::default());
    assert_eq!(summary.runaway, None);
}

/// A pendulum falls from rest: gravity feeds it, and not without end.
#[test]
fn a_pendulum_on_the_ground_does_not_run_away() {
    let mut scene = description(&[free(0.0, 0.0)], 3.0);
    scene.base = Base::Fixed;
    scene.gravity = Some(Gravity { up: Vec3::unit_z(), acceleration: 9.8 });
    scene.bodies[0].mass_properties.center_of_mass = Vec3::unit_y();
    let (found, summary) = run(&Scene::new(scene).expect("a body"), &Options::default());
    assert!(found.samples.iter().any(|sample| sample.kinetic_energy > 1.0));
    assert_eq!(summary.runaway, None);
}

/// Two booms at rest beside each other that only a coupling moves.
fn coupled(coupling: Coupling) -> SceneDescription {
    let mut scene = description(&[free(0.1, 0.0), free(0.0, 0.0)], 1e4);
    scene.couplings = vec![coupling];
    scene
}

/// What a coupling feeds is not blamed on the springs and dashpots of its hinges.
#[test]
fn a_coupling_of_the_wrong_sign() {
    let coupling = Coupling {
        hinges: [0, 1],
        ratio: 1.0,
        stiffness: 2.0,
        rest: 0.0,
        damping: 0.0,
        is_mutual: true,
    };
    for wrong in [Coupling { damping: -0.5, ..coupling }, Coupling { stiffness: -2.0, ..coupling }]
    {
        let scene = Scene::new(coupled(wrong)).expect("rotors are bodies");
        let (hinge, feeds, _) = given_up(&scene);
        assert_eq!((hinge, feeds), (FIRST, Feeds::Coupling), "{wrong:?}");
    }
}

/// A motor gives a rotor a thousand times the energy of all that moved before, and then the satellite turns on for long:
/// this is no motion that runs away.
#[test]
fn a_rotor_that_spins_up_does_not_run_away() {
    for body in [None, Some(0)] {
        let mut scene = description(&[oscillating(free(1e-3, 0.0), 0.03, 0.0)], 1e9);
        let speed = RotorSpeed::Table(vec![[0.0, 0.0], [5.0, 600.0]]);
        scene.rotors = vec![Rotor { body, axis: Vec3::unit_x(), inertia: 0.05, speed }];
        let scene = Scene::new(scene).expect("rotors are bodies");
        let options = Options { samples: 1, ..Options::default() };
        let mut until = TooLong(Cell::new(0));
        let failure = simulate(&scene, &options, &mut until).expect_err("it is stopped");
        assert!(matches!(failure.error, SimError::Interrupted { .. }), "{}", failure.error);
    }
}

/// A table that is level is a motor. Whether a damper bounds the rate or not, this is no motion that runs away, though it
/// gains a hundred thousand times what the table says between its points.
#[test]
fn a_motor_that_is_a_level_table_does_not_run_away() {
    for (damping, torque) in [(0.1, 1.0), (0.1, -1.0), (0.0, 1.0)] {
        let dashpot = Dashpot { rate_linear: -damping, ..Dashpot::default() };
        let mut scene = description(&[Hinge { dashpot, ..free(0.0, 0.0) }], 20.0);
        let points = vec![[-1e-3, torque], [1e-3, torque]];
        scene.torque_tables.push(TorqueTable { hinge: 0, points });
        let scene = Scene::new(scene).expect("rotors are bodies");
        let (found, summary) = run(&scene, &Options::default());
        let last = found.last();
        assert!(last.beta[0].abs() > 100.0, "{:?}", last.beta);
        assert_eq!(summary.runaway, None, "{damping}");
        let rate = match damping {
            0.0 => torque * 20.0 / REDUCED,
            _ => torque / damping * -(-damping * 20.0 / REDUCED).exp_m1(),
        };
        assert!((last.tau[0] / rate - 1.0).abs() < 1e-8, "{} {rate}", last.tau[0]);
    }
}

/// A motor hides nothing that does feed a motion: a dashpot of the wrong sign at its hinge and at another one, whatever it does
/// against its own damper, and a spring that pushes away.
#[test]
fn what_feeds_is_found_beside_a_motor() {
    let damped = |hinge| growing(hinge, -0.3);
    let pushed = |hinge| Hinge {
        spring: Spring { quadratic: 0.0, linear: 0.5, preload_angle: 0.0 },
        ..hinge
    };
    for (hinges, expected) in [
        (vec![growing(free(0.0, 0.0), 0.5)], (FIRST, Feeds::Dashpot)),
        (vec![damped(free(0.0, 0.0)), growing(free(0.0, 1e-3), 0.1)], (SECOND, Feeds::Dashpot)),
        (vec![pushed(free(0.0, 0.0))], (FIRST, Feeds::Spring)),
    ] {
        let mut scene = description(&hinges, 1e4);
        scene.torque_tables.push(TorqueTable { hinge: 0, points: vec![[-1.0, 1.0], [1.0, 1.0]] });
        let (hinge, feeds, _) = given_up(&Scene::new(scene).expect("rotors are bodies"));
        assert_eq!((hinge, feeds), expected);
    }
}

/// Stops a run after many looks.
struct TooLong(Cell<usize>);

impl Recorder for TooLong {
    fn sample(&mut self, _: &Snapshot) -> std::io::Result<()> {
        Ok(())
    }

    fn event(&mut self, _: &Event, _: &Snapshot) -> std::io::Result<()> {
        Ok(())
    }

    fn interrupted(&self) -> bool {
        self.0.set(self.0.get() + 1);
        self.0.get() > 5000
    }
}
