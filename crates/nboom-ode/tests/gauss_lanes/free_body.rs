//! A free body, against elliptic functions and its momentum.

use nboom_ode::{GaussLanes, Stepper, System};

use crate::{distance, follow, tolerance};

/// A free body of these principal moments of inertia: attitude, then angular velocity.
struct Body;

const MOMENTS: [f64; 3] = [1.0, 2.0, 2.6];

impl System for Body {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let [a, b, c] = MOMENTS;
        let (&[s, x, y, z], &[p, q, r]) = (&[y[0], y[1], y[2], y[3]], &[y[4], y[5], y[6]]);
        dy[0] = -0.5 * (x * p + y * q + z * r);
        dy[1] = 0.5 * (s * p + y * r - z * q);
        dy[2] = 0.5 * (s * q + z * p - x * r);
        dy[3] = 0.5 * (s * r + x * q - y * p);
        dy[4] = (b - c) / a * q * r;
        dy[5] = (c - a) / b * r * p;
        dy[6] = (a - b) / c * p * q;
    }
}

/// Jacobi's sn, cn and dn of parameter m (arithmetic and geometric means).
fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let mut means = vec![(1.0_f64, m.sqrt())];
    let mut b = (1.0 - m).sqrt();
    while means.last().is_some_and(|(_, c)| *c > 1e-17) {
        let (a, _) = means[means.len() - 1];
        means.push((0.5 * (a + b), 0.5 * (a - b)));
        b = (a * b).sqrt();
    }
    let mut phi = (1_u32 << (means.len() - 1)) as f64 * means[means.len() - 1].0 * u;
    for (a, c) in means[1..].iter().rev() {
        phi = 0.5 * (phi + (c / a * phi.sin()).asin());
    }
    let sn = phi.sin();
    [sn, phi.cos(), (1.0 - m * sn * sn).sqrt()]
}

/// ω of the body about its axes that starts with ω = (p, 0, r), its squared momentum below twice its
/// energy times the second moment (Landau and Lifshitz, Mechanics, chapter VI, axes counted backwards).
fn turning([p, r]: [f64; 2], t: f64) -> [f64; 3] {
    let [a, b, c] = MOMENTS;
    let (energy, squared) = (a * p * p + c * r * r, (a * p).powi(2) + (c * r).powi(2));
    assert!(squared < energy * b);
    let rate = ((b - a) * (energy * c - squared) / (a * b * c)).sqrt();
    let m = (c - b) * (squared - energy * a) / ((b - a) * (energy * c - squared));
    let [sn, cn, dn] = jacobi(rate * t, m);
    let q = ((squared - energy * a) / (b * (b - a))).sqrt();
    [p * dn, q * sn, r * cn]
}

/// The momentum in inertial axes.
fn momentum(y: &[f64]) -> [f64; 3] {
    let [s, v] = [[y[0]; 3], [y[1], y[2], y[3]]];
    let h = [0, 1, 2].map(|i| MOMENTS[i] * y[4 + i]);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
    };
    let twice = cross(v, h).map(|x| 2.0 * x);
    let turned = cross(v, twice);
    [0, 1, 2].map(|i| h[i] + s[i] * twice[i] + turned[i])
}

const SPIN: [f64; 2] = [1.5, 0.3];
const AT_START: [f64; 7] = [1.0, 0.0, 0.0, 0.0, SPIN[0], 0.0, SPIN[1]];

#[test]
fn a_free_body_turns_as_elliptic_functions_do_and_keeps_its_momentum() {
    for relative in [1e-6, 1e-9, 1e-12] {
        let mut stepper = GaussLanes::new(tolerance(relative));
        stepper.start(&mut Body, 0.0, &AT_START, 7);
        let (mut y, mut error, mut drift) = ([0.0; 7], 0.0_f64, 0.0_f64);
        follow(&mut stepper, &mut Body, 20.0, |stepper| {
            let window = stepper.window();
            for x in [0.1, 0.45, 0.8, 1.0] {
                stepper.interpolate(x, &mut y);
                let exact = turning(SPIN, window.time + x * window.length());
                error = error.max(distance(&y[4..], &exact));
                drift = drift.max(distance(&momentum(&y), &momentum(&AT_START)));
            }
        });
        // Twenty units of time, in each of which the body turns by 1.5 and errors by as much.
        assert!(error < 30.0 * relative, "{relative:e}: {error:e}");
        assert!(drift < 60.0 * relative, "{relative:e}: {drift:e}");
    }
}

#[test]
fn the_order_is_sixteen() {
    let error = |count: u32| {
        let mut stepper = GaussLanes::new(tolerance(1e-15));
        stepper.start(&mut Body, 0.0, &AT_START, 7);
        for _ in 0..count {
            stepper.retake(&mut Body, 24.0 / f64::from(count));
            stepper.advance();
        }
        let end = &stepper.window().state;
        [distance(&end[4..], &turning(SPIN, 24.0)), distance(&momentum(end), &momentum(&AT_START))]
    };
    let (coarse, fine) = (error(8), error(12));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        let order = (coarse / fine).ln() / 1.5_f64.ln();
        assert!((14.5..18.5).contains(&order), "{order}: {coarse:e} {fine:e}");
    }
}
