//! Generated text does not change unnoticed, and what is checked in is compiled and gives the
//! closed form's numbers.

use std::path::{Path, PathBuf};

use nboom_codegen::{Level, Request, STRAIGHT_LIMIT, StressRequest, generate, source};
use nboom_formulation::{
    Coordinates, Forces, Formulation, Layout, Parameters, RightSideLayout, Symmetry,
};
use nboom_loads::{Loads, SceneMotion};
use nboom_model::{
    Appendage, Hinge, HingeState, KickOffSpring, MassProperties, Material, Mount, Scene,
    SceneDescription, SectionShape, Segment, SegmentStructure, Shape, Station, Structure, Topology,
    Vertex,
};
use nboom_scalar::{Kernel, Mat3, Routine, Sym3, Vec3};

/// Lints that a program may turn on say nothing of generated code.
#[warn(
    elided_lifetimes_in_paths,
    explicit_outlives_requirements,
    missing_copy_implementations,
    missing_debug_implementations,
    missing_docs,
    single_use_lifetimes,
    trivial_casts,
    trivial_numeric_casts,
    unreachable_pub,
    unused,
    unused_lifetimes,
    unused_qualifications,
    unused_results,
    clippy::all,
    clippy::pedantic,
    clippy::nursery,
    clippy::expect_used,
    clippy::indexing_slicing
)]
mod golden {
    include!("golden/s1.rs");
    include!("golden/four_s3.rs");
    include!("golden/snake.rs");
    include!("golden/right_side.rs");
    include!("golden/stresses.rs");
}

/// One boom, as straight-line code.
fn s1() -> Request {
    Request::new("S1", Topology::new([Shape::Chain(1)]), Level::Exact)
}

/// Four equal booms along principal axes: loops over links, and all four side by side.
fn four_s3() -> Request {
    Request::new("FourS3", Topology::new(vec![Shape::Chain(3); 4]), Level::Fast)
        .with_external_wrench()
        .with_symmetry(Symmetry::Principal)
}

/// A limb too long for a straight line: links along their principal axes, each turned by a quarter from the one
/// before.
fn snake() -> Request {
    let limb = format!("T{}", "r".repeat(66)).parse().expect("a topology");
    let mut request = Request::new("Snake", limb, Level::Fast).with_external_wrench();
    let quarter = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(Some);
    let zero = Some(0.0);
    let body = [None, zero, None, zero, None, None, None, zero, zero, zero];
    let link = [&quarter[..], &[zero, None, zero], &body].concat();
    let first = Layout::MAIN + Layout::BRANCH + Layout::BODY;
    let links = request.assumptions[first..].chunks_exact_mut(link.len());
    links.for_each(|of_link| of_link.copy_from_slice(&link));
    request.assumptions[first - Layout::BODY..first].copy_from_slice(&body);
    request
}

/// One boom that a line pushes, with its hinge law and its attitude.
fn right_side() -> Request {
    Request::new("RightSideS1", Topology::new([Shape::Chain(1)]), Level::Exact)
        .with_external_wrench()
        .for_right_side()
        .with_lines(2)
        .with_couplings()
        .with_rotors()
}

