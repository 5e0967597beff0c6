//! Numbers that differ only by rounding of runs.

use nboom_study::statistics::{Role, Statistics, SummaryColumn};
use nboom_tables::Cell;

use crate::{field, uniform};

/// Statistics of a result that is `around + size * x` of a variable x, which is uniform.
fn of_result(label: &str, around: f64, size: f64) -> SummaryColumn {
    of_runs_within(0.0, (label, around, size))
}

/// Likewise, of runs with a relative tolerance.
fn of_runs_within(rtol: f64, (label, around, size): (&str, f64, f64)) -> SummaryColumn {
    let fields = vec![field("x", Role::Variable), field(label, Role::Result)];
    let mut statistics = Statistics::new(fields, &[]).of_runs_within(rtol);
    for x in uniform(4).take(300) {
        statistics.row(&[Cell::Number(x), Cell::Number(around + size * x)]);
    }
    statistics.finish().columns.swap_remove(1)
}

#[test]
fn nothing_drives_a_result_that_differs_by_rounding_only() {
    for label in ["lock_time of boom", "final omega_x"] {
        for around in [5.0_f64, -5.0, 5e-7] {
            let size = |share: f64| around.abs() * share;
            for share in [0.0, 1e-13, 5e-11] {
                let found = of_result(label, around, size(share));
                assert_eq!(found.drivers, [], "{label} {around} {share}");
                assert!(found.is_constant);
                let histogram = found.histogram.expect("numbers");
                assert_eq!(histogram.counts, [300], "{label} {around} {share}");
            }
            // What is above the tenth digit is of the motion.
            let found = of_result(label, around, size(2e-10));
            let [driver] = found.drivers[..] else { panic!("one variable") };
            assert!((driver.coefficient - 1.0).abs() < 1e-4, "{driver:?}");
            assert!(!found.is_constant);
            assert!(found.histogram.expect("numbers").counts.len() > 1);
        }
    }
    // Of a number with both signs it is the size of the larger that counts.
    assert_eq!(of_result("final omega_x", -1e-15, 2e-15).drivers.len(), 1);
}

#[test]
fn nothing_drives_a_result_that_differs_by_errors_of_its_runs() {
    let drivers = |rtol: f64, share: f64| {
        let found = of_runs_within(rtol, ("final omega_x", 5.0, 5.0 * share));
        assert_eq!(found.is_constant, found.drivers.is_empty());
        found.drivers.len()
    };
    let of_tolerance = [(1e-9, 9e-8, 2e-7), (1e-6, 9e-5, 2e-4)];
    // However tight and however loose it is.
    let bounds = [(1e-14, 5e-11, 2e-10), (1e-2, 9e-4, 2e-3)];
    for (rtol, errors, more) in of_tolerance.into_iter().chain(bounds) {
        assert_eq!((drivers(rtol, errors), drivers(rtol, more)), (0, 1), "{rtol:e}");
    }
}

#[test]
fn counts_have_no_errors() {
    let fields = vec![field("x", Role::Variable), field("evaluations", Role::Result)];
    let mut statistics = Statistics::new(fields, &[]).of_runs_within(1e-6);
    for x in uniform(4).take(300) {
        statistics.row(&[Cell::Number(x), Cell::Number((1e6 + 50.0 * x).round())]);
    }
    let column = statistics.finish().columns.swap_remove(1);
    assert!(!column.is_constant && column.drivers.len() == 1, "{column:?}");
}

/// A latch that does not close differs from all that do.
#[test]
fn what_keeps_a_latch_open_drives_one_that_closes_at_one_time() {
    let fields = vec![field("x", Role::Variable), field("lock_time of boom", Role::Result)];
    let mut statistics = Statistics::new(fields, &[]);
    for (number, x) in (0..400).zip(uniform(4)) {
        let noise = 1e-13 * f64::from((number * 37) % 100);
        let time = if x < 0.5 { Cell::Number(2.0 + noise) } else { Cell::Empty };
        statistics.row(&[Cell::Number(x), time]);
    }
    let found = statistics.finish().columns.swap_remove(1);
    let [driver] = found.drivers[..] else { panic!("one variable") };
    // Ranks from 0 to 1 have the variance 1/12, two ties of one half each 1/16, their covariance is 1/16: 0.866, of 400
    // draws to 0.02 or so.
    assert!((driver.coefficient - 0.75_f64.sqrt()).abs() < 0.03, "{driver:?}");
    assert_eq!(
        found.histogram.expect("times").counts.iter().filter(|count| **count > 0).count(),
        1
    );
}

/// Points of what is drawn are exact, however close they lie.
#[test]
fn numbers_that_are_drawn_are_told_apart_as_they_are() {
    let fields = vec![field("x", Role::Variable), field("final omega_x", Role::Result)];
    let mut statistics = Statistics::new(fields, &[]);
    for x in uniform(4).take(300) {
        statistics.row(&[Cell::Number(1e9 + 1e-2 * x), Cell::Number(x)]);
    }
    let found = statistics.finish();
    let [driver] = found.columns[1].drivers[..] else { panic!("one variable") };
    assert!(driver.coefficient > 0.999, "{driver:?}");
}
