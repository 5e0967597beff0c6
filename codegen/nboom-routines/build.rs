//! Generates the stock routines.

use std::path::PathBuf;

use nboom_codegen::{Level, Module, Request};
use nboom_formulation::{Formulation, Layout, RightSideLayout, Symmetry};
use nboom_model::{Shape, Topology};

/// Topologies that scenes often have, or come through while their hinges are released and lock.
#[rustfmt::skip]
const STOCK: [&str; 27] = [
    // A main body alone, booms and wings of panels.
    "M", "S1", "S2", "S3", "2xS1", "S2_S1", "2xS2", "2xS3", "2xS4", "2xS5", "4xS1", "4xS2", "4xS3", "4xS4",
    "4xS5", "6xS1", "6xS2", "6xS3", "6xS4", "20xS5", "S100",
    // Hinges canted to each other: a gimbal, a pair of booms, a gimbal on a boom.
    "Trr", "2xTrr", "Trrr",
    // Paddles, with the report's satellite last.
    "P", "S1_P", "S2_P",
];

fn stock() -> impl Iterator<Item = Topology> {
    STOCK.into_iter().map(topology)
}

fn topology(name: &str) -> Topology {
    name.parse().expect("it is the name of a topology")
}

/// Formulations that have a routine of S2_P besides that of `articulated`.
const OTHERS: [Formulation; 4] =
    [Formulation::Report, Formulation::Relative, Formulation::Symmetric, Formulation::Momentum];

fn main() {
    let directory = std::env::var_os("OUT_DIR").expect("cargo runs build scripts");
    let directory = PathBuf::from(directory);
    let files = [
        ("stock.rs", accelerations()),
        ("equations.rs", equations()),
        ("right_sides.rs", right_sides()),
        ("exact.rs", exact()),
        ("exact_right_sides.rs", exact_right_sides()),
    ];
    for (file, requests) in files {
        let code = Module::from(requests).text().expect("stock topologies can be generated");
        std::fs::write(directory.join(file), code).expect("the output directory can be written");
    }
    println!("cargo::rerun-if-changed=build.rs");
}

/// What routines of a topology assume. Of chains there is one more kind: with some links held at any angle to the
/// next, a boom along principal axes is mirrored still.
fn symmetries(topology: &Topology) -> impl Iterator<Item = Symmetry> {
    let has_chains = topology.hinges() > 0
        && topology.shapes().iter().all(|shape| matches!(shape, Shape::Chain(_)));
    Symmetry::ALL.into_iter().filter(move |kind| *kind != Symmetry::Mirrored || has_chains)
}

/// Routines for each topology of the stock, then S2_P by the other formulations.
fn accelerations() -> Vec<Request> {
    let mut requests = Vec::new();
    for topology in stock() {
        for symmetry in symmetries(&topology) {
            let name = name(&topology, symmetry);
            let request = Request::new(&name, topology.clone(), Level::Fast);
            requests.push(request.with_external_wrench().with_symmetry(symmetry));
        }
    }
    requests.extend(OTHERS.map(|formulation| s2_p("", Level::Fast, formulation)));
    requests
}

/// Matrix and right side of S2_P by each formulation that has them.
fn equations() -> Vec<Request> {
    with_equations(|formulation| s2_p("Equations", Level::Fast, formulation).for_equations())
}

/// The most hinges of a topology that has right sides with lines.
const FEW_HINGES: usize = 4;

/// The most equal chains of a topology that has right sides with couplings: wings that cables keep in step.
const MOST_COUPLED: usize = 2;

/// The most links of such a chain.
const LONGEST_COUPLED: usize = 5;

/// The most equal appendages of a topology that has right sides: with more, registers are full already.
const MOST_EQUAL: usize = 4;

