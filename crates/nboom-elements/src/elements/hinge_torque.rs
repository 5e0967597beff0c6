use nboom_model::{Hinge, Mode, Scene};
use nboom_scalar::Real;

use super::hinge_law::HingeLaw;
use super::torque_table::TablePiece;

/// The torque about one hinge: of its spring and dashpot, and of its table where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeTorque<R> {
    law: HingeLaw<R>,
    /// The law without what is commanded.
    alone: HingeLaw<R>,
    /// Potential energy where that of the law alone is zero.
    stored: R,
    /// A torque that is held.
    commanded: R,
}

impl<R: Real> HingeTorque<R> {
    /// Writes that of each hinge of `scene` in `mode` to `all`.
    pub(super) fn write_all(scene: &Scene, mode: &Mode, all: &mut Vec<Self>) {
        let hinges = scene.bodies.iter().map(|body| &body.hinge);
        let law = |hinge: &Hinge| HingeLaw::new(&hinge.spring, &hinge.dashpot);
        all.clear();
        let zero = R::zero();
        let of_law = |law| Self { law, alone: law, stored: zero, commanded: zero };
        all.extend(hinges.map(law).map(of_law));
        // Tables come last among the elements of a mode.
        let first = mode.pieces.len() - scene.torque_tables.len();
        for (table, &piece) in scene.torque_tables.iter().zip(&mode.pieces[first..]) {
            let TablePiece { from, coefficients, stored } = TablePiece::new(table, piece);
            let torque = &mut all[table.hinge];
            torque.stored = torque.alone.potential(from) + stored;
            torque.alone = torque.alone.with_cubic(from, coefficients);
            torque.law = torque.alone;
        }
    }

    /// Holds a commanded torque, as a constant part of the law.
    pub(super) fn hold(&mut self, commanded: f64) {
        self.commanded = R::constant(commanded);
        self.law = self.alone.with_constant(self.commanded);
    }

    /// Torque at angle `beta` \[rad\] and rate `tau` \[rad/T\]; positive when it increases β.
    #[inline(always)]
    pub fn torque(&self, beta: R, tau: R) -> R {
        self.law.torque(beta, tau)
    }

    /// The law of all that acts about the hinge in the mode.
    pub fn law(&self) -> &HingeLaw<R> {
        &self.law
    }

    /// The part of the torque that depends on the rate, and does work no potential accounts for.
    #[inline(always)]
    pub fn rate_torque(&self, tau: R) -> R {
        self.law.rate_torque(tau)
    }

    /// Potential energy of the part that depends on the angle.
    pub fn potential(&self, beta: R) -> R {
        self.alone.potential(beta) + self.stored - self.commanded * beta
    }
}

impl HingeTorque<f64> {
    /// Whether the torque depends on the rate.
    pub fn depends_on_rate(&self) -> bool {
        self.law.depends_on_rate()
    }
}