/// A boom of a tube and a triangle on a hub, with a kick-off spring.
fn stresses() -> StressRequest {
    let body = |mass: f64| MassProperties::new(mass, Vec3::unit_y(), Sym3::diagonal(2.0, 0.5, 2.0));
    let kick_off = KickOffSpring {
        main_body_point: Vec3::new(0.0, 0.5, -1.0),
        body_point: Vec3::unit_y() * 0.5,
        coefficients: [1.0, 0.0, 0.0, 0.0],
        limit_length: 5.0,
    };
    let slice =
        |at: f64| MassProperties::new(1.0, Vec3::unit_y() * at, Sym3::diagonal(0.3, 0.1, 0.3));
    let vertex = |xi, zeta| Vertex { xi, zeta, thickness: 0.01 };
    let triangle = vec![vertex(0.4, -0.2), vertex(0.0, 0.5), vertex(-0.3, -0.3)];
    let tube = SectionShape::Tube { radius: 0.2, thickness: 0.01 };
    let station = |distance_from_hinge, section| Station {
        distance_from_hinge,
        slice: slice(distance_from_hinge + 0.5),
        section,
    };
    let segment = SegmentStructure {
        pulse_constant: 0.1,
        material: Material::elastic(7e10, 0.3),
        stations: vec![station(1.0, tube), station(0.0, SectionShape::Polygon(triangle))],
    };
    let mut description = SceneDescription::at_rest("golden", body(10.0), 1.0);
    let hinge = Hinge { kick_off: Some(kick_off), ..Hinge::free() };
    let mass_properties = segment.mass_properties().expect("there are slices");
    let segments = vec![Segment { length: 2.0, mass_properties, hinge }];
    let mount = Mount::at(Vec3::new(0.1, 1.0, -0.2));
    description.attach(&Appendage::Regular { mount, segments });
    let scene = Scene::new(description).expect("the bodies are physical");
    let structure = Structure::new(&scene, vec![segment]).expect("slices make the boom");
    StressRequest::of_scene(&scene, &structure, Level::Exact).expect("sections are right")
}

fn text_of(request: &Request) -> String {
    source(request).expect("the request describes a routine")
}

/// Compares with the file of that name, or writes it when `NBOOM_BLESS` is 1.
fn is_checked_in(name: &str, found: &str) {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    if std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1") {
        std::fs::write(&path, found).expect("the golden file can be written");
        return;
    }
    let expected = std::fs::read_to_string(&path).expect("the golden file can be read");
    let differs = expected.lines().zip(found.lines()).position(|(a, b)| a != b);
    assert!(
        expected == found,
        "{name}: first difference after line {}; NBOOM_BLESS=1 cargo test -p nboom-codegen \
         --test golden rewrites it",
        differs.unwrap_or_else(|| expected.lines().count().min(found.lines().count()))
    );
}

#[test]
fn generated_text_is_what_is_checked_in() {
    is_checked_in("s1.rs", &text_of(&s1()));
    is_checked_in("four_s3.rs", &text_of(&four_s3()));
    is_checked_in("snake.rs", &text_of(&snake()));
    is_checked_in("right_side.rs", &text_of(&right_side()));
    is_checked_in("stresses.rs", &stresses().source().expect("sections are right"));
}

#[test]
fn the_same_request_gives_the_same_bytes() {
    for request in [s1(), four_s3(), snake()] {
        assert_eq!(text_of(&request), text_of(&request.clone()));
    }
}

#[test]
fn small_satellites_are_straight_lines_and_large_ones_loops() {
    assert!(!text_of(&s1()).contains(" in 0.."));
    assert!(text_of(&four_s3()).contains("for i in (0..3).rev()"));
    let evaluation = generate(&s1()).expect("S1 can be generated").evaluation;
    assert_eq!(evaluation.angles, 1);
    assert!(evaluation.flops() <= STRAIGHT_LIMIT);
}

#[test]
fn loops_over_equal_appendages_say_that_one_state_fills_registers() {
    assert!(text_of(&four_s3()).contains("const IN_PACKS: bool = true;"));
    for without in [s1(), snake(), right_side()] {
        assert!(!text_of(&without).contains("IN_PACKS"));
    }
    let part = "Trr(rr)(rr)(s)".parse().expect("a topology");
    assert!(text_of(&Request::new("Limb", part, Level::Fast)).contains("IN_PACKS"));
}

#[test]
fn equal_parts_of_a_limb_go_side_by_side_unless_the_limb_has_equals() {
    let of = |name: &str| {
        let topology = name.parse().expect("a topology");
        text_of(&Request::new("Limb", topology, Level::Fast)).replace(char::is_whitespace, "")
    };
    let (one, two) = (of("Trr(rr)(rr)(s)"), of("2xTrr(rr)(rr)(s)"));
    assert!(one.contains("t7_0_part1_in::<f64,I::Two") && !one.contains("t7_0_limb_in"));
    assert!(!two.contains("_part1") && two.contains("t7_0_limb_in"));
    let several = of("Tr(r(rr)(rr)(rr))(sr(rs)(rs))");
    assert!(several.contains("_part2_in") && !several.contains("_part3"));
}