/// Right sides for topologies of the stock, without external wrench. Of few hinges there is one more that assumes
/// nothing and takes an external wrench, which a thrust is, and others, along principal axes and along any, that take
/// a line that pushes each link, and of fewer hinges two of them and the wrench. Where lines push limbs, accelerations
/// have to do.
///
/// Wings of panels that follow each other, one or two, have one along principal axes and one along any whose hinges
/// are coupled.
///
/// Those that have few hinges, couplings, or a chain whose links can only be taken one after the other, are for
/// eight states at once, too.
fn right_sides() -> Vec<Request> {
    let mut requests = Vec::new();
    let is_wanted = |topology: &Topology| topology.groups().all(|(_, n)| n <= MOST_EQUAL);
    for topology in stock().filter(is_wanted) {
        let has_few = topology.hinges() <= FEW_HINGES;
        for symmetry in symmetries(&topology) {
            let name = name(&topology, symmetry);
            let request = Request::new(&name, topology.clone(), Level::Fast).for_right_side();
            let request = request.with_symmetry(symmetry);
            let general = || request.clone();
            let named = |kind: &str| Request { name: format!("{kind}{name}"), ..general() };
            let is_planar = topology.hinges() > 0 && !topology.has_limbs();
            let is_general = symmetry == Symmetry::General;
            let is_pushed = has_few && symmetry != Symmetry::Mirrored && is_planar;
            // With more hinges, more lines or a wrench beside them take too much straight code.
            let takes_both = topology.hinges() < FEW_HINGES;
            let pushed = is_pushed.then(|| {
                let pushed = named("Pushed");
                if takes_both {
                    pushed.with_lines(RightSideLayout::LINES_OF_LINK).with_external_wrench()
                } else {
                    pushed.with_lines(1)
                }
            });
            let thrust = (has_few && is_general).then(|| named("Thrust").with_external_wrench());
            let is_coupled = symmetry != Symmetry::Mirrored && is_wing(&topology);
            let coupled = is_coupled.then(|| named("Coupled").with_couplings().on_eight_states());
            let on_eight = has_few || topology.shapes().len() == 1;
            requests.push(if on_eight { request.on_eight_states() } else { request });
            requests.extend(pushed.map(Request::on_eight_states).into_iter().chain(thrust));
            requests.extend(coupled);
        }
    }
    requests
}

/// Whether all of it is equal chains that may be coupled.
fn is_wing(topology: &Topology) -> bool {
    let mut groups = topology.groups();
    let is_coupled = |(shape, count): (Shape, usize)| {
        let links = 2..=LONGEST_COUPLED;
        matches!(shape, Shape::Chain(_)) && links.contains(&shape.hinges()) && count <= MOST_COUPLED
    };
    groups.next().is_some_and(is_coupled) && groups.next().is_none()
}

/// Routines that keep the closed form's every rounding on `f64`, for the tests.
fn exact() -> Vec<Request> {
    let satellite = |name: &str, of: &str| Request::new(name, topology(of), Level::Exact);
    let rolled = [
        satellite("RolledS3", "4xS3").with_external_wrench(),
        satellite("RolledP", "3xP").with_external_wrench(),
        satellite("RolledS30", "S30"),
        satellite("RolledMixed", "2xS4_S2_2xP"),
        satellite("StraightLimb", "Tr(rp)(s)_S1").with_external_wrench(),
        satellite("PackedLimbs", "3xTr(rpr)(s)_2xTs(r)(rp)_S2").with_external_wrench(),
    ];
    let general = Formulation::ALL.map(|formulation| s2_p("", Level::Exact, formulation));
    let principal = Formulation::ALL.map(|formulation| {
        let name = camel_case(formulation) + "S1P";
        satellite(&name, "S1_P").with_symmetry(Symmetry::Principal).by(formulation)
    });
    let equations =
        with_equations(|formulation| s2_p("Equations", Level::Exact, formulation).for_equations());
    let unequal = unequal(satellite("RolledUnequal", "4xS2"));
    rolled.into_iter().chain([unequal]).chain(general).chain(principal).chain(equations).collect()
}

