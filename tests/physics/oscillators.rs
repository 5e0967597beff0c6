//! One hinge whose axis passes through both mass centres: the two bodies turn against each
//! other like one with the reduced inertia J₁J₂/(J₁ + J₂), and eq. (6.1) has closed forms.

use nboom::model::{
    Body, Dashpot, Hinge, HingeStart, HingeState, Joint, MassProperties, Mount, SceneDescription,
    Spring,
};
use nboom::scalar::{Sym3, Vec3};

use super::jacobi::sn_cn_dn;
use super::log::{options, run};
use super::random_scene::Rng;

const J_MAIN: f64 = 5.0;
const J_BOOM: f64 = 2.0;
const REDUCED: f64 = J_MAIN * J_BOOM / (J_MAIN + J_BOOM);

/// Rates at rtol 1e-12 over a few dozen steps; dense output between them is of order seven and
/// errs ten times as much as the steps.
const CLOSE: f64 = 1e-10;

/// An inertia whose principal axis `along` has the moment `j`.
fn inertia_about(along: Vec3<f64>, j: f64) -> Sym3<f64> {
    Sym3::diagonal(1.5 * j, 1.5 * j, 1.5 * j) + Sym3::outer(along) * (-0.5 * j)
}

/// Two bodies whose common axis points anywhere, turning about it together as well.
pub fn scene(
    spring: Spring,
    dashpot: Dashpot,
    angle: f64,
    rate: f64,
    end: f64,
) -> SceneDescription {
    let dice = &mut Rng::new(11);
    let along = dice.direction();
    let off = dice.vector(1.0);
    let main_body = MassProperties::new(7.0, off, inertia_about(along, J_MAIN));
    let mut scene = SceneDescription::at_rest("oscillator", main_body, end);
    let mount = Mount { point: off + along * 0.8, rot_inboard_from_hinge: dice.rotation() };
    let axis = mount.rot_inboard_from_hinge.transpose_mul(along);
    let boom = MassProperties::new(3.0, axis * 0.6, inertia_about(axis, J_BOOM));
    let start = HingeStart { angle, rate, state: HingeState::Free };
    let hinge = Hinge { spring, dashpot, start, ..Hinge::free() };
    let tip = Vec3::zero();
    let joint = Joint::Revolute;
    scene.bodies.push(Body {
        inboard: None,
        mount,
        joint,
        axis,
        mass_properties: boom,
        tip,
        hinge,
    });
    scene.initial.attitude = dice.attitude();
    scene.initial.velocity_inertial = dice.vector(2.0);
    scene.initial.omega_body = along * 0.37;
    scene
}

/// Compares angle and rate with `expected`, at 100 times; angles and rates of order one.
fn compare(scene: &SceneDescription, expected: impl Fn(f64) -> (f64, f64)) {
    let log = run(scene, &options(100, 1e-12));
    let spin = scene.initial.omega_body;
    let along = spin * (1.0 / spin.norm());
    for seen in &log.samples {
        let (beta, tau) = expected(seen.time);
        assert!((seen.beta[0] - beta).abs() < CLOSE, "{}: {} {beta}", seen.time, seen.beta[0]);
        assert!((seen.tau[0] - tau).abs() < CLOSE, "{}: {} {tau}", seen.time, seen.tau[0]);
        // The main body takes the other share: J₁ ω + J₂ (ω + τ) is constant.
        let started = scene.bodies[0].hinge.start.rate;
        let omega = spin + along * ((started - tau) * J_BOOM / (J_MAIN + J_BOOM));
        assert!((seen.omega_body - omega).norm() < CLOSE);
    }
}

fn start(scene: &SceneDescription) -> (f64, f64) {
    let start = scene.bodies[0].hinge.start;
    (start.angle, start.rate)
}

#[test]
fn linear_spring() {
    let spring = Spring { quadratic: 0.0, linear: -3.0, preload_angle: 0.4 };
    let scene = scene(spring, Dashpot::default(), 0.9, -0.5, 20.0);
    let (beta, tau) = start(&scene);
    let w = (3.0 / REDUCED).sqrt();
    compare(&scene, |t| {
        let ((s, c), x) = ((w * t).sin_cos(), beta + 0.4);
        (x * c + tau / w * s - 0.4, tau * c - x * w * s)
    });
}

