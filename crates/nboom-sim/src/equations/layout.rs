use std::ops::Range;

use nboom_scalar::Vec3;

/// Which variables are integrated in a mode, and where they stand: attitude (4), rate (3)
/// unless it follows from the angular momentum, angles and rates of the free hinges, and only
/// where needed the thrust's displacement and velocity of the mass centre (6), the work of
/// dashpots (1), and the work and angular impulse of the thrust (4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VariableLayout {
    /// H̄_c, inertial axes, of a mode in which it stands for the rate.
    pub momentum: Option<Vec3<f64>>,
    pub free: usize,
    pub thrust: bool,
    pub dashpots: bool,
}

impl VariableLayout {
    pub const ATTITUDE: Range<usize> = 0..4;

    pub fn omega(&self) -> Range<usize> {
        let start = Self::ATTITUDE.end;
        start..start + if self.momentum.is_none() { 3 } else { 0 }
    }

    pub fn beta(&self) -> Range<usize> {
        let start = self.omega().end;
        start..start + self.free
    }

    pub fn tau(&self) -> Range<usize> {
        let start = self.beta().end;
        start..start + self.free
    }

    /// Whether the rate of some variable is an acceleration.
    pub fn needs_accelerations(&self) -> bool {
        self.momentum.is_none() || self.free > 0
    }

    /// Displacement of the mass centre by the thrust, then its velocity.
    pub fn thrust_motion(&self) -> Range<usize> {
        let start = self.tau().end;
        start..start + if self.thrust { 6 } else { 0 }
    }

    /// Variables that decide on the step size; the others are integrals along the way.
    pub fn controlled(&self) -> usize {
        self.thrust_motion().end
    }

    pub fn dashpot_work(&self) -> Range<usize> {
        let start = self.controlled();
        start..start + usize::from(self.dashpots)
    }

    /// Work of the thrust, then its angular impulse.
    pub fn thrust_work(&self) -> Range<usize> {
        let start = self.dashpot_work().end;
        start..start + if self.thrust { 4 } else { 0 }
    }

    pub fn len(&self) -> usize {
        self.thrust_work().end
    }
}
