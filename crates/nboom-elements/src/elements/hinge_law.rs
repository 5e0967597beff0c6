use nboom_model::{Dashpot, Hinge, Spring};
use nboom_scalar::Real;

/// Torque about a hinge axis while one piece of its table holds, if it has one: that of spring and dashpot, eq. (6.1),
/// and of the table, with powers of s = β − β₀ collected: Q = (q₁τ + q₂)τ + ((A₃s + A₂)s + A₁)s + A₀.
///
/// It acts on the outboard body along the hinge axis, and reversed on the inboard one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeLaw<R> {
    q1: R,
    q2: R,
    a3: R,
    a2: R,
    a1: R,
    a0: R,
    /// β₀, where the piece of the table begins; without one zero.
    from: R,
}

impl<R: Real> HingeLaw<R> {
    /// The law of this spring and this dashpot.
    pub fn new(spring: &Spring, dashpot: &Dashpot) -> Self {
        let [q3, q4, gamma] =
            [dashpot.angle_quadratic, dashpot.angle_linear, dashpot.preload_angle].map(R::constant);
        let [k1, k2, theta] =
            [spring.quadratic, spring.linear, spring.preload_angle].map(R::constant);
        let two = R::constant(2.0);
        Self {
            q1: R::constant(dashpot.rate_quadratic),
            q2: R::constant(dashpot.rate_linear),
            a3: R::zero(),
            a2: q3 + k1,
            a1: q4 + k2 + two * (q3 * gamma + k1 * theta),
            a0: (q3 * gamma + q4) * gamma + (k1 * theta + k2) * theta,
            from: R::zero(),
        }
    }

    /// The law with numbers q₁, q₂, A₃, A₂, A₁, A₀, β₀.
    pub fn of_numbers([q1, q2, a3, a2, a1, a0, from]: [R; 7]) -> Self {
        Self { q1, q2, a3, a2, a1, a0, from }
    }

    /// The law of spring and dashpot with a cubic by the angle from `from` beside it, its coefficients by ascending
    /// powers.
    pub(super) fn with_cubic(self, from: R, [c0, c1, c2, c3]: [R; 4]) -> Self {
        let Self { a2, a1, a0, .. } = self;
        Self {
            a3: c3,
            a2: a2 + c2,
            a1: R::constant(2.0) * a2 * from + a1 + c1,
            a0: (a2 * from + a1) * from + a0 + c0,
            from,
            ..self
        }
    }

    /// The law with a constant torque beside it.
    pub fn with_constant(self, torque: R) -> Self {
        Self { a0: self.a0 + torque, ..self }
    }

    /// Adds a constant torque, and torques that are so many times β and τ.
    pub fn add_linear(&mut self, [constant, of_angle, of_rate]: [R; 3]) {
        self.q2 += of_rate;
        self.a1 += of_angle;
        self.a0 += constant + of_angle * self.from;
    }

    /// q₁, q₂, A₃, A₂, A₁, A₀, β₀.
    pub fn numbers(&self) -> [R; 7] {
        [self.q1, self.q2, self.a3, self.a2, self.a1, self.a0, self.from]
    }

    /// Torque at angle `beta` \[rad\] and rate `tau` \[rad/T\]; positive when it increases β.
    #[inline(always)]
    pub fn torque(&self, beta: R, tau: R) -> R {
        let s = beta - self.from;
        self.rate_torque(tau) + ((self.a3 * s + self.a2) * s + self.a1) * s + self.a0
    }

    /// The part of the torque that depends on the rate, and does work no potential accounts for.
    #[inline(always)]
    pub fn rate_torque(&self, tau: R) -> R {
        (self.q1 * tau + self.q2) * tau
    }

    /// Potential energy of the part that depends on the angle; zero at β₀.
    pub fn potential(&self, beta: R) -> R {
        let [half, third, quarter] = [2.0, 3.0, 4.0].map(|power| R::constant(1.0 / power));
        let s = beta - self.from;
        let of_squares = self.a3 * quarter * s + self.a2 * third;
        -(((of_squares * s + self.a1 * half) * s + self.a0) * s)
    }
}

impl HingeLaw<f64> {
    /// The torque with every term, by powers of s and τ, by its magnitude.
    pub(super) fn magnitude(&self, beta: f64, tau: f64) -> f64 {
        let [q1, q2, a3, a2, a1, a0, _] = self.numbers().map(f64::abs);
        let (s, tau) = ((beta - self.from).abs(), tau.abs());
        (q1 * tau + q2) * tau + ((a3 * s + a2) * s + a1) * s + a0
    }

    /// Whether the torque depends on the rate.
    pub fn depends_on_rate(&self) -> bool {
        self.q1 != 0.0 || self.q2 != 0.0
    }
}

