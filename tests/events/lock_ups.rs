//! When a hinge locks, and what it does to the others, against closed forms and, for joint
//! lock-ups, against one lock-up after the other.

use nboom::dynamics::{self, Recursive, Struck};
use nboom::model::{
    Appendage, Hinge, HingeLabel, HingeStart, HingeState, MassProperties, Mode, ModelWarning,
    Mount, Release, Scene, SceneDescription, Segment,
};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::EventKind::{LockUp, Release as Released};
use nboom::sim::{InstantMotion, Jump, Recorder, simulate};

use crate::collect::{run, tight};
use crate::rotors::{
    BOOM, HUB, ROUNDING, ball, free, growing, locking_at, merged_rate, oscillating, scene, waiting,
};

#[test]
fn a_boom_that_locks_makes_the_hub_turn() {
    let (found, _) = run(&scene(&[locking_at(free(-1.0, 2.0), 0.0)], 1.0), &tight(4));
    let (event, after) = &found.events[0];
    assert_eq!((event.kind, event.hinge), (LockUp, Some(0)));
    assert!((event.time - 0.5).abs() < ROUNDING);
    let expected = merged_rate(0.0, 2.0);
    assert!((after.omega_body.x - expected).abs() < ROUNDING);
    assert_eq!((after.beta[0], after.tau[0]), (0.0, 0.0));
    // The impulse gives the hub its momentum, and the boom the opposite.
    let impulse = event.impulse.expect("a lock-up has an impulse");
    assert!((impulse + HUB * expected).abs() < ROUNDING);
    assert!((event.before.kinetic_energy - 0.5 * BOOM * 4.0).abs() < ROUNDING);
    let after_energy = 0.5 * (HUB + BOOM) * expected * expected;
    assert!((event.after.kinetic_energy - after_energy).abs() < ROUNDING);
    assert_eq!(found.last().hinges, [HingeState::Locked]);
}

#[test]
fn a_hinge_that_starts_on_its_lock_angle_locks_when_it_returns() {
    // β = sin 3t / 3 is back after half a period.
    let with_rate = locking_at(oscillating(free(0.0, 1.0), 3.0, 0.0), 0.0);
    let (found, _) = run(&scene(&[with_rate], 2.0), &tight(1));
    let [(LockUp, Some(0), time)] = found.happenings()[..] else { panic!("one lock-up") };
    assert!((time - std::f64::consts::PI / 3.0).abs() < 1e-11, "{time}");
}

#[test]
fn a_hinge_that_left_its_lock_angle_is_known_to_have_left_it_at_later_events() {
    // Until the second boom is released it is rigid with the hub, and β₁ is sin wt / w.
    let frequency = 3.0 * (0.8 / (5.0 / 6.0_f64)).sqrt();
    let back = std::f64::consts::PI / frequency;
    for before in [1e-2, 1e-4, 1e-6, 1e-8] {
        let swings = locking_at(oscillating(free(0.0, 1.0), 3.0, 0.0), 0.0);
        let late = waiting(Release::Time(back - before));
        let (found, _) = run(&scene(&[swings, late], 4.0), &tight(1));
        let [(Released, Some(1), _), (LockUp, Some(0), time)] = found.happenings()[..] else {
            panic!("{before:e}: a release, then a lock-up: {:?}", found.happenings())
        };
        // The other boom takes no part in what is about the axis; the frequency is 3 from its
        // release on, which changes the time by `before` cubed at most.
        assert!((time - back).abs() < 1e-11 + before.powi(3), "{before:e}: {time}, {back}");
    }
}

/// β of a hinge released at rest at β = 0 under β̈ = −w²(β − c) + 2gβ̇.
fn from_rest(t: f64, w: f64, g: f64, c: f64) -> f64 {
    let damped = (w * w - g * g).sqrt();
    let phase = damped * t;
    c * (1.0 - (g * t).exp() * (phase.cos() - g / damped * phase.sin()))
}

