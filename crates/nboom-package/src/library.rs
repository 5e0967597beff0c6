//! `README.md` and `src/lib.rs` of a crate of routines.

use std::fmt::Write;

use nboom_codegen::{CodegenError, Request, links};
use nboom_formulation::{Formulation, Layout, Recognised};
use nboom_model::{Joint, Mode, Scene, WeldedTree, steers};
use nboom_scalar::{TreeLink, Twist};

use crate::choices::Requests;
use crate::manifest::rust_name;
use crate::{PackageError, right_side, stresses};

/// What the crate is, which is its documentation too.
const README: &str = include_str!("../templates/README.md");

const CODE: &str = include_str!("../templates/lib.rs");

/// What only a crate with equations has.
const EQUATIONS: &str = include_str!("../templates/equations.rs");

/// What a hinge has besides in it.
const EQUATION_FIELD: &str = "    /// Row and column of its unknown in the matrix of [`equations`], and its place in the right side.\n    \
     pub equation: usize,\n";

/// What only a crate with inverse dynamics has.
const INVERSE: &str = include_str!("../templates/inverse_dynamics.rs");

/// What only a crate has whose main body is held: in the documentation and in the code.
const HELD: [&str; 2] =
    [include_str!("../templates/held.md"), include_str!("../templates/held.rs")];

/// What such a crate has besides with equations or inverse dynamics.
const LET_GO: [&str; 2] =
    [include_str!("../templates/let_go.md"), include_str!("../templates/let_go.rs")];

/// Paths and texts for a scene; `name` is the crate's. `recognised` are its appendages, and those of the
/// scene with its main body free.
pub(crate) fn files(
    scene: &Scene,
    name: &str,
    requests: &Requests,
    [recognised, free]: [&Recognised; 2],
) -> Result<[(String, String); 2], PackageError> {
    let of_routines = requests.all().into_iter().map(|request| request.name);
    let of_stresses = requests.stresses.iter().map(|request| request.name.clone());
    let names: Vec<String> = of_routines.chain(of_stresses).collect();
    let row_of_stresses = requests.stresses.as_ref().map(stresses::row);
    let parameters = recognised.parameters.write();
    let equations = requests.equations.as_ref().map(|request| {
        EQUATIONS
            .replace("UNKNOWNS", unknowns(request.formulation))
            .replace("EQUATIONS", &request.name)
    });
    let inverse = requests.inverse_dynamics.as_ref();
    let inverse = inverse.map(|request| INVERSE.replace("INVERSE", &request.name));
    let right_side = requests.right_side.as_ref();
    let right_side = right_side.map(|request| right_side::texts(scene, recognised, request));
    let [side_in_words, side_in_code] = right_side.transpose()?.unwrap_or_default();
    let of_free = equations.is_some() || inverse.is_some();
    let rows = requests.equations.as_ref().map(|request| (request.formulation, free));
    let hinges = hinges(scene, recognised, rows.map(|(_, free)| free));
    let equations_in_words =
        rows.map_or(String::new(), |(formulation, free)| order(scene, formulation, free));
    let held = held_main(scene);
    let is_let_go = held.is_some() && of_free;
    let only_if = |is_so: bool, text: &str| if is_so { text } else { "" }.to_owned();
    let of_held = |i: usize| only_if(held.is_some(), HELD[i]) + &only_if(is_let_go, LET_GO[i]);
    let omega = scene.initial.omega_body.to_array();
    let omega = if held.is_some() { omega } else { [1.0, 0.1, 0.0] };
    let hold = "state[3..9].copy_from_slice(&holding_wrench(MAIN_BODY));\n";
    let uses_of_held = "MAIN_BODY, holding_wrench, ";
    let values = [
        ("RIGHT_SIDE_IN_WORDS", side_in_words),
        ("RIGHT_SIDE_IN_CODE", side_in_code),
        ("HELD_IN_WORDS", of_held(0)),
        ("HELD_IN_CODE", of_held(1)),
        ("USES_OF_HELD", only_if(held.is_some(), uses_of_held)),
        ("HOLD", only_if(held.is_some(), hold)),
        ("OMEGA", format!("{omega:?}")),
        ("MAIN_BODY", format!("{:?}", held.unwrap_or_default())),
        ("HEAVY", format!("{:?}", WeldedTree::<f64>::heavy_main().mass)),
        ("FREE_LIST", list(free)),
        ("SCENE", in_words(&scene.name)),
        ("VERSION", env!("CARGO_PKG_VERSION").to_owned()),
        ("TOPOLOGY", requests.whole.topology.to_string()),
        ("LINKS", in_words(&links_in_words(scene)?)),
        ("ROUTINE_TABLE", table(&requests.all()) + &row_of_stresses.clone().unwrap_or_default()),
        ("STRESSES", row_of_stresses.map_or(String::new(), |_| stresses::NUMBERS.to_owned())),
        ("PACKAGE", name.to_owned()),
        ("CRATE", rust_name(name)),
        ("FIRST", names[0].clone()),
        ("NAMES", names.join(", ")),
        ("PARAMETER_COUNT", parameters.len().to_string()),
        ("PARAMETER_LIST", list(recognised)),
        ("USES", only_if(of_free || requests.right_side.is_some(), "\nuse std::sync::OnceLock;\n")),
        ("HINGE_COUNT", recognised.links.len().to_string()),
        ("TREE_LIST", tree(recognised)),
        ("MORE_FUNCTIONS", equations.unwrap_or_default() + &inverse.unwrap_or_default()),
        ("EQUATION_FIELD", only_if(rows.is_some(), EQUATION_FIELD)),
        ("EQUATIONS_IN_WORDS", equations_in_words),
        // Names of bodies may look like such keys.
        ("HINGE_LIST", hinges),
    ];
    let filled = |template: &str| {
        let fill = |text: String, (key, value): &(&str, String)| {
            text.replace(&format!("/*{key}*/"), value)
        };
        values.iter().fold(template.to_owned(), fill)
    };
    Ok([("README.md".to_owned(), filled(README)), ("src/lib.rs".to_owned(), filled(CODE))])
}

