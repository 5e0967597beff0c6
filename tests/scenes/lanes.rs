//! Runs side by side, whose steps are taken in lanes: each is what it is alone.

use std::cell::RefCell;
use std::future::poll_fn;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::pin::{Pin, pin};
use std::task::{Context, Poll, Waker};

use nboom::model::{Scene, SceneDescription};
use nboom::scalar::{InstructionSet, Kernel};
use nboom::sim::{Lanes, Method, Options, Simulator, Summary, Task};

use crate::catalog::Reference;
use crate::collect::{Collected, run, tight};
use crate::random_scene::Rng;
use crate::trajectories::agrees;

/// Of runs that take explicit steps in lanes: by `auto` tight tolerances have stages of one run side by side.
fn options(samples: usize) -> Options {
    Options {
        integrator: Method::Dop853,
        kernels: nboom_routines::for_runs(),
        batches: nboom_routines::right_sides_of_eight(),
        lanes: true,
        ..tight(samples)
    }
}

/// The scene with other masses and another spin, a few per cent away.
fn dispersed(scene: &Scene, seed: u64) -> Scene {
    let mut dice = Rng::new(seed);
    let mut description: SceneDescription = (**scene).clone();
    for body in &mut description.bodies {
        body.mass_properties.mass *= dice.between(1.0, 1.02);
    }
    description.initial.omega_body = description.initial.omega_body * dice.between(0.99, 1.01);
    Scene::new(description).expect("a physical scene")
}

