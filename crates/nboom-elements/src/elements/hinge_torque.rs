use nboom_model::{Hinge, Mode, Scene};
use nboom_scalar::Real;

use super::hinge_law::HingeLaw;
use super::torque_table::TablePiece;

/// The torque about one hinge: of its spring and dashpot, and of its table where it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeTorque<R> {
    law: HingeLaw<R>,
    table: Option<TablePiece<R>>,
}

impl<R: Real> HingeTorque<R> {
    /// Writes that of each hinge of `scene` in `mode` to `all`.
    pub(super) fn write_all(scene: &Scene, mode: &Mode, all: &mut Vec<Self>) {
        let hinges = scene.bodies.iter().map(|body| &body.hinge);
        let law = |hinge: &Hinge| HingeLaw::new(&hinge.spring, &hinge.dashpot);
        all.clear();
        all.extend(hinges.map(|hinge| Self { law: law(hinge), table: None }));
        // Tables come last among the elements of a mode.
        let first = mode.pieces.len() - scene.torque_tables.len();
        for (table, &piece) in scene.torque_tables.iter().zip(&mode.pieces[first..]) {
            all[table.hinge].table = Some(TablePiece::new(table, piece));
        }
    }

    /// Holds a commanded torque, as a constant part of the law of `hinge`.
    pub(super) fn hold(&mut self, hinge: &Hinge, commanded: f64) {
        let law = HingeLaw::new(&hinge.spring, &hinge.dashpot);
        self.law = law.with_constant(R::constant(commanded));
    }

    /// Torque at angle `beta` \[rad\] and rate `tau` \[rad/T\]; positive when it increases β.
    #[inline(always)]
    pub fn torque(&self, beta: R, tau: R) -> R {
        let torque = self.law.torque(beta, tau);
        match &self.table {
            Some(table) => torque + table.torque(beta),
            None => torque,
        }
    }

    /// The law of spring and dashpot, where they are all that acts about the hinge.
    pub fn law(&self) -> Option<&HingeLaw<R>> {
        self.table.is_none().then_some(&self.law)
    }

    /// The part of the torque that depends on the rate, and does work no potential accounts for.
    #[inline(always)]
    pub fn rate_torque(&self, tau: R) -> R {
        self.law.rate_torque(tau)
    }

    /// Potential energy of the part that depends on the angle.
    pub fn potential(&self, beta: R) -> R {
        let potential = self.law.potential(beta);
        self.table.as_ref().map_or(potential, |table| potential + table.potential(beta))
    }
}

impl HingeTorque<f64> {
    /// Whether the torque depends on the rate.
    pub fn depends_on_rate(&self) -> bool {
        self.law.depends_on_rate()
    }
}
