use nboom_model::{Coupling, Scene, WeldedTree};
use nboom_scalar::Real;

/// The law of a [`Coupling`]: a spring and a damper along s = ρ₁β₁ + ρ₂β₂ − θ, which pull with T = −k s − c ṡ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingLaw<R> {
    /// ρ₁, ρ₂.
    weights: [R; 2],
    stiffness: R,
    rest: R,
    damping: R,
}

impl<R: Real> CouplingLaw<R> {
    /// The law with numbers ρ₁, ρ₂, k, θ, c.
    pub fn of_numbers([first, second, stiffness, rest, damping]: [R; 5]) -> Self {
        Self { weights: [first, second], stiffness, rest, damping }
    }

    /// ρ₁, ρ₂, k, θ, c.
    pub fn numbers(&self) -> [R; 5] {
        let Self { weights: [first, second], stiffness, rest, damping } = *self;
        [first, second, stiffness, rest, damping]
    }

    /// The same with the hinges in the other order.
    pub fn reversed(self) -> Self {
        let [first, second] = self.weights;
        Self { weights: [second, first], ..self }
    }

    /// The torques about both hinges at their β and τ, ρ₁T and ρ₂T, if it acts on both.
    #[inline(always)]
    pub fn torques(&self, beta: [R; 2], tau: [R; 2]) -> [R; 2] {
        let [spring, damper] = self.pulls(beta, tau);
        self.weights.map(|weight| weight * (spring + damper))
    }

    /// Power of the damper at the τ of both hinges, if it acts on both.
    #[inline(always)]
    pub fn rate_power(&self, tau: [R; 2]) -> R {
        let rate = self.along(tau);
        -(self.damping * rate) * rate
    }

    /// What the spring and the damper pull with.
    #[inline(always)]
    fn pulls(&self, beta: [R; 2], tau: [R; 2]) -> [R; 2] {
        let stretched = self.along(beta) - self.rest;
        [-(self.stiffness * stretched), -(self.damping * self.along(tau))]
    }

    #[inline(always)]
    fn along(&self, [first, second]: [R; 2]) -> R {
        self.weights[0] * first + self.weights[1] * second
    }

    /// What one that acts on both hinges adds to the law of the first while the second is held at this angle: a constant
    /// torque, and factors of β and of τ.
    pub fn beside_held(&self, beta: R) -> [R; 3] {
        let weight = self.weights[0];
        let constant = -(self.stiffness * (self.weights[1] * beta - self.rest));
        [constant * weight, -(self.stiffness * weight) * weight, -(self.damping * weight) * weight]
    }
}

/// A [`Coupling`] in one mode. A hinge that is held keeps its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled<R> {
    /// Its hinges, as numbered in the scene.
    pub hinges: [usize; 2],
    /// Where each of them is.
    pub ends: [CoupledEnd<R>; 2],
    /// Its law, hinges in this order.
    pub law: CouplingLaw<R>,
    /// Whether it acts on both hinges; otherwise it acts on the first alone, with T, and its law follows the second.
    pub is_mutual: bool,
    brakes: bool,
}

/// A hinge at one end of a coupling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoupledEnd<R> {
    /// Its position among the free hinges.
    Free(usize),
    /// The angle at which it is held.
    Held(R),
}

impl<R: Real> CoupledEnd<R> {
    fn new(hinge: usize, tree: &WeldedTree<R>) -> Self {
        let position = tree.links.iter().position(|link| link.hinge == hinge);
        position.map_or(Self::Held(tree.angles[hinge]), Self::Free)
    }

    /// β and τ, of which `free` has those of the free hinges.
    #[inline(always)]
    fn read(&self, [beta, tau]: [&[R]; 2]) -> [R; 2] {
        match *self {
            Self::Free(j) => [beta[j], tau[j]],
            Self::Held(angle) => [angle, R::zero()],
        }
    }

    fn is_free(&self) -> bool {
        matches!(self, Self::Free(_))
    }
}

impl<R: Real> Coupled<R> {
    /// All of a scene, whose links are those of `tree`.
    pub(super) fn all(scene: &Scene, tree: &WeldedTree<R>) -> impl Iterator<Item = Self> {
        let of = move |coupling: &Coupling| {
            let Coupling { ratio, stiffness, rest, damping, is_mutual, .. } = *coupling;
            let weights = if is_mutual { [1.0, -ratio] } else { [0.0, ratio] };
            Self {
                hinges: coupling.hinges,
                ends: coupling.hinges.map(|hinge| CoupledEnd::new(hinge, tree)),
                law: CouplingLaw {
                    weights: weights.map(R::constant),
                    stiffness: R::constant(stiffness),
                    rest: R::constant(rest),
                    damping: R::constant(damping),
                },
                is_mutual,
                brakes: damping != 0.0,
            }
        };
        scene.couplings.iter().map(of)
    }

    /// T by its spring and by its damper, at the β and τ of the ends.
    #[inline(always)]
    fn pulls(&self, [[beta, tau], [other_beta, other_tau]]: [[R; 2]; 2]) -> [R; 2] {
        self.law.pulls([beta, other_beta], [tau, other_tau])
    }

    /// Adds its torques to those about the free hinges, at their β and τ.
    #[inline(always)]
    pub(super) fn add_to_free(&self, free: [&[R]; 2], torques: &mut [R]) {
        let [spring, damper] = self.pulls(self.ends.each_ref().map(|end| end.read(free)));
        let torque = spring + damper;
        if let CoupledEnd::Free(j) = self.ends[0] {
            torques[j] += torque;
        }
        if let (CoupledEnd::Free(j), true) = (self.ends[1], self.is_mutual) {
            torques[j] += self.law.weights[1] * torque;
        }
    }

