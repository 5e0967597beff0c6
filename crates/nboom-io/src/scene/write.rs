//! A scene as TOML text: what is read from it is the scene again, to the last bit.

mod joints;
mod lines;

use nboom_model::{
    Base, Body, BodyShape, Course, Drive, DrivePoint, ExternalAxes, ExternalKind, HingeLabel,
    MassProperties, Material, RotorSpeed, Scene, SectionShape, SegmentStructure, Solid, Station,
    Structure, StructureError, UnitSystem, WantedTable,
};
use nboom_scalar::{Mat3, Vec3};

use super::catalog::{BASES, FILES_ON_REQUEST, SLICES};
use crate::words::external_table;
use crate::{Sampling, SceneFile, SceneSettings};
use joints::{couplings, joint};
use lines::{Lines, angle, angles, angles_over_time, inertia, list, listed, number, text, vector};

/// The text of a scene. Comments, parameters, includes and repetitions of the file that it was read
/// from are not in it, nor are a deck's settings of the integrator and printer of 1970.
pub fn write_scene(file: &SceneFile) -> String {
    let SceneFile { scene, structure, settings, .. } = file;
    let mut lines = Lines::default();
    lines.value("name", text(&scene.name));
    if let Some(units) = &settings.units {
        lines.value("units", of_units(units));
    }
    lines.table("run");
    if scene.initial.time != 0.0 {
        lines.value("start", number(scene.initial.time));
    }
    lines.value("end", number(scene.end_time));
    output(&mut lines, file);
    lines.table("main_body");
    mass_properties(&mut lines, &scene.main_body);
    lines.optional("base", (scene.base == Base::Fixed).then(|| text(BASES[1])));
    lines.optional("shape", scene.shapes().main_body.as_ref().map(shape));
    if let Some(drive) = scene.base.drive() {
        prescribed(&mut lines, drive);
    }
    rotors(&mut lines, scene, None);
    externals(&mut lines, scene, None);
    surroundings(&mut lines, scene);
    let materials = materials(structure.as_ref());
    for (i, material) in materials.iter().enumerate() {
        let Material { youngs_modulus, poissons_ratio, yield_stress, ultimate_stress } = *material;
        lines.table(&format!("materials.{}", material_name(i)));
        lines.value("youngs_modulus", number(youngs_modulus));
        lines.value("poissons_ratio", number(poissons_ratio));
        lines.optional("yield_stress", yield_stress.map(number));
        lines.optional("ultimate_stress", ultimate_stress.map(number));
    }
    let differing = differing(scene, structure.as_ref());
    for (i, of_body) in scene.bodies.iter().enumerate() {
        let segment = structure.as_ref().map(|structure| &structure.segments()[i]);
        body(&mut lines, scene, i, of_body);
        let has_pulses = of_body.hinge.may_be_struck();
        let strength = |segment| strength(&mut lines, segment, has_pulses, &materials);
        segment.into_iter().for_each(strength);
        let differs = differing.contains(&scene.label(i));
        lines.optional("slices", differs.then(|| text(SLICES[0])));
        lines.table(&format!("body.{}", of_body.joint.name()));
        joint(&mut lines, scene, i, of_body);
        couplings(&mut lines, scene, i);
        rotors(&mut lines, scene, Some(i));
        externals(&mut lines, scene, Some(i));
        segment.into_iter().for_each(|segment| stations(&mut lines, segment));
    }
    lines.text
}

fn output(lines: &mut Lines, SceneFile { scene, settings, legacy, .. }: &SceneFile) {
    let SceneSettings { sampling, table, hinge_loads, listing, .. } = settings;
    let mut values = Vec::new();
    values.extend(sampling.as_ref().map(|sampling| match sampling {
        Sampling::Uniform(samples) => ("samples", samples.to_string()),
        Sampling::Every(every) => ("every", number(*every)),
        Sampling::At(times) => ("times", listed(times.iter().copied().map(number))),
    }));
    if let Some(WantedTable { columns, in_degrees }) = table {
        let columns = columns.iter().map(|column| text(&column.name(scene.labels())));
        values.push(("columns", listed(columns)));
        values.push(("angles", text(if *in_degrees { "degrees" } else { "radians" })));
    }
    let files = FILES_ON_REQUEST.iter().zip([hinge_loads, listing]).filter(|(_, wanted)| **wanted);
    let files = files.map(|(file, _)| text(file));
    values.extend((*hinge_loads || *listing).then(|| ("files", listed(files))));
    let every = Some(legacy.stress_interval).filter(|every| *every > 1);
    values.extend(every.map(|every| ("stress_every", every.to_string())));
    if !values.is_empty() {
        lines.table("output");
        values.iter().for_each(|(key, value)| lines.value(key, value));
    }
}

