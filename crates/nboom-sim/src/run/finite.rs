//! Refuses numbers that are not finite before a recorder keeps them.

use nboom_model::Scene;
use nboom_scalar::{Vec3, Wrench};

use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::instant::Outcome;
use crate::run::record::{Detail, Snapshot};

/// Refuses a snapshot that has a number beyond all numbers, by name and hinge. Its account, which comes later, is
/// checked by the ledger.
pub(crate) fn check_snapshot(scene: &Scene, snapshot: &Snapshot) -> Result<(), SimError> {
    // All fields are named, so that a new one cannot be forgotten here.
    let Snapshot {
        time,
        position_inertial,
        velocity_inertial,
        attitude,
        omega_body,
        beta,
        tau,
        alpha,
        sigma,
        rotor_speeds,
        hinges: _,
        kinetic_energy,
        linear_momentum_inertial,
        angular_momentum_inertial,
        nutation,
        detail,
        account: _,
        steps: _,
        next_step,
    } = snapshot;
    let totals = Totals {
        kinetic_energy: *kinetic_energy,
        linear_momentum_inertial: *linear_momentum_inertial,
        angular_momentum_inertial: *angular_momentum_inertial,
    };
    let of_hinges =
        [("angle", beta), ("rate", tau), ("summed angle", alpha), ("summed rate", sigma)];
    let check = Check { scene, time: *time };
    check.numbers(&[("time", *time)])?;
    check.hinges(&of_hinges)?;
    check.vectors(&[
        ("attitude", attitude.vector),
        ("angular rate", *omega_body),
        ("position", *position_inertial),
        ("velocity", *velocity_inertial),
    ])?;
    let numbers =
        [("attitude", attitude.scalar), ("nutation", *nutation), ("next step", *next_step)];
    check.numbers(&numbers)?;
    check.of_bodies("speed of a rotor", rotor_speeds, bodies_of_rotors(scene))?;
    check.totals(&totals)?;
    detail.as_ref().map_or(Ok(()), |detail| check.detail(detail))
}

/// The hinge of the body of each rotor.
fn bodies_of_rotors(scene: &Scene) -> impl Iterator<Item = Option<usize>> {
    scene.rotors.iter().map(|rotor| rotor.body)
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

    /// Numbers of what is in bodies, whose hinges these are, or on them.
    fn of_bodies(
        &self,
        quantity: &'static str,
        numbers: &[f64],
        mut hinges: impl Iterator<Item = Option<usize>>,
    ) -> Result<(), SimError> {
        let first = numbers.iter().position(|number| !number.is_finite());
        self.of(first.and_then(|first| hinges.nth(first)?), quantity, first.is_none())
    }

    fn totals(&self, totals: &Totals) -> Result<(), SimError> {
        self.numbers(&[("kinetic energy", totals.kinetic_energy)])?;
        self.vectors(&[
            ("linear momentum", totals.linear_momentum_inertial),
            ("angular momentum", totals.angular_momentum_inertial),
        ])
    }

    fn detail(&self, detail: &Detail) -> Result<(), SimError> {
        // All fields are named, as those of a snapshot.
        let Detail {
            omega_dot_body,
            origin_acceleration_body,
            reaction,
            beta_ddot,
            alpha_ddot,
            hinge_torque,
            lines,
            outside,
            rotors,
            motor_torques,
            mass_center_body,
            mass_center_inertial,
            mass_center_velocity_inertial,
            mass_center_acceleration_inertial,
        } = detail;
        self.hinges(&[
            ("acceleration", beta_ddot),
            ("summed acceleration", alpha_ddot),
            ("torque", hinge_torque),
        ])?;
        for line in lines {
            let Some(names) = line.kind.names().line else { continue };
            self.of(Some(line.hinge), names.force, line.force.is_finite())?;
            self.of(Some(line.hinge), names.length, line.length.is_finite())?;
        }
        for (amount, external) in outside.iter().zip(self.scene.externals_on_hinged()) {
            let is_finite = amount.iter().all(|x| x.is_finite());
            self.of(external.body, "force or torque from outside", is_finite)?;
        }
        for ([speed, acceleration], rotor) in rotors.iter().zip(self.scene.rotors_in_hinged()) {
            self.of(rotor.body, "speed of a rotor", speed.is_finite())?;
            self.of(rotor.body, "acceleration of a rotor", acceleration.is_finite())?;
        }
        self.of_bodies("torque of a motor", motor_torques, bodies_of_rotors(self.scene))?;
        if let Some(reaction) = reaction {
            let Wrench { moment, force } = *reaction;
            self.vectors(&[("reaction force", force), ("reaction moment", moment)])?;
        }
        self.vectors(&[
            ("angular acceleration", *omega_dot_body),
            ("acceleration", *origin_acceleration_body),
            ("mass centre", *mass_center_body),
            ("position of the mass centre", *mass_center_inertial),
            ("velocity of the mass centre", *mass_center_velocity_inertial),
            ("acceleration of the mass centre", *mass_center_acceleration_inertial),
        ])
    }
}

#[cfg(test)]
mod tests {
    use nboom_elements::{Kind, LineReading};
    use nboom_model::{
        Appendage, External, Hinge, MassProperties, Mount, Rotor, RotorSpeed, SceneDescription,
        Segment,
    };
    use nboom_scalar::Sym3;

    use super::*;