/// Runs scenes side by side, as many at once as are said.
fn beside(scenes: &[Scene], options: Options, at_once: usize) -> Vec<(Collected, Summary)> {
    let lanes = Lanes::new();
    let left = RefCell::new(scenes.iter().enumerate());
    let found = RefCell::new(Vec::new());
    let task = async || {
        let next = || left.borrow_mut().next();
        while let Some((number, scene)) = next() {
            let mut collected = Collected::default();
            let mut simulator = Simulator::new(scene, options);
            let summary = simulator.run_in(&lanes, &mut collected).await.expect("it runs").clone();
            found.borrow_mut().push((number, (collected, summary)));
        }
    };
    lanes.carry_out((0..at_once).map(|_| -> Task<'_> { Box::pin(task()) }).collect());
    let mut found = found.into_inner();
    found.sort_by_key(|(number, _)| *number);
    found.into_iter().map(|(_, run)| run).collect()
}

#[test]
fn a_run_does_not_depend_on_those_beside_it() {
    let mut scenes = Vec::new();
    for reference in Reference::all() {
        scenes.extend((0..5).map(|seed| dispersed(&reference.scene(), seed)));
    }
    for options in [
        options(10),
        Options { integrator: Method::Dopri5, rtol: 1e-6, atol: 1e-9, ..options(10) },
        Options { integrator: Method::Auto, rtol: 1e-9, ..options(10) },
    ] {
        let alone: Vec<(Collected, Summary)> =
            scenes.iter().map(|scene| run(scene, &options)).collect();
        for at_once in [3, 16] {
            let found = beside(&scenes, options, at_once);
            assert_eq!(found.len(), scenes.len());
            for (((found, summary), (alone, of_alone)), scene) in
                found.iter().zip(&alone).zip(&scenes)
            {
                assert_eq!(found.samples, alone.samples, "{}", scene.name);
                assert_eq!(found.events, alone.events, "{}", scene.name);
                assert_eq!(summary, of_alone, "{}", scene.name);
            }
        }
    }
}

#[test]
fn runs_in_lanes_agree_with_the_references() {
    for reference in Reference::all() {
        let (found, _) = run(&reference.scene(), &options(reference.intervals()));
        agrees("lanes", &found, &reference);
    }
}

#[test]
fn lanes_are_filled_by_runs_of_one_kind() {
    if InstructionSet::of_this_processor() == InstructionSet::Portable {
        return;
    }
    let reference = Reference::load("report_testcase");
    let scenes: Vec<Scene> = (0..40).map(|seed| dispersed(&reference.scene(), seed)).collect();
    let lanes = Lanes::new();
    let task = async |scene: &Scene| {
        let mut simulator = Simulator::new(scene, options(1));
        simulator.run_in(&lanes, &mut Collected::default()).await.expect("it runs");
    };
    lanes.carry_out(scenes.iter().map(|scene| -> Task<'_> { Box::pin(task(scene)) }).collect());
    let filled = lanes.steps() as f64 / (8 * lanes.packs()) as f64;
    assert!(lanes.steps() > 40 * 40, "{} steps in lanes", lanes.steps());
    assert!(filled > 0.5, "{filled} of all lanes are filled");
}

/// Equal appendages fill the registers of one state, so that lanes have nothing to add.
#[test]
fn only_code_that_leaves_registers_empty_has_lanes() {
    if InstructionSet::of_this_processor() == InstructionSet::Portable {
        return;
    }
    let steps_by = |in_packs: bool| -> usize {
        let allowed = |kernel: &&Kernel| kernel.in_packs == in_packs;
        let kernels: Vec<Kernel> =
            nboom_routines::for_runs().iter().filter(allowed).copied().collect();
        let options = Options { kernels: kernels.leak(), ..options(1) };
        let lanes = Lanes::new();
        for reference in Reference::all() {
            let mut simulator = Simulator::new(&reference.scene(), options);
            let mut ignored = Collected::default();
            lanes.finish(simulator.run_in(&lanes, &mut ignored)).expect("it runs");
        }
        lanes.steps()
    };
    assert!(steps_by(false) > 1000, "{} steps", steps_by(false));
    assert_eq!(steps_by(true), 0);
}

/// Tasks that are not runs alone: what an engineer's own future may do beside one.
#[test]
fn lanes_outlast_tasks_that_are_given_up_wait_for_others_or_panic() {
    let reference = Reference::load("report_testcase");
    let scenes: Vec<Scene> = (0..6).map(|seed| dispersed(&reference.scene(), seed)).collect();
    let alone: Vec<Summary> = scenes.iter().map(|scene| run(scene, &options(1)).1).collect();
    let lanes = Lanes::new();
    let run_in = async |lanes: &Lanes, number: usize| {
        let mut simulator = Simulator::new(&scenes[number], options(1));
        let found = simulator.run_in(lanes, &mut Collected::default()).await.expect("it runs");
        assert_eq!(*found, alone[number]);
    };
    // Some are polled once and dropped, and some twice in a row; some wait for something else first, and some run in
    // lanes in which nobody else does.
    let task = async |number: usize| {
        let given_up = poll_some(pin!(run_in(&lanes, number)), number % 3);
        assert!(given_up.is_pending());
        let mut rounds = number;
        poll_fn(|_| {
            rounds = rounds.saturating_sub(1);
            if rounds == 0 { Poll::Ready(()) } else { Poll::Pending }
        })
        .await;
        run_in(&Lanes::new(), number).await;
        run_in(&lanes, number).await;
    };
    lanes.carry_out((0..6).map(|i| -> Task<'_> { Box::pin(task(i)) }).collect());
    let undisturbed = Lanes::new();
    let runs = (0..6).map(|i| -> Task<'_> { Box::pin(run_in(&undisturbed, i)) });
    undisturbed.carry_out(runs.collect());
    assert_eq!(lanes.steps(), undisturbed.steps(), "steps that are given up are not taken");

    // The last one falls when the others have their steps in lanes.
    let falls = async |number: usize| {
        let (mut run, mut rounds) = (pin!(run_in(&lanes, number)), 0);
        poll_fn(|context| {
            rounds += 1;
            assert!(number < 5 || rounds < 3, "a recorder's panic");
            run.as_mut().poll(context)
        })
        .await;
    };
    let tasks = || (0..6).map(|i| -> Task<'_> { Box::pin(falls(i)) }).collect();
    assert!(catch_unwind(AssertUnwindSafe(|| lanes.carry_out(tasks()))).is_err());
    lanes.carry_out((0..2).map(|i| -> Task<'_> { Box::pin(run_in(&lanes, i)) }).collect());
    lanes.finish(run_in(&lanes, 5));
}

fn poll_some(mut future: Pin<&mut impl Future<Output = ()>>, again: usize) -> Poll<()> {
    let mut context = Context::from_waker(Waker::noop());
    let polls = (0..=again).map(|_| future.as_mut().poll(&mut context));
    polls.last().expect("it is polled at least once")
}