#[test]
fn what_is_checked_in_is_formatted_as_rustfmt_does() {
    let crate_root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = ["s1.rs", "four_s3.rs", "snake.rs", "right_side.rs", "stresses.rs"]
        .map(|name| crate_root.join("tests/golden").join(name));
    let rustfmt = std::process::Command::new("rustfmt")
        .args(["--check", "--edition", "2024", "--config-path"])
        .arg(crate_root.join("../.."))
        .args(files)
        .output();
    let said = rustfmt.expect("the toolchain has rustfmt");
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stdout));
}

/// A satellite with a positive mass matrix, other numbers for each `case`.
fn parameters<T: Routine>(topology: &Topology, case: usize) -> Vec<f64> {
    let mut count = 0;
    let mut wave = || {
        count += 1;
        (1.3 * f64::from(count) + 0.7 * case as f64).sin()
    };
    let body = |mass: f64, wave: &mut dyn FnMut() -> f64| {
        let mut body = vec![mass * (1.5 + 0.5 * wave())];
        body.extend((0..3).map(|_| 0.3 * mass * wave()));
        body.extend((0..3).map(|_| mass * (1.75 + 0.25 * wave())));
        body.extend((0..3).map(|_| 0.1 * mass * wave()));
        body
    };
    let mut all = body(100.0, &mut wave);
    let place = |wave: &mut dyn FnMut() -> f64| {
        let rot = Mat3::from_euler_121(3.0 * wave(), 3.0 * wave(), 3.0 * wave());
        let mut place: Vec<f64> = rot.rows.into_iter().flat_map(Vec3::to_array).collect();
        place.extend((0..3).map(|_| wave()));
        place
    };
    for shape in topology.shapes() {
        all.extend(place(&mut wave));
        for link in 0..shape.hinges() {
            let is_limb = matches!(shape, Shape::Limb(_));
            if is_limb && link > 0 {
                all.extend(place(&mut wave));
            }
            all.extend(body(1.0, &mut wave));
            if !is_limb {
                all.extend((0..2).map(|_| 0.6 + 0.4 * wave()));
            }
        }
    }
    T::ASSUMPTIONS.iter().for_each(|&(i, value)| all[i] = value);
    all
}

fn state<T: Routine>(case: usize) -> Vec<f64> {
    let number = |i: usize| 2.0 * (1.7 * i as f64 + 0.9 * case as f64 + 0.3).sin();
    let mut state: Vec<f64> = (0..T::COORDINATES).map(number).collect();
    if !T::EXTERNAL {
        state[3..9].fill(0.0);
    }
    state
}

fn is_the_closed_form<T: Routine>(request: &Request) {
    let topology = &request.topology;
    assert_eq!(T::TOPOLOGY, topology.to_string());
    assert_eq!(T::PARAMETERS, Layout::parameters(topology));
    let kernel = Kernel::of::<T>();
    for case in 0..50 {
        let (parameters, state) = (parameters::<T>(topology, case), state::<T>(case));
        let satellite = Parameters::read(topology, parameters.iter().copied());
        let coordinates = Coordinates::read(topology, &state);
        let expected =
            Formulation::Articulated.solve(topology, &satellite, &coordinates).write(topology);

        let (mut constants, mut found) = (vec![0.0; T::CONSTANTS], vec![0.0; T::OUTPUTS]);
        T::prepare(&parameters, &mut constants);
        T::evaluate(&constants, &state, &mut found);
        if request.level == Level::Exact {
            assert_eq!(found, expected, "{} case {case}", T::TOPOLOGY);
        }
        near(&found, &expected, case);

        kernel.evaluate(&constants, &state, &mut found);
        near(&found, &expected, case);
    }
}

