//! What of a motion is more than rounding.

use nboom_model::Scene;

use crate::Run;
use crate::table::Table;

/// Share of what the energy could make of it below which an angular momentum is rounding.
const NO_MOMENTUM: f64 = 1e-7;

/// Share of the fastest hinge's rate below which a rate is rounding.
const NO_RATE: f64 = 1e-9;

impl Run {
    /// Whether the angular momentum of the motion is more than rounding, so that nutation means something.
    pub fn has_momentum(&self) -> bool {
        self.motion().is_some_and(|motion| has_momentum(motion, self.scene()))
    }

    /// The angular rate below which one is rounding beside those of the hinges.
    pub fn least_rate(&self) -> f64 {
        let Some(motion) = self.motion() else { return 0.0 };
        let hinges = self.hinges().into_iter().filter(|hinge| !hinge.slides);
        let rates = hinges.filter_map(|hinge| motion.column(&format!("tau_{}", hinge.key)));
        NO_RATE * rates.flatten().fold(0.0, |most: f64, rate| most.max(rate.abs()))
    }
}

fn has_momentum(motion: &Table, scene: Option<&Scene>) -> bool {
    let parts = ["x", "y", "z"].map(|axis| motion.column(&format!("angular_momentum_{axis}")));
    let [Some(x), Some(y), Some(z)] = parts else { return false };
    let sizes = (0..x.len()).map(|row| x[row].hypot(y[row]).hypot(z[row]));
    let largest = sizes.fold(0.0, f64::max);
    let (Some(scene), Some(energy)) = (scene, motion.column("kinetic_energy")) else {
        return largest > 0.0;
    };
    let masses = scene.bodies.iter().map(|body| body.mass_properties.mass);
    let mass = scene.main_body.mass + masses.sum::<f64>();
    let reaches = scene.bodies.iter().map(|body| body.tip.norm() + body.mount.point.norm());
    let energy = energy.iter().copied().fold(0.0, f64::max);
    largest > NO_MOMENTUM * reaches.fold(0.0, f64::max) * (2.0 * mass * energy).sqrt()
}

#[cfg(test)]
mod tests {
    use nboom_model::{Appendage, Hinge, MassProperties, Mount, SceneDescription, Segment};
    use nboom_scalar::{Sym3, Vec3};

    use super::*;

    /// A boom of 2 m on a mount 1 m out; 10 kg in all.
    fn scene() -> Scene {
        let body = |mass| MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let mut description = SceneDescription::at_rest("boom", body(8.0), 1.0);
        let segment = Segment { length: 2.0, mass_properties: body(2.0), hinge: Hinge::free() };
        let mount = Mount::at(Vec3::unit_y());
        description.attach(&Appendage::Regular { mount, segments: vec![segment] });
        Scene::new(description).expect("the bodies are physical")
    }

    #[test]
    fn momentum_is_rounding_beside_what_the_energy_could_make_of_it() {
        let names = ["t", "angular_momentum_x", "angular_momentum_y", "angular_momentum_z"];
        let names = names.into_iter().chain(["kinetic_energy"]).map(str::to_owned).collect();
        let mut motion = Table::new(names);
        // 5 J could be 3 m √(2 · 10 kg · 5 J) = 30 N m s.
        for (largest, expected) in [(2.9e-6, false), (3.1e-6, true)] {
            motion.push(&[0.0, 0.0, -largest, 0.0, 5.0]);
            assert_eq!(has_momentum(&motion, Some(&scene())), expected, "{largest:e}");
        }
        assert!(has_momentum(&motion, None));
        assert!(!has_momentum(&Table::new(vec!["t".to_owned()]), None));
    }
}
