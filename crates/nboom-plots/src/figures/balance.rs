//! What became of energy, and what the conservation laws are off by.

use std::borrow::Cow;

use nboom_report::Table;

use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::Source;

const ENERGIES: [(&str, &str); 6] = [
    ("kinetic energy", "kinetic_energy"),
    ("potential energy", "potential_energy"),
    ("work of dashpots", "dashpot_work"),
    ("work of thrust", "thrust_work"),
    ("work of motors", "motor_work"),
    ("taken by lock-ups", "lock_up_loss"),
];

const LAWS: [(&str, &str); 3] = [
    ("linear momentum", "residual_linear_momentum"),
    ("angular momentum", "residual_angular_momentum"),
    ("energy", "residual_energy"),
];

pub(super) fn energy<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let curves = moving(source.run.ledger()?, &ENERGIES);
    let note = "What kinetic and potential energy gain and lock-ups take is the work done. Lines join output times.";
    let panels = vec![Panel::new("Energy", &source.units.energy, Scale::Linear, curves)];
    Some(Figure { title: "Energy", note: note.to_owned(), panels })
}

pub(super) fn residuals<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let curves = moving(source.run.ledger()?, &LAWS);
    let note = "What momentum and energy are off by after all impulses and all work, relative. Zeros have no place.";
    let panels = vec![Panel::new("Residual", "", Scale::Logarithmic, curves)];
    Some(Figure { title: "Conservation", note: note.to_owned(), panels })
}

/// Curves of those columns that are not always zero.
fn moving<'a>(ledger: &'a Table, columns: &[(&str, &str)]) -> Vec<Curve<'a>> {
    let curve = |(label, name): &(&str, &str)| {
        let values =
            ledger.column(name).filter(|column| column.iter().any(|value| *value != 0.0))?;
        Some(Curve::new(*label, ledger.times(), Cow::Borrowed(values)))
    };
    columns.iter().filter_map(curve).collect()
}
