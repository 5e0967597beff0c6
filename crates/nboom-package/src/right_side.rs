//! The right side of a scene's differential equations in a crate of routines.

use nboom_codegen::{CodegenError, Request};
use nboom_formulation::{Forces, Recognised, RightSideLayout};
use nboom_model::{Course, External, Mode, Scene, WeldedTree};
use nboom_scalar::Wrench;
use nboom_verify::TestCase;

use crate::PackageError;

/// What only such a crate has: in the documentation and in the code.
const TEXTS: [&str; 2] =
    [include_str!("../templates/right_side.md"), include_str!("../templates/right_side.rs")];

/// What the documentation and the code have of the `request` for the scene, whose appendages are `recognised`.
///
/// # Errors
/// What a right side has no place for.
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
    let thrusts: Vec<String> = thrusts(scene).filter_map(thrust).collect();
    let holdings: Vec<String> = holdings(scene).map(holding).collect();
    let values = [
        ("RIGHT_SIDE", request.name.clone()),
        ("START_TIME", literal(scene.initial.time)),
        ("START_COUNT", start.len().to_string()),
        ("START", format!("{start:?}")),
        ("VARIABLE_LIST", variables(scene, recognised)),
        ("WRENCH", format!("{:?}", RightSideLayout::external(topology))),
        ("SPIN", format!("{:?}", RightSideLayout::spin(topology))),
        ("THRUST_COUNT", thrusts.len().to_string()),
        ("THRUST_LIST", thrusts.concat()),
        ("HOLDING_COUNT", holdings.len().to_string()),
        ("HOLDING_LIST", holdings.concat()),
        ("SIDE_PARAMETER_COUNT", parameters.len().to_string()),
        ("SIDE_PARAMETER_LIST", lines),
    ];
    let fill =
        |text: String, (key, value): &(&str, String)| text.replace(&format!("/*{key}*/"), value);
    Ok(TEXTS.map(|text| values.iter().fold(text.to_owned(), fill)))
}

/// What acts in a test case.
///
/// # Errors
/// What a right side has no place for.
pub(crate) fn forces(test_case: &TestCase) -> Result<Forces<f64>, PackageError> {
    let no_place = |what| CodegenError::no_place(test_case.scene(), what).into();
    test_case
        .forces()
        .expect("requests are refused before when there is no topology")
        .map_err(no_place)
}

/// The numbers of the scene at its start; all kick-off springs push.
fn parameters(scene: &Scene, recognised: &Recognised) -> Result<Vec<f64>, PackageError> {
    let mut forces = forces(&TestCase::new(scene.clone(), 0, 0)?.with_lines_pushing())?;
    let now = scene.initial.time;
    forces.external = Wrench::zero();
    let acts = |external: &&External| external.course.acts(external.course.piece_at(now));
    thrusts(scene).filter(acts).for_each(|external| forces.external.add(wrench(external)));
    if let Some((_, wrench)) = holdings(scene).take_while(|(from, _)| *from <= now).last() {
        forces.external = wrench;
    }
    Ok([recognised.parameters.write(), forces.write()].concat())
}

/// What acts on a main body from outside that is not held.
fn thrusts(scene: &Scene) -> impl Iterator<Item = &External> {
    scene.externals.iter().filter(|_| !scene.base.is_held())
}

/// Moment and force about O, main-body axes.
fn wrench(External { kind, point, amount, .. }: &External) -> Wrench<f64> {
    kind.wrench(*point, *amount)
}

/// A pulse; a right side has no place for others.
fn thrust(external: &External) -> Option<String> {
    let Course::Pulse { on, off } = external.course else { return None };
    let (on, off) = (literal(on), literal(off));
    Some(format!("    Thrust {{ on: {on}, off: {off}, wrench: {:?} }},\n", six(wrench(external))))
}

/// The wrench that holds a main body from each time on, earlier ones first.
fn holdings(scene: &Scene) -> impl Iterator<Item = (f64, Wrench<f64>)> {
    let beta = vec![0.0; scene.bodies.len()];
    let mut from = scene.base.is_held().then_some(f64::NEG_INFINITY);
    (0..).map_while(move |drive| {
        let since = from?;
        from = scene.base.end_of(drive);
        let mode = Mode { drive, ..Mode::at_start(scene) };
        Some((since, WeldedTree::new(scene, &mode, &beta).holding_wrench()?))
    })
}

fn holding((from, wrench): (f64, Wrench<f64>)) -> String {
    format!("    Holding {{ from: {}, wrench: {:?} }},\n", literal(from), six(wrench))
}

/// Moment, then force.
fn six(Wrench { moment, force }: Wrench<f64>) -> Vec<f64> {
    [moment.to_array(), force.to_array()].concat()
}

/// A time as code has it.
fn literal(time: f64) -> String {
    match time {
        f64::INFINITY => "f64::INFINITY".to_owned(),
        f64::NEG_INFINITY => "f64::NEG_INFINITY".to_owned(),
        _ => format!("{time:?}"),
    }
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
fn variables(scene: &Scene, recognised: &Recognised) -> String {
    let topology = &recognised.topology;
    let inboard = topology.inboard_hinges();
    let mut rows = vec![String::new(); recognised.links.len()];
    for (hinge, &link) in recognised.links.iter().enumerate() {
        let [angle, rate] =
            [RightSideLayout::beta, RightSideLayout::tau].map(|of| of(topology).start + hinge);
        let law = RightSideLayout::law(topology, hinge).start;
        // Each body is a link, so that no link has a second line.
        let kick_off = RightSideLayout::coefficients(topology, hinge).start;
        let limit = scene.bodies[link].hinge.kick_off.map(|spring| spring.limit_length);
        let coupling = inboard[hinge].map(|_| RightSideLayout::coupling(topology, hinge).start);
        rows[link] = format!(
            "    Variables {{ angle: {angle}, rate: {rate}, law: {law}, kick_off: {kick_off}, \
             kick_off_limit: {limit:?}, coupling: {coupling:?} }},\n"
        );
    }
    rows.concat()
}