#[test]
fn a_hinge_pushed_off_its_lock_angle_locks_when_it_returns() {
    let (w, g, c) = (3.0, 0.4, 0.2);
    // Growing oscillations pass zero with a rate; from rest to 0 < t < half a period β rises.
    let (mut low, mut high) = (1.5, 2.09);
    assert!(from_rest(low, w, g, c) > 0.0 && from_rest(high, w, g, c) < 0.0);
    while high - low > 1e-15 * high && (low + high) / 2.0 > low && (low + high) / 2.0 < high {
        let middle = (low + high) / 2.0;
        if from_rest(middle, w, g, c) > 0.0 { low = middle } else { high = middle }
    }
    let at_rest = growing(oscillating(free(0.0, 0.0), w, c), g);
    let released = growing(oscillating(waiting(Release::Time(0.25)), w, c), g);
    for (hinge, start) in [(at_rest, 0.0), (released, 0.25)] {
        let (found, _) = run(&scene(&[locking_at(hinge, 0.0)], 4.0), &tight(1));
        let locks: Vec<_> = found.happenings().into_iter().filter(|h| h.0 == LockUp).collect();
        let [(LockUp, Some(0), time)] = locks[..] else { panic!("one lock-up: {locks:?}") };
        // At 1e-12 in the angle and a rate of 0.3.
        assert!((time - start - low).abs() < 1e-10, "{time}, {low}");
    }
}

#[test]
fn a_hinge_at_rest_on_its_lock_angle_is_thrown_off_and_locks_on_return() {
    // The second boom locks at 0.5, makes the hub turn at 0.2 under the first one, which falls
    // back by 0.1 until the third locks at 1 and makes the hub turn at −1/3.
    let hinges = [
        locking_at(free(0.0, 0.0), 0.0),
        locking_at(free(0.0, 1.0), 0.5),
        locking_at(free(0.0, -3.0), -3.1),
    ];
    let (found, _) = run(&scene(&hinges, 2.0), &tight(1));
    let expected = [(1, 0.5), (2, 1.0), (0, 1.3)];
    assert_eq!(found.happenings().len(), 3, "{:?}", found.happenings());
    for (event, (hinge, time)) in found.happenings().iter().zip(expected) {
        assert_eq!((event.0, event.1), (LockUp, Some(hinge)));
        assert!((event.2 - time).abs() < ROUNDING, "{event:?}");
    }
}

#[test]
fn a_hinge_locked_from_the_start_has_no_event() {
    let start = HingeStart { angle: 0.3, rate: 0.0, state: HingeState::Locked };
    let locked = oscillating(Hinge { start, ..Hinge::free() }, 2.0, 0.0);
    let (found, _) = run(&scene(&[locking_at(locked, 0.3), free(0.0, 1.0)], 1.0), &tight(2));
    assert_eq!(found.happenings(), []);
    assert_eq!((found.last().beta[0], found.last().hinges[0]), (0.3, HingeState::Locked));
}

#[test]
fn a_hinge_locked_elsewhere_stays_there_with_a_warning() {
    let start = HingeStart { angle: 0.3, rate: 0.0, state: HingeState::Locked };
    let locked = |angle| locking_at(Hinge { start, ..Hinge::free() }, angle);
    let elsewhere = scene(&[locked(0.4), free(0.0, 1.0)], 1.0);
    let first = HingeLabel::new(0, 0);
    assert_eq!(elsewhere.warnings(), [ModelWarning::LockedElsewhere(first)]);
    let (found, _) = run(&elsewhere, &tight(1));
    assert_eq!((found.happenings().len(), found.last().beta[0]), (0, 0.3));
    assert_eq!(scene(&[locked(0.3), Hinge { start, ..Hinge::free() }], 1.0).warnings(), []);
}

#[test]
fn a_hinge_that_starts_beyond_its_lock_angle_locks_when_it_comes_back() {
    for side in [1.0, -1.0] {
        // On the other side of the angle, and on its way further: β = 0.2 + sin(3t)/3 until it
        // comes down to 0.
        let beyond = oscillating(free(side * 0.2, side), 3.0, side * 0.2);
        let (found, _) = run(&scene(&[locking_at(beyond, 0.0)], 2.5), &tight(1));
        let [(LockUp, Some(0), time)] = found.happenings()[..] else { panic!("one lock-up") };
        let expected = (std::f64::consts::PI + 0.6_f64.asin()) / 3.0;
        assert!((time - expected).abs() < 1e-11, "{time}");
    }
}

