//! How far closed forms on `f64` are from the recursive path in double-double, which shares only
//! spatial algebra with them.

use nboom::formulation::report::OriginMotion;
use nboom::formulation::{Formulation, Recognised, report};
use nboom::scalar::DoubleDouble;

use crate::random_scene::Rng;
use crate::satellites::{Satellite, exact, flat, random};

const SATELLITES: u64 = 1000;

/// Largest error of an acceleration, relative to the largest acceleration.
fn error(found: &[f64], exact: &[DoubleDouble]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let scale = exact.iter().fold(0.0_f64, |most, number| most.max(number.to_f64().abs()));
    let off = |(f, e): (&f64, &DoubleDouble)| (DoubleDouble::from(*f) - *e).to_f64().abs() / scale;
    found.iter().zip(exact).map(off).fold(0.0, f64::max)
}

/// For each random satellite the errors of all formulations, and what rounding allows.
fn errors() -> Vec<([f64; 5], f64)> {
    let of_satellite = |seed: u64| {
        let moment = random(seed);
        let satellite = Satellite::of_moment(&moment);
        let recognised = satellite.recognised();
        let Recognised { topology, parameters, links, .. } = &recognised;
        let coordinates = satellite.coordinates_of(&recognised);
        let exact = exact(&moment, links);
        let errors = Formulation::ALL.map(|formulation| {
            error(&flat(&formulation.solve(topology, parameters, &coordinates)), &exact)
        });
        let unknowns = 6.0 + topology.hinges() as f64;
        (errors, unknowns * f64::EPSILON * satellite.condition())
    };
    (0..SATELLITES).map(of_satellite).collect()
}

/// Worst and median error of each formulation that the documents give.
fn documented() -> Vec<(String, f64, f64)> {
    let document = include_str!("../../docs/formulations.md");
    let (_, rest) = document.split_once("<!-- errors -->\n").expect("a begin mark");
    let (table, _) = rest.split_once("<!-- end of errors -->").expect("an end mark");
    let row = |line: &str| {
        let (name, figures) = line.strip_prefix("| `")?.split_once("` | ")?;
        let (worst, median) = figures.trim_end_matches(" |").split_once(" | ")?;
        Some((name.to_owned(), worst.parse().ok()?, median.parse().ok()?))
    };
    table.lines().filter_map(row).collect()
}

#[test]
fn errors_are_rounding_times_condition() {
    for (seed, (errors, rounding)) in errors().into_iter().enumerate() {
        for (error, formulation) in errors.into_iter().zip(Formulation::ALL) {
            // Elimination of n unknowns without growth is off by at most about n ε κ, and the
            // rounding of matrix and right side by a few ε κ.
            assert!(error < 4.0 * rounding, "seed {seed}, {formulation}: {error:e}, {rounding:e}");
        }
    }
}

#[test]
fn errors_are_those_of_the_table() {
    let all = errors();
    let documented = documented();
    assert_eq!(documented.len(), Formulation::ALL.len());
    for (i, formulation) in Formulation::ALL.into_iter().enumerate() {
        let mut of_formulation: Vec<f64> = all.iter().map(|(errors, _)| errors[i]).collect();
        of_formulation.sort_by(f64::total_cmp);
        let (worst, median) = (of_formulation[all.len() - 1], of_formulation[all.len() / 2]);
        let (name, worst_there, median_there) = &documented[i];
        assert_eq!(name, formulation.name());
        for (found, expected) in [(worst, worst_there), (median, median_there)] {
            // Sines of other libraries may round otherwise.
            let ratio = found / expected;
            assert!(
                (0.5..2.0).contains(&ratio),
                "{name}: {found:e} found, {expected:e} documented"
            );
        }
    }
}

const DISTANCES: [f64; 6] = [0.0, 1.0, 1e2, 1e4, 1e6, 1e8];
const FAR_SATELLITES: u64 = 60;

/// Worst error of `articulated`, and of `report` with |ρ̄| and |v̄| up to each distance, of satellites
/// whose rates are so many times as fast.
fn errors_away_from_the_origin(faster: f64) -> Vec<f64> {
    let mut worst = vec![0.0_f64; 1 + DISTANCES.len()];
    for seed in 0..FAR_SATELLITES {
        let mut moment = random(seed);
        moment.omega = moment.omega * faster;
        moment.tau.iter_mut().for_each(|tau| *tau *= faster);
        let satellite = Satellite::of_moment(&moment);
        let recognised = satellite.recognised();
        let Recognised { topology, parameters, links, .. } = &recognised;
        let coordinates = satellite.coordinates_of(&recognised);
        let exact = exact(&moment, links);
        let articulated = Formulation::Articulated.solve(topology, parameters, &coordinates);
        let dice = &mut Rng::new(seed);
        let (rho, v) = (dice.vector(1.0), dice.vector(1.0));
        let of_report = DISTANCES.map(|distance| {
            let place = OriginMotion { rho: rho * distance, v: v * distance };
            report::solve(topology, parameters, &coordinates, &place)
        });
        for (worst, found) in worst.iter_mut().zip([articulated].iter().chain(&of_report)) {
            *worst = worst.max(error(&flat(found), &exact));
        }
    }
    worst
}

#[test]
fn the_report_loses_as_many_digits_as_the_origin_is_far() {
    for faster in [1.0, 1e3] {
        let errors = errors_away_from_the_origin(faster);
        let shown: Vec<String> = errors.iter().map(|error| format!("{error:.1e}")).collect();
        println!("rates times {faster}: {}", shown.join(" | "));
        let (near, far) = (errors[1], &errors[3..]);
        // The forms that do not know where O is are where `report` is near it, at any rate.
        assert!(errors[0] < near && near < 1e-13, "{shown:?}");
        // Satellites measure about one, and what cancels is as long as ρ̄ beside them.
        for (error, distance) in far.iter().zip(&DISTANCES[2..]) {
            let lost = error / (distance * f64::EPSILON);
            assert!((1.0..1e2).contains(&lost), "{distance:e}: {error:e}");
        }
    }
}
