use nboom_model::{Coupling, Scene, WeldedTree};
use nboom_scalar::Real;

/// A [`Coupling`] in one mode. A hinge that is held keeps its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CouplingLaw<R> {
    ends: [End<R>; 2],
    ratio: R,
    stiffness: R,
    rest: R,
    damping: R,
    is_mutual: bool,
    brakes: bool,
}

/// A hinge at one end of a coupling.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End<R> {
    /// As numbered in the scene.
    hinge: usize,
    /// Its position among the free hinges, or the angle at which it is held.
    place: Place<R>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Place<R> {
    Free(usize),
    Held(R),
}

impl<R: Real> End<R> {
    fn new(hinge: usize, tree: &WeldedTree<R>) -> Self {
        let position = tree.links.iter().position(|link| link.hinge == hinge);
        Self { hinge, place: position.map_or(Place::Held(tree.angles[hinge]), Place::Free) }
    }

    /// β and τ, of which `free` has those of the free hinges.
    #[inline(always)]
    fn read(&self, [beta, tau]: [&[R]; 2]) -> [R; 2] {
        match self.place {
            Place::Free(j) => [beta[j], tau[j]],
            Place::Held(angle) => [angle, R::zero()],
        }
    }
}

impl<R: Real> CouplingLaw<R> {
    /// All of a scene, whose links are those of `tree`.
    pub fn all(scene: &Scene, tree: &WeldedTree<R>) -> impl Iterator<Item = Self> {
        let of = move |coupling: &Coupling| Self {
            ends: coupling.hinges.map(|hinge| End::new(hinge, tree)),
            ratio: R::constant(coupling.ratio),
            stiffness: R::constant(coupling.stiffness),
            rest: R::constant(coupling.rest),
            damping: R::constant(coupling.damping),
            is_mutual: coupling.is_mutual,
            brakes: coupling.damping != 0.0,
        };
        scene.couplings.iter().map(of)
    }

    /// Torque on the first hinge by its spring and by its damper, at the β and τ of the ends.
    #[inline(always)]
    fn parts(&self, [[own_beta, own_tau], [other_beta, other_tau]]: [[R; 2]; 2]) -> [R; 2] {
        let (beta, tau) = (self.ratio * other_beta, self.ratio * other_tau);
        let (stretched, rate) =
            if self.is_mutual { (own_beta - beta, own_tau - tau) } else { (beta, tau) };
        let stretched = stretched - self.rest;
        [-(self.stiffness * stretched), -(self.damping * rate)]
    }

    /// Adds its torques to those about the free hinges, at their β and τ.
    #[inline(always)]
    pub fn add_to_free(&self, free: [&[R]; 2], torques: &mut [R]) {
        let [spring, damper] = self.parts(self.ends.each_ref().map(|end| end.read(free)));
        let torque = spring + damper;
        if let Place::Free(j) = self.ends[0].place {
            torques[j] += torque;
        }
        if let (Place::Free(j), true) = (self.ends[1].place, self.is_mutual) {
            torques[j] -= self.ratio * torque;
        }
    }

    /// Adds its torques to those about all hinges of the scene, at their β and τ.
    pub fn add_to_all(&self, [beta, tau]: [&[R]; 2], torques: &mut [R]) {
        let [first, second] = self.ends.map(|end| end.hinge);
        let [spring, damper] = self.parts([first, second].map(|hinge| [beta[hinge], tau[hinge]]));
        torques[first] += spring + damper;
        if self.is_mutual {
            torques[second] -= self.ratio * (spring + damper);
        }
    }

    /// Power of what no potential accounts for: of the damper, and of all where it acts on one hinge alone.
    #[inline(always)]
    pub fn power(&self, free: [&[R]; 2]) -> R {
        let ends = self.ends.each_ref().map(|end| end.read(free));
        let [spring, damper] = self.parts(ends);
        let [[_, tau], [_, other_tau]] = ends;
        if self.is_mutual {
            damper * (tau - self.ratio * other_tau)
        } else {
            (spring + damper) * tau
        }
    }

    /// Whether some of its work is not that of a potential.
    pub fn has_power(&self) -> bool {
        if self.is_mutual { self.brakes && self.acts() } else { self.ends[0].is_free() }
    }

    /// Whether it acts on a hinge that is free.
    pub fn acts(&self) -> bool {
        self.ends[0].is_free() || self.is_mutual && self.ends[1].is_free()
    }

    /// Potential energy of its spring at β of all hinges; zero where it acts on one hinge alone.
    pub fn potential(&self, beta: &[R]) -> R {
        if !self.is_mutual {
            return R::zero();
        }
        let [first, second] = self.ends.map(|end| beta[end.hinge]);
        let stretched = first - self.ratio * second - self.rest;
        R::constant(0.5) * (self.stiffness * (stretched * stretched))
    }

    /// Its first hinge.
    pub fn hinge(&self) -> usize {
        self.ends[0].hinge
    }
}

impl<R> End<R> {
    fn is_free(&self) -> bool {
        matches!(self.place, Place::Free(_))
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
