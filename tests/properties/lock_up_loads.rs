//! Impulses and peaks of lock-ups of random trees: balances, latches, joint lock-ups.

use nalgebra::DVector;
use nboom::dynamics::{Impulses, Struck};
use nboom::loads::{LoadSet, Loads, LockUpShare, VelocityChange};
use nboom::scalar::{Twist, Vec3};

use crate::loads::{Sliced, main_body, of_all, on_main_body};
use crate::newton_euler::vector;
use crate::random_scene::Moment;
use crate::{Prepared, relative};

/// What a lock-up changes; all for every hinge of the scene.
struct Locked {
    jump: Jump,
    /// What each locking hinge alone would change.
    shares: Vec<(usize, Jump)>,
    /// Impulses of the latches.
    latches: Vec<f64>,
}

/// Locks about half of the free hinges.
fn lock(case: &Sliced) -> Option<Locked> {
    let mut prepared = Prepared::new(&case.moment);
    let count = case.tau_dot.len();
    let free = prepared.dynamics.free_hinges().to_vec();
    let locking: Vec<usize> = (0..free.len()).step_by(2).collect();
    locking.first()?;
    let (beta, tau) = (prepared.beta.clone(), prepared.tau.clone());
    let mut lock_up = Impulses::of_none();
    let struck: Vec<_> = locking.iter().copied().map(Struck::locks).collect();
    let locked = prepared.dynamics.strike(&beta, &tau, &struck, &mut lock_up);
    locked.expect("bodies have inertia");
    let mut latches = vec![0.0; count];
    locking.iter().zip(&lock_up.torques).for_each(|(&p, &impulse)| latches[free[p]] = impulse);
    let factored = prepared.mass_matrix().cholesky().expect("positive definite");
    let alone = |(&p, &impulse): (&usize, &f64)| {
        let mut right = DVector::zeros(6 + free.len());
        right[6 + p] = impulse;
        (free[p], Jump::new(factored.solve(&right).as_slice(), &free, count))
    };
    let shares = locking.iter().zip(&lock_up.torques).map(alone).collect();
    let Impulses { delta_velocity_body: v, delta_omega_body: w, delta_tau, .. } = lock_up;
    let all = [&v.to_array()[..], &w.to_array(), &delta_tau].concat();
    Some(Locked { jump: Jump::new(&all, &free, count), shares, latches })
}

struct Jump {
    origin_body: Vec3<f64>,
    omega_body: Vec3<f64>,
    tau: Vec<f64>,
}

impl Jump {
    /// From (ΔV, Δω, Δτ) with τ of the free hinges.
    fn new(values: &[f64], free: &[usize], count: usize) -> Self {
        let part = |at: usize| Vec3::new(values[at], values[at + 1], values[at + 2]);
        Self { origin_body: part(0), omega_body: part(3), tau: of_all(free, &values[6..], count) }
    }

    fn change(&self) -> VelocityChange<'_> {
        let Self { origin_body, omega_body, tau } = self;
        VelocityChange { origin_body: *origin_body, omega_body: *omega_body, tau }
    }
}

#[test]
fn impulses_balance_and_are_the_latches_impulses_about_the_axes() {
    let mut seen = 0;
    for case in Sliced::all() {
        let Some(Locked { jump, latches, .. }) = lock(&case) else { continue };
        let Moment { scene, mode, beta, .. } = &case.moment;
        let mut finder = Loads::new(scene, Some(&case.structure));
        let mut found = finder.load_set();
        finder.impulses(beta, &jump.change(), &mut found);
        let jump = Twist { angular: jump.omega_body, linear: jump.origin_body };
        let momenta = main_body(scene).inertia_wrench(Vec3::zero(), jump);
        let [(force, force_size), (moment, moment_size)] =
            on_main_body(scene, &case.placed(), &found);
        for (found, expected, size) in
            [(force, momenta.force, force_size), (moment, momenta.moment, moment_size)]
        {
            let residual = (found - vector(expected)).norm();
            assert!(residual < 1e-12 * (size + expected.norm()), "{residual} of {size}");
        }
        let residual = finder.largest_torque_residual(&found, &mode.hinges, &latches);
        let (hinge, residual) = residual.expect("one is free");
        assert!(residual < 1e-12, "{residual} at hinge {hinge}");
        seen += 1;
    }
    assert!(seen > 50, "{seen} cases with a lock-up");
}

#[test]
fn shares_of_a_joint_lock_up_have_their_own_pulses() {
    let mut joint = 0;
    for case in Sliced::all() {
        let Some(Locked { jump, shares, latches }) = lock(&case) else { continue };
        let Moment { scene, mode, beta, .. } = &case.moment;
        let count = scene.bodies.len();
        let mut finder = Loads::new(scene, Some(&case.structure));
        let mut whole = finder.load_set();
        finder.impulses(beta, &jump.change(), &mut whole);
        let share = |pulse_constant: f64, jump| LockUpShare { pulse_constant, jump };
        // With one pulse for all, peaks are the whole jump's impulses over its constant.
        let alike: Vec<_> = shares.iter().map(|(_, jump)| share(0.2, jump.change())).collect();
        let mut peaks = finder.load_set();
        finder.add_lock_up(beta, &alike, 1.0, &mut peaks);
        let flat = |loads: &LoadSet, factor: f64| {
            let all =
                (0..count).flat_map(|i| loads.stations(i).iter().copied().chain([loads.hinge(i)]));
            let entries =
                all.flat_map(|w| w.moment.to_array().into_iter().chain(w.force.to_array()));
            DVector::from_iterator(entries.clone().count(), entries.map(|entry| factor * entry))
        };
        assert!(relative(&flat(&peaks, 0.2), &flat(&whole, 1.0)) < 1e-11);
        // With pulses of their own, the moment about each axis is that of its own latch.
        let constant = |i: usize| case.structure.segments()[i].pulse_constant;
        let own = shares.iter().map(|(i, jump)| share(constant(*i), jump.change()));
        let own: Vec<_> = own.collect();
        let mut peaks = finder.load_set();
        finder.add_lock_up(beta, &own, 1.5, &mut peaks);
        let torques: Vec<f64> = (0..count).map(|i| 1.5 / constant(i) * latches[i]).collect();
        let (_, residual) =
            finder.largest_torque_residual(&peaks, &mode.hinges, &torques).expect("one is free");
        assert!(residual < 1e-11, "{residual}");
        joint += usize::from(shares.len() > 1);
    }
    assert!(joint > 20, "{joint} joint lock-ups");
}
