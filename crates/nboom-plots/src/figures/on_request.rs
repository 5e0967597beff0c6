//! What few scenes have: rotors, and test rigs that move or hold the main body.

use std::borrow::Cow;

use nboom_report::Table;

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
            "Motor",
            &units.torque,
            Scale::Linear,
            of(run.requested(), "motor_torque", false),
        ),
    ];
    Some(Figure { title: "Rotors", note: run.captions().rotor_speeds.to_owned(), panels })
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
    let note =
        "Velocity along inertial axes; force and moment about O on the main body, along its axes.";
    Some(Figure { title: "Test rig", note: note.to_owned(), panels })
}
