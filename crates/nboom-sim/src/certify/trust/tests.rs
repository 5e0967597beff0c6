use super::*;
use crate::equations::totals::Totals;

#[test]
fn digits_are_counted_down_from_sixteen() {
    let count = |difference| Digits { quantity: "x", difference }.count();
    assert_eq!([0.0, 1e-20, 2e-10, 0.99e-9, 0.5, 1.0, 7.0].map(count), [16, 16, 9, 9, 0, 0, 0]);
    assert_eq!(count(f64::NAN), 0);
}

fn lock_up(impulse: f64) -> Event {
    let none = Totals {
        kinetic_energy: 1.0,
        linear_momentum_inertial: Vec3::zero(),
        angular_momentum_inertial: Vec3::zero(),
    };
    Event {
        time: 1.0,
        kind: EventKind::LockUp,
        hinge: Some(0),
        impulse: Some(impulse),
        before: none,
        after: none,
    }
}

/// The largest values of a run in which a wheel turned fast and a boom swung a little, for 100 time units.
fn wheel_and_boom() -> Scales {
    let hinges = vec![1.0, 1.0];
    Scales {
        time: 100.0,
        omega: 1.0,
        beta: vec![6e5, 7e-4],
        tau: vec![6e3, 4e-6],
        rho: 1.0,
        v: 1.0,
        impulse: 1.0,
        of_hinges: hinges,
        force: 1.0,
        moment: 1.0,
    }
}

#[test]
fn each_hinge_is_measured_by_itself() {
    let at = |beta: [f64; 2], tau: [f64; 2]| Snapshot {
        beta: beta.to_vec(),
        tau: tau.to_vec(),
        ..Snapshot::empty()
    };
    let (run, truth) = (at([6e5, 7.07e-4], [6e3, 4.04e-6]), at([6e5, 7e-4], [6e3, 4e-6]));
    let found = differences(&run, &truth, &wheel_and_boom());
    let of = |quantity| found.iter().find(|of| of.quantity == quantity).expect("all are there");
    // A hundredth of the boom's own, to rounding, and not 1e-11 of the wheel's.
    for quantity in ["beta", "tau"] {
        let difference = of(quantity).difference;
        assert!((difference - 0.01).abs() < 1e-12, "{quantity}: {difference:e}");
    }
}

#[test]
fn a_clock_that_counts_from_long_ago_knows_fewer_digits() {
    let after = |start: f64| {
        let event = Event { time: start + 2.75, ..lock_up(1.0) };
        compare(start, &event, &event, &wheel_and_boom()).time.count()
    };
    // Of 2.75, to a quarter of the spacing of f64 at the time: 2^-25 near 1e9, 2^-15 near 1e12.
    assert_eq!([0.0, 1e9, 1e12].map(after), [16, 7, 4]);
}

#[test]
fn a_run_that_fails_has_no_end() {
    let mut witness = Witness::new();
    witness.sample(&Snapshot::empty()).expect("it is kept");
    witness.event(&lock_up(1.0), &Snapshot::empty()).expect("it is kept");
    assert_eq!(witness.end(), None);
    let end = Event { kind: EventKind::End, hinge: None, impulse: None, ..lock_up(1.0) };
    witness.event(&end, &Snapshot::empty()).expect("it is kept");
    assert_eq!(witness.end(), Some(&Snapshot::empty()));
}

#[test]
fn impulses_differ_in_shares_of_their_size() {
    let of_one = Scales {
        time: 1.0,
        omega: 1.0,
        beta: vec![1.0],
        tau: vec![1.0],
        rho: 1.0,
        v: 1.0,
        impulse: 1.0,
        of_hinges: vec![1.0],
        force: 1.0,
        moment: 1.0,
    };
    let found = compare(0.0, &lock_up(-4003.0), &lock_up(-4000.0), &of_one);
    let impulse = found.impulse.expect("both have one");
    // 3 of 4000, and a rounding.
    assert!((impulse.difference - 7.5e-4).abs() < 1e-18, "{}", impulse.difference);
}
