//! A torque-free asymmetric top over a thousand turns against Jacobi's solution of Euler's
//! equations (Landau and Lifshitz, Mechanics, §37), rates and attitude.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, Unit};
use nboom::model::{MassProperties, SceneDescription};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::{Method, Options};

use super::jacobi::{complete, sn_cn_dn};
use super::log::{Log, options, run};
use super::newton_euler::{matrix, vector};
use super::random_scene::Rng;

/// Rates about the principal axes, moments in rising or falling order: the middle one is zero
/// at time zero, the last one never changes sign.
struct Top {
    moments: [f64; 3],
    amplitudes: [f64; 3],
    /// du/dt of the elliptic functions.
    rate: f64,
    parameter: f64,
}

impl Top {
    /// The top with rates (first, 0, last) at time zero, circling the last axis.
    fn new(moments: [f64; 3], first: f64, last: f64) -> Self {
        let [i1, i2, i3] = moments;
        let momentum_squared = (i1 * first).powi(2) + (i3 * last).powi(2);
        let twice_energy = i1 * first * first + i3 * last * last;
        let (of_12, of_3) =
            (twice_energy * i3 - momentum_squared, momentum_squared - twice_energy * i1);
        let middle = (of_12 / (i2 * (i3 - i2))).sqrt();
        // With the moments falling instead of rising the middle rate has the other sign.
        let middle = if i1 < i3 { middle } else { -middle };
        Self {
            moments,
            amplitudes: [first, middle, last],
            rate: ((i3 - i2) * of_3 / (i1 * i2 * i3)).sqrt(),
            parameter: (i2 - i1) * of_12 / ((i3 - i2) * of_3),
        }
    }

    fn omega(&self, t: f64) -> [f64; 3] {
        let (sn, cn, dn) = sn_cn_dn(self.rate * t, self.parameter);
        let [a, b, c] = self.amplitudes;
        [a * cn, b * sn, c * dn]
    }

    fn momentum(&self) -> f64 {
        let [a, _, c] = self.amplitudes;
        (self.moments[0] * a).hypot(self.moments[2] * c)
    }

    /// The time after which the rates repeat.
    fn period(&self) -> f64 {
        4.0 * complete(self.parameter) / self.rate
    }

    /// The angle about the angular momentum by which the attitude has turned after a period:
    /// the mean of dφ/dt = |H| (I₁ω₁² + I₂ω₂²) / (I₁²ω₁² + I₂²ω₂²), which is periodic, so that
    /// equally spaced points give it to rounding.
    fn turn_of_a_period(&self) -> f64 {
        let points = 400;
        let slope = |n: i32| {
            let [a, b, _] = self.omega(self.period() * f64::from(n) / f64::from(points));
            let [ia, ib, _] = self.moments;
            (ia * a * a + ib * b * b) / ((ia * a).powi(2) + (ib * b).powi(2))
        };
        let mean = (0..points).map(slope).sum::<f64>() / f64::from(points);
        self.momentum() * mean * self.period()
    }
}

/// The top with its principal axes along any axes of the main body.
fn compare(top: &Top, seed: u64) {
    let dice = &mut Rng::new(seed);
    let axes = dice.rotation();
    let [i1, i2, i3] = top.moments;
    let inertia = Sym3::diagonal(i1, i2, i3).rotated(&axes);
    // The mass centre off O: the motion of O must not enter.
    let body = MassProperties::new(3.0, dice.vector(2.0), inertia);
    let typical = top.momentum() / i2;
    // A thousand turns, rounded to whole periods.
    let periods = (1000.0 * TAU / typical / top.period()).round();
    let mut scene = SceneDescription::at_rest("top", body, periods * top.period());
    scene.initial.attitude = dice.attitude();
    scene.initial.omega_body = axes * Vec3::from(top.omega(0.0));
    // At 1e-13 rounding takes over: some 30 000 steps, each off by 1e-16, and near the separatrix
    // the phase of later turns magnifies that to 1e-8.
    for rtol in [1e-11, 1e-12] {
        follow(top, &scene, &axes, &options(2000, rtol), periods * top.turn_of_a_period());
    }
    let gauss = Options { integrator: Method::Gauss, ..options(2000, 1e-11) };
    let log = follow(top, &scene, &axes, &gauss, periods * top.turn_of_a_period());
    // The norm of the attitude walks with some 1e4 roundings; momentum comes from no integration.
    let (drift, momentum) = (
        log.summary.attitude_drift,
        log.summary.conservation.angular_momentum.expect("a free main body"),
    );
    assert!(drift < 1e-13, "norm: {drift:e}");
    assert!(momentum < 1e-14, "angular momentum: {momentum:e}");
}

