//! Rotors: how fast they turn over time, and what their motors do.

use nboom_model::RotorMotion;
use nboom_scalar::{Real, Vec3};

use crate::{Accelerations, Motion, Recursive, pose};

impl<R: Real> Recursive<R> {
    /// Makes the rotors go on from `motions` at the time `since`, as the scene lists them, until
    /// the mode is set anew.
    pub fn spin_from(&mut self, since: R, motions: impl Iterator<Item = RotorMotion<R>>) {
        let (at, kept) = &mut self.rotors;
        *at = since;
        kept.clear();
        kept.extend(motions);
        self.tree.set_rotors(kept.iter().copied());
    }

    /// How the rotors in hinged bodies turn at the time to which they were set last, as the scene
    /// lists them.
    pub fn rotors_in_hinged(&self) -> impl Iterator<Item = &RotorMotion<R>> {
        let all = self.scene.rotors.iter().zip(&self.tree.rotors);
        all.filter(|(rotor, _)| rotor.body.is_some()).map(|(_, rotor)| &rotor.motion)
    }

    /// Whether a rotor changes its speed in the mode.
    pub fn spins_up(&self) -> bool {
        self.rotors.1.iter().any(|motion| motion.acceleration != 0.0)
    }

    /// Sets the speeds of the rotors to what they are at `time`.
    #[inline(always)]
    pub fn turn_rotors(&mut self, time: R) {
        if self.spins_up() {
            let (since, motions) = &self.rotors;
            let duration = time - *since;
            self.tree.set_rotors(motions.iter().map(|motion| motion.after(duration)));
        }
    }

    /// Power −Σ ω̄·(dh̄/dt) of the moments by which the motors of rotors that they speed up push
    /// off from bodies that turn at ω̄.
    #[inline(always)]
    pub fn spin_up_power(&mut self, motion: &Motion<'_, R>) -> R {
        let mut taken = R::zero();
        if let Some(spin) = self.tree.main_spin {
            taken += motion.omega_body.dot(spin.rate);
        }
        if self.tree.links.iter().any(|link| link.spin.is_some()) {
            pose::place(&self.tree, &self.constants, motion.beta, &mut self.poses);
            self.velocities_with_origin_at_rest(motion);
            for (link, (pose, twist)) in
                self.tree.links.iter().zip(self.poses.iter().zip(&self.twists))
            {
                if let Some(spin) = link.spin {
                    taken += twist.angular.dot(pose.rot * spin.rate);
                }
            }
        }
        -taken
    }

    /// Sets `out` to the torque J (dΩ/dt + ā·dω̄/dt) of the motor of each rotor, as the scene lists
    /// them, in a motion with these accelerations.
    pub fn motor_torques(
        &mut self,
        motion: &Motion<'_, R>,
        accelerations: &Accelerations<R>,
        out: &mut Vec<R>,
    ) {
        out.clear();
        if !self.tree.has_rotors() {
            return;
        }
        pose::place(&self.tree, &self.constants, motion.beta, &mut self.poses);
        let Self { tree, poses, omegas, twists, .. } = self;
        for (j, link) in tree.links.iter().enumerate() {
            let (omega, turning) =
                link.inboard.map_or((motion.omega_body, accelerations.omega_dot_body), |i| {
                    (omegas[i], twists[i].angular)
                });
            let of_hinge = |rate: R| poses[j].motion(rate).angular;
            let (own, changing) = (of_hinge(motion.tau[j]), of_hinge(accelerations.tau_dot[j]));
            omegas[j] = omega + own;
            twists[j].angular = turning + omega.cross(own) + changing;
        }
        out.extend(tree.rotors.iter().map(|rotor| {
            let turning: Vec3<R> = match rotor.link {
                Some(link) => poses[link].rot.transpose_mul(twists[link].angular),
                None => accelerations.omega_dot_body,
            };
            let own = R::constant(rotor.motion.acceleration);
            rotor.inertia * (own + rotor.axis.dot(turning))
        }));
    }

    /// Σ ½ J Ω²: kinetic energy of the rotors relative to their bodies.
    #[inline(always)]
    pub(crate) fn energy_in_bodies(&self) -> R {
        let half = R::constant(0.5);
        let mut energy = R::zero();
        for rotor in &self.tree.rotors {
            let speed = rotor.motion.speed;
            energy += half * rotor.inertia * (speed * speed);
        }
        energy
    }
}
