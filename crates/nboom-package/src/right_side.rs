//! The right side of a scene's differential equations in a crate of routines.

use nboom_codegen::Request;
use nboom_formulation::{Recognised, RightSideLayout};
use nboom_model::{Course, External, ExternalKind, Scene};
use nboom_scalar::Wrench;
use nboom_verify::TestCase;

use crate::PackageError;

/// What only such a crate has: in the documentation and in the code.
const TEXTS: [&str; 2] =
    [include_str!("../templates/right_side.md"), include_str!("../templates/right_side.rs")];

/// What the documentation and the code have of the `request` for the scene, whose appendages are `recognised`.
pub(crate) fn texts(
    scene: &Scene,
    recognised: &Recognised,
    request: &Request,
) -> Result<[String; 2], PackageError> {
    let topology = &recognised.topology;
    let parameters = parameters(scene, recognised)?;
    let names = (0..).map(|i| RightSideLayout::name(topology, i));
    let lines = parameters.iter().zip(names);
    let lines: String =
        lines.map(|(number, name)| format!("    {number:?}, // {name}\n")).collect();
    let start = start(scene, recognised);
    let thrusts: Vec<String> = thrusts(scene).map(thrust).collect();
    let values = [
        ("RIGHT_SIDE", request.name.clone()),
        ("START_COUNT", start.len().to_string()),
        ("START", format!("{start:?}")),
        ("VARIABLE_LIST", variables(recognised)),
        ("WRENCH", format!("{:?}", RightSideLayout::external(topology))),
        ("THRUST_COUNT", thrusts.len().to_string()),
        ("THRUST_LIST", thrusts.concat()),
        ("SIDE_PARAMETER_COUNT", parameters.len().to_string()),
        ("SIDE_PARAMETER_LIST", lines),
    ];
    let fill =
        |text: String, (key, value): &(&str, String)| text.replace(&format!("/*{key}*/"), value);
    Ok(TEXTS.map(|text| values.iter().fold(text.to_owned(), fill)))
}

/// The numbers of the scene at its start, all kick-off springs pushing.
fn parameters(scene: &Scene, recognised: &Recognised) -> Result<Vec<f64>, PackageError> {
    let test_case = TestCase::new(scene.clone(), 0, 0)?.with_lines_pushing();
    // Requests are refused before when something has no place.
    let mut forces = test_case.forces().and_then(Result::ok).expect("there is a request");
    if !scene.base.is_held() {
        forces.external = Wrench::zero();
        let now = scene.initial.time;
        let act = |external: &&External| external.course.acts(external.course.piece_at(now));
        thrusts(scene).filter(act).for_each(|external| forces.external.add(wrench(external)));
    }
    Ok([recognised.parameters.write(), forces.write()].concat())
}

/// What acts on a main body from outside that is not held.
fn thrusts(scene: &Scene) -> impl Iterator<Item = &External> {
    scene.externals.iter().filter(|_| !scene.base.is_held())
}

/// Moment and force about O, main-body axes.
fn wrench(External { kind, amount, point, .. }: &External) -> Wrench<f64> {
    match kind {
        ExternalKind::Force => Wrench::of_force(*point, *amount),
        ExternalKind::Torque => Wrench { moment: *amount, ..Wrench::zero() },
    }
}

fn thrust(external: &External) -> String {
    let Course::Pulse { on, off } = external.course else {
        unreachable!("a right side has no place for others");
    };
    let number = |time: f64| match time {
        f64::INFINITY => "f64::INFINITY".to_owned(),
        f64::NEG_INFINITY => "f64::NEG_INFINITY".to_owned(),
        _ => format!("{time:?}"),
    };
    let Wrench { moment, force } = wrench(external);
    let numbers = [moment.to_array(), force.to_array()].concat();
    format!("    Thrust {{ on: {}, off: {}, wrench: {numbers:?} }},\n", number(on), number(off))
}

/// Attitude, ω, angles and rates where the scene starts, hinges in the topology's order.
fn start(scene: &Scene, recognised: &Recognised) -> Vec<f64> {
    let attitude = scene.initial.attitude;
    let mut all = vec![attitude.scalar];
    all.extend(attitude.vector.to_array());
    all.extend(scene.initial.omega_body.to_array());
    let starts = || recognised.links.iter().map(|&link| scene.bodies[link].hinge.start);
    all.extend(starts().map(|start| start.angle));
    all.extend(starts().map(|start| start.rate));
    all
}

/// A line for each hinge in the order of the scene.
fn variables(recognised: &Recognised) -> String {
    let topology = &recognised.topology;
    let mut rows = vec![String::new(); recognised.links.len()];
    for (hinge, &link) in recognised.links.iter().enumerate() {
        let [angle, rate] =
            [RightSideLayout::beta, RightSideLayout::tau].map(|of| of(topology).start + hinge);
        let law = RightSideLayout::law(topology, hinge).start;
        // Each body is a link, so that no link has a second line.
        let kick_off = RightSideLayout::coefficients(topology, hinge).start;
        rows[link] = format!(
            "    Variables {{ angle: {angle}, rate: {rate}, law: {law}, kick_off: {kick_off} }},\n"
        );
    }
    rows.concat()
}