#[test]
fn linear_spring_and_dashpot() {
    // Spring and the dashpot's own spring term act in parallel, each from its preload angle.
    let spring = Spring { quadratic: 0.0, linear: -2.0, preload_angle: 0.4 };
    let (rate_linear, angle_linear) = (-0.3, -1.0);
    let dashpot = Dashpot { rate_linear, angle_linear, preload_angle: -0.2, ..Dashpot::default() };
    let scene = scene(spring, dashpot, 0.9, -0.5, 20.0);
    let (beta, tau) = start(&scene);
    let rest = -(2.0 * 0.4 - 1.0 * 0.2) / 3.0;
    let decay = 0.15 / REDUCED;
    let w = (3.0 / REDUCED - decay * decay).sqrt();
    compare(&scene, |t| {
        let ((s, c), x) = ((w * t).sin_cos(), beta - rest);
        let (fade, b) = ((-decay * t).exp(), (tau + decay * x) / w);
        let at = fade * (x * c + b * s);
        (at + rest, -decay * at + fade * w * (b * c - x * s))
    });
}

#[test]
fn overdamped() {
    let spring = Spring { quadratic: 0.0, linear: -1.0, preload_angle: 0.0 };
    let dashpot = Dashpot { rate_linear: -6.0, ..Dashpot::default() };
    let scene = scene(spring, dashpot, 1.0, 0.8, 20.0);
    let (beta, tau) = start(&scene);
    let half = 3.0 / REDUCED;
    let root = (half * half - 1.0 / REDUCED).sqrt();
    let (slow, fast) = (-half + root, -half - root);
    let of_fast = (tau - slow * beta) / (fast - slow);
    compare(&scene, |t| {
        let (a, b) = ((beta - of_fast) * (slow * t).exp(), of_fast * (fast * t).exp());
        (a + b, slow * a + fast * b)
    });
}

#[test]
fn quadratic_dashpot() {
    // I dτ/dt = q₁ τ²; with this sign it brakes a positive rate.
    let q1 = -0.8;
    let dashpot = Dashpot { rate_quadratic: q1, ..Dashpot::default() };
    let scene = scene(Spring::default(), dashpot, 0.3, 1.4, 20.0);
    let (beta, tau) = start(&scene);
    compare(&scene, |t| {
        let slower = 1.0 - q1 * tau * t / REDUCED;
        (beta - REDUCED / q1 * slower.ln(), tau / slower)
    });
}

#[test]
fn constant_torque() {
    // A spring so soft that its preload alone counts: κ₂ θ = 0.5 with κ₂ β below 1e-12 of it.
    let spring = Spring { quadratic: 0.0, linear: 5e-16, preload_angle: 1e15 };
    let scene = scene(spring, Dashpot::default(), 0.2, -1.0, 10.0);
    let (beta, tau) = start(&scene);
    let a = 0.5 / REDUCED;
    // Angles here grow to 25, so that rounding and tolerance are those of 25.
    let log = run(&scene, &options(10, 1e-12));
    for seen in &log.samples {
        let t = seen.time;
        assert!((seen.beta[0] - (beta + tau * t + 0.5 * a * t * t)).abs() < 25.0 * CLOSE);
        assert!((seen.tau[0] - (tau + a * t)).abs() < 10.0 * CLOSE);
    }
}

#[test]
fn quadratic_spring() {
    // I x'' = κ₁x² + κ₂x with x = β + θ swings between the two lower of three turning points:
    // x = e₁ + (e₂ − e₁) sn²(√(κ₁(e₃ − e₁)/6I) t).
    let (e1, e2, e3, k1) = (-0.6, 1.0, 1.5, 0.9);
    let spring =
        Spring { quadratic: k1, linear: -2.0 / 3.0 * k1 * (e1 + e2 + e3), preload_angle: 0.25 };
    let scene = scene(spring, Dashpot::default(), e1 - 0.25, 0.0, 30.0);
    let w = (k1 * (e3 - e1) / (6.0 * REDUCED)).sqrt();
    let m = (e2 - e1) / (e3 - e1);
    compare(&scene, |t| {
        let (sn, cn, dn) = sn_cn_dn(w * t, m);
        (e1 + (e2 - e1) * sn * sn - 0.25, 2.0 * (e2 - e1) * sn * cn * dn * w)
    });
}

#[test]
fn quadratic_dashpot_angle_term() {
    // q₃(β + γ)² + q₄(β + γ) is the same law as the spring's, from its own preload angle.
    let spring = Spring { quadratic: 0.9, linear: -1.14, preload_angle: 0.25 };
    let dashpot = Dashpot {
        angle_quadratic: 0.9,
        angle_linear: -1.14,
        preload_angle: 0.25,
        ..Dashpot::default()
    };
    let (angle, rate, end) = (-0.85, 0.0, 10.0);
    let by_spring = run(&scene(spring, Dashpot::default(), angle, rate, end), &options(20, 1e-12));
    let by_dashpot = run(&scene(Spring::default(), dashpot, angle, rate, end), &options(20, 1e-12));
    for (a, b) in by_spring.samples.iter().zip(&by_dashpot.samples) {
        // Equal to rounding, which the steps may magnify a little.
        assert!((a.beta[0] - b.beta[0]).abs() < 1e-13);
    }
}
