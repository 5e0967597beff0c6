//! Runs that integrate momenta: trajectories of the references by every method, and H̄_c that stays
//! where it is.

use nboom::formulation::Formulation;
use nboom::scalar::Vec3;
use nboom::sim::{Form, Method, Options, Path};

use crate::catalog::Reference;
use crate::collect::{run, tight};
use crate::compare::compare;
use crate::trajectories::agrees;

fn with(integrator: Method, samples: usize) -> Options {
    let formulation = Some(Form::Closed(Formulation::Momentum));
    Options { path: Path::Generic, formulation, integrator, ..tight(samples) }
}

#[test]
fn every_method_follows_the_references() {
    // The long spin is for orders that are high.
    for reference in Reference::all().filter(|reference| reference.name != "s11_long_spin") {
        for integrator in [Method::Dopri5, Method::Dop853, Method::Gauss] {
            let options = with(integrator, reference.intervals());
            let (found, summary) = run(&reference.scene(), &options);
            agrees(integrator.name(), &found, &reference);
            assert!(summary.selections.iter().all(|of| of.formulation == "momentum"));
        }
        // Its polynomial between the ends of a step is of order 3 alone.
        let options = with(Method::Radau5, reference.intervals());
        let deviation = compare(&run(&reference.scene(), &options).0, &reference);
        assert!(deviation.states < 1e-8, "{}: {deviation}", reference.name);
    }
}

/// The velocities of a state are solved for, H̄_c is summed over the bodies again and turned: a few
/// dozen roundings on the scale of the bodies' own momenta, however many steps a run takes and
/// whatever they err.
const ROUNDING: f64 = 20.0 * f64::EPSILON;

#[test]
fn the_angular_momentum_stays_where_it_is() {
    for reference in Reference::all() {
        let scene = reference.scene();
        for rtol in [1e-6, 1e-12] {
            let options = Options { rtol, ..with(Method::Auto, reference.intervals()) };
            let (_, summary) = run(&scene, &options);
            let balance = summary.conservation.angular_momentum.expect("a free main body");
            println!("{} {rtol:e}: {balance:e}", reference.name);
            assert!(balance < ROUNDING, "{}: {balance:e}", reference.name);
        }
    }
}

/// A lock-up leaves H̄_c and the momenta of the other hinges; the run goes on from these.
#[test]
fn lock_ups_leave_the_angular_momentum() {
    let reference = Reference::load("report_testcase");
    let (found, _) = run(&reference.scene(), &with(Method::Auto, 1));
    let momentum: Vec<Vec3<f64>> =
        found.events.iter().map(|(_, after)| after.angular_momentum_inertial).collect();
    let apart = |h: &Vec3<f64>| (*h - momentum[0]).norm() / momentum[0].norm();
    let worst = momentum.iter().map(apart).fold(0.0, f64::max);
    assert!(found.events.len() > 10 && worst < ROUNDING, "{worst:e}");
}
