//! Hinge laws that a program brings itself.

use std::io;

use nboom_formulation::Formulation;
use nboom_model::{Dashpot, Hinge, Scene, SceneDescription, Spring};
use nboom_ode::Method;
use nboom_sim::{
    Form, InstantMotion, Nobody, Options, OwnLaw, Path, Recorder, SimError, Simulator, Summary,
    simulate,
};

use crate::stops::stops;
use crate::{BOOM, HUB, REDUCED, Told, apart, ball, free, reference, rotors, scene, tight};

/// A run under own laws, and what it told.
fn under(scene: &Scene, options: Options, laws: Vec<OwnLaw>) -> (Told, Summary) {
    let (mut simulator, mut told) = (Simulator::under_laws(scene, options, laws), Told::default());
    let summary = simulator.run(&mut told).expect("it runs to its end").clone();
    (told, summary)
}

/// Springs and dashpots of a scene as laws of a program; the scene without them.
fn taken_out(scene: &Scene) -> (Scene, Vec<OwnLaw>) {
    let mut bare = SceneDescription::clone(scene);
    let take_out = |(i, body): (usize, &mut nboom_model::Body)| {
        let (spring, dashpot) = (body.hinge.spring, body.hinge.dashpot);
        (body.hinge.spring, body.hinge.dashpot) = (Spring::default(), Dashpot::default());
        // Eq. (6.1) as printed.
        OwnLaw::new(i, move |beta, tau| {
            let (s, d) = (beta + spring.preload_angle, beta + dashpot.preload_angle);
            (spring.quadratic * s + spring.linear) * s
                + (dashpot.rate_quadratic * tau + dashpot.rate_linear) * tau
                + (dashpot.angle_quadratic * d + dashpot.angle_linear) * d
        })
    };
    let laws = bare.bodies.iter_mut().enumerate().map(take_out).collect();
    (Scene::new(bare).expect("bodies are physical"), laws)
}

#[test]
fn springs_and_dashpots_written_by_hand_make_their_motion() {
    for name in ["s03_chain3_general", "s07_quadratic_terms", "s10_symmetric_lock"] {
        let whole = reference(name).ending_at(1.0).expect("an end after the start");
        let (bare, laws) = taken_out(&whole);
        let mut expected = Told::default();
        simulate(&whole, &tight(4), &mut expected).expect("it runs to its end");
        for (integrator, rtol) in
            [(Method::Auto, 1e-12), (Method::Gauss, 1e-12), (Method::Radau5, 1e-8)]
        {
            let options = Options { integrator, rtol, atol: 1e-2 * rtol, ..tight(4) };
            let (found, summary) = under(&bare, options, laws.clone());
            assert_eq!(found.kinds(), expected.kinds(), "{name}");
            let off = apart(found.last(), expected.last());
            // Errors of some hundred steps, which lock-ups magnify.
            assert!(off < 1e3 * rtol, "{name}, {}: {off:e}", integrator.name());
            assert!(summary.conservation.energy < 1e3 * rtol, "{name}: {:?}", summary.conservation);
            let torque =
                |told: &Told| told.last().detail.as_ref().expect("asked for").hinge_torque.clone();
            for (found, expected) in torque(&found).iter().zip(torque(&expected)) {
                assert!((found - expected).abs() < 1e4 * rtol * expected.abs().max(1.0), "{name}");
            }
        }
    }
}

/// μ β̈ = −k sin β is a pendulum: ½ μ τ² − k cos β is constant.
#[test]
fn a_law_that_no_scene_has() {
    let (stiffness, start) = (3.0, 2.0_f64);
    let pendulum = OwnLaw::new(0, move |beta: f64, _| -stiffness * beta.sin());
    let (told, summary) =
        under(&scene(rotors(&[free(start, 0.0)], 10.0)), tight(50), vec![pendulum]);
    for sample in &told.samples {
        let energy = 0.5 * REDUCED * sample.tau[0].powi(2) - stiffness * sample.beta[0].cos();
        // The tolerance is 1e-12 in each of some dozen steps.
        assert!((energy + stiffness * start.cos()).abs() < 1e-10, "at {}", sample.time);
    }
    assert!(summary.conservation.energy < 1e-10, "{:?}", summary.conservation);
    assert_eq!(summary.code().path, "generic");
}

/// Two laws about one hinge add up, also to its spring, and a held hinge bears its own.
#[test]
fn laws_about_one_hinge_add_up() {
    let constant = |hinge, torque: f64| OwnLaw::new(hinge, move |_, _| torque);
    let mut hinges = [free(0.0, 0.0), free(0.0, 0.0)];
    hinges[1].start.state = nboom_model::HingeState::Locked;
    let laws = vec![constant(0, 0.3), constant(1, 5.0), constant(0, -0.1)];
    let (told, _) = under(&scene(rotors(&hinges, 2.0)), tight(1), laws);
    // The hub and the held boom have a moment of inertia of 5.
    let beta = 0.5 * 0.2 / (5.0 / 6.0) * 4.0;
    assert!((told.last().beta[0] - beta).abs() < 1e-13, "{}", told.last().beta[0]);
    assert_eq!(told.last().beta[1], 0.0);
}

