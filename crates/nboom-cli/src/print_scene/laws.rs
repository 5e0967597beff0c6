//! What acts at a joint and ends its motion, as a scene in TOML says it.

use nboom_model::{
    Coupling, Dashpot, Hinge, HingeLabel, KickOffSpring, Scene, Spring, Stops, TorqueTable,
};

use super::{coordinate, joint};
use crate::format::{short, vector};

/// A line for each law of a hinge.
pub(super) fn of(scene: &Scene, i: usize) -> impl Iterator<Item = String> {
    let (hinge, label) = (&scene.bodies[i].hinge, scene.label(i));
    let laws = [
        spring(&label, &hinge.spring),
        damper(&label, &hinge.dashpot),
        friction(hinge),
        stops(&label, &hinge.stops),
        hinge.kick_off.as_ref().map(kick_off),
    ];
    let couplings = scene.couplings.iter().filter(|coupling| coupling.hinges[0] == i);
    let couplings = couplings.map(|one| coupling(scene, &label, one)).collect::<Vec<_>>();
    let tables = scene.torque_tables.iter().filter(|table| table.hinge == i);
    let tables = tables.map(|table| torque_table(&label, table)).collect::<Vec<_>>();
    laws.into_iter().flatten().chain(couplings).chain(tables)
}

fn spring(label: &HingeLabel, spring: &Spring) -> Option<String> {
    let Spring { quadratic, linear, preload_angle } = *spring;
    ([quadratic, linear] != [0.0; 2]).then(|| {
        let (stiffness, rest) = (short(0.0 - linear, 6), coordinate(label, 0.0 - preload_angle));
        format!("spring: stiffness {stiffness}, rest {rest}{}", term("quadratic", quadratic))
    })
}

fn friction(hinge: &Hinge) -> Option<String> {
    (hinge.friction != 0.0).then(|| format!("friction: {}", short(hinge.friction, 6)))
}

fn stops(label: &HingeLabel, stops: &Stops) -> Option<String> {
    let places: Vec<String> = stops.iter().map(|stop| coordinate(label, stop.angle)).collect();
    let restitution = short(stops.restitution, 6);
    let told = || format!("stops: {}, restitution {restitution}", places.join(" and "));
    (!places.is_empty()).then(told)
}

fn damper(label: &HingeLabel, dashpot: &Dashpot) -> Option<String> {
    let Dashpot { rate_quadratic, rate_linear, angle_quadratic, angle_linear, preload_angle } =
        *dashpot;
    let of_angle = [angle_linear, angle_quadratic];
    (of_angle != [0.0; 2] || [rate_quadratic, rate_linear] != [0.0; 2]).then(|| {
        let damping = short(0.0 - rate_linear, 6);
        let rest = format!(", rest {}", coordinate(label, 0.0 - preload_angle));
        let [rate_squared, angle, angle_squared] = label.joint.damper_names();
        let parts = [
            term(rate_squared, rate_quadratic),
            term(angle, angle_linear),
            term(angle_squared, angle_quadratic),
            if of_angle == [0.0; 2] { String::new() } else { rest },
        ];
        format!("damper: damping {damping}{}", parts.concat())
    })
}

fn coupling(scene: &Scene, label: &HingeLabel, coupling: &Coupling) -> String {
    let Coupling { hinges: [_, other], ratio, stiffness, rest, damping, is_mutual } = *coupling;
    let [ratio, stiffness, damping] = [ratio, stiffness, damping].map(|number| short(number, 6));
    let (other, rest) = (joint(&scene.label(other)), coordinate(label, rest));
    let alone = if is_mutual { "" } else { ", acts on this hinge alone" };
    format!(
        "coupling to {other}: ratio {ratio}, stiffness {stiffness}, rest {rest}, damping {damping}{alone}"
    )
}

fn torque_table(label: &HingeLabel, table: &TorqueTable) -> String {
    let what = label.joint.force_name();
    let point =
        |[at, amount]: &[f64; 2]| format!("{} at {}", short(*amount, 6), coordinate(label, *at));
    format!("{what} table: {}", table.points.iter().map(point).collect::<Vec<_>>().join(", "))
}

/// A term, unless it is zero.
fn term(name: &str, coefficient: f64) -> String {
    if coefficient == 0.0 { String::new() } else { format!(", {name} {}", short(coefficient, 6)) }
}

fn kick_off(spring: &KickOffSpring) -> String {
    let from = vector(spring.main_body_point);
    let to = vector(spring.body_point);
    let coefficients = spring.coefficients.map(|coefficient| short(coefficient, 6)).join(", ");
    let limit = short(spring.limit_length, 6);
    format!("kick-off spring: {from} to {to}, coefficients {coefficients}, up to length {limit}")
}
