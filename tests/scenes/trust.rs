//! What a certificate says is off against what is off.

use nboom::scalar::Vec3;
use nboom::sim::{Options, Witness, simulate, trust};

use crate::catalog::Reference;
use crate::compare::{hinge_of, kind_of};
use crate::support::{number, numbers};

/// Errors of the reference run itself, and of what 80-bit arithmetic is compared with.
const ROUND_OFF: f64 = 1e-10;

/// A thousand times tighter, a reference is off by some hundredths of the error at most.
fn close(said: f64, found: f64) -> bool {
    (said - found).abs() < 0.1 * found + ROUND_OFF
}

#[test]
fn differences_from_a_tighter_run_are_the_errors() {
    let (mut events, mut large) = (0, 0);
    for reference in Reference::all() {
        let scene = reference.scene();
        let options = Options { rtol: 1e-6, atol: 1e-7, samples: 1, ..Options::default() };
        let mut witness = Witness::new();
        simulate(&scene, &options, &mut witness).expect("every scene runs to its end");
        let said = trust(&scene, &options, &witness).expect("the reference runs, too");
        assert!(said.same_events, "{}", reference.name);

        for event in &said.events {
            let is_it = |other: &&serde_json::Value| {
                kind_of(other) == event.event.kind
                    && hinge_of(other) == event.event.hinge
                    && (number(other, "time") - event.event.time).abs() < 1e-3
            };
            // A release at the initial time is none of the oracle's.
            let Some(truth) = reference.events.iter().find(is_it) else { continue };
            let since = number(truth, "time") - scene.initial.time;
            let off =
                (event.event.time - number(truth, "time")).abs() / since.max(f64::MIN_POSITIVE);
            assert!(close(event.time.difference, off), "{}: {off:e} {event:?}", reference.name);
            events += 1;
            large += usize::from(off > 100.0 * ROUND_OFF);
        }

        let last = reference.samples.last().expect("there are samples");
        let omega = numbers(&last["omega"]);
        let truth = Vec3::new(omega[0], omega[1], omega[2]);
        let ours = witness.end().expect("the run has ended").omega_body;
        let difference =
            (ours - truth).to_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let off = difference / omega.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let said = said.end.iter().find(|digits| digits.quantity == "omega").expect("a row");
        assert!(close(said.difference, off), "{}: {off:e} {said:?}", reference.name);
    }
    assert!(events > 40 && large > 5, "{events} events, {large} of them off by much");
}
