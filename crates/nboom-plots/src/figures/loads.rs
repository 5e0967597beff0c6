//! Forces of kick-off springs, loads of hinges, stresses.

use std::borrow::Cow;
use std::collections::BTreeMap;

use nboom_elements::KickOffLaw;
use nboom_model::{Posture, Scene};
use nboom_report::{Largest, Table, Worst};

use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::{Source, Wanted};

const ENVELOPE: &str = "Dots: the largest of the whole motion, with the pulses of latches.";
const WITHOUT_PULSES: &str =
    "Dots: the largest of the whole motion, without latches, which have no pulse_constant.";

pub(super) fn kick_off_forces<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let (scene, motion) = (source.run.scene()?, source.run.motion()?);
    let sprung: Vec<usize> =
        (0..scene.bodies.len()).filter(|&i| scene.bodies[i].hinge.kick_off.is_some()).collect();
    if sprung.is_empty() {
        return None;
    }
    let columns = source.hinges.iter().map(|hinge| motion.column(&format!("beta_{}", hinge.key)));
    let columns: Vec<&[f64]> = columns.collect::<Option<_>>()?;
    let forces = forces(source, scene, motion.times(), &columns, &sprung);
    let curves = sprung.iter().zip(forces).map(|(&i, forces)| {
        let hinge = &source.hinges[i];
        let curve = Curve::new(&hinge.label, motion.times(), Cow::Owned(forces));
        Curve { group: hinge.appendage, ..curve }
    });
    let panels = Panel::of_groups("Force", &source.units.force, Scale::Linear, curves.collect());
    Some(Figure { title: "Forces of kick-off springs", note: String::new(), panels })
}

/// At each time the force of the kick-off springs of these hinges. A spring lets go and takes hold at its events: at
/// its limit length only they say on which side the motion is.
fn forces(
    source: &Source<'_>,
    scene: &Scene,
    times: &[f64],
    angles: &[&[f64]],
    sprung: &[usize],
) -> Vec<Vec<f64>> {
    let mut forces = vec![Vec::with_capacity(times.len()); sprung.len()];
    let mut acts: Vec<Option<bool>> = vec![None; sprung.len()];
    let mut events = source.run.events().iter().peekable();
    for (row, &time) in times.iter().enumerate() {
        // Of rows at one time the last is after what happens then.
        let is_after = times.get(row + 1) != Some(&time);
        while let Some(event) =
            events.next_if(|event| event.t < time || is_after && event.t == time)
        {
            let place = sprung.iter().position(|&i| {
                let hinge = &source.hinges[i];
                (Some(hinge.appendage), Some(hinge.segment)) == (event.appendage, event.segment)
            });
            match (place, event.kind.as_str()) {
                (Some(place), "kick_off_engage") => acts[place] = Some(true),
                (Some(place), "kick_off_disengage") => acts[place] = Some(false),
                _ => {}
            }
        }
        let angles: Vec<f64> = angles.iter().map(|column| column[row]).collect();
        let posture = Posture::new(scene, &angles);
        for (place, &i) in sprung.iter().enumerate() {
            let Some(spring) = scene.bodies[i].hinge.kick_off else { continue };
            let length = (posture.hinges[i].kick_off - spring.main_body_point).norm();
            let acts = *acts[place].get_or_insert(length <= spring.limit_length);
            let force = KickOffLaw::new(spring.coefficients).force(length);
            forces[place].push(if acts { force } else { 0.0 });
        }
    }
    forces
}

pub(super) fn hinge_loads<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let loads = source.run.hinge_loads()?;
    let units = &source.units;
    let of = |quantity: &str, label, unit| {
        let (scale, in_degrees, slides) = (Scale::Linear, false, None);
        let wanted = Wanted { quantity, label, unit, scale, in_degrees, slides };
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
    let panels = forces.into_iter().chain(of("moment", "Moment", units.torque.as_str())).collect();
    let note = if source.run.has_latch_pulses() { ENVELOPE } else { WITHOUT_PULSES };
    Some(Figure { title: "Loads of hinges", note: note.to_owned(), panels })
}

pub(super) fn stresses<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let stresses = source.run.stresses()?;
    let curve = |hinge: &crate::source::Hinge| {
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
    let note = format!("Of the worst station of each segment. {ENVELOPE}");
    Some(Figure { title: "Stresses", note, panels })
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