/// Energy of the springs of a hinge over all angles between start, lock angle and preload angle and a
/// radian beyond, every term taken by its magnitude.
pub(crate) fn stored(hinge: &Hinge) -> f64 {
    let over = |quadratic: f64, linear: f64, preload: f64| {
        let from = |angle: f64| (angle + preload).abs() + 1.0;
        let reach = from(hinge.start.angle).max(hinge.lock_angle.map_or(0.0, from));
        (quadratic.abs() * reach / 3.0 + linear.abs() / 2.0) * reach * reach
    };
    let (spring, dashpot) = (hinge.spring, hinge.dashpot);
    over(spring.quadratic, spring.linear, spring.preload_angle)
        + over(dashpot.angle_quadratic, dashpot.angle_linear, dashpot.preload_angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPRING: Spring = Spring { quadratic: 0.3, linear: -1.7, preload_angle: 0.4 };
    const DASHPOT: Dashpot = Dashpot {
        rate_quadratic: 0.05,
        rate_linear: -0.6,
        angle_quadratic: -0.2,
        angle_linear: 0.9,
        preload_angle: -1.1,
    };

    #[test]
    fn torque_is_eq_6_1_term_by_term() {
        let law = HingeLaw::<f64>::new(&SPRING, &DASHPOT);
        for (beta, tau) in [(0.0, 0.0), (1.3, -2.0), (-4.0, 0.7)] {
            let (from_dashpot, from_spring): (f64, f64) = (beta - 1.1, beta + 0.4);
            let expected = 0.05 * tau * tau - 0.6 * tau - 0.2 * from_dashpot.powi(2)
                + 0.9 * from_dashpot
                + 0.3 * from_spring.powi(2)
                - 1.7 * from_spring;
            assert!((law.torque(beta, tau) - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn either_part_of_a_dashpot_makes_the_torque_depend_on_the_rate() {
        let depends = |rate_quadratic, rate_linear| {
            let dashpot = Dashpot { rate_quadratic, rate_linear, ..DASHPOT };
            HingeLaw::<f64>::new(&SPRING, &dashpot).depends_on_rate()
        };
        assert!(depends(0.05, 0.0) && depends(0.0, -0.6) && !depends(0.0, 0.0));
    }

    #[test]
    fn a_cubic_adds_its_torque_wherever_it_is_written_from() {
        let spring = HingeLaw::<f64>::new(&SPRING, &DASHPOT);
        let (from, [c0, c1, c2, c3]) = (1.7, [0.3, -0.8, 2.0, -1.1]);
        let both = spring.with_cubic(from, [c0, c1, c2, c3]);
        for (beta, tau) in [(0.0, 0.0), (1.3, -2.0), (-4.0, 0.7)] {
            let s: f64 = beta - from;
            let cubic = c0 + c1 * s + c2 * s.powi(2) + c3 * s.powi(3);
            let expected = spring.torque(beta, tau) + cubic;
            assert!((both.torque(beta, tau) - expected).abs() < 1e-12);
            let integral =
                c0 * s + c1 * s.powi(2) / 2.0 + c2 * s.powi(3) / 3.0 + c3 * s.powi(4) / 4.0;
            let lost = spring.potential(beta) - spring.potential(from) - integral;
            assert!((both.potential(beta) - lost).abs() < 1e-11);
            let mut all = both;
            all.add_linear([0.5, -0.6, 0.9]);
            let added = all.torque(beta, tau) - both.torque(beta, tau);
            assert!((added - (0.5 - 0.6 * beta + 0.9 * tau)).abs() < 1e-12);
        }
        assert_eq!(HingeLaw::of_numbers(both.numbers()), both);
    }

    #[test]
    fn the_magnitude_is_that_of_all_terms() {
        let law = HingeLaw::of_numbers([0.05, -0.6, -1.1, 2.0, -0.8, 0.3, 1.5]);
        let found = law.magnitude(-4.0, 0.7);
        let expected = (0.05 * 0.7 + 0.6) * 0.7 + ((1.1 * 5.5 + 2.0) * 5.5 + 0.8) * 5.5 + 0.3;
        assert!((found - expected).abs() < 1e-12);
        assert!(found >= law.torque(-4.0, 0.7).abs());
    }

    #[test]
    fn work_is_the_loss_of_potential() {
        let law = HingeLaw::<f64>::new(&SPRING, &Dashpot { rate_linear: 0.0, ..DASHPOT });
        let (from, to, parts) = (-1.0, 2.0, 2000);
        let width = (to - from) / f64::from(parts);
        let middle = |i: i32| law.torque(from + width * (f64::from(i) + 0.5), 0.0);
        let work: f64 = (0..parts).map(|i| middle(i) * width).sum();
        // The midpoint rule of a quadratic errs by width² (to - from) A₂ / 12, about 6e-8.
        assert!((work - (law.potential(from) - law.potential(to))).abs() < 1e-7);
    }
}
