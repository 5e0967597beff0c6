//! What of a motion is more than rounding.

use nboom_model::Scene;

use crate::Run;
use crate::table::Table;

/// Share of what the energy could make of it below which a momentum is rounding.
const NO_MOMENTUM: f64 = 1e-7;

/// Share of the fastest hinge's rate below which a rate is rounding.
const NO_RATE: f64 = 1e-9;

impl Run {
    /// Whether the angular momentum of the motion is more than rounding, so that nutation means something.
    pub fn has_momentum(&self) -> bool {
        self.motion().is_some_and(|motion| !is_rounding(motion, Momentum::Angular))
    }

    /// The angular rate below which one is rounding beside those of the hinges.
    pub fn least_rate(&self) -> f64 {
        let Some(motion) = self.motion() else { return 0.0 };
        let hinges = self.hinges().into_iter().filter(|hinge| !hinge.slides);
        let rates = hinges.filter_map(|hinge| motion.column(&format!("tau_{}", hinge.key)));
        NO_RATE * rates.flatten().fold(0.0, |most: f64, rate| most.max(rate.abs()))
    }
}

/// What a scene tells of the momenta that its motion could have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes {
    mass: f64,
    /// From a body's joint to its ends.
    reach: f64,
}

impl Sizes {
    pub fn of(scene: &Scene) -> Self {
        let masses = scene.bodies.iter().map(|body| body.mass_properties.mass);
        let reaches = scene.bodies.iter().map(|body| body.tip.norm() + body.mount.point.norm());
        let mass = scene.main_body.mass + masses.sum::<f64>();
        Self { mass, reach: reaches.fold(0.0, f64::max) }
    }
}

/// A momentum of a motion as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Momentum {
    Linear,
    Angular,
}

/// Whether only rounding moves a column, since it has a momentum, or hangs on one, that is zero as a whole.
pub(crate) fn of_no_momentum(motion: &Table) -> impl Fn(&str) -> bool {
    let [linear, angular] =
        [Momentum::Linear, Momentum::Angular].map(|momentum| is_rounding(motion, momentum));
    move |name| {
        linear && name.starts_with("linear_momentum_")
            || angular && (name.starts_with("angular_momentum_") || name == "nutation")
    }
}

/// Whether a momentum of the motion is nothing but rounding, or is not known.
fn is_rounding(motion: &Table, momentum: Momentum) -> bool {
    let name = match momentum {
        Momentum::Linear => "linear_momentum",
        Momentum::Angular => "angular_momentum",
    };
    let parts = ["x", "y", "z"].map(|axis| motion.column(&format!("{name}_{axis}")));
    let [Some(x), Some(y), Some(z)] = parts else { return true };
    let sizes = (0..x.len()).map(|row| x[row].hypot(y[row]).hypot(z[row]));
    let largest = sizes.fold(0.0, f64::max);
    let (Some(Sizes { mass, reach }), Some(energy)) =
        (motion.sizes, motion.column("kinetic_energy"))
    else {
        return largest == 0.0;
    };
    let energy = energy.iter().copied().fold(0.0, f64::max);
    let arm = if momentum == Momentum::Angular { reach } else { 1.0 };
    largest <= NO_MOMENTUM * arm * (2.0 * mass * energy).sqrt()
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
        let mut motion = motion("angular_momentum");
        // 5 J could be 3 m √(2 · 10 kg · 5 J) = 30 N m s.
        for (largest, expected) in [(2.9e-6, true), (3.1e-6, false)] {
            motion.push(&[0.0, 0.0, -largest, 0.0, 5.0]);
            assert_eq!(is_rounding(&motion, Momentum::Angular), expected, "{largest:e}");
        }
        assert!(is_rounding(&motion, Momentum::Linear), "there are no columns of it");
        motion.sizes = None;
        assert!(!is_rounding(&motion, Momentum::Angular));
        let mut motion = self::motion("linear_momentum");
        // 5 J could be √(2 · 10 kg · 5 J) = 10 N s.
        for (largest, expected) in [(0.9e-6, true), (1.1e-6, false)] {
            motion.push(&[0.0, largest, 0.0, 0.0, 5.0]);
            assert_eq!(is_rounding(&motion, Momentum::Linear), expected, "{largest:e}");
        }
    }

    fn motion(momentum: &str) -> Table {
        let parts = ["x", "y", "z"].map(|axis| format!("{momentum}_{axis}"));
        let names = ["t".to_owned()].into_iter().chain(parts).chain(["kinetic_energy".to_owned()]);
        Table { sizes: Some(Sizes::of(&scene())), ..Table::new(names.collect()) }
    }
}
