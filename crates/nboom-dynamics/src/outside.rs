use nboom_scalar::{Quaternion, Real, Twist, Vec3, Wrench};

use crate::{Invariants, Motion, Recursive};

/// What acts from outside on all bodies together, main-body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromOutside<R> {
    /// Force.
    pub force: Vec3<R>,
    /// Moment about the system mass centre.
    pub moment: Vec3<R>,
    /// Power.
    pub power: R,
}

impl<R: Real> Recursive<R> {
    /// Sets what acts from outside and the [speeds of rotors](Self::turn_rotors) to what they are
    /// at the time `time` and the attitude `attitude` (of any norm), which they keep until set
    /// again.
    #[inline(always)]
    pub fn set_outside(&mut self, attitude: Quaternion<R>, time: R) {
        self.turn_rotors(time);
        if self.elements.pushes_vary() {
            self.elements.set_pushes(&attitude.normalized().to_matrix(), time);
        }
    }

    /// What acts from outside in a motion whose energy and momenta are `found`, which were the last
    /// to be asked for.
    #[inline(always)]
    pub fn outside(&self, motion: &Motion<'_, R>, found: &Invariants<R>) -> FromOutside<R> {
        let of_main = Twist { angular: motion.omega_body, linear: found.origin_velocity };
        let elements = &self.elements;
        let (mut power, mut moment) =
            elements.external_power_and_moment(of_main, found.mass_center);
        for (link, push) in elements.on_links() {
            let (pose, twist) = (&self.poses[link], self.twists[link]);
            let twist = Twist { linear: twist.linear + found.origin_velocity, ..twist };
            let center = found.mass_center - pose.position;
            let (p, m) = push.power_and_moment(Some(&pose.rot), twist, center);
            power += p;
            moment += m;
        }
        FromOutside { force: self.acting_from_outside().force, moment, power }
    }

    /// The force from outside on all bodies together, main-body axes, at the angles `beta` of the
    /// free hinges; `None` when nothing acts.
    pub fn outside_force(&mut self, beta: &[R]) -> Option<Vec3<R>> {
        if !self.elements.acts_from_outside() {
            return None;
        }
        if self.elements.on_links().next().is_some() {
            self.place(beta);
        }
        Some(self.acting_from_outside().force)
    }

    /// All that acts from outside in the posture that was placed last, about O, main-body axes.
    #[inline(always)]
    pub(crate) fn acting_from_outside(&self) -> Wrench<R> {
        let mut all = self.elements.external().unwrap_or(Wrench::zero());
        for (link, push) in self.elements.on_links() {
            let pose = &self.poses[link];
            all.add(push.wrench(Some(&pose.rot)).seen_from(pose.position));
        }
        all
    }
}
