//! Refuses numbers that are not finite before a recorder keeps them.

use nboom_model::Scene;
use nboom_scalar::Vec3;

use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::instant::Outcome;
use crate::run::record::{Detail, Snapshot};

/// Refuses a snapshot that has a number beyond all numbers, by name and hinge.
pub(crate) fn check_snapshot(scene: &Scene, snapshot: &Snapshot) -> Result<(), SimError> {
    let quaternion = snapshot.attitude;
    let totals = Totals {
        kinetic_energy: snapshot.kinetic_energy,
        linear_momentum_inertial: snapshot.linear_momentum_inertial,
        angular_momentum_inertial: snapshot.angular_momentum_inertial,
    };
    let of_hinges = [
        ("angle", &snapshot.beta),
        ("rate", &snapshot.tau),
        ("summed angle", &snapshot.alpha),
        ("summed rate", &snapshot.sigma),
    ];
    let check = Check { scene, time: snapshot.time };
    check.hinges(&of_hinges)?;
    check.vectors(&[
        ("attitude", quaternion.vector),
        ("angular rate", snapshot.omega_body),
        ("position", snapshot.position_inertial),
        ("velocity", snapshot.velocity_inertial),
    ])?;
    check.numbers(&[("attitude", quaternion.scalar), ("nutation", snapshot.nutation)])?;
    check.totals(&totals)?;
    snapshot.detail.as_ref().map_or(Ok(()), |detail| check.detail(detail))
}

/// Checks the events of an instant and what its impulses change.
pub(crate) fn check_instant(
    scene: &Scene,
    time: f64,
    outcome: &Outcome<f64>,
) -> Result<(), SimError> {
    let check = Check { scene, time };
    for event in &outcome.events {
        let impulse = event.impulse.unwrap_or(0.0);
        check.of(event.hinge, "impulse", impulse.is_finite())?;
        check.totals(&event.before)?;
        check.totals(&event.after)?;
    }
    for jump in outcome.velocity_jumps() {
        let position = jump.tau.iter().position(|change| !change.is_finite());
        let hinge = position.map(|j| outcome.free_before()[j]);
        check.of(hinge, "jump of the rate", hinge.is_none())?;
        check.vectors(&[
            ("jump of the velocity", jump.velocity_body),
            ("jump of the angular rate", jump.omega_body),
        ])?;
    }
    Ok(())
}

/// Refuses numbers of one time.
pub(crate) struct Check<'a> {
    pub scene: &'a Scene,
    pub time: f64,
}

impl Check<'_> {
    /// A number of the whole satellite or of a hinge.
    pub fn of(
        &self,
        hinge: Option<usize>,
        quantity: &'static str,
        is_finite: bool,
    ) -> Result<(), SimError> {
        if is_finite {
            return Ok(());
        }
        let hinge = hinge.map(|i| self.scene.label(i));
        Err(SimError::Overflow { time: self.time, quantity, hinge })
    }

    /// Numbers of the whole satellite.
    pub fn numbers(&self, numbers: &[(&'static str, f64)]) -> Result<(), SimError> {
        numbers.iter().try_for_each(|(name, number)| self.of(None, name, number.is_finite()))
    }

    fn vectors(&self, vectors: &[(&'static str, Vec3<f64>)]) -> Result<(), SimError> {
        let is_finite = |v: &Vec3<f64>| v.to_array().iter().all(|x| x.is_finite());
        vectors.iter().try_for_each(|(name, vector)| self.of(None, name, is_finite(vector)))
    }

    /// Numbers of each hinge.
    fn hinges(&self, lists: &[(&'static str, &Vec<f64>)]) -> Result<(), SimError> {
        for (name, numbers) in lists {
            let first = numbers.iter().position(|number| !number.is_finite());
            self.of(first, name, first.is_none())?;
        }
        Ok(())
    }

    fn totals(&self, totals: &Totals) -> Result<(), SimError> {
        self.numbers(&[("kinetic energy", totals.kinetic_energy)])?;
        self.vectors(&[
            ("linear momentum", totals.linear_momentum_inertial),
            ("angular momentum", totals.angular_momentum_inertial),
        ])
    }

    fn detail(&self, detail: &Detail) -> Result<(), SimError> {
        self.hinges(&[
            ("acceleration", &detail.beta_ddot),
            ("summed acceleration", &detail.alpha_ddot),
            ("torque", &detail.hinge_torque),
        ])?;
        for line in &detail.lines {
            let Some(names) = line.kind.names().line else { continue };
            self.of(Some(line.hinge), names.force, line.force.is_finite())?;
            self.of(Some(line.hinge), names.length, line.length.is_finite())?;
        }
        self.vectors(&[
            ("angular acceleration", detail.omega_dot_body),
            ("acceleration", detail.origin_acceleration_body),
            ("mass centre", detail.mass_center_body),
            ("position of the mass centre", detail.mass_center_inertial),
            ("velocity of the mass centre", detail.mass_center_velocity_inertial),
            ("acceleration of the mass centre", detail.mass_center_acceleration_inertial),
        ])
    }
}
