//! How long generated text may become, and requests that are refused because they describe no routine.

use nboom_codegen::{CodegenError, HINGE_LIMIT, Level, Module, Request, STRAIGHT_LIMIT, source};
use nboom_formulation::Formulation;
use nboom_model::{
    Body, Hinge, Joint, MassProperties, Mount, Scene, SceneDescription, Shape, Topology,
};
use nboom_scalar::{Sym3, Vec3};

fn s1() -> Request {
    Request::new("S1", Topology::new([Shape::Chain(1)]), Level::Exact)
}

fn text_of(request: &Request) -> String {
    source(request).expect("the request describes a routine")
}

fn refusal(request: &Request) -> CodegenError {
    source(request).expect_err("the request describes no routine")
}

#[test]
fn names_and_paths_that_are_none_are_refused() {
    for name in ["", "S1 P", "4xS1", "fn", "r#fn", "S-1", "Real", "Pack", "k", "x", "kernels"] {
        let request = Request { name: name.to_owned(), ..s1() };
        assert_eq!(refusal(&request), CodegenError::Name(name.to_owned()));
    }
    for path in ["", "::", "not a path", "scalar::{Real}"] {
        let request = Request { scalar_path: path.to_owned(), ..s1() };
        let expected = CodegenError::Path { name: "S1".to_owned(), path: path.to_owned() };
        assert_eq!(refusal(&request), expected);
    }
    let elsewhere = Request { scalar_path: "::nboom::scalar".to_owned(), ..s1() };
    assert!(text_of(&elsewhere).contains("use ::nboom::scalar::{"));
}

/// Right sides are added to routines before these are checked.
#[test]
fn a_formulation_that_does_not_take_a_scene_is_refused_beside_right_sides_too() {
    let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("mast", body, 1.0);
    description.bodies.push(Body {
        inboard: None,
        mount: Mount::at(Vec3::unit_x()),
        joint: Joint::Prismatic,
        axis: Vec3::unit_x(),
        mass_properties: body,
        tip: Vec3::unit_x(),
        hinge: Hinge::free(),
    });
    let scene = Scene::new(description).expect("a slide");
    for formulation in [Formulation::Report, Formulation::Relative, Formulation::Momentum] {
        let module = Module::of_simulator(&scene, None, formulation, Level::Fast);
        let error = module.and_then(|module| module.text()).expect_err("slides are no chains");
        assert!(matches!(error, CodegenError::NoLimbs { .. }), "{error}");
    }
}

#[test]
fn parameters_that_do_not_fit_are_refused() {
    let (topology, expected) = (s1().topology.to_string(), s1().assumptions.len());
    for found in [0, expected - 1, expected + 1] {
        let request = Request { assumptions: vec![None; found], ..s1() };
        assert_eq!(
            refusal(&request),
            CodegenError::Parameters { topology: topology.clone(), found, expected }
        );
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut request = s1();
        request.assumptions[7] = Some(bad);
        let error = refusal(&request);
        let CodegenError::NotFinite { number, value, .. } = error else {
            panic!("{topology}: {error}");
        };
        assert_eq!((number, value.to_bits()), (7, bad.to_bits()));
    }
}

#[test]
fn more_hinges_than_the_limit_are_refused() {
    let links = HINGE_LIMIT + 1;
    let topology = Topology::new([Shape::Chain(links)]);
    let name = topology.to_string();
    let request = Request::new("Long", topology, Level::Fast);
    let formulation = Formulation::Articulated;
    let limit = HINGE_LIMIT;
    let expected = CodegenError::TooLarge { topology: name, formulation, links, limit };
    assert_eq!(refusal(&request), expected);
    let request = Request::new("Longest", Topology::new([Shape::Chain(HINGE_LIMIT)]), Level::Fast);
    assert!(source(&request).is_ok());
}

/// A limb of so many joints about axes that are canted anyhow.
fn canted(joints: usize) -> Request {
    let topology = format!("T{}", "r".repeat(joints)).parse().expect("a topology");
    Request::new("Canted", topology, Level::Fast)
}

