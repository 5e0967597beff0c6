use nboom_loads::{LoadEquations, LoadSet, Loads};
use nboom_model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
use nboom_scalar::{Sym3, Vec3};

use super::*;

/// A ball on a ball, and the gauges of its hinge.
fn hinge() -> (LoadSet, [Gauge; 2]) {
    let ball = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("a ball on a ball", ball, 1.0);
    let segments = vec![Segment { length: 1.0, mass_properties: ball, hinge: Hinge::free() }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    let scene = Scene::new(description).expect("balls are bodies");
    let loads = Loads::by(LoadEquations::new(&scene, None)).load_set();
    let gauges = Gauge::of_hinge(0, &loads);
    (loads, gauges)
}

#[test]
fn a_curve_that_overflows_is_not_halved() {
    let (_, [gauge, _]) = hinge();
    let (basis, places) = (Basis::new(), nodes::places());
    let numbers = places.map(|x| [1e308 * (0.5 + x); 6]);
    let coefficients = basis.coefficients(&numbers);
    assert!(coefficients.iter().flatten().any(|number| number.is_nan()));
    let (mut largest, mut at) = (1.0, None);
    let curve = Curve { basis: &basis, places: &places, gauge: &gauge };
    let found = &mut (&mut largest, &mut at);
    curve.climb(&coefficients, &numbers, [0.0, 1.0], 0, 0.0, found);
    assert_eq!((largest, at), (f64::INFINITY, Some(0.0)));
}

/// Loads of one hinge that are known but for a share of rounding.
struct Rounded {
    rounding: f64,
    evaluations: usize,
    largest: f64,
    reach: f64,
}

impl Loaded for Rounded {
    fn write(&mut self, u: f64, row: &mut [f64]) -> Result<(), StrengthError> {
        self.evaluations += 1;
        let noise = (1e9 * u).sin();
        row.fill((3.0 * u).sin() * (1.0 + self.rounding * noise));
        Ok(())
    }

    fn largest(&self, _: usize) -> f64 {
        self.largest
    }

    fn largest_of_kind(&self, _: usize) -> f64 {
        self.largest
    }

    fn keep(
        &mut self,
        _: usize,
        _: &Gauge,
        value: f64,
        _: f64,
        _: &[f64],
    ) -> Result<(), StrengthError> {
        self.largest = value;
        Ok(())
    }

    fn may_reach(&mut self, _: usize, value: f64) {
        self.reach = self.reach.max(value);
    }
}

#[test]
fn rounding_is_not_searched_to_the_end() {
    let (loads, [gauge, _]) = hinge();
    for rounding in [0.0, 1e-10, 1e-6, 1e-4, 1e-2] {
        let none = f64::NEG_INFINITY;
        let mut loaded = Rounded { rounding, evaluations: 0, largest: none, reach: none };
        let mut search = Search::new(vec![gauge.clone()], loads.count());
        search.over([0.0, 1.0], &mut loaded).expect("numbers");
        let first = loaded.evaluations;
        for step in 1..100 {
            let from = 1e-3 * f64::from(step);
            search.over([0.52 + from, 0.52 + from + 1e-3], &mut loaded).expect("numbers");
        }
        assert!(loaded.evaluations - first < 1200, "{rounding}: {}", loaded.evaluations);
        let Rounded { largest, reach, .. } = loaded;
        assert!(first < 500, "{rounding}: {first}");
        // Three equal components, of which each is 1 at most.
        let off = largest / 3.0_f64.sqrt() - 1.0;
        assert!(off.abs() < 1e-8 + 2.0 * rounding, "{rounding}: {off}");
        let missed = reach / largest - 1.0;
        assert!(rounding < 1e-8 || missed > 0.1 * rounding, "{rounding}: {missed}");
        assert_eq!(reach > largest, rounding > 1e-8, "{rounding}: {missed}");
    }
}