#[test]
fn a_hinge_released_while_another_locks_is_rigid_during_the_impulse() {
    let hinges = [waiting(Release::Time(0.5)), locking_at(free(0.0, 1.0), 0.5)];
    let (found, _) = run(&scene(&hinges, 1.0), &tight(1));
    let kinds: Vec<_> = found.happenings().iter().map(|h| (h.0, h.1)).collect();
    assert_eq!(kinds, [(LockUp, Some(1)), (Released, Some(0))]);
    let times: Vec<f64> = found.happenings().iter().map(|h| h.2).collect();
    assert_eq!(times[0], times[1]);
    // The held boom belongs to the hub when the impulse acts.
    let expected = BOOM / (HUB + 2.0 * BOOM);
    let after = &found.events[0].1;
    assert!((after.omega_body.x - expected).abs() < ROUNDING, "{}", after.omega_body.x);
    assert_eq!(after.tau, [0.0, 0.0]);
    // The lock-up takes energy, and the release after it none.
    let [before, after] = [0.5 * BOOM, 0.5 * (HUB + 2.0 * BOOM) * expected * expected];
    for ((event, _), energies) in found.events.iter().zip([[before, after], [after, after]]) {
        let told = [event.before.kinetic_energy, event.after.kinetic_energy];
        let off = told.iter().zip(energies).map(|(told, energy)| (told - energy).abs());
        assert!(off.fold(0.0, f64::max) < ROUNDING, "{:?}: {told:?} {energies:?}", event.kind);
    }
}

#[test]
fn two_lock_ups_a_nanosecond_apart_happen_in_time_order() {
    // The later one is numbered first.
    let hinges = [locking_at(free(0.0, 1.0), 0.5 + 1e-9), locking_at(free(0.0, 1.0), 0.5)];
    let (found, _) = run(&scene(&hinges, 1.0), &tight(1));
    let [(LockUp, Some(1), first), (LockUp, Some(0), second)] = found.happenings()[..] else {
        panic!("two lock-ups: {:?}", found.happenings())
    };
    assert!((first - 0.5).abs() < ROUNDING);
    // The first lock-up leaves the other boom a relative rate of 0.8.
    let expected = 1e-9 / (1.0 - merged_rate(0.0, 1.0));
    assert!((second - first - expected).abs() < ROUNDING, "{}", second - first);
    let rates: Vec<f64> = found.events.iter().map(|(_, after)| after.omega_body.x).collect();
    assert!((rates[0] - merged_rate(0.0, 1.0)).abs() < ROUNDING);
    assert!((rates[1] - 2.0 * BOOM / (HUB + 2.0 * BOOM)).abs() < ROUNDING);
}

#[test]
fn two_lock_ups_a_picosecond_apart_are_one_instant() {
    for (a, b) in [(0.5, 0.5 + 1e-12), (0.5 + 1e-12, 0.5), (0.5, 0.5)] {
        let hinges = [locking_at(free(0.0, 1.0), a), locking_at(free(0.0, 1.0), b)];
        let (found, _) = run(&scene(&hinges, 1.0), &tight(1));
        let [(LockUp, Some(0), first), (LockUp, Some(1), second)] = found.happenings()[..] else {
            panic!("two lock-ups by number: {:?}", found.happenings())
        };
        assert_eq!(first, second);
        let (one, other) = (&found.events[0], &found.events[1]);
        assert_eq!((one.0.before, one.0.after), (other.0.before, other.0.after));
        assert_eq!(one.1.beta, [a, b]);
        assert!((one.1.omega_body.x - 2.0 * BOOM / (HUB + 2.0 * BOOM)).abs() < ROUNDING);
        // Each boom gives up the momentum of its own loss of rate.
        let impulse = -BOOM * (1.0 - one.1.omega_body.x);
        for (event, _) in [one, other] {
            assert!((event.impulse.expect("an impulse") - impulse).abs() < ROUNDING);
        }
    }
}

/// Two booms in mirror image on a spinning hub, with mass centres off their hinge axes.
fn mirror_image(lock_angle: Option<f64>, end_time: f64) -> Scene {
    let mut description = SceneDescription::at_rest("mirror image", ball(HUB), end_time);
    description.initial.omega_body = Vec3::new(0.0, 0.0, 0.7);
    for side in [1.0, -1.0] {
        // Half a turn about z takes one boom into the other.
        let rot =
            Mat3::about_axis(Vec3::unit_z(), if side > 0.0 { 0.0 } else { std::f64::consts::PI });
        let mount = Mount { point: Vec3::new(0.0, side, 0.2), rot_inboard_from_hinge: rot };
        let hinge = Hinge { lock_angle, ..free(1.2, -0.5) };
        let inertia = Sym3::diagonal(0.4, 0.1, 0.4);
        let mass_properties = MassProperties::new(1.5, Vec3::new(0.0, 0.8, 0.0), inertia);
        let segments = vec![Segment { length: 1.6, mass_properties, hinge }];
        description.attach(&Appendage::Regular { mount, segments });
    }
    Scene::new(description).expect("booms are bodies")
}

