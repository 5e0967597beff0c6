//! Springs and dampers between two hinges: closed forms, balances, and the independent derivation.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::model::{
    Body, Coupling, Hinge, HingeState, Joint, MassProperties, Mode, Mount, Scene, SceneDescription,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::Form;

use super::log::{options, run};
use super::newton_euler::{accelerations, loads, place, vector};
use super::random_scene::{Rng, all_acting, conservative, description};

fn coupling(hinges: [usize; 2]) -> Coupling {
    let (ratio, stiffness, rest, damping) = (1.0, 0.0, 0.0, 0.0);
    Coupling { hinges, ratio, stiffness, rest, damping, is_mutual: true }
}

/// Two rotors about one axis through their mass centres on a hub that does not turn about it: the wheel of
/// inertia `a` first. Their torques on the hub cancel.
fn rotors(a: f64, b: f64) -> SceneDescription {
    let hub = MassProperties::new(50.0, Vec3::zero(), Sym3::diagonal(20.0, 30.0, 25.0));
    let mut scene = SceneDescription::at_rest("rotors", hub, 3.0);
    scene.bodies = [a, b]
        .map(|about_z| Body {
            inboard: None,
            mount: Mount::at(Vec3::zero()),
            joint: Joint::Revolute,
            axis: Vec3::unit_z(),
            mass_properties: MassProperties::new(
                2.0,
                Vec3::zero(),
                Sym3::diagonal(about_z, about_z, about_z),
            ),
            tip: Vec3::unit_x(),
            hinge: Hinge::free(),
        })
        .into();
    scene
}

/// Both swing against each other: ẍ = −k x / μ − c ẋ / μ for x = β₁ − β₂ − θ, 1/μ = 1/a + 1/b.
#[test]
fn two_rotors_on_one_spring_and_damper_swing_against_each_other() {
    let (a, b, k, c, rest) = (0.5, 0.8, 4.0, 0.3, 0.25);
    let mut scene = rotors(a, b);
    let spring = Coupling { stiffness: k, damping: c, rest, ..coupling([0, 1]) };
    scene.couplings = vec![spring];
    scene.bodies[0].hinge.start.angle = 1.0;
    let found = run(&scene, &options(12, 1e-13));
    let per_inertia = 1.0 / a + 1.0 / b;
    let decay = 0.5 * c * per_inertia;
    let frequency = (k * per_inertia - decay * decay).sqrt();
    for seen in &found.samples {
        let (s, cosine) = (frequency * seen.time).sin_cos();
        let x = 0.75 * (-decay * seen.time).exp() * (cosine + decay / frequency * s);
        assert!((seen.beta[0] - seen.beta[1] - rest - x).abs() < 1e-12, "at {}", seen.time);
        assert!((a * seen.tau[0] + b * seen.tau[1]).abs() < 1e-13);
        assert!(seen.omega_body.norm() < 1e-13);
    }
}

/// A gear: with a stiff spring the second goes `ratio` of the first, and the torques share the work.
#[test]
fn what_a_spring_with_a_ratio_takes_from_one_hinge_the_other_gets() {
    let (ratio, k) = (-2.5, 3.0);
    let mut scene = rotors(0.4, 0.9);
    scene.couplings = vec![Coupling { stiffness: k, ratio, rest: 0.1, ..coupling([0, 1]) }];
    scene.bodies[1].hinge.start.rate = 1.0;
    let found = run(&scene, &options(16, 1e-12));
    let first = &found.samples[0];
    let stored = |beta: &[f64]| 0.5 * k * (beta[0] - ratio * beta[1] - 0.1).powi(2);
    let mut most = 0.0_f64;
    for seen in &found.samples {
        let gained = seen.kinetic_energy - first.kinetic_energy;
        let given = stored(&first.beta) - stored(&seen.beta);
        assert!((gained - given).abs() < 1e-11, "{gained} {given}");
        most = most.max(gained.abs());
    }
    assert!(most > 0.1, "{most}");
    assert!(found.summary.conservation.energy < 1e-11);
}

