//! Forces of kick-off springs, loads of hinges, stresses.

use std::borrow::Cow;
use std::collections::BTreeMap;

use nboom_report::{Hinge, Largest, Table, Worst};

use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::{Source, Wanted};

pub(super) fn kick_off_forces<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let wanted = Wanted {
        quantity: "force",
        label: "Force",
        unit: &source.units.force,
        scale: Scale::Linear,
        in_degrees: false,
        slides: None,
        wheels: None,
    };
    let panels = source.of_hinges(source.run.kick_offs()?, &wanted);
    Some(Figure { title: "Forces of kick-off springs", note: String::new(), panels })
}

pub(super) fn hinge_loads<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let loads = source.run.hinge_loads()?;
    let units = &source.units;
    let of = |quantity: &str, label, unit| {
        let (scale, in_degrees, slides) = (Scale::Linear, false, None);
        let wanted = Wanted { quantity, label, unit, scale, in_degrees, slides, wheels: None };
        let mut panels = source.of_hinges(loads, &wanted);
        let sizes = source.run.hinge_envelope().iter().filter_map(|worst| match &worst.what {
            Largest::Hinge { quantity: of, magnitude } if of == quantity => {
                Some((source.label(worst.appendage, worst.segment), [worst.t, *magnitude]))
            }
            _ => None,
        });
        let sizes: BTreeMap<String, [f64; 2]> = sizes.collect();
        let curves = panels.iter_mut().flat_map(|panel| &mut panel.curves);
        curves.for_each(|curve| curve.largest = sizes.get(&curve.label).copied());
        panels
    };
    let forces = of("force", "Force", units.force.as_str());
    let panels: Vec<_> =
        forces.into_iter().chain(of("moment", "Moment", units.torque.as_str())).collect();
    let note = dots(source, &panels).to_owned();
    Some(Figure { title: "Loads of hinges", note, panels })
}

pub(super) fn stresses<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let stresses = source.run.stresses()?;
    let curve = |hinge: &Hinge| {
        let worst = worst_station(stresses, &format!("{}_", hinge.key))?;
        let of_segment =
            source.run.stress_envelope().iter().filter(|worst| {
                (worst.appendage, worst.segment) == (hinge.appendage, hinge.segment)
            });
        let largest = of_segment.filter_map(von_mises).max_by(|a, b| a[1].total_cmp(&b[1]));
        let curve = Curve::new(&hinge.label, stresses.times(), Cow::Owned(worst));
        Some(Curve { group: hinge.appendage, largest, ..curve })
    };
    let curves = source.hinges.iter().filter_map(curve).collect();
    let panels = Panel::of_groups("Von Mises stress", &source.units.stress, Scale::Linear, curves);
    let note = format!("{} {}", source.run.captions().stresses, dots(source, &panels));
    Some(Figure { title: "Stresses", note, panels })
}

/// What the dots of these panels are; nothing where there are none.
fn dots(source: &Source<'_>, panels: &[Panel<'_>]) -> &'static str {
    let has_dots =
        panels.iter().flat_map(|panel| &panel.curves).any(|curve| curve.largest.is_some());
    if has_dots { source.run.captions().dots } else { "" }
}

/// At each time the largest stress of the stations of a segment, whose columns begin so.
fn worst_station(stresses: &Table, segment: &str) -> Option<Vec<f64>> {
    let names = stresses.names().iter().filter(|name| name.starts_with(segment));
    let columns = names.filter_map(|name| stresses.column(name));
    columns.map(<[f64]>::to_vec).reduce(|worst, other| {
        worst.iter().zip(other).map(|(worst, stress)| worst.max(stress)).collect()
    })
}

fn von_mises(worst: &Worst) -> Option<[f64; 2]> {
    match worst.what {
        Largest::Station { von_mises, .. } => Some([worst.t, von_mises]),
        Largest::Hinge { .. } => None,
    }
}