/// ω̇ and a_O less gravity of a main body that is held, when the scene starts; main-body axes.
fn held_main(scene: &Scene) -> Option<[f64; 6]> {
    let beta = vec![0.0; scene.bodies.len()];
    let drive = scene.base.piece_at(scene.initial.time);
    let mode = Mode { drive, ..Mode::at_start(scene) };
    let Twist { angular, linear } = WeldedTree::new(scene, &mode, &beta).held?;
    let ([a, b, c], [d, e, f]) = (angular.to_array(), linear.to_array());
    Some([a, b, c, d, e, f])
}

/// A line for each parameter, with its name.
fn list(recognised: &Recognised) -> String {
    let line = |(i, parameter): (usize, f64)| {
        format!("    {parameter:?}, // {}\n", Layout::name(&recognised.topology, i))
    };
    recognised.parameters.write().into_iter().enumerate().map(line).collect()
}

/// Which hinge of the scene each link of the topology is.
fn links_in_words(scene: &Scene) -> Result<String, CodegenError> {
    let all = links(scene)?;
    let all = all.iter().map(|[link, hinge]| format!("{link} is hinge {hinge}"));
    let all = all.collect::<Vec<_>>().join("; ");
    Ok(if all.is_empty() { "none".to_owned() } else { all })
}

/// A scene's name as it can stand in a line of Markdown.
fn in_words(name: &str) -> String {
    name.chars()
        .filter(|c| !steers(*c))
        .map(|c| if "`[]<>*/".contains(c) { ' ' } else { c })
        .collect()
}

/// A row for each routine.
fn table(requests: &[Request]) -> String {
    let mut rows = String::new();
    for request in requests {
        let Request { name, topology, formulation, output, level, .. } = request;
        let assumptions = request.assumptions_in_words().join("; ");
        let assumptions = if assumptions.is_empty() { "nothing".to_owned() } else { assumptions };
        writeln!(
            rows,
            "| `{name}` | {topology} | {} | {formulation} | {} | {assumptions} |",
            output.name(),
            level.name()
        )
        .expect("a string takes any text");
    }
    rows
}

/// A line for each hinge in the order of the scene. `of_equations` are the appendages of equations, if there are any.
fn hinges(scene: &Scene, recognised: &Recognised, of_equations: Option<&Recognised>) -> String {
    let topology = &recognised.topology;
    let mut rows = vec![String::new(); recognised.links.len()];
    for (&link, place) in recognised.links.iter().zip(Layout::places(topology)) {
        let label = scene.label(link);
        let [angle, rate, torque] = Layout::hinge_in_state(topology, place);
        let row = |of: &Recognised| of.links.iter().position(|&other| other == link);
        let row = of_equations
            .and_then(row)
            .map_or(String::new(), |row| format!(", equation: {}", Layout::OUTPUT + row));
        let slides = label.joint == Joint::Prismatic;
        rows[link] = format!(
            "    Hinge {{ name: {:?}, appendage: {}, segment: {}, slides: {slides}, angle: {angle}, \
             rate: {rate}, torque: {torque}, acceleration: {}{row} }},\n",
            label.name.as_deref().unwrap_or_default(),
            label.appendage + 1,
            label.segment + 1,
            Layout::OUTPUT + place
        );
    }
    rows.concat()
}

/// In which order rows and columns of the matrix stand.
fn order(scene: &Scene, formulation: Formulation, recognised: &Recognised) -> String {
    let hinges = recognised.links.iter().map(|&link| scene.label(link).to_string());
    let hinges = in_words(&hinges.collect::<Vec<_>>().join("; "));
    let hinges = if hinges.is_empty() { "none".to_owned() } else { hinges };
    format!(
        "**Equations** are the matrix, row by row, and the right side. Rows and columns are those of {}, the first two \
         of 3 numbers each. Hinges come appendage by appendage, in the order of the topology, which may differ \
         from that of `HINGES` and of accelerations: {hinges}. `Hinge::equation` counts rows from 0.\n\n",
        unknowns(formulation)
    )
}

/// A line for each link of the tree that derivatives loop over.
fn tree(recognised: &Recognised) -> String {
    let line = |link: TreeLink| {
        let TreeLink { inboard, joint, mount, body, angle, rate, torque, acceleration } = link;
        format!(
            "    TreeLink {{ inboard: {inboard:?}, joint: nboom_scalar::TreeJoint::{joint:?}, mount: \
             nboom_scalar::TreeMount::{mount:?}, body: {body}, angle: {angle}, rate: {rate}, torque: \
             {torque}, acceleration: {acceleration} }},\n"
        )
    };
    Layout::tree(&recognised.topology).into_iter().map(line).collect()
}

/// What a formulation's equations are solved for.
fn unknowns(formulation: Formulation) -> &'static str {
    match formulation {
        Formulation::Report => "v̇, ω̇ and σ̇",
        Formulation::Relative => "v̇, ω̇ and τ̇",
        _ => "a_O, ω̇ and τ̇",
    }
}
