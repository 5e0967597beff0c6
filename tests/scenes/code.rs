//! Which code computes accelerations: every formulation leads to the reference trajectories, and
//! what cannot be had is refused, or replaced where that is allowed.

use nboom::formulation::{Formulation, assumptions_in_a_word};
use nboom::model::{
    Body, Hinge, HingeState, Joint, MassProperties, Mount, Release, Rotor, RotorSpeed, Scene,
    SceneDescription,
};
use nboom::scalar::{Kernel, Sym3, Vec3};
use nboom::sim::{Form, Method, NoRoutine, Options, Path, Selection, SimError};

use crate::catalog::Reference;
use crate::collect::{run, tight, try_run};
use crate::trajectories::agrees;

fn asking(path: Path, formulation: Option<Form>, kernels: &'static [Kernel]) -> Options {
    Options { path, formulation, kernels, ..tight(20) }
}

/// Path, formulation and reason.
fn told(selection: &Selection) -> (&str, &str, &str) {
    (selection.path, selection.formulation, &selection.reason)
}

#[test]
fn every_closed_form_agrees_with_the_references() {
    for reference in Reference::all() {
        let scene = reference.scene();
        let samples = reference.intervals();
        let with = |form| Options { samples, ..asking(Path::Generic, Some(form), &[]) };
        let (recursive, _) = run(&scene, &with(Form::Recursive));
        for formulation in Formulation::ALL {
            let (found, summary) = run(&scene, &with(Form::Closed(formulation)));
            agrees(formulation.name(), &found, &reference);
            let [only] = &summary.selections[..] else { panic!("{:?}", summary.selections) };
            assert_eq!(told(only), ("generic", formulation.name(), "as demanded"));
            // Other operations leave other roundings; with the same ones it is the same code.
            let rounded_alike = found.samples == recursive.samples;
            assert!(!rounded_alike || scene.bodies.is_empty(), "{} {formulation}", reference.name);
        }
    }
}

/// A hub with a boom, and from 0.5 on a second one that slides on the boom, 45 degrees from its hinge.
fn skew() -> Scene {
    let inertia = Sym3::diagonal(1.0, 1.2, 1.4);
    let mass_properties = MassProperties::new(1.0, Vec3::new(0.1, 0.5, 0.2), inertia);
    let mut scene = SceneDescription::at_rest("skew", mass_properties, 1.0);
    let mount = Mount::at(Vec3::unit_y());
    let (tip, hinge) = (Vec3::unit_y(), Hinge::free());
    let boom = Body {
        inboard: None,
        mount,
        joint: Joint::Revolute,
        axis: Vec3::unit_x(),
        mass_properties,
        tip,
        hinge,
    };
    let mut hinge = Hinge::free();
    (hinge.start.state, hinge.release) = (HingeState::Unreleased, Release::Time(0.5));
    let axis = Vec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
    let joint = Joint::Prismatic;
    scene.bodies = vec![boom, Body { inboard: Some(0), joint, axis, hinge, ..boom }];
    scene.initial.omega_body = Vec3::new(0.3, -0.5, 1.0);
    Scene::new(scene).expect("a physical scene")
}

#[test]
fn a_closed_form_that_is_demanded_of_a_tree_is_refused() {
    let of_any_tree = [Formulation::Symmetric, Formulation::Articulated, Formulation::Momentum];
    for formulation in Formulation::ALL.into_iter().filter(|f| !of_any_tree.contains(f)) {
        let options = asking(Path::Generic, Some(Form::Closed(formulation)), &[]);
        let (found, result) = try_run(&skew(), &options);
        let error = result.expect_err("not covered").error;
        assert_eq!(
            error.to_string(),
            format!(
                "at time 0.5: formulation {formulation} does not cover hinge 1,2, which belongs \
                 neither to a chain nor to a paddle of rigid bodies; symmetric covers any tree of \
                 rigid bodies, recursive any scene"
            )
        );
        // Until then it is one boom, which all of them cover.
        assert_eq!(found.last().time, 0.45);
    }
}

