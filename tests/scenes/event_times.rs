//! Event times do not depend on where steps end.

use nboom::sim::{Method, Options};

use crate::catalog::Reference;
use crate::collect::run;
use crate::support::number;

/// Of the time since the start; the references' own event times are known to 6e-14, most of them to
/// 5e-15.
const TIMES: f64 = 1e-12;

/// The largest difference of an event's time from the reference, in units of the time since the
/// start.
fn worst(reference: &Reference, options: &Options) -> f64 {
    let (found, _) = run(&reference.scene(), options);
    let start = number(&reference.samples[0], "t");
    let happenings = found.happenings();
    assert_eq!(happenings.len(), reference.events.len(), "{}", reference.name);
    let pairs = happenings.iter().zip(&reference.events);
    let off = pairs.map(|(found, expected)| {
        let time = number(expected, "time");
        (found.2 - time).abs() / (time - start).max(f64::MIN_POSITIVE)
    });
    off.fold(0.0, f64::max)
}

#[test]
fn event_times_are_within_1e_minus_12_whatever_the_steps() {
    for reference in Reference::all() {
        for rtol in [1e-12, 3e-13, 1e-13] {
            // Steps as long as the error allows, and shorter ones of no special length.
            for parts in [1.0, 101.7, 311.3, 1999.9] {
                let max_step = reference.time_span() / parts;
                let options = Options {
                    samples: 1,
                    integrator: Method::Dop853,
                    rtol,
                    atol: 0.1 * rtol,
                    max_step,
                    ..Options::default()
                };
                let off = worst(&reference, &options);
                println!("{} {rtol:e} {parts}: {off:.1e}", reference.name);
                assert!(off < TIMES, "{} {rtol:e} {parts}: {off:e}", reference.name);
            }
        }
    }
}