#[test]
fn a_joint_lock_up_is_one_lock_up_after_the_other_with_latches_kept() {
    let (found, _) = run(&mirror_image(Some(0.9), 3.0), &tight(1));
    let [(LockUp, Some(0), time), (LockUp, Some(1), other)] = found.happenings()[..] else {
        panic!("two lock-ups: {:?}", found.happenings())
    };
    assert_eq!(time, other);
    let after = &found.events[0].1;

    // The motion just before, from the same scene without latches.
    let scene = mirror_image(None, time);
    let before = run(&scene, &tight(1)).0.last().clone();
    let mut dynamics = Recursive::new(&scene);
    let [mut one, mut two, mut both] = [(); 3].map(|()| dynamics::Impulses::of_none());
    dynamics
        .strike(&before.beta, &before.tau, &[0, 1].map(Struck::locks), &mut both)
        .expect("regular");
    for (first, second) in [(0, 1), (1, 0)] {
        let mut dynamics = Recursive::new(&scene);
        dynamics
            .strike(&before.beta, &before.tau, &[Struck::locks(first)], &mut one)
            .expect("regular");
        let mut mode = Mode::at_start(&scene);
        mode.hinges[first] = HingeState::Locked;
        dynamics.set_mode(&mode, &before.beta);
        let rate = before.tau[second] + one.delta_tau[second];
        dynamics
            .strike(&[before.beta[second]], &[rate], &[Struck::locks(0)], &mut two)
            .expect("regular");
        let change = one.delta_omega_body + two.delta_omega_body;
        // Rounding of two small linear systems.
        assert!((change - both.delta_omega_body).norm() < 1e-14);
        assert!((one.delta_energy + two.delta_energy - both.delta_energy).abs() < 1e-14);
        let omega = before.omega_body + change;
        // The two runs reach the lock angle to the tolerance of 1e-12.
        assert!((omega - after.omega_body).norm() < 1e-11);
    }
    for ((event, _), impulse) in found.events.iter().zip(&both.torques) {
        assert!((event.impulse.expect("an impulse") - impulse).abs() < 1e-11);
    }
    let impulses = both.torques;
    assert!((impulses[0] - impulses[1]).abs() < 1e-11, "mirror images: {impulses:?}");
}

/// The jumps of the one instant in which hinges lock.
#[derive(Default)]
struct Shares(Vec<Jump>);

impl Recorder for Shares {
    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> std::io::Result<()> {
        assert!(self.0.is_empty() || instant.jumps.is_empty(), "a second lock-up");
        self.0.extend(instant.jumps.iter().cloned());
        Ok(())
    }
}

#[test]
fn each_share_of_a_joint_lock_up_is_by_its_own_impulse() {
    // The first two lock at 0.5, the third turns on.
    let rates = [1.0, -3.0, 0.4];
    let [first, second] = [0, 1].map(|i| locking_at(free(0.0, rates[i]), 0.5 * rates[i]));
    let scene = scene(&[first, second, free(0.0, rates[2])], 0.7);
    let mut shares = Shares::default();
    simulate(&scene, &tight(1), &mut shares).expect("a uniform motion");
    let hinges: Vec<usize> = shares.0.iter().map(|jump| jump.hinge).collect();
    assert_eq!(hinges, [0, 1]);
    // Two booms give the hub their momentum and get a share of the rate.
    let rate = BOOM * (rates[0] + rates[1]) / (HUB + 2.0 * BOOM);
    for jump in &shares.0 {
        let impulse = BOOM * (rate - rates[jump.hinge]);
        let (hub, booms) = (jump.omega_body.x, jump.tau.iter().map(|tau| jump.omega_body.x + tau));
        assert!((hub + impulse / HUB).abs() < ROUNDING, "{jump:?}");
        for (i, absolute) in booms.enumerate() {
            let expected = if i == jump.hinge { impulse / BOOM } else { 0.0 };
            assert!((absolute - expected).abs() < ROUNDING, "boom {i}: {jump:?}");
        }
        // All mass centres stay where they are.
        assert!(jump.velocity_body.norm() < ROUNDING, "{jump:?}");
    }
}
