//! What the stresses of a scene are computed for.

use nboom_io::SceneFile;
use nboom_model::{Material, Scene, SectionShape, SegmentStructure, Station, Structure};
use nboom_strength::PulseShape;

use crate::format::{count, short};

/// Stations, sections, materials and pulses of latches and stops, for people to read; numbers to six digits.
pub(crate) fn text(file: &SceneFile) -> String {
    let Some(structure) = &file.structure else { return format!("{NONE}\n") };
    let mut lines = vec![heading(structure)];
    for (i, segment) in structure.segments().iter().enumerate() {
        lines.extend(segment_lines(&file.scene, i, segment));
    }
    lines.join("\n") + "\n"
}

const NONE: &str = "stresses: none; the scene has no stations";

fn heading(structure: &Structure) -> String {
    let counts = structure.segments().iter().map(|segment| segment.stations.len());
    let segments = counts.clone().filter(|&stations| stations > 0).count();
    if segments == 0 {
        return NONE.to_owned();
    }
    let stations = count(counts.sum(), "station", "stations");
    format!("stresses: at {stations} of {}", count(segments, "segment", "segments"))
}

fn segment_lines(scene: &Scene, i: usize, segment: &SegmentStructure) -> Vec<String> {
    let of_stations = (!segment.stations.is_empty())
        .then(|| [stations(segment), material(&segment.material)])
        .into_iter()
        .flatten();
    let pulse = scene.bodies[i].hinge.may_be_struck().then(|| pulse(segment.pulse_constant));
    let mut parts = of_stations.chain(pulse);
    let Some(first) = parts.next() else { return Vec::new() };
    let first = format!("  segment {}: {first}", scene.label(i));
    [first].into_iter().chain(parts.map(|part| format!("    {part}"))).collect()
}

fn pulse(constant: f64) -> String {
    let [over_peak, lasts] =
        [constant, PulseShape::HalfSine.duration(constant)].map(|time| short(time, 6));
    format!("pulse: impulse over peak {over_peak}, half a sine of {lasts}")
}

/// How far they are from the hinge and what sections they have, neighbours with the same one together.
fn stations(segment: &SegmentStructure) -> String {
    let at = |station: &Station| short(station.distance_from_hinge, 6);
    let of_shape = |alike: &[Station]| {
        let places: Vec<String> = alike.iter().map(at).collect();
        format!("at {}: {}", places.join(", "), shape(&alike[0].section))
    };
    let alike = segment.stations.chunk_by(|a, b| a.section == b.section);
    alike.map(of_shape).collect::<Vec<_>>().join("; ")
}

fn shape(section: &SectionShape) -> String {
    match section {
        SectionShape::Tube { radius, thickness } => {
            format!("tube of radius {}, wall {}", short(*radius, 6), short(*thickness, 6))
        }
        SectionShape::Polygon(vertices) => format!("polygon of {} walls", vertices.len()),
    }
}

fn material(material: &Material) -> String {
    let Material { youngs_modulus, poissons_ratio, yield_stress, ultimate_stress } = *material;
    let [modulus, ratio] = [youngs_modulus, poissons_ratio].map(|number| short(number, 6));
    let strength = |word: &str, stress: Option<f64>| match stress {
        Some(stress) => format!("{word} at {}", short(stress, 6)),
        None => format!("{word} at an unknown stress"),
    };
    let (yields, breaks) = (strength("yields", yield_stress), strength("breaks", ultimate_stress));
    format!("material: Young's modulus {modulus}, Poisson's ratio {ratio}, {yields}, {breaks}")
}