fn of_units(units: &UnitSystem) -> String {
    match units {
        UnitSystem::Custom { length, time, force } => {
            let [length, time, force] = [length, time, force].map(|label| text(label));
            format!("{{ length = {length}, time = {time}, force = {force} }}")
        }
        named => text(named.name()),
    }
}

fn mass_properties(lines: &mut Lines, properties: &MassProperties) {
    lines.value("mass", number(properties.mass));
    lines.value("mass_centre", vector(properties.center_of_mass));
    lines.value("inertia", inertia(&properties.inertia));
}

fn surroundings(lines: &mut Lines, scene: &Scene) {
    let initial = &scene.initial;
    lines.table("initial");
    let [x, y, z] = initial.attitude.vector.to_array();
    let quaternion = list([initial.attitude.scalar, x, y, z]);
    lines.value("attitude", format!("{{ quaternion = {quaternion} }}"));
    lines.value("position", vector(initial.position_inertial));
    // How fast a main body is that is held follows from what holds it, which a study may vary.
    if !scene.base.is_held() {
        lines.line(angles("rate", initial.omega_body.to_array()));
        lines.value("velocity", vector(initial.velocity_inertial));
    }
    if let Some(gravity) = &scene.gravity {
        lines.table("gravity");
        lines.value("acceleration", number(gravity.acceleration));
        lines.value("up", vector(gravity.up));
    }
}

/// The name of a body; one without is called by its hinge's numbers.
fn name_of(scene: &Scene, i: usize) -> String {
    let numbered = || format!("segment {}", scene.label(i));
    scene.name_of(i).map_or_else(numbered, str::to_owned)
}

fn body(lines: &mut Lines, scene: &Scene, i: usize, body: &Body) {
    lines.tables("body");
    lines.value("name", text(&name_of(scene, i)));
    lines.optional("on", body.inboard.map(|inboard| text(&name_of(scene, inboard))));
    mass_properties(lines, &body.mass_properties);
    lines.value("tip", vector(body.tip));
    lines.optional("shape", scene.shapes().of(i).map(shape));
    if let Some(spring) = &body.hinge.kick_off {
        let [from, to] = [spring.main_body_point, spring.body_point].map(vector);
        let (force, limit) = (list(spring.coefficients), number(spring.limit_length));
        let value =
            format!("{{ main_body_end = {from}, end = {to}, force = {force}, limit = {limit} }}");
        lines.value("kick_off", value);
    }
}

/// The prescribed motion of the main body.
fn prescribed(lines: &mut Lines, Drive { axis, points }: &Drive) {
    lines.table("main_body.drive");
    lines.value("axis", direction(*axis));
    let over_time = |value: fn(&DrivePoint) -> f64| -> Vec<[f64; 2]> {
        points.iter().map(|point| [point.time, value(point)]).collect()
    };
    lines.line(angles_over_time("rate", &over_time(|point| point.rate)));
    let speeds = over_time(|point| point.speed);
    lines.value("speed", listed(speeds.into_iter().map(list)));
}

/// The rotors of a body, as tables of it.
fn rotors(lines: &mut Lines, scene: &Scene, body: Option<usize>) {
    for rotor in scene.rotors.iter().filter(|rotor| rotor.body == body) {
        lines.tables(if body.is_some() { "body.rotor" } else { "main_body.rotor" });
        lines.value("axis", direction(rotor.axis));
        lines.value("inertia", number(rotor.inertia));
        lines.line(match &rotor.speed {
            RotorSpeed::Constant(speed) => angle("speed", *speed),
            RotorSpeed::Table(points) => angles_over_time("speed_over_time", points),
        });
    }
}

