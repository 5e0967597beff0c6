//! What few scenes have: rotors, and test rigs that move or hold the main body.

use std::borrow::Cow;

use nboom_report::{Captions, Table};

use super::XYZ;
use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::{Source, degrees};

pub(super) fn rotors<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let (run, units) = (source.run, &source.units);
    let of = |table: Option<&'a Table>, quantity: &str, in_degrees: bool| {
        let rotors = run.rotors().into_iter();
        let curves = rotors.filter_map(|rotor| {
            let table = table?;
            let column = table.column(&format!("{quantity}_{}", rotor.key))?;
            let values = if in_degrees { degrees(column) } else { Cow::Borrowed(column) };
            Some(Curve::new(rotor.label, table.times(), values))
        });
        curves.collect::<Vec<_>>()
    };
    let panels = vec![
        Panel::new(
            "Speed",
            &units.rate,
            Scale::Linear,
            of(run.rotor_speeds(), "rotor_speed", true),
        ),
        Panel::new(
            "Torque of the motor",
            &units.torque,
            Scale::Linear,
            of(run.requested(), "motor_torque", false),
        ),
    ];
    let Captions { rotor_speeds, on_request, .. } = run.captions();
    let has_torques = !panels[1].curves.is_empty();
    let of_torques = if has_torques { format!(" Torques: {on_request}") } else { String::new() };
    Some(Figure { title: "Rotors", note: format!("{rotor_speeds}{of_torques}"), panels })
}

pub(super) fn rig<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let (run, units) = (source.run, &source.units);
    let of = |table: Option<&'a Table>, quantity: &str| {
        let curves = XYZ.into_iter().filter_map(|axis| {
            let table = table?;
            let column = table.column(&format!("{quantity}_{axis}"))?;
            Some(Curve::new(axis, table.times(), Cow::Borrowed(column)))
        });
        curves.collect::<Vec<_>>()
    };
    let slid = run.motion().filter(|_| run.is_slid());
    let panels = vec![
        Panel::new("Velocity", &units.speed, Scale::Linear, of(slid, "v")),
        Panel::new("Force", &units.force, Scale::Linear, of(run.requested(), "reaction_force")),
        Panel::new("Moment", &units.torque, Scale::Linear, of(run.requested(), "reaction_moment")),
    ];
    let is_borne = panels[1..].iter().any(|panel| !panel.curves.is_empty());
    let velocity = (!panels[0].curves.is_empty()).then_some("Velocity along inertial axes.");
    let borne = is_borne.then(|| {
        let of_run = run.captions().on_request;
        format!("Force and moment about O on the main body, along its axes. {of_run}")
    });
    let note = velocity.map(str::to_owned).into_iter().chain(borne).collect::<Vec<_>>().join(" ");
    Some(Figure { title: "Test rig", note, panels })
}