#[test]
fn a_rotor_on_a_body_that_moves_is_what_is_not_covered() {
    let mut scene = SceneDescription::clone(&skew());
    let speed = RotorSpeed::Constant(10.0);
    scene.rotors.push(Rotor { body: Some(0), axis: Vec3::unit_z(), inertia: 0.1, speed });
    let scene = Scene::new(scene).expect("a physical scene");
    for formulation in [Formulation::Report, Formulation::Relative, Formulation::Articulated] {
        let options = asking(Path::Generic, Some(Form::Closed(formulation)), &[]);
        let told = try_run(&scene, &options).1.expect_err("not covered").error.to_string();
        let why = format!("{formulation} does not cover hinge 1,1, whose body has a rotor; ");
        assert!(told.contains(&why), "{told}");
    }
    run(&scene, &asking(Path::Generic, Some(Form::Closed(Formulation::Symmetric)), &[]));
}

#[test]
fn closed_forms_take_a_tree_where_the_recursion_takes_it() {
    let with = |form| run(&skew(), &asking(Path::Generic, Some(form), &[])).0;
    let recursive = with(Form::Recursive);
    for formulation in [Formulation::Symmetric, Formulation::Articulated, Formulation::Momentum] {
        let found = with(Form::Closed(formulation));
        assert_ne!(found.samples, recursive.samples, "the same roundings");
        for (a, b) in found.samples.iter().zip(&recursive.samples) {
            let apart = (a.omega_body - b.omega_body).norm()
                + a.tau.iter().zip(&b.tau).map(|(a, b)| (a - b).abs()).sum::<f64>();
            assert!(apart < 1e-11, "{formulation}: {apart:e} at {}", a.time);
        }
    }
    let moved = recursive.last().tau[1].abs();
    assert!(moved > 0.01, "{moved}");
}

#[test]
fn the_automatic_path_replaces_what_does_not_cover_the_mode() {
    let relative = Some(Form::Closed(Formulation::Relative));
    let (_, summary) = run(&skew(), &asking(Path::Auto, relative, &[]));
    let [boom, tree] = &summary.selections[..] else { panic!("{:?}", summary.selections) };
    let why = "no relative routine for topology S1";
    assert_eq!(told(boom), ("generic", "relative", why));
    let why = "formulation relative does not cover hinge 1,2, which belongs neither to a chain nor to \
               a paddle of rigid bodies";
    assert_eq!((tree.since, told(tree)), (0.5, ("generic", "recursive", why)));

    let (_, summary) = run(&skew(), &asking(Path::Auto, None, nboom_routines::all()));
    let [boom, tree] = &summary.selections[..] else { panic!("{:?}", summary.selections) };
    assert_eq!((boom.path, boom.formulation), ("generated", "articulated"));
    let why = "no routine for topology Trs";
    assert_eq!(told(tree), ("generic", "recursive", why));
}

/// Evaluations are counted by the integrator, too.
#[test]
fn evaluations_are_shared_out_among_the_code_that_made_them() {
    // Each half of the span takes several steps.
    for (path, told, [least, most]) in
        [(Path::Auto, "mixed", [0.1, 0.9]), (Path::Generic, "generic", [0.0, 0.0])]
    {
        let (_, summary) = run(&skew(), &asking(path, None, nboom_routines::all()));
        let code = summary.code();
        assert_eq!(code.path, told, "{:?}", summary.selections);
        let counted: usize = summary.selections.iter().map(|of| of.evaluations).sum();
        assert_eq!(counted, summary.evaluations);
        let of_routines = summary.selections.iter().filter(|of| of.path == "generated");
        let of_routines: usize = of_routines.map(|of| of.evaluations).sum();
        assert_eq!(code.generated_share, of_routines as f64 / counted as f64);
        assert!((least..=most).contains(&code.generated_share), "{}", code.generated_share);
    }
}

#[test]
fn series_are_nobody_else_s_code() {
    let options =
        Options { integrator: Method::Taylor, ..asking(Path::Auto, None, nboom_routines::all()) };
    let (_, summary) = run(&skew(), &options);
    let [only] = &summary.selections[..] else { panic!("{:?}", summary.selections) };
    let why = "power series of these equations, as recorded";
    assert_eq!(told(only), ("series", "articulated", why));
    assert_eq!((summary.code().path, summary.code().generated_share), ("series", 0.0));
    assert_eq!(only.evaluations, summary.evaluations);
}

