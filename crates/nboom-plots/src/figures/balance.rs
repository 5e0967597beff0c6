//! What became of energy, and what the conservation laws are off by.

use std::borrow::Cow;

use nboom_report::{Captioned, Table};

use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::Source;

pub(super) fn energy<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let captions = source.run.captions();
    let curves = moving(source.run.ledger()?, &captions.energies);
    let panels = vec![Panel::new("Energy", &source.units.energy, Scale::Linear, curves)];
    Some(Figure { title: "Energy", note: captions.energy.to_owned(), panels })
}

pub(super) fn residuals<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let captions = source.run.captions();
    let curves = moving(source.run.ledger()?, &captions.laws);
    let panels = vec![Panel::new("Residual", "", Scale::Logarithmic, curves)];
    Some(Figure { title: "Conservation", note: captions.residuals.to_owned(), panels })
}

/// Curves of those columns that are not always zero.
fn moving<'a>(ledger: &'a Table, columns: &[Captioned]) -> Vec<Curve<'a>> {
    let curve = |(label, name): &Captioned| {
        let values =
            ledger.column(name).filter(|column| column.iter().any(|value| *value != 0.0))?;
        Some(Curve::new(*label, ledger.times(), Cow::Borrowed(values)))
    };
    columns.iter().filter_map(curve).collect()
}
