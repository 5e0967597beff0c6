//! A smaller tolerance gives a smaller error, until rounding is reached.

use nboom::sim::Options;

use crate::catalog::Reference;
use crate::collect::run;
use crate::compare::{Deviation, compare};

/// Where rounding takes over: 2e-16 in each of some thousand steps, times what a run amplifies.
const ROUND_OFF: f64 = 1e-11;

fn deviation(reference: &Reference, rtol: f64) -> Deviation {
    let samples = reference.intervals();
    let options = Options { samples, rtol, atol: 0.1 * rtol, ..Options::default() };
    compare(&run(&reference.scene(), &options).0, reference)
}

#[test]
fn the_error_follows_the_tolerance_down_to_rounding() {
    for reference in Reference::all() {
        let tolerances = [1e-6, 1e-8, 1e-10, 1e-12];
        let found = tolerances.map(|rtol| deviation(&reference, rtol).states);
        println!("{}: {found:?}", reference.name);
        for (errors, tolerance) in found.windows(2).zip(&tolerances[1..]) {
            // A hundred times smaller a tolerance must take away at least four fifths of the
            // error: a steady method takes away ninety-nine hundredths, and the share that falls
            // to single components in single scenes varies.
            let follows = errors[1] < 0.2 * errors[0] || errors[1] < ROUND_OFF;
            assert!(follows, "{} at {tolerance:e}: {found:?}", reference.name);
        }
        assert!(found[0] > ROUND_OFF, "{}: a tolerance of 1e-6 changes nothing", reference.name);
    }
}