/// The stock routines for a boom under the name of this formulation.
fn named(formulation: Formulation) -> impl Iterator<Item = Kernel> {
    let stock = nboom_routines::all().iter().filter(|kernel| {
        kernel.topology == "S1" && kernel.formulation == Formulation::Articulated.name()
    });
    stock.map(move |&kernel| {
        let mut named = kernel;
        named.formulation = formulation.name();
        named
    })
}

#[test]
fn a_routine_is_of_the_formulation_that_is_asked_for() {
    use Formulation::{Articulated, Momentum, Report};
    let scene = skew().ending_at(0.4).expect("the boom alone");
    let chosen = |path, formulation: Option<Formulation>, kernels| {
        let options = asking(path, formulation.map(Form::Closed), kernels);
        let (_, result) = try_run(&scene, &options);
        let mut selections = result.map_err(|failure| failure.error)?.selections;
        Ok::<Selection, SimError>(selections.pop().expect("one mode"))
    };
    let report: &'static [Kernel] = named(Report).collect::<Vec<_>>().leak();
    let of_articulated = named(Articulated).filter(|kernel| kernel.assumptions.is_empty());
    let both: &'static [Kernel] =
        named(Report).chain(of_articulated).chain(named(Report)).collect::<Vec<_>>().leak();
    for (path, asked, kernels, path_used, formulation) in [
        (Path::Generated, None, report, "generated", Report),
        (Path::Generated, None, both, "generated", Articulated),
        (Path::Generated, Some(Report), both, "generated", Report),
        (Path::Auto, None, both, "generated", Articulated),
        (Path::Auto, Some(Report), both, "generated", Report),
        (Path::Auto, Some(Momentum), both, "generic", Momentum),
        (Path::Generic, Some(Report), both, "generic", Report),
    ] {
        let found = chosen(path, asked, kernels).expect("it can be had");
        assert_eq!((found.path, found.formulation), (path_used, formulation.name()), "{asked:?}");
    }
    let Err(SimError::NoRoutine { source, .. }) = chosen(Path::Generated, Some(Momentum), both)
    else {
        panic!("no routine is momentum's")
    };
    assert_eq!(source.to_string(), "no momentum routine for topology S1");
}

/// Springs that push do not take a satellite along principal axes to right sides that assume nothing.
#[test]
fn right_sides_along_principal_axes_take_springs_that_push() {
    let deck = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/n-boom-1970.nml");
    let scene = nboom::io::read_scene(&deck).expect("the sample deck").scene;
    let is_kept = |kernel: &&Kernel| {
        kernel.result != "right_side" || assumptions_in_a_word(kernel) != "general"
    };
    let kernels: &'static [Kernel] =
        nboom_routines::for_runs().iter().filter(is_kept).copied().collect::<Vec<_>>().leak();
    let (_, summary) = run(&scene, &asking(Path::Generated, None, kernels));
    // With a hinge held at an angle axes are no principal ones: S1, 2xS1, S1_P.
    for topology in ["S2_S1", "S2_P"] {
        let routine = format!("routine for {topology}, ");
        let of_topology = |of: &&Selection| of.reason.starts_with(&routine);
        let selection = summary.selections.iter().find(of_topology).expect("a mode of it");
        assert!(selection.reason.contains("; whole right side"), "{selection:?}");
    }
}

#[test]
fn the_recursion_has_no_routine() {
    let kernels = nboom_routines::all();
    let with = |path| try_run(&skew(), &asking(path, Some(Form::Recursive), kernels)).1;
    let automatic = with(Path::Auto).expect("library code").selections;
    let [only] = &automatic[..] else { panic!("{automatic:?}") };
    assert_eq!(told(only), ("generic", "recursive", "as demanded"));
    let error = with(Path::Generated).expect_err("it is library code").error;
    assert!(matches!(error, SimError::NoRoutine { source: NoRoutine::Topology { .. }, .. }));
}