    /// Adds its torques to those about all hinges of the scene, at their β and τ.
    pub(super) fn add_to_all(&self, [beta, tau]: [&[R]; 2], torques: &mut [R]) {
        let [first, second] = self.hinges;
        let [spring, damper] = self.pulls([first, second].map(|hinge| [beta[hinge], tau[hinge]]));
        torques[first] += spring + damper;
        if self.is_mutual {
            torques[second] += self.law.weights[1] * (spring + damper);
        }
    }

    /// Power of what no potential accounts for: of the damper, and of all where it acts on one hinge alone.
    #[inline(always)]
    pub(super) fn power(&self, free: [&[R]; 2]) -> R {
        self.power_at(self.ends.each_ref().map(|end| end.read(free)))
    }

    /// The same at β and τ of all hinges of the scene.
    pub(super) fn power_in(&self, [beta, tau]: [&[R]; 2]) -> R {
        self.power_at(self.hinges.map(|hinge| [beta[hinge], tau[hinge]]))
    }

    /// The same at the β and τ of the ends.
    #[inline(always)]
    fn power_at(&self, ends: [[R; 2]; 2]) -> R {
        let [[_, tau], [_, other_tau]] = ends;
        if self.is_mutual {
            return self.law.rate_power([tau, other_tau]);
        }
        let [spring, damper] = self.pulls(ends);
        (spring + damper) * tau
    }

    /// Whether some of its work is not that of a potential.
    pub(super) fn has_power(&self) -> bool {
        if self.is_mutual { self.brakes && self.acts() } else { self.ends[0].is_free() }
    }

    /// Whether it acts on a hinge that is free.
    pub(super) fn acts(&self) -> bool {
        self.ends[0].is_free() || self.is_mutual && self.ends[1].is_free()
    }

    /// Potential energy of its spring at β of all hinges; zero where it acts on one hinge alone.
    pub(super) fn potential(&self, beta: &[R]) -> R {
        if !self.is_mutual {
            return R::zero();
        }
        let stretched = self.law.along(self.hinges.map(|hinge| beta[hinge])) - self.law.rest;
        R::constant(0.5) * (self.law.stiffness * (stretched * stretched))
    }

    /// Its first hinge.
    pub(super) fn hinge(&self) -> usize {
        self.hinges[0]
    }
}

impl Coupled<f64> {
    /// What it pulls with about its hinges, every term by its magnitude, at β and τ of all hinges of the scene, each
    /// times the size of the hinge.
    pub(super) fn magnitude(&self, [beta, tau]: [&[f64]; 2], size: impl Fn(usize) -> f64) -> f64 {
        let CouplingLaw { weights, stiffness, rest, damping } = self.law;
        let along = |of: &[f64]| {
            weights.iter().zip(self.hinges).map(|(weight, i)| (weight * of[i]).abs()).sum::<f64>()
        };
        let pull = stiffness.abs() * (along(beta) + rest.abs()) + damping.abs() * along(tau);
        let [first, second] = self.hinges.map(size);
        pull * (first + if self.is_mutual { weights[1].abs() * second } else { 0.0 })
    }
}

/// The most energy that the spring of a coupling can store on its way, every term taken by its magnitude.
pub(crate) fn stored(scene: &Scene, coupling: &Coupling) -> f64 {
    let reach = |hinge: usize| {
        let of = &scene.bodies[hinge].hinge;
        let lock = of.lock_angle.map_or(0.0, f64::abs);
        of.start.angle.abs().max(lock) + scene.coordinate_scale(hinge)
    };
    let [first, second] = coupling.hinges.map(reach);
    let stretched = first + coupling.ratio.abs() * second + coupling.rest.abs();
    0.5 * coupling.stiffness.abs() * stretched * stretched
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HingeLaw;
    use nboom_model::{Dashpot, Spring};

    const LAW: [f64; 5] = [1.0, -2.0, 3.0, 0.4, 0.7];

    #[test]
    fn the_torques_are_those_of_a_spring_and_a_damper_along_the_stretch() {
        let law = CouplingLaw::of_numbers(LAW);
        let (beta, tau) = ([0.3, -0.8], [1.1, 0.6]);
        let stretched: f64 = 0.3 + 2.0 * 0.8 - 0.4;
        let rate: f64 = 1.1 - 2.0 * 0.6;
        let pull = -3.0 * stretched - 0.7 * rate;
        let [first, second] = law.torques(beta, tau);
        assert!((first - pull).abs() < 1e-14 && (second + 2.0 * pull).abs() < 1e-14);
        assert!((law.rate_power(tau) + 0.7 * rate * rate).abs() < 1e-14);
        let turned = law.reversed();
        assert_eq!(turned.torques([-0.8, 0.3], [0.6, 1.1]), [second, first]);
        assert_eq!(CouplingLaw::of_numbers(law.numbers()), law);
    }

    #[test]
    fn beside_a_held_hinge_it_is_a_part_of_the_others_law() {
        let (own, held, tau) = (0.3, -0.8, 1.1);
        for law in [CouplingLaw::of_numbers(LAW), CouplingLaw::of_numbers(LAW).reversed()] {
            let [expected, _] = law.torques([own, held], [tau, 0.0]);
            let mut found = HingeLaw::new(&Spring::default(), &Dashpot::default());
            found.add_linear(law.beside_held(held));
            assert!((found.torque(own, tau) - expected).abs() < 1e-14);
        }
    }
}
