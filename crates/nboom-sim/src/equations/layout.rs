use std::ops::Range;

use nboom_dynamics::Recursive;
use nboom_model::Scene;
use nboom_scalar::{Number, Vec3};

use crate::equations::state::State;

/// What is integrated for the rates of the main body and of the free hinges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unknowns {
    /// ω and τ.
    Velocities,
    /// τ. ω follows from H̄_c, inertial axes, which is constant in the mode.
    HingeRates(Vec3<f64>),
    /// π, from which ω and τ follow with H̄_c: this one, inertial axes, and what the thrust has
    /// added.
    Momenta(Vec3<f64>),
}

/// Which variables are integrated in a mode, and where they stand: attitude (4), rate (3) unless it
/// follows from the angular momentum, angles of the free hinges and their rates or momenta, and
/// only where needed the thrust's displacement and velocity of the mass centre (6), the work of
/// dashpots (1), the work (1) and angular impulse (3) of the thrust, and the work of the motors
/// that speed rotors up on what carries these (1). The impulse comes before all work where the rate
/// follows from it. What a control law commands on the main body counts as thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VariableLayout {
    pub unknowns: Unknowns,
    pub free: usize,
    /// Whether the main body is held, so that nothing displaces the mass centre but the hinges.
    pub held: bool,
    pub thrust: bool,
    pub dashpots: bool,
    /// Whether rotors change their speeds.
    pub spins_up: bool,
}

impl VariableLayout {
    pub const ATTITUDE: Range<usize> = 0..4;

    /// Of the velocities of a satellite whose hinges are held and on which nothing acts.
    pub fn of_no_hinges() -> Self {
        Self {
            unknowns: Unknowns::Velocities,
            free: 0,
            held: false,
            thrust: false,
            dashpots: false,
            spins_up: false,
        }
    }

    /// That of ω and τ in the mode of `dynamics`, without the work of dashpots; `state` says whether rotors change
    /// their speeds.
    pub fn of_velocities<R: Number>(
        scene: &Scene,
        dynamics: &Recursive<R>,
        state: &State<R>,
    ) -> Self {
        let is_driven = scene.base.drive().is_some();
        Self {
            free: dynamics.free_hinges().len(),
            held: scene.base.is_held(),
            thrust: dynamics.elements().acts_from_outside() || is_driven,
            spins_up: state.spins_up(),
            ..Self::of_no_hinges()
        }
    }

    /// The one with the most variables that a satellite with so many hinges has.
    pub fn largest(hinges: usize) -> Self {
        Self { free: hinges, thrust: true, dashpots: true, spins_up: true, ..Self::of_no_hinges() }
    }

    pub fn omega(&self) -> Range<usize> {
        let start = Self::ATTITUDE.end;
        start..start + if self.unknowns == Unknowns::Velocities { 3 } else { 0 }
    }

    pub fn beta(&self) -> Range<usize> {
        let start = self.omega().end;
        start..start + self.free
    }

    /// τ of the free hinges, or π.
    pub fn hinge_motion(&self) -> Range<usize> {
        let start = self.beta().end;
        start..start + self.free
    }

    pub fn has_momenta(&self) -> bool {
        matches!(self.unknowns, Unknowns::Momenta(_))
    }

    /// Whether rates of variables take the elimination of the hinges.
    pub fn needs_elimination(&self) -> bool {
        !matches!(self.unknowns, Unknowns::HingeRates(_)) || self.free > 0
    }

    /// Displacement of the mass centre by the thrust, then its velocity.
    pub fn thrust_motion(&self) -> Range<usize> {
        let start = self.hinge_motion().end;
        start..start + if self.thrust && !self.held { 6 } else { 0 }
    }

    /// Variables that decide on the step size; the others are integrals along the way.
    pub fn controlled(&self) -> usize {
        self.thrust_motion().end + if self.has_momenta() { self.impulses() } else { 0 }
    }

    pub fn dashpot_work(&self) -> Range<usize> {
        let start = self.controlled();
        start..start + usize::from(self.dashpots)
    }

    pub fn thrust_work(&self) -> Range<usize> {
        let start = self.dashpot_work().end;
        start..start + usize::from(self.thrust)
    }

    /// Angular impulse of the thrust about the mass centre, inertial axes.
    pub fn angular_impulse(&self) -> Range<usize> {
        let start =
            if self.has_momenta() { self.thrust_motion().end } else { self.thrust_work().end };
        start..start + self.impulses()
    }

    fn impulses(&self) -> usize {
        if self.thrust && !self.held { 3 } else { 0 }
    }

    /// The variable that is the derivative of variable `i`, if there is one.
    pub fn rate_of(&self, i: usize) -> Option<usize> {
        let beta = self.beta();
        let rates_are_variables = !self.has_momenta();
        (rates_are_variables && beta.contains(&i))
            .then(|| self.hinge_motion().start + i - beta.start)
    }

    /// Work on their carriers of the motors that speed rotors up.
    pub fn spin_up_work(&self) -> Range<usize> {
        let start = self.thrust_work().end.max(self.angular_impulse().end);
        start..start + usize::from(self.spins_up)
    }

    pub fn len(&self) -> usize {
        self.spin_up_work().end
    }
}