/// While one hinge is held its angle counts, and the whole torque is on the other.
#[test]
fn a_held_hinge_is_the_other_end_of_the_spring() {
    let mut scene = rotors(0.4, 0.9);
    scene.couplings = vec![Coupling { stiffness: 2.0, ratio: 2.0, ..coupling([0, 1]) }];
    scene.bodies[1].hinge.start.state = HingeState::Locked;
    scene.bodies[1].hinge.start.angle = 0.3;
    let mut alone = scene.clone();
    alone.couplings.clear();
    (alone.bodies[0].hinge.spring.linear, alone.bodies[0].hinge.spring.preload_angle) =
        (-2.0, -0.6);
    let [coupled, alone] = [scene, alone].map(|scene| run(&scene, &options(7, 1e-13)));
    for (a, b) in coupled.samples.iter().zip(&alone.samples) {
        assert!((a.beta[0] - b.beta[0]).abs() < 1e-13 && (a.tau[0] - b.tau[0]).abs() < 1e-13);
    }
}

fn random_couplings(bodies: usize, seed: u64) -> Vec<Coupling> {
    let dice = &mut Rng::new(seed ^ 0xc0b1);
    let mut one = || {
        let first = dice.below(bodies);
        let second = (first + 1 + dice.below(bodies - 1)) % bodies;
        Coupling {
            hinges: [first, second],
            ratio: dice.between(-2.0, 2.0),
            stiffness: dice.between(0.0, 5.0),
            rest: dice.between(-1.0, 1.0),
            damping: dice.between(0.0, 1.0),
            is_mutual: dice.chance(0.7),
        }
    };
    vec![one(), one()]
}

#[test]
fn coupled_trees_accelerate_as_by_newton_and_euler() {
    for seed in 0..40 {
        let bodies = 2 + (seed % 5) as usize;
        let mut scene = description(bodies, seed);
        scene.couplings = random_couplings(bodies, seed);
        let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
        let tau: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.rate).collect();
        let omega = scene.initial.omega_body;
        let checked = Scene::new(scene.clone()).expect("a valid scene");
        let mode: Mode = all_acting(&checked, vec![HingeState::Free; bodies]);
        let mut dynamics = Recursive::new(&checked);
        dynamics.set_mode(&mode, &beta);
        let mut found = Accelerations::for_hinges(bodies);
        let motion = Motion { omega_body: omega, beta: &beta, tau: &tau };
        dynamics.accelerations(&motion, &mut found);
        let placed = place(&scene, &beta, &tau, vector(omega), vector(Vec3::zero()));
        let acting = loads(&scene, &mode, &placed, &beta, &tau);
        let expected = accelerations(&scene, &mode, &placed, &tau, &acting);
        let largest = expected.tau_dots.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in found.tau_dot.iter().zip(&expected.tau_dots) {
            // The dense solution errs by rounding times its condition.
            assert!((a - b).abs() < 1e-10 * largest, "seed {seed}: {a} {b}");
        }
    }
}

#[test]
fn coupled_trees_keep_their_balances_by_all_code() {
    for seed in 0..12 {
        let bodies = 2 + (seed % 4) as usize;
        let mut scene = conservative(bodies, seed);
        scene.end_time = 0.3;
        scene.couplings = random_couplings(bodies, seed);
        let mut ends = Vec::new();
        for formulation in [None, Form::named("symmetric")] {
            let options = nboom::sim::Options { formulation, ..options(2, 1e-12) };
            let found = run(&scene, &options);
            let balance = found.summary.conservation;
            let angular = balance.angular_momentum.expect("a free main body");
            assert!(balance.energy < 1e-9 && angular < 1e-9, "{seed} {balance:?}");
            ends.push(found.last().beta.clone());
        }
        for (a, b) in ends[0].iter().zip(&ends[1]) {
            assert!((a - b).abs() < 1e-9, "seed {seed}: {a} {b}");
        }
    }
}