/// Runs the scene and compares: rates at all output times, the attitude at the end, after
/// turning by `turn` about the angular momentum, and the angular momentum always.
fn follow(
    top: &Top,
    scene: &SceneDescription,
    axes: &Mat3<f64>,
    options: &Options,
    turn: f64,
) -> Log {
    let log = run(scene, options);
    let h = log.samples[0].angular_momentum_inertial;
    let typical = top.momentum() / top.moments[1];
    let (mut worst, mut worst_h) = (0.0_f64, 0.0_f64);
    for seen in &log.samples {
        let expected = *axes * Vec3::from(top.omega(seen.time));
        worst = worst.max((seen.omega_body - expected).norm() / typical);
        worst_h = worst_h.max((seen.angular_momentum_inertial - h).norm() / h.norm());
    }
    // Steps of less than 1/40 turn, each in error by rtol at most, all in the same sense;
    // twice that because an error in energy shifts the phase of all later steps. The bound
    // falls with rtol, which the error of a wrong equation would not.
    let steps = log.summary.steps_accepted;
    assert!(steps < 80_000, "{steps} steps");
    let allowed = 2.0 * steps as f64 * options.rtol;
    assert!(worst < allowed, "omega: {worst:e} of {allowed:e}");
    let turned = Rotation3::from_axis_angle(&Unit::new_normalize(vector(h)), turn.rem_euclid(TAU));
    let expected = turned.matrix() * matrix(&log.samples[0].attitude.to_matrix());
    let error = (matrix(&log.last().attitude.to_matrix()) - expected).amax();
    assert!(error < allowed, "attitude: {error:e} of {allowed:e}");
    // Most of an error is phase, which changes no momentum.
    assert!(worst_h < 0.01 * allowed, "angular momentum: {worst_h:e} of {allowed:e}");
    log
}

#[test]
fn circling_the_axis_of_largest_inertia() {
    compare(&Top::new([1.0, 2.0, 2.6], 0.7, 0.9), 1);
}

#[test]
fn circling_the_axis_of_smallest_inertia() {
    compare(&Top::new([2.6, 2.0, 1.0], 0.5, 1.3), 2);
}

#[test]
fn near_the_separatrix() {
    // Almost all of a turn near one axis, then over to the other side quickly.
    let top = Top::new([1.0, 2.0, 2.6], 1.0, 0.802);
    assert!((0.99..1.0).contains(&top.parameter), "{}", top.parameter);
    compare(&top, 3);
}

#[test]
fn the_closed_form_solves_eulers_equations() {
    for top in [Top::new([1.0, 2.0, 2.6], 0.7, 0.9), Top::new([2.6, 2.0, 1.0], 0.5, 1.3)] {
        let [i1, i2, i3] = top.moments;
        for t in [0.0, 0.3, 2.9, 71.0] {
            let h = 1e-5;
            let ([a, b, c], [am, bm, cm], [ap, bp, cp]) =
                (top.omega(t), top.omega(t - h), top.omega(t + h));
            // Second differences err by h² and by rounding over h, both below 1e-10.
            for (found, expected) in [
                ((ap - am) / (2.0 * h), (i2 - i3) / i1 * b * c),
                ((bp - bm) / (2.0 * h), (i3 - i1) / i2 * c * a),
                ((cp - cm) / (2.0 * h), (i1 - i2) / i3 * a * b),
            ] {
                assert!((found - expected).abs() < 1e-8, "{t}: {found} {expected}");
            }
        }
    }
}

/// Steps too long for six digits: of one body the residual is the way of the angular momentum in shares
/// of it.
#[test]
fn what_angular_momentum_loses_is_told() {
    let top = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 2.0, 2.9));
    let mut description = SceneDescription::at_rest("top", top, 20.0);
    description.initial.omega_body = Vec3::new(0.9, 1.0, -0.7);
    let found = run(&description, &Options { integrator: Method::Dopri5, ..options(200, 1e-4) });
    let at = |i: usize| found.samples[i].angular_momentum_inertial;
    let off = |i: usize| (at(i) - at(0)).norm() / at(0).norm();
    let largest = (0..found.samples.len()).map(off).fold(0.0, f64::max);
    let told = found.summary.conservation.angular_momentum.expect("a free main body");
    assert!(largest > 1e-6, "{largest:e}");
    // Shares of the momentum then and at first differ by the share itself.
    assert!((told / largest - 1.0).abs() < 1e-2, "{told:e} {largest:e}");
}