    /// A boom on a hub, with a rotor and a thrust in the boom.
    fn scene() -> Scene {
        let hub = MassProperties::new(9.0, Vec3::zero(), Sym3::diagonal(4.0, 3.0, 2.0));
        let mut description = SceneDescription::at_rest("boom", hub, 1.0);
        let boom = MassProperties::new(2.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
        let segments = vec![Segment { length: 2.0, mass_properties: boom, hinge: Hinge::free() }];
        let mount = Mount::at(Vec3::unit_y());
        description.attach(&Appendage::Regular { mount, segments });
        let (axis, speed) = (Vec3::unit_z(), RotorSpeed::Constant(7.0));
        description.rotors.push(Rotor { body: Some(0), axis, inertia: 0.4, speed });
        let thrust = External::thrust(Vec3::unit_x(), Vec3::unit_y(), [0.0, 1.0]);
        description.externals.push(External { body: Some(0), ..thrust });
        Scene::new(description).expect("bodies")
    }

    /// A motion with a number in every place.
    fn motion() -> Snapshot {
        let (one, two) = (|| vec![1.0], || vec![[1.0; 2]]);
        let reading =
            LineReading { kind: Kind::KickOff, hinge: 0, acts: true, force: 1.0, length: 1.0 };
        let detail = Detail {
            reaction: Some(Wrench::zero()),
            beta_ddot: one(),
            alpha_ddot: one(),
            hinge_torque: one(),
            lines: vec![reading],
            outside: vec![[1.0; 3]],
            rotors: two(),
            motor_torques: one(),
            ..Detail::empty()
        };
        Snapshot {
            beta: one(),
            tau: one(),
            alpha: one(),
            sigma: one(),
            rotor_speeds: one(),
            detail: Some(detail),
            ..Snapshot::empty()
        }
    }

    /// A place for a number of a motion.
    type Place = fn(&mut Snapshot) -> &mut f64;

    fn detail(snapshot: &mut Snapshot) -> &mut Detail {
        snapshot.detail.as_mut().expect("it has one")
    }

    fn reaction(snapshot: &mut Snapshot) -> &mut Wrench<f64> {
        detail(snapshot).reaction.as_mut().expect("it has one")
    }

    const PLACES: [(&str, Place); 33] = [
        ("time", |of| &mut of.time),
        ("position", |of| &mut of.position_inertial.x),
        ("velocity", |of| &mut of.velocity_inertial.y),
        ("attitude", |of| &mut of.attitude.scalar),
        ("attitude", |of| &mut of.attitude.vector.z),
        ("angular rate", |of| &mut of.omega_body.x),
        ("angle", |of| &mut of.beta[0]),
        ("rate", |of| &mut of.tau[0]),
        ("summed angle", |of| &mut of.alpha[0]),
        ("summed rate", |of| &mut of.sigma[0]),
        ("speed of a rotor", |of| &mut of.rotor_speeds[0]),
        ("kinetic energy", |of| &mut of.kinetic_energy),
        ("linear momentum", |of| &mut of.linear_momentum_inertial.y),
        ("angular momentum", |of| &mut of.angular_momentum_inertial.z),
        ("nutation", |of| &mut of.nutation),
        ("next step", |of| &mut of.next_step),
        ("angular acceleration", |of| &mut detail(of).omega_dot_body.x),
        ("acceleration", |of| &mut detail(of).origin_acceleration_body.y),
        ("reaction force", |of| &mut reaction(of).force.z),
        ("reaction moment", |of| &mut reaction(of).moment.x),
        ("acceleration", |of| &mut detail(of).beta_ddot[0]),
        ("summed acceleration", |of| &mut detail(of).alpha_ddot[0]),
        ("torque", |of| &mut detail(of).hinge_torque[0]),
        ("kick-off force", |of| &mut detail(of).lines[0].force),
        ("kick-off length", |of| &mut detail(of).lines[0].length),
        ("force or torque from outside", |of| &mut detail(of).outside[0][2]),
        ("speed of a rotor", |of| &mut detail(of).rotors[0][0]),
        ("acceleration of a rotor", |of| &mut detail(of).rotors[0][1]),
        ("torque of a motor", |of| &mut detail(of).motor_torques[0]),
        ("mass centre", |of| &mut detail(of).mass_center_body.y),
        ("position of the mass centre", |of| &mut detail(of).mass_center_inertial.z),
        ("velocity of the mass centre", |of| &mut detail(of).mass_center_velocity_inertial.x),
        ("acceleration of the mass centre", |of| {
            &mut detail(of).mass_center_acceleration_inertial.y
        }),
    ];

    #[test]
    fn a_number_that_is_not_finite_is_refused_in_every_place() {
        let scene = scene();
        assert!(check_snapshot(&scene, &motion()).is_ok());
        let mut passed = Vec::new();
        for (name, place) in PLACES {
            for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut snapshot = motion();
                *place(&mut snapshot) = wrong;
                match check_snapshot(&scene, &snapshot) {
                    Err(SimError::Overflow { quantity, .. }) if quantity == name => {}
                    other => passed.push((name, wrong, other)),
                }
            }
        }
        assert!(passed.is_empty(), "{passed:#?}");
    }

    #[test]
    fn what_is_of_a_body_is_refused_by_its_hinge() {
        let places: [Place; 4] = [
            |of| &mut of.rotor_speeds[0],
            |of| &mut detail(of).outside[0][0],
            |of| &mut detail(of).rotors[0][1],
            |of| &mut detail(of).motor_torques[0],
        ];
        for place in places {
            let mut snapshot = motion();
            *place(&mut snapshot) = f64::NAN;
            let refused = check_snapshot(&scene(), &snapshot);
            assert!(
                matches!(refused, Err(SimError::Overflow { hinge: Some(_), .. })),
                "{refused:?}"
            );
        }
    }
}
