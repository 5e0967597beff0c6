use nboom_loads::{LoadEquations, LoadSet, Loads};
use nboom_model::{Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment};
use nboom_scalar::{Mat3, Sym3, Vec3};

use super::*;

/// A ball on a ball, and the gauges of its hinge, along the axes of the ball alone or of both.
fn hinge_about(axis: Option<Vec3<f64>>) -> (LoadSet, [Gauge; 2]) {
    let ball = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("a ball on a ball", ball, 1.0);
    let segments = vec![Segment { length: 1.0, mass_properties: ball, hinge: Hinge::free() }];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    let scene = Scene::new(description).expect("balls are bodies");
    let loads = Loads::by(LoadEquations::new(&scene, None)).load_set();
    let gauges = Gauge::of_hinge(0, &loads, axis);
    (loads, gauges)
}

fn hinge() -> (LoadSet, [Gauge; 2]) {
    hinge_about(None)
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

/// Loads of one hinge that are known but for a share of rounding; all numbers are alike.
struct Rounded<F> {
    law: F,
    rounding: f64,
    evaluations: usize,
    largest: f64,
}

impl<F: Fn(f64) -> f64> Rounded<F> {
    fn new(rounding: f64, law: F) -> Self {
        Self { law, rounding, evaluations: 0, largest: f64::NEG_INFINITY }
    }

    /// Searches an interval, and returns how many evaluations that took.
    fn search(&mut self, span: [f64; 2]) -> usize {
        let (loads, [gauge, _]) = hinge();
        let before = self.evaluations;
        Search::new(vec![gauge], loads.count()).over(span, self).expect("numbers");
        self.evaluations - before
    }

    /// The largest of the three numbers whose length the gauge is.
    fn largest_number(&self) -> f64 {
        self.largest / 3.0_f64.sqrt()
    }
}

/// From -1 to 1, another one for each number.
fn noise(u: f64) -> f64 {
    let mixed = u.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl<F: Fn(f64) -> f64> Loaded for Rounded<F> {
    fn write(&mut self, u: f64, row: &mut [f64]) -> Result<(), StrengthError> {
        self.evaluations += 1;
        row.fill((self.law)(u) + self.rounding * noise(u));
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
}

#[test]
fn rounding_is_not_searched_to_the_end() {
    for rounding in [0.0, 1e-10, 1e-6, 1e-4, 1e-2] {
        let mut loads = Rounded::new(rounding, |u| (3.0 * u).sin());
        let first = loads.search([0.0, 1.0]);
        assert!(first < 500, "{rounding}: {first}");
        // Three equal components, of which each is 1 at most.
        let off = loads.largest_number() - 1.0;
        assert!(off.abs() < 1e-8 + 2.0 * rounding, "{rounding}: {off}");
        let mut others = 0;
        for step in 0..100 {
            let from = 0.52 + 1e-3 * f64::from(step);
            others += loads.search([from, from + 1e-3]);
        }
        assert!(others < 6000, "{rounding}: {others}");
    }
}

/// A law of a program's own jumps where no step ends, once or several times in a step, and falls from there.
#[test]
fn jumps_are_searched_to_the_end_though_loads_are_rounded() {
    let step_of = |u: f64, every: f64| (u / every).fract();
    for rounding in [0.0, 1e-10, 1e-6, 1e-4] {
        for at in 1..200 {
            let at = f64::from(at) / 200.0 + 0.001_234;
            let law = |u: f64| if u < at { 0.3 } else { (5.0 * (at - u)).exp() };
            let mut loads = Rounded::new(rounding, law);
            loads.search([0.0, 1.0]);
            let off = loads.largest_number() - 1.0;
            assert!(off.abs() < 2e-3 + rounding, "{rounding}, {at}: {off}");
        }
        for every in [0.5, 0.25, 0.211, 0.1, 0.051_7, 0.01] {
            let mut loads = Rounded::new(rounding, |u| 1.0 - 0.2 * step_of(u, every) + 0.1 * u);
            loads.search([0.0, 1.0 - 1e-9]);
            let last = (1.0_f64 / every).ceil() - 1.0;
            let expected = 1.0 + 0.1 * last * every;
            let off = loads.largest_number() - expected;
            assert!(off.abs() < 2e-3 + rounding, "{rounding}, {every}: {off}");
        }
    }
}

/// One that is just where rounding is measured.
#[test]
fn a_jump_at_a_probe_is_no_rounding() {
    for probe in PROBES {
        let at = 0.5 + 0.5 * probe;
        let law = |u: f64| if u < at { 0.3 } else { (5.0 * (at - u)).exp() };
        let mut loads = Rounded::new(0.0, law);
        loads.search([0.0, 1.0]);
        let off = loads.largest_number() - 1.0;
        assert!(off.abs() < 2e-3, "{probe}: {off}");
    }
}

/// The force of a hinge that turns its body about x at a rate.
struct Turning {
    rate: f64,
    evaluations: usize,
    largest: f64,
    /// When that is, and the force then, along axes that do not turn.
    at: (f64, Vec3<f64>),
}

impl Turning {
    /// Along axes that do not turn; largest where y is 1.
    fn force(u: f64) -> Vec3<f64> {
        Vec3::new(0.1, (0.5 * u + 1.2).sin(), 0.2)
    }

    fn rotation(&self, u: f64) -> Mat3<f64> {
        Mat3::about_axis(Vec3::unit_x(), self.rate * u)
    }
}

impl Loaded for Turning {
    fn write(&mut self, u: f64, row: &mut [f64]) -> Result<(), StrengthError> {
        self.evaluations += 1;
        row.fill(0.0);
        row[..3].copy_from_slice(&self.rotation(u).transpose_mul(Self::force(u)).to_array());
        row[row.len() - 1] = self.rate * u;
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
        gauge: &Gauge,
        value: f64,
        u: f64,
        row: &[f64],
    ) -> Result<(), StrengthError> {
        self.largest = value;
        self.at = (u, self.rotation(u) * gauge.load(row).force);
        Ok(())
    }
}

#[test]
fn a_body_that_turns_fast_takes_no_more_evaluations() {
    for rate in [0.0, 1.0, 400.0, 1e6] {
        let (loads, [force, _]) = hinge_about(Some(Vec3::unit_x()));
        let at = (f64::NAN, Vec3::zero());
        let mut turning = Turning { rate, evaluations: 0, largest: f64::NEG_INFINITY, at };
        let width = loads.count() + 1;
        Search::new(vec![force], width).over([0.0, 1.0], &mut turning).expect("numbers");
        assert_eq!(turning.evaluations, FINE, "{rate}");
        let off = turning.largest - 1.05_f64.sqrt();
        assert!(off.abs() < 1e-8, "{rate}: {off}");
        // The polynomials are that good; of an angle of 1e6 the rounding is less.
        let (u, found) = turning.at;
        assert!((found - Turning::force(u)).norm() < 1e-8, "{rate}: {found:?}");
    }
}