#[test]
fn text_grows_by_tables_alone_with_the_joints_of_a_limb() {
    let lines = |joints| text_of(&canted(joints)).lines().count();
    let (short, long, longest) = (lines(100), lines(200), lines(HINGE_LIMIT));
    // A row in each of two tables.
    assert_eq!(long - short, 2 * 100);
    assert_eq!(longest - short, 2 * (HINGE_LIMIT - 100));
    let of_line = text_of(&canted(20));
    assert!(of_line.contains("fn t20_0_limb_in<"), "20 joints are one line");
}

#[test]
fn limbs_are_taken_joint_by_joint_where_lines_are_too_long_together() {
    let two = format!("T{}_T{}", "r".repeat(25), "r".repeat(24)).parse().expect("a topology");
    let text = text_of(&Request::new("Two", two, Level::Fast));
    // Limbs with long names are called by their joints and those before.
    let of = |joints: usize, step: &str| format!("fn t{joints}_{}_{step}<", (25 - joints) * 25);
    assert!(text.contains(&of(25, "limb_in")) && text.contains(&of(24, "joint1_inward")));
    assert!(!text.contains(&of(24, "limb_in")) && !text.contains(&of(25, "joint1_inward")));
}

#[test]
fn limbs_that_share_too_few_steps_are_refused() {
    let limbs: Vec<String> = (13..21).map(|n| format!("T{}", "rpsrr".repeat(n))).collect();
    let topology: Topology = limbs.join("_").parse().expect("a topology");
    let long = refusal(&Request::new("Refused", topology.clone(), Level::Fast));
    assert!(
        matches!(&long, CodegenError::Budget { topology: of, operations, limit, .. }
            if *of == topology.to_string() && operations > limit),
        "{long}"
    );
}

#[test]
fn what_a_formulation_cannot_give_is_refused() {
    let of = |name: &str, formulation| {
        let topology: Topology = name.parse().expect("a topology");
        Request::new("Refused", topology, Level::Fast).by(formulation)
    };
    for formulation in [Formulation::Articulated, Formulation::Momentum] {
        let expected = CodegenError::NoEquations { topology: "S2".to_owned(), formulation };
        assert_eq!(refusal(&of("S2", formulation).for_equations()), expected);
    }
    let dense = refusal(&of("S60", Formulation::Report));
    assert!(
        matches!(&dense, CodegenError::Budget { topology, formulation: Formulation::Report, operations, limit }
            if topology == "S60" && operations > limit),
        "{dense}"
    );
    let long = refusal(&canted(64).for_inverse_dynamics());
    assert!(
        matches!(&long, CodegenError::Budget { topology, operations, limit, .. }
            if *topology == canted(64).topology.to_string() && operations > limit),
        "{long}"
    );
    let inverse = of("S2", Formulation::Report).for_inverse_dynamics();
    let (topology, formulation) = ("S2".to_owned(), Formulation::Report);
    assert_eq!(refusal(&inverse), CodegenError::NoInverse { topology, formulation });
    let held = || of("S2", Formulation::Symmetric).with_held_main_body();
    for request in
        [held().for_equations(), held().by(Formulation::Articulated).for_inverse_dynamics()]
    {
        let (topology, output) = ("S2".to_owned(), request.output);
        assert_eq!(refusal(&request), CodegenError::HeldMainBody { topology, output });
    }
    for name in ["S10", "4xS5"] {
        let expected =
            CodegenError::StraightAlone { topology: name.to_owned(), limit: STRAIGHT_LIMIT };
        let right_side = of(name, Formulation::Articulated).for_right_side();
        assert!(source(&right_side.clone().with_couplings()).is_ok());
        assert_eq!(refusal(&right_side.with_lines(2)), expected);
    }
    let limb = of(&format!("T{}", "r".repeat(17)), Formulation::Articulated).for_right_side();
    assert!(source(&limb).is_ok());
    let refused = refusal(&limb.with_couplings());
    assert!(matches!(refused, CodegenError::StraightAlone { .. }), "{refused}");
    let long = refusal(&of("S101", Formulation::Symmetric));
    assert!(matches!(long, CodegenError::TooLarge { links: 101, .. }), "{long}");
}
