//! The largest von Mises stress is attained and nowhere exceeded.

use std::f64::consts::TAU;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, PointStress, Polygon, Section, Tube, WallStress, report};
use proptest::prelude::*;

use super::random::{cases, description, load};

/// Samples of a wall or of a circle. Between neighbours the curve departs from its maximum by at
/// most its curvature times the square of half a step: relative 1e-3, far more than rounding.
const SAMPLES: u32 = 400;

/// Rounding of a stress computed twice.
const ROUNDING: f64 = 1e-12;

fn samples(polygon: &Polygon, load: &Wrench<f64>) -> Vec<PointStress> {
    let stresses = polygon.stresses(load);
    let places = |wall| (0..=SAMPLES).map(move |i| (wall, f64::from(i) / f64::from(SAMPLES)));
    let all = (0..polygon.walls().len()).flat_map(places);
    all.map(|(wall, x)| stresses.at(wall, x)).collect()
}

fn largest(samples: impl IntoIterator<Item = f64>) -> f64 {
    samples.into_iter().fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn of_polygons(description in description(), load in load()) {
        let polygon = description.polygon();
        let sampled = largest(samples(&polygon, &load).iter().map(|s| s.stress.von_mises()));
        let worst = Section::Polygon(polygon.clone()).stresses(&load).max_von_mises();
        let found = worst.stress.von_mises();
        prop_assert!(sampled <= found * (1.0 + ROUNDING), "{sampled} above {found}");
        prop_assert!(sampled >= found * (1.0 - 1e-3), "{sampled} far below {found}");
        let wall = &polygon.walls()[worst.wall.expect("of a polygon")];
        let way = worst.place - wall.start();
        let x = way.xi.hypot(way.zeta) / wall.length();
        prop_assert!(x <= 1.0 + ROUNDING);
    }

    /// Also where the maximum of a wall is not that of the section.
    #[test]
    fn of_walls(normal in prop::array::uniform2(-9.0..9.0), shear in prop::array::uniform3(-9.0..9.0)) {
        let square = |x: f64| {
            let (sigma, tau) = (normal[0] + x * normal[1], shear[0] + x * (shear[1] + x * shear[2]));
            sigma * sigma + 3.0 * tau * tau
        };
        let direction = Point { xi: 1.0, zeta: 0.0 };
        let x = WallStress { normal, shear, direction }.max_von_mises();
        let sampled = largest((0..=SAMPLES).map(|i| square(f64::from(i) / f64::from(SAMPLES))));
        prop_assert!((0.0..=1.0).contains(&x));
        prop_assert!(sampled <= square(x) * (1.0 + ROUNDING));
    }

    #[test]
    fn of_tubes(radius in 0.1..5.0, ratio in 0.001..1.0, load in load()) {
        let tube = Tube::new(radius, ratio * radius).expect("a tube");
        let stresses = tube.stresses(&load);
        let angles = || (0..4 * SAMPLES).map(|i| TAU * f64::from(i) / f64::from(4 * SAMPLES));
        let sampled = largest(angles().map(|theta| stresses.at(theta).stress.von_mises()));
        let found = stresses.at(stresses.max_von_mises()).stress.von_mises();
        prop_assert!(sampled <= found * (1.0 + ROUNDING), "{sampled} above {found}");
        prop_assert!(sampled >= found * (1.0 - 1e-3), "{sampled} far below {found}");

        let of_report = |theta: f64| report::tube_stress(&stresses, theta).von_mises();
        let sampled = largest(angles().map(of_report));
        let found = of_report(report::max_von_mises_of_tube(&stresses));
        prop_assert!(sampled <= found * (1.0 + ROUNDING), "{sampled} above {found}");
    }

    /// The square of a stress may overflow or vanish where the stress does not.
    #[test]
    fn of_loads_of_any_size(description in description(), load in load(), power in -250..250) {
        let section = Section::Polygon(description.polygon());
        let tube = Section::Tube(Tube::new(1.0, 0.1).expect("a tube"));
        let factor = 10.0_f64.powi(power);
        let scaled = Wrench { force: load.force * factor, moment: load.moment * factor };
        for section in [section, tube] {
            let stresses = section.stresses(&scaled);
            let found = stresses.max_von_mises().stress.von_mises() / factor;
            let right = section.stresses(&load).max_von_mises().stress.von_mises();
            prop_assert!((found - right).abs() <= ROUNDING * right, "{found} and {right}");
            prop_assert!(!stresses.is_at_most((1.0 - ROUNDING) * right * factor));
            // Far more than what bounds may leave open.
            prop_assert!(stresses.is_at_most(1.5 * right * factor));
            prop_assert!(!stresses.is_at_most(-right * factor) && !stresses.is_at_most(f64::NAN));
        }
    }

    /// Largest and smallest stress over all directions of a face.
    #[test]
    fn principal_stresses(description in description(), load in load(), angle in 0.0..TAU) {
        let stress = Section::Polygon(description.polygon()).stresses(&load).max_von_mises().stress;
        let [most, least] = stress.principal();
        let (sin, cos) = angle.sin_cos();
        let on_face = stress.normal * cos * cos + 2.0 * stress.shear() * sin * cos;
        let rounding = ROUNDING * stress.von_mises();
        prop_assert!(on_face <= most + rounding && on_face >= least - rounding);
        // Invariants of the tensor: trace and determinant.
        prop_assert!((most + least - stress.normal).abs() <= rounding);
        let determinant = most * least + stress.shear().powi(2);
        prop_assert!(determinant.abs() <= rounding * stress.von_mises());
    }
}

#[test]
fn without_a_load_there_is_no_stress() {
    let tube = Section::Tube(Tube::new(2.0, 0.05).expect("a tube"));
    let nothing = Wrench { force: Vec3::zero(), moment: Vec3::zero() };
    assert_eq!(tube.stresses(&nothing).max_von_mises().stress.von_mises(), 0.0);
}
