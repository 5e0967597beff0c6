//! Joints as TOML: how they start, what acts at them and ends their motion.

use nboom_model::{Body, Coupling, Hinge, HingeState, Joint, Release, Scene};

use super::lines::{Lines, angle, angles, list, number, text, vector};
use super::{direction, name_of, turned};

/// The keys of a joint.
pub(super) fn joint(lines: &mut Lines, scene: &Scene, i: usize, body: &Body) {
    let coordinate = |key, value| coordinate(body.joint, key, value);
    let Hinge { spring, dashpot, friction, stops, release, lock_angle, start, .. } = &body.hinge;
    lines.value("at", vector(body.mount.point));
    lines.value("axis", direction(body.axis));
    lines.optional("axes", turned(&body.mount.rot_inboard_from_hinge));
    lines.value("state", text(start.state.name()));
    lines.line(coordinate("start", start.angle));
    if start.rate != 0.0 {
        lines.line(coordinate(body.joint.rate_name(), start.rate));
    }
    lock_angle.iter().for_each(|&lock| lines.line(coordinate("latch", lock)));
    if !stops.is_none() {
        lines.line(stops_of(body.joint, [stops.lower, stops.upper]));
    }
    if stops.restitution != 0.0 {
        lines.value("restitution", number(stops.restitution));
    }
    if start.state == HingeState::Unreleased {
        lines.optional("release", of_release(scene, release));
    }
    if [spring.quadratic, spring.linear] != [0.0; 2] {
        let numbers = [("stiffness", 0.0 - spring.linear), ("quadratic", spring.quadratic)];
        lines.value("spring", law(body.joint, &numbers, spring.preload_angle, 1));
    }
    let [rate_squared, angle, angle_squared] = body.joint.damper_names();
    let numbers = [
        ("damping", 0.0 - dashpot.rate_linear),
        (rate_squared, dashpot.rate_quadratic),
        (angle, dashpot.angle_linear),
        (angle_squared, dashpot.angle_quadratic),
    ];
    if numbers.iter().any(|(_, number)| *number != 0.0) {
        lines.value("damper", law(body.joint, &numbers, dashpot.preload_angle, 0));
    }
    if *friction != 0.0 {
        lines.value("friction", number(*friction));
    }
    if let Some(table) = scene.torque_tables.iter().find(|table| table.hinge == i) {
        let points: Vec<String> = table.points.iter().map(|&point| list(point)).collect();
        let key = if body.joint.slides() { "force" } else { "torque_rad" };
        lines.value(key, format!("[{}]", points.join(", ")));
    }
}

/// A key of a coordinate or rate of a joint with its value.
fn coordinate(joint: Joint, key: &str, value: f64) -> String {
    match joint {
        Joint::Revolute => angle(key, value),
        Joint::Prismatic => format!("{key} = {}", number(value)),
    }
}

/// The key of stops with its values, of which infinite ones are none.
fn stops_of(joint: Joint, stops: [f64; 2]) -> String {
    match joint {
        Joint::Revolute => angles("stops", stops),
        Joint::Prismatic => format!("stops = {}", list(stops)),
    }
}

/// The numbers of a law that are not zero, and the first `required` ones in any case.
fn law(joint: Joint, numbers: &[(&str, f64)], preload_angle: f64, required: usize) -> String {
    let is_told = |(i, (_, number)): &(usize, &(&str, f64))| *i < required || *number != 0.0;
    let told = numbers.iter().enumerate().filter(is_told);
    let mut parts: Vec<String> =
        told.map(|(_, (key, value))| format!("{key} = {}", number(*value))).collect();
    if preload_angle != 0.0 {
        parts.push(coordinate(joint, "rest", -preload_angle));
    }
    format!("{{ {} }}", parts.join(", "))
}

fn of_release(scene: &Scene, release: &Release) -> Option<String> {
    match release {
        Release::Time(time) => Some(format!("{{ at = {} }}", number(*time))),
        Release::Angle { hinge, angle: passes } => {
            let joint = scene.bodies[*hinge].joint;
            let passes = coordinate(joint, joint.passes_name(), *passes);
            let when = text(&name_of(scene, *hinge));
            Some(format!("{{ when = {when}, {passes} }}"))
        }
        Release::AfterLock { hinge, delay } => {
            let after = text(&name_of(scene, *hinge));
            Some(format!("{{ after = {after}, by = {} }}", number(*delay)))
        }
        Release::Never => None,
    }
}

/// The couplings of hinge `i`, as tables of its body.
pub(super) fn couplings(lines: &mut Lines, scene: &Scene, i: usize) {
    for coupling in scene.couplings.iter().filter(|coupling| coupling.hinges[0] == i) {
        let Coupling { hinges: [_, other], ratio, stiffness, rest, damping, is_mutual } = *coupling;
        lines.tables("body.coupling");
        lines.value("to", text(&name_of(scene, other)));
        let numbers = [("ratio", ratio), ("stiffness", stiffness), ("damping", damping)];
        numbers.iter().for_each(|(key, value)| lines.value(key, number(*value)));
        if rest != 0.0 {
            lines.line(match scene.bodies[i].joint {
                Joint::Revolute => angle("rest", rest),
                Joint::Prismatic => format!("rest_length = {}", number(rest)),
            });
        }
        if !is_mutual {
            lines.value("acts_on", text("this"));
        }
    }
}
