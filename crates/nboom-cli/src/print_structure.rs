//! What the stresses of a scene are computed for.

use nboom_io::SceneFile;
use nboom_model::{Material, SectionShape, SegmentStructure, Station, Structure};

use crate::format::{count, short};

/// Stations, sections and materials, for people to read; numbers to six digits.
pub(crate) fn text(file: &SceneFile) -> String {
    let Some(structure) = file.structure.as_ref().filter(|structure| structure.has_stations())
    else {
        return "stresses: none; the scene has no stations\n".to_owned();
    };
    let mut lines = vec![heading(structure)];
    let bodies = file.scene.labels().iter().zip(&file.scene.bodies);
    for (segment, (label, body)) in structure.segments().iter().zip(bodies) {
        if segment.stations.is_empty() {
            continue;
        }
        lines.push(format!("  segment {label}: {}", stations(segment)));
        lines.push(format!("    {}", material(&segment.material)));
        if body.hinge.lock_angle.is_some() {
            let pulse = short(segment.pulse_constant, 6);
            lines.push(format!("    lock-up pulse: impulse over peak {pulse}"));
        }
    }
    lines.join("\n") + "\n"
}

fn heading(structure: &Structure) -> String {
    let counts = structure.segments().iter().map(|segment| segment.stations.len());
    let segments = counts.clone().filter(|&stations| stations > 0).count();
    let stations = count(counts.sum(), "station", "stations");
    format!("stresses: at {stations} of {}", count(segments, "segment", "segments"))
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