/// Right sides that keep every rounding.
fn exact_right_sides() -> Vec<Request> {
    let satellite =
        |name: &str, of: &str| Request::new(name, topology(of), Level::Exact).for_right_side();
    vec![
        satellite("RolledS3", "4xS3").with_external_wrench().with_rotors(),
        satellite("RolledP", "5xP").with_external_wrench(),
        satellite("RolledS30", "S30"),
        satellite("RolledMixed", "2xS4_S2_S1_2xP"),
        unequal_laws(unequal(satellite("RolledUnequal", "4xS2"))),
        satellite("StraightM", "M"),
        satellite("StraightS1P", "S1_P").with_symmetry(Symmetry::Principal),
        satellite("PushedStraightS1P", "S1_P").with_lines(1).with_symmetry(Symmetry::Principal),
        satellite("PushedS2P", "S2_P").with_external_wrench().with_lines(2).with_couplings(),
        satellite("PackedLimbs", "5xTr(rp)(s)_S2").with_external_wrench(),
        satellite("PushedLimb", "Trs").with_lines(1).with_couplings(),
        satellite("PushedS3", "S3").with_lines(1).by(Formulation::Relative),
        satellite("CoupledS3", "S3").with_couplings().with_rotors(),
        satellite("CoupledRolled", "4xS3_2xS2_S1").with_couplings(),
        unequal_couplings(satellite("CoupledUnequal", "4xS2").with_couplings()),
    ]
}

/// Assumes numbers of laws: one of all hinges, others of some.
fn unequal_laws(mut request: Request) -> Request {
    for hinge in 0..request.topology.hinges() {
        let law = RightSideLayout::law(&request.topology, hinge);
        request.assumptions[law.start] = Some(0.0);
        request.assumptions[law.start + 1] = (hinge > 2).then_some(-0.5);
    }
    request
}

/// Assumes numbers of couplings: one of all hinges, others of some.
fn unequal_couplings(mut request: Request) -> Request {
    for hinge in 0..request.topology.hinges() {
        let coupling = RightSideLayout::coupling(&request.topology, hinge);
        request.assumptions[coupling.start] = Some(1.0);
        request.assumptions[coupling.start + 1] = (hinge > 2).then_some(-0.5);
    }
    request
}

/// Assumes of some appendages and links what it does not of others, or other numbers.
fn unequal(mut request: Request) -> Request {
    let link = |appendage: usize, link: usize| {
        let branch = Layout::MAIN + appendage * (Layout::BRANCH + 2 * Layout::LINK);
        branch + Layout::BRANCH + link * Layout::LINK
    };
    let mut assume = |at: usize, value: f64| request.assumptions[at] = Some(value);
    // The first appendage's masses; the last one's hinge point, in front of its links.
    assume(link(0, 0), 1.25);
    assume(link(0, 1), 1.5);
    assume(link(3, 0) - 1, 0.0);
    for appendage in 0..4 {
        // First moments: of the first link alone, of all links.
        assume(link(appendage, 0) + 1, 0.0);
        (0..2).for_each(|i| assume(link(appendage, i) + 3, 0.0));
        // A moment of inertia that is another one in each appendage.
        (0..2).for_each(|i| assume(link(appendage, i) + 5, 1.5 + 0.25 * appendage as f64));
    }
    request
}

fn with_equations(request: impl Fn(Formulation) -> Request) -> Vec<Request> {
    let all = Formulation::ALL.into_iter();
    all.filter(|formulation| formulation.has_equations()).map(request).collect()
}

/// S2_P with external wrench, nothing assumed: for example `ReportEquationsS2P`.
fn s2_p(word: &str, level: Level, formulation: Formulation) -> Request {
    let name = camel_case(formulation) + word + "S2P";
    Request::new(&name, topology("S2_P"), level).with_external_wrench().by(formulation)
}

fn camel_case(formulation: Formulation) -> String {
    let (first, rest) = formulation.name().split_at(1);
    first.to_uppercase() + rest
}

/// For example `PrincipalS2P`, `Mirrored2S2` or `General4S3`.
fn name(topology: &Topology, symmetry: Symmetry) -> String {
    let kind = match symmetry {
        Symmetry::Principal => "Principal",
        Symmetry::Mirrored => "Mirrored",
        Symmetry::General => "General",
    };
    format!("{kind}{}", topology.to_string().replace(['_', 'x'], ""))
}