fn near(found: &[f64], expected: &[f64], case: usize) {
    let scale = expected.iter().fold(1.0_f64, |largest, e| largest.max(e.abs()));
    for (found, expected) in found.iter().zip(expected) {
        // Fused and regrouped rounding, on mass matrices of condition up to 1e3.
        assert!((found - expected).abs() < 1e-12 * scale, "case {case}: {found} {expected}");
    }
}

#[test]
fn what_is_checked_in_computes_the_closed_form() {
    is_the_closed_form::<golden::S1>(&s1());
    is_the_closed_form::<golden::FourS3>(&four_s3());
    is_the_closed_form::<golden::Snake>(&snake());
}

#[test]
fn a_checked_in_right_side_is_that_of_the_equations() {
    type T = golden::RightSideS1;
    let topology = right_side().topology;
    let kernel = Kernel::of::<T>();
    for case in 0..50 {
        let satellite = parameters::<T>(&topology, case);
        let of_forces = RightSideLayout::parameters(&topology) - satellite.len();
        let forces: Vec<f64> = (0..of_forces).map(|i| 0.3 + 0.1 * i as f64).collect();
        let (all, y) = ([&satellite[..], &forces].concat(), state::<T>(case));
        let satellite = Parameters::read(&topology, satellite);
        let forces = Forces::read(topology.hinges(), forces);
        let form = Formulation::Articulated;
        let expected = nboom_formulation::right_side(form, &topology, &satellite, &forces, &y);
        let (mut constants, mut found) = (vec![0.0; T::CONSTANTS], vec![0.0; T::OUTPUTS]);
        assert!(kernel.accepts(&all));
        T::prepare(&all, &mut constants);
        T::evaluate(&constants, &y, &mut found);
        assert_eq!(found, expected, "case {case}");
        kernel.evaluate(&constants, &y, &mut found);
        near(&found, &expected, case);
    }
}

#[test]
fn checked_in_stresses_are_those_of_the_equations() {
    let mut equations = stresses().equations;
    let numbers = equations.numbers();
    let kernel = Kernel::of::<golden::StressesS1>();
    assert!(kernel.accepts(&numbers));
    let (mut expected, mut constants) = (equations.load_set(), vec![0.0; kernel.constants]);
    kernel.prepare(&numbers, &mut constants);
    let mut found = vec![0.0; kernel.outputs];
    for case in 0..50 {
        let state = state::<golden::StressesS1>(case);
        let motion = SceneMotion::of_numbers(&state, equations.motion_size());
        equations.evaluate(&motion, &mut expected);
        let expected = expected.numbers();
        golden::StressesS1::evaluate(&constants, &state, &mut found);
        assert_eq!(found, expected, "case {case}");
        kernel.evaluate(&constants, &state, &mut found);
        near(&found, &expected, case);
    }
}

#[test]
fn checked_in_stresses_judge_a_contradiction_as_the_equations_do() {
    let equations = stresses().equations;
    let size = equations.motion_size();
    let kernels = [Kernel::of::<golden::StressesS1>()];
    let mut by_equations = Loads::by(equations.clone());
    let mut by_code = Loads::by(equations).with_kernels(&kernels);
    assert!(by_code.generated_for().is_some() && by_equations.generated_for().is_none());
    for case in 0..50 {
        let state = state::<golden::StressesS1>(case);
        let motion = SceneMotion::of_numbers(&state, size);
        let mut residual = |loads: &mut Loads| {
            let mut found = loads.load_set();
            loads.continuous(&motion, &mut found);
            let residual = loads.largest_torque_residual(&found, &[HingeState::Free], &[0.3]);
            residual.expect("it is free").1
        };
        let [expected, found] = [&mut by_equations, &mut by_code].map(&mut residual);
        assert!(expected > 1e-3, "case {case}: {expected} is no contradiction");
        // Fused and regrouped rounding.
        assert!((found - expected).abs() < 1e-12, "case {case}: {found} {expected}");
    }
}
