//! The motion: hinges, rates of the main body, nutation and direction cosines.

use std::borrow::Cow;

use super::XYZ;
use crate::axis::Scale;
use crate::figure::{Curve, Figure, Panel};
use crate::source::{Source, Wanted, degrees};

/// Change of a direction cosine below which it is rounding.
const ROUNDING: f64 = 1e-9;

pub(super) fn angles<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let angles = Wanted {
        quantity: "beta",
        label: "Angle",
        unit: "°",
        scale: Scale::Degrees,
        in_degrees: true,
        slides: Some(false),
        wheels: Some(false),
    };
    let unit = &source.units.length;
    let travels = Wanted {
        label: "Travel",
        unit,
        scale: Scale::Linear,
        in_degrees: false,
        slides: Some(true),
        ..angles
    };
    // Their turns would make all other angles one line.
    let wheels = Wanted { label: "Angle of wheels", wheels: Some(true), ..angles };
    of_hinges(source, "Deployment angles", [angles, wheels, travels])
}

pub(super) fn rates<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let rates = Wanted {
        quantity: "tau",
        label: "Rate",
        unit: &source.units.rate,
        scale: Scale::Linear,
        in_degrees: true,
        slides: Some(false),
        wheels: Some(false),
    };
    let unit = &source.units.speed;
    let speeds = Wanted { label: "Speed", unit, in_degrees: false, slides: Some(true), ..rates };
    let wheels = Wanted { label: "Rate of wheels", wheels: Some(true), ..rates };
    of_hinges(source, "Rates of deployment", [rates, wheels, speeds])
}

fn of_hinges<'a>(
    source: &Source<'a>,
    title: &'static str,
    wanted: [Wanted<'_>; 3],
) -> Option<Figure<'a>> {
    let motion = source.run.motion()?;
    let panels = wanted.iter().flat_map(|wanted| source.of_hinges(motion, wanted)).collect();
    Some(Figure { title, note: String::new(), panels })
}

pub(super) fn body_rates<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let motion = source.run.motion()?;
    let curve = |axis: &str| {
        let omega = motion.column(&format!("omega_{axis}"))?;
        Some(Curve::new(axis, motion.times(), degrees(omega)))
    };
    let curves: Option<Vec<_>> = XYZ.into_iter().map(curve).collect();
    let panel = Panel::new("Rate", &source.units.rate, Scale::Linear, curves?);
    let panels = vec![Panel { least: source.run.least_rate().to_degrees(), ..panel }];
    let note = "Along the axes of the main body.".to_owned();
    Some(Figure { title: "Angular rate of the main body", note, panels })
}

pub(super) fn nutation<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let motion = source.run.motion()?;
    if !source.run.has_momentum() {
        return None;
    }
    let nutation = degrees(motion.column("nutation")?);
    let curves = vec![Curve::new("nutation", motion.times(), nutation)];
    let note = source.run.captions().nutation.to_owned();
    let panels = vec![Panel::new("Angle", "°", Scale::Degrees, curves)];
    Some(Figure { title: "Nutation", note, panels })
}

/// Of the main body's axes with the inertial ones, as the printout of 1970 has them.
pub(super) fn direction_cosines<'a>(source: &Source<'a>) -> Option<Figure<'a>> {
    let motion = source.run.motion()?;
    let quaternion = ["chi", "kappa_x", "kappa_y", "kappa_z"].map(|name| motion.column(name));
    let [Some(w), Some(i), Some(j), Some(k)] = quaternion else { return None };
    // Columns of the rotation from main-body to inertial components.
    let axes = |row: usize| {
        let [w, i, j, k] = [w[row], i[row], j[row], k[row]];
        [
            [1.0 - 2.0 * (j * j + k * k), 2.0 * (i * j + w * k), 2.0 * (i * k - w * j)],
            [2.0 * (i * j - w * k), 1.0 - 2.0 * (i * i + k * k), 2.0 * (j * k + w * i)],
            [2.0 * (i * k + w * j), 2.0 * (j * k - w * i), 1.0 - 2.0 * (i * i + j * j)],
        ]
    };
    let cosines: Vec<[[f64; 3]; 3]> = (0..w.len()).map(axes).collect();
    let panel = |body: usize| {
        let curve = |(inertial, axis): (usize, &str)| {
            let values: Cow<'a, [f64]> = cosines.iter().map(|axes| axes[body][inertial]).collect();
            Curve::new(format!("inertial {axis}"), motion.times(), values)
        };
        let curves = XYZ.into_iter().enumerate().map(curve).collect();
        let panel = Panel::new(&format!("Of the {} axis", XYZ[body]), "", Scale::Linear, curves);
        Panel { least: ROUNDING, ..panel }
    };
    let note = "Of the main body’s axes, with each of the inertial axes.".to_owned();
    Some(Figure { title: "Direction cosines", note, panels: (0..3).map(panel).collect() })
}