#[test]
fn a_simulator_keeps_its_laws() {
    let push = || vec![OwnLaw::new(0, |_, tau| 0.4 - 0.1 * tau)];
    let (first, other) =
        (scene(rotors(&[free(0.0, 0.0)], 1.0)), scene(rotors(&[free(0.1, 0.0); 2], 1.0)));
    let mut simulator = Simulator::under_laws(&first, tight(2), push());
    simulator.run(&mut Nobody).expect("it runs to its end");
    simulator.set_scene(&other);
    let mut told = Told::default();
    simulator.run(&mut told).expect("it runs to its end");
    assert_eq!(told, under(&other, tight(2), push()).0);
    assert!(told.last().tau[0] > 0.1);
}

#[test]
fn code_that_does_not_know_them_is_refused() {
    let scene = scene(rotors(&[free(0.0, 0.0)], 1.0));
    let refused = |options| {
        let laws = vec![OwnLaw::new(0, |_, _| 1.0)];
        let mut simulator = Simulator::under_laws(&scene, options, laws);
        let error = simulator.run(&mut Nobody).expect_err("it is refused").error;
        matches!(error, SimError::OwnLaws { .. })
    };
    let articulated = Some(Form::Closed(Formulation::Articulated));
    assert!(refused(Options { integrator: Method::Taylor, ..tight(1) }));
    assert!(refused(Options { path: Path::Generated, ..tight(1) }));
    assert!(refused(Options { formulation: articulated, ..tight(1) }));
    let recursive = Options { formulation: Some(Form::Recursive), path: Path::Generic, ..tight(1) };
    under(&scene, recursive, vec![OwnLaw::new(0, |_, _| 1.0)]);
    let mut beyond = Simulator::under_laws(&scene, tight(1), vec![OwnLaw::new(1, |_, _| 1.0)]);
    let error = beyond.run(&mut Nobody).expect_err("there is no such hinge").error;
    assert_eq!(
        error.to_string(),
        "own hinge law: hinge number 2 found, one of the 1 hinges expected"
    );
}

#[test]
fn a_torque_that_is_no_number_ends_the_run() {
    let scene = scene(rotors(&[free(0.0, 1.0)], 2.0));
    let law = OwnLaw::new(0, |beta: f64, _| (0.5 - beta).sqrt());
    let mut simulator = Simulator::under_laws(&scene, tight(1), vec![law]);
    let failure = simulator.run(&mut Nobody).expect_err("no number").error;
    let SimError::NotFinite { time, .. } = failure else { panic!("{failure}") };
    assert!(time > 0.3 && time < 0.6, "{time}");
}

/// Keeps the acceleration of the first hinge before each instant.
#[derive(Default)]
struct Before(Vec<f64>);

impl Recorder for Before {
    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, motion: &InstantMotion<'_>) -> io::Result<()> {
        self.0.extend(motion.before.map(|before| before.detail.beta_ddot[0]));
        Ok(())
    }
}

/// The motion before an impact at the initial time is that of the scene under all its laws, whatever ran before.
#[test]
fn accelerations_before_an_impact_at_the_start_are_those_of_the_scene() {
    let begins_at_its_stop = |moment: f64| {
        let hits = Hinge { stops: stops(-1.0, 0.0, 1.0), ..free(0.0, 1.0) };
        let spring = Spring { linear: -1.0, preload_angle: 0.5, ..Spring::default() };
        let mut description = rotors(&[Hinge { spring, ..hits }], 0.5);
        description.bodies[0].mass_properties = ball(moment);
        scene(description)
    };
    let reduced = |boom: f64| HUB * boom / (HUB + boom);
    let scenes = [BOOM, 3.0 * BOOM].map(|moment| (begins_at_its_stop(moment), reduced(moment)));
    let articulated = Some(Form::Closed(Formulation::Articulated));
    for (options, push) in [
        (tight(1), 0.7),
        (Options { formulation: articulated, path: Path::Generic, ..tight(1) }, 0.0),
    ] {
        let laws = if push > 0.0 { vec![OwnLaw::new(0, move |_, _| push)] } else { Vec::new() };
        let mut simulator = Simulator::under_laws(&scenes[0].0, options, laws);
        for (scene, reduced) in &scenes {
            simulator.set_scene(scene);
            let mut before = Before::default();
            simulator.run(&mut before).expect("it runs to its end");
            let expected = (push - 0.5) / reduced;
            assert!((before.0[0] - expected).abs() < 1e-14, "{:?}, {expected} expected", before.0);
        }
    }
}