/// What acts on a body from outside, as tables of it.
fn externals(lines: &mut Lines, scene: &Scene, body: Option<usize>) {
    for external in scene.externals.iter().filter(|external| external.body == body) {
        let owner = if body.is_some() { "body" } else { "main_body" };
        lines.tables(&format!("{owner}.{}", external_table(external.kind)));
        let amount = match external.kind {
            ExternalKind::Force => "force",
            ExternalKind::Torque => "torque",
        };
        lines.value(amount, vector(external.amount));
        lines.value("point", vector(external.point));
        if external.axes == ExternalAxes::Inertial {
            lines.value("axes", text("inertial"));
        }
        match &external.course {
            Course::Pulse { on, off } => {
                let times = [("from", on), ("until", off)].into_iter();
                let times = times.filter(|(_, time)| time.is_finite());
                times.for_each(|(key, time)| lines.value(key, number(*time)));
            }
            Course::Table(points) => {
                lines.value("over_time", listed(points.iter().map(|&point| list(point))));
            }
        }
    }
}

fn shape(shape: &BodyShape) -> String {
    let solid = match shape.solid {
        Solid::Box(sides) => format!("box = {}", vector(sides)),
        Solid::Panel(sides) => format!("panel = {}", vector(sides)),
        Solid::Cylinder { radius, length, along } => {
            let [radius, length] = [radius, length].map(number);
            let along = direction(along);
            format!("cylinder = {{ radius = {radius}, length = {length}, along = {along} }}")
        }
    };
    let axes = turned(&shape.axes).map_or_else(String::new, |axes| format!(", axes = {axes}"));
    format!("{{ {solid}, at = {}{axes} }}", vector(shape.middle))
}

/// Axes, unless they are those of the body itself.
fn turned(axes: &Mat3<f64>) -> Option<String> {
    let columns = || [0, 1, 2].map(|j| vector(axes.column(j))).join(", ");
    (*axes != Mat3::identity()).then(|| format!("{{ columns = [{}] }}", columns()))
}

fn direction(axis: Vec3<f64>) -> String {
    let names = ["x", "y", "z"].into_iter().zip([Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()]);
    let named = names.into_iter().find_map(|(name, unit)| {
        let sign = if axis == unit { "" } else { "-" };
        (axis == unit || axis == unit * -1.0).then(|| text(&format!("{sign}{name}")))
    });
    named.unwrap_or_else(|| vector(axis))
}

/// The materials of bodies with stations, each once.
fn materials(structure: Option<&Structure>) -> Vec<Material> {
    let mut materials = Vec::new();
    for material in structure.iter().flat_map(|structure| structure.materials()) {
        if !materials.contains(material) {
            materials.push(*material);
        }
    }
    materials
}

/// Bodies to which their slices do not add up.
fn differing(scene: &Scene, structure: Option<&Structure>) -> Vec<HingeLabel> {
    let segments = structure.map(|structure| structure.segments().to_vec());
    let checked = segments.map(|segments| Structure::with_differing_slices(scene, segments));
    let differences = checked.and_then(Result::ok).map_or_else(Vec::new, |(_, found)| found);
    let segment = |difference| match difference {
        StructureError::Segment { place, .. } => Some(place.segment),
        _ => None,
    };
    differences.into_iter().filter_map(segment).collect()
}

fn material_name(i: usize) -> String {
    format!("material_{}", i + 1)
}

fn strength(
    lines: &mut Lines,
    segment: &SegmentStructure,
    has_pulses: bool,
    materials: &[Material],
) {
    // Of a body without pulses it is idle, and read as this unless it is given.
    let is_said =
        has_pulses || segment.pulse_constant != SegmentStructure::default().pulse_constant;
    lines.optional("pulse_constant", is_said.then(|| number(segment.pulse_constant)));
    let material = materials.iter().position(|material| *material == segment.material);
    lines.optional("material", material.map(|i| text(&material_name(i))));
}

fn stations(lines: &mut Lines, segment: &SegmentStructure) {
    for Station { distance_from_hinge, slice, section } in &segment.stations {
        lines.tables("body.station");
        lines.value("at", number(*distance_from_hinge));
        mass_properties(lines, slice);
        let walls = match section {
            SectionShape::Tube { radius, thickness } => {
                let [radius, thickness] = [*radius, *thickness].map(number);
                format!("{{ tube = {{ radius = {radius}, thickness = {thickness} }} }}")
            }
            SectionShape::Polygon(vertices) => {
                let row = |v: &nboom_model::Vertex| list([v.xi, v.zeta, v.thickness]);
                let rows: Vec<String> = vertices.iter().map(row).collect();
                format!("{{ polygon = [{}] }}", rows.join(", "))
            }
        };
        lines.value("section", walls);
    }
}
