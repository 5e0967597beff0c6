//! Rotors whose speeds change after the end of the run.

use super::ModelWarning;
use crate::{Rotor, RotorSpeed, Scene};

pub(super) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let end = scene.end_time;
    let late = |rotor: &Rotor| {
        let RotorSpeed::Table(points) = &rotor.speed else { return None };
        let mut changes = points.windows(2).filter(|pair| pair[0][1] != pair[1][1]);
        let from = changes.find(|pair| pair[0][0] >= end)?[0][0];
        Some(ModelWarning::SpeedAfterEnd { body: scene.body_name(rotor.body), from, end })
    };
    scene.rotors.iter().filter_map(late).collect()
}

#[cfg(test)]
mod tests {
    use nboom_scalar::{Sym3, Vec3};

    use super::*;
    use crate::{MassProperties, SceneDescription};

    fn told(speed: RotorSpeed) -> Vec<String> {
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let mut description = SceneDescription::at_rest("wheel", body, 5.0);
        let axis = Vec3::unit_x();
        description.rotors = vec![Rotor { body: None, axis, inertia: 0.1, speed }];
        let warnings = Scene::new(description).expect("a scene").warnings();
        warnings.iter().map(ToString::to_string).collect()
    }

    fn table(points: &[[f64; 2]]) -> Vec<String> {
        told(RotorSpeed::Table(points.to_vec()))
    }

    #[test]
    fn a_rotor_that_changes_its_speed_after_the_end_is_told() {
        for points in [&[[5.0, 1.0], [6.0, 2.0]][..], &[[0.0, 0.5], [5.0, 1.0], [6.0, 2.0]]] {
            let expected = "rotor on the main body: a change of speed from 5.0 on found, one before the end of the \
                            run at 5.0 expected";
            assert_eq!(table(points), [expected]);
        }
    }

    #[test]
    fn one_that_changes_it_up_to_the_end_or_never_is_not() {
        assert_eq!(told(RotorSpeed::Constant(2.0)), [""; 0]);
        assert_eq!(table(&[[0.0, 1.0], [4.0, 2.0], [9.0, 3.0]]), [""; 0]);
        assert_eq!(table(&[[0.0, 1.0], [4.0, 2.0], [6.0, 2.0], [9.0, 2.0]]), [""; 0]);
    }
}
