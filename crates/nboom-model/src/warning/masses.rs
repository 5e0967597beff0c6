//! Masses of which double precision cannot hold the sum.

use super::ModelWarning;
use crate::{BodyName, Scene};

/// Masses that differ by more are probably a slip of a unit; what is left of sixteen digits is seven.
const UNEQUAL: f64 = 1e9;

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let main = (BodyName::MainBody, scene.main_body.mass);
    let hinged = scene.bodies.iter().enumerate();
    let hinged =
        hinged.map(|(i, body)| (BodyName::Segment(scene.label(i)), body.mass_properties.mass));
    // Rings and wheels are without mass.
    let all: Vec<_> = [main].into_iter().chain(hinged).filter(|(_, mass)| *mass > 0.0).collect();
    let by_mass = |a: &&(_, f64), b: &&(_, f64)| a.1.total_cmp(&b.1);
    let (Some(least), Some(largest)) = (all.iter().min_by(by_mass), all.iter().max_by(by_mass))
    else {
        return Vec::new();
    };
    if largest.1 / least.1 <= UNEQUAL {
        return Vec::new();
    }
    vec![ModelWarning::UnequalMasses { least: least.clone(), largest: largest.clone() }]
}
