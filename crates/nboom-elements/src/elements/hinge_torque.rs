use nboom_model::{Hinge, Mode, Scene};
use nboom_scalar::Real;

use super::friction::friction_torques;
use super::hinge_law::HingeLaw;
use super::torque_table::TablePiece;

/// The torque about one hinge: of its spring and dashpot, of its table and its friction where it has these, and what
/// is commanded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeTorque<R> {
    /// Of spring, dashpot and table.
    law: HingeLaw<R>,
    /// Potential energy where that of the law is zero.
    stored: R,
    /// A torque that a control law holds.
    commanded: R,
    /// The torque of friction in the direction of motion that the mode has.
    friction: R,
}

impl<R: Real> HingeTorque<R> {
    /// Writes that of each hinge of `scene` in `mode` to `all`.
    pub(super) fn write_all(scene: &Scene, mode: &Mode, all: &mut Vec<Self>) {
        let hinges = scene.bodies.iter().map(|body| &body.hinge);
        let law = |hinge: &Hinge| HingeLaw::new(&hinge.spring, &hinge.dashpot);
        all.clear();
        let zero = R::zero();
        let of_law = |law| Self { law, stored: zero, commanded: zero, friction: zero };
        all.extend(hinges.map(law).map(of_law));
        // Tables come last among the elements of a mode, after friction.
        let tables = &mode.pieces[scene.friction_pieces().end..];
        for (table, &piece) in scene.torque_tables.iter().zip(tables) {
            all[table.hinge].add(TablePiece::new(table, piece));
        }
        for (hinge, torque) in friction_torques(scene, mode) {
            all[hinge].friction = R::constant(torque);
        }
    }

    /// Adds a piece of the table of the hinge.
    fn add(&mut self, TablePiece { from, coefficients, stored }: TablePiece<R>) {
        self.stored = self.law.potential(from) + stored;
        self.law = self.law.with_cubic(from, coefficients);
    }

    /// Holds a commanded torque, which is constant.
    pub(super) fn hold(&mut self, commanded: f64) {
        self.commanded = R::constant(commanded);
    }

    /// Torque at angle `beta` \[rad\] and rate `tau` \[rad/T\]; positive when it increases β.
    #[inline(always)]
    pub fn torque(&self, beta: R, tau: R) -> R {
        self.law.torque(beta, tau) + (self.commanded + self.friction)
    }

    /// The law of all that acts about the hinge in the mode.
    pub fn law(&self) -> HingeLaw<R> {
        self.law.with_constant(self.commanded + self.friction)
    }

    /// The part of the torque that depends on the rate, and does work no potential accounts for.
    #[inline(always)]
    pub fn rate_torque(&self, tau: R) -> R {
        self.law.rate_torque(tau)
    }

    /// Potential energy of the part that depends on the angle.
    pub fn potential(&self, beta: R) -> R {
        self.law.potential(beta) + self.stored - self.commanded * beta
    }
}

impl HingeTorque<f64> {
    /// The torque with every term by its magnitude, but for friction.
    pub(super) fn magnitude(&self, beta: f64, tau: f64) -> f64 {
        self.law.magnitude(beta, tau) + self.commanded.abs()
    }

    /// Whether the torque depends on the rate.
    pub fn depends_on_rate(&self) -> bool {
        self.law.depends_on_rate()
    }
}

#[cfg(test)]
mod tests {
    use nboom_model::{Dashpot, Spring, TorqueTable};

    use super::*;

    #[test]
    fn pieces_of_a_table_meet_beside_a_spring_under_a_command() {
        let spring = Spring { quadratic: 0.3, linear: -1.7, preload_angle: 0.4 };
        let points = vec![[-1.0, 2.0], [-0.4, -0.5], [0.2, 3.0], [1.5, 3.5]];
        let table = TorqueTable { hinge: 0, points };
        let law = HingeLaw::<f64>::new(&spring, &Dashpot::default());
        for (k, &[at, _]) in table.points.iter().enumerate() {
            let [before, after] = [k, k + 1].map(|piece| {
                let mut torque = HingeTorque { law, stored: 0.0, commanded: 0.0, friction: 0.0 };
                torque.add(TablePiece::new(&table, piece));
                torque.hold(1.3);
                torque
            });
            // Some roundings of numbers below 10.
            assert!((before.torque(at, 0.0) - after.torque(at, 0.0)).abs() < 1e-13);
            assert!((before.potential(at) - after.potential(at)).abs() < 1e-13);
            assert!((before.torque(at, 0.0) - before.law().torque(at, 0.0)).abs() < 1e-13);
            let h = 1e-5;
            let slope = (after.potential(at + h) - after.potential(at)) / h;
            // A one-sided difference errs by h times half the slope of the torque, which is below 20.
            assert!((slope + after.torque(at, 0.0)).abs() < 1e-3);
        }
    }
}
