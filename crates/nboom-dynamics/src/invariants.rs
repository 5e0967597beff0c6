use nboom_model::Joint;
use nboom_scalar::{Real, RigidInertia, Sym3, Twist, Vec3, Wrench};

use crate::pose;
use crate::{Motion, Recursive};

/// Energy and momenta of all bodies, main-body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<R> {
    /// S̄: system mass centre from O.
    pub mass_center: Vec3<R>,
    /// V: inertial velocity of O.
    pub origin_velocity: Vec3<R>,
    /// Kinetic energy, eq. (8.11), with that of rotors.
    pub kinetic_energy: R,
    /// The part of it that is not the motion of the mass centre.
    pub energy_about_center: R,
    /// Linear momentum P̄, the sum over the bodies, eq. (8.7).
    pub linear_momentum: Vec3<R>,
    /// Angular momentum H̄_c about the system mass centre, eq. (8.12).
    pub angular_momentum: Vec3<R>,
    /// Sum of the magnitudes of the links' linear momenta; bodies that held hinges weld together are one link.
    pub linear_momentum_scale: R,
    /// Sum of the magnitudes of the links' angular momenta about the mass centre, and of those of rotors relative to
    /// their bodies.
    pub angular_momentum_scale: R,
    /// Σ h̄·ω̄ + Σ ½ J Ω² of rotors with the momenta h̄ relative to bodies that turn at ω̄: the
    /// part of the kinetic energy that would not be there if all of them stood still in their
    /// bodies.
    pub rotor_energy: R,
}

/// Length of a line, and how it changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineLength<R> {
    /// |x̄|².
    pub squared: R,
    /// Rate of |x̄|².
    pub squared_rate: R,
}

/// The length of a line that one hinge alone moves, which turns: |x̄|² = mean + along_cos cos β +
/// along_sin sin β.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineCircle<R> {
    /// The hinge's position in [`Recursive::free_hinges`].
    pub position: usize,
    /// The mean of |x̄|².
    pub mean: R,
    /// What it changes with cos β.
    pub along_cos: R,
    /// What it changes with sin β.
    pub along_sin: R,
}

impl<R: Real> Recursive<R> {
    /// Energy and momenta when the system mass centre moves with `center_velocity` (inertial,
    /// main-body axes).
    #[inline(always)]
    pub fn invariants(
        &mut self,
        motion: &Motion<'_, R>,
        center_velocity: Vec3<R>,
    ) -> Invariants<R> {
        self.place(motion.beta);
        self.velocities_with_origin_at_rest(motion);
        let inverse_mass = R::one() / self.total_mass();
        let (mut first_moment, mut linear_momentum) = (Vec3::zero(), Vec3::zero());
        for (position, inertia, twist) in self.moving_links(motion.omega_body) {
            first_moment += inertia.first_moment + position * inertia.mass;
            linear_momentum += inertia.momentum(twist).force;
        }
        let mass_center = first_moment * inverse_mass;
        let origin_velocity = center_velocity - linear_momentum * inverse_mass;
        let mut found = Invariants {
            mass_center,
            origin_velocity,
            kinetic_energy: R::constant(0.5) * (self.total_mass() * center_velocity.norm_squared()),
            energy_about_center: R::zero(),
            linear_momentum: Vec3::zero(),
            angular_momentum: Vec3::zero(),
            linear_momentum_scale: R::zero(),
            angular_momentum_scale: R::zero(),
            rotor_energy: R::zero(),
        };
        let from_center = origin_velocity - center_velocity;
        for (position, inertia, twist) in self.moving_links(motion.omega_body) {
            let relative = Twist { linear: twist.linear + from_center, ..twist };
            found.add_body(position - mass_center, inertia, relative, center_velocity);
        }
        if self.tree.has_rotors() {
            if let Some(spin) = self.tree.main_spin {
                found.add_rotors(motion.omega_body, spin.momentum);
            }
            for (pose, twist) in self.poses.iter().zip(&self.twists) {
                if let Some(spin) = pose.spin {
                    found.add_rotors(twist.angular, spin.momentum);
                }
            }
            found.add_rotor_energy(self.energy_in_bodies());
        }
        found
    }

    /// ω, main-body axes, with which all bodies together have the angular momentum
    /// `momentum_body` about the system mass centre (main-body axes), eq. (8.12) solved for it.
    #[inline(always)]
    pub fn angular_rate(&mut self, momentum_body: Vec3<R>, beta: &[R], tau: &[R]) -> Vec3<R> {
        let hinges_alone = Motion { omega_body: Vec3::zero(), beta, tau };
        let of_hinges = self.invariants(&hinges_alone, Vec3::zero());
        let mut about_center = Sym3::zero();
        for (position, inertia, _) in self.moving_links(Vec3::zero()) {
            let arm = position - of_hinges.mass_center;
            about_center += inertia.seen_from(arm).about_origin;
        }
        about_center.solve(momentum_body - of_hinges.angular_momentum)
    }

    /// Length and rate of a line, by its place among [`Elements::lines`](nboom_elements::Elements),
    /// when `of_hinge` gives β and τ of each free hinge that moves its end.
    ///
    /// # Panics
    /// When there are not so many lines.
    pub fn line_length(&self, line: usize, of_hinge: impl Fn(usize) -> [R; 2]) -> LineLength<R> {
        let line = &self.elements.lines()[line];
        let (mut end, mut velocity) = (line.point, Vec3::zero());
        for j in self.path_inward(line.link) {
            let ([beta, tau], of_link) = (of_hinge(j), &self.constants[j]);
            let turned = of_link.turned(beta);
            let from_hinge = turned * end;
            let own = of_link.joint().motion(of_link.axis_inboard(), tau);
            velocity = turned * velocity + own.at(from_hinge).linear;
            end = of_link.offset(self.tree.links[j].point, beta) + from_hinge;
        }
        let along = end - line.main_body_point;
        let rate = along.dot(velocity);
        LineLength { squared: along.norm_squared(), squared_rate: rate + rate }
    }

    /// |x̄|² of all lines at the angles `beta` of the free hinges.
    pub fn line_lengths_squared(&mut self, beta: &[R], out: &mut [R]) {
        pose::place(&self.tree, &self.constants, beta, &mut self.poses);
        for (length, line) in out.iter_mut().zip(self.elements.lines()) {
            *length = line.end_and_span(&self.poses).1.norm_squared();
        }
    }

    /// How a line's length depends on its hinge; none where other hinges move it too, and where the hinge slides.
    ///
    /// # Panics
    /// When there are not so many lines.
    pub fn line_circle(&self, line: usize) -> Option<LineCircle<R>> {
        let line = &self.elements.lines()[line];
        let mut path = self.path_inward(line.link);
        let (Some(position), None) = (path.next(), path.next()) else { return None };
        let of_link = &self.constants[position];
        if of_link.joint().slides() {
            return None;
        }
        let [still, along_cos, along_sin] = of_link.turned_parts(line.point);
        let center = self.tree.links[position].point + still - line.main_body_point;
        let twice = |along: Vec3<R>| center.dot(along) + center.dot(along);
        Some(LineCircle {
            position,
            // Both parts are square to each other and of one length.
            mean: center.norm_squared() + along_cos.norm_squared(),
            along_cos: twice(along_cos),
            along_sin: twice(along_sin),
        })
    }

    /// Each free hinge that moves the end of a line, outboard before inboard: its position in
    /// [`Recursive::free_hinges`], and what it leaves free.
    ///
    /// # Panics
    /// When there are not so many lines.
    pub fn line_joints(&self, line: usize) -> impl Iterator<Item = (usize, Joint)> {
        let path = self.path_inward(self.elements.lines()[line].link);
        path.map(|position| (position, self.tree.links[position].joint))
    }

    #[inline(always)]
    fn path_inward(&self, from: Option<usize>) -> impl Iterator<Item = usize> {
        std::iter::successors(from, |&j| self.tree.links[j].inboard)
    }

    #[inline(always)]
    fn total_mass(&self) -> R {
        R::constant(self.scene.total_mass())
    }

    #[inline(always)]
    pub(crate) fn velocities_with_origin_at_rest(&mut self, motion: &Motion<'_, R>) {
        for (j, link) in self.tree.links.iter().enumerate() {
            let of_main = Twist { angular: motion.omega_body, linear: Vec3::zero() };
            let inboard = match link.inboard {
                Some(i) => self.twists[i],
                None => of_main,
            };
            let pose = &self.poses[j];
            self.twists[j] = inboard.at(pose.offset);
            self.twists[j].add(pose.motion(motion.tau[j]));
        }
    }

    /// Every link, the main one first, whose rate is `omega_body`: hinge position from O, mass properties about
    /// the hinge, rates with O at rest.
    #[inline(always)]
    fn moving_links(
        &self,
        omega_body: Vec3<R>,
    ) -> impl Iterator<Item = (Vec3<R>, &RigidInertia<R>, Twist<R>)> {
        let of_main = Twist { angular: omega_body, linear: Vec3::zero() };
        let links = self.poses.iter().zip(&self.twists);
        let links = links.map(|(pose, &twist)| (pose.position, &pose.inertia, twist));
        std::iter::once((Vec3::zero(), &self.tree.main, of_main)).chain(links)
    }
}

impl<R: Real> Invariants<R> {
    /// Angular momentum about O.
    pub fn angular_momentum_about_origin(&self) -> Vec3<R> {
        self.angular_momentum + self.mass_center.cross(self.linear_momentum)
    }

    /// Adds the rotors of a body that turns at `omega`, whose momentum relative to it is `spin`.
    #[inline(always)]
    fn add_rotors(&mut self, omega: Vec3<R>, spin: Vec3<R>) {
        self.angular_momentum += spin;
        self.angular_momentum_scale += spin.norm();
        self.add_rotor_energy(omega.dot(spin));
    }

    #[inline(always)]
    fn add_energy_about_center(&mut self, energy: R) {
        self.kinetic_energy += energy;
        self.energy_about_center += energy;
    }

    fn add_rotor_energy(&mut self, energy: R) {
        self.add_energy_about_center(energy);
        self.rotor_energy += energy;
    }

    /// Adds a body whose hinge is at `arm` from the mass centre and moves as `relative` to it.
    #[inline(always)]
    fn add_body(
        &mut self,
        arm: Vec3<R>,
        inertia: &RigidInertia<R>,
        relative: Twist<R>,
        center_velocity: Vec3<R>,
    ) {
        let Wrench { moment: about_hinge, force: momentum } = inertia.momentum(relative);
        let twice_energy = relative.linear.dot(momentum) + relative.angular.dot(about_hinge);
        let inertial_momentum = momentum + center_velocity * inertia.mass;
        let about_center = about_hinge + arm.cross(momentum);
        self.add_energy_about_center(R::constant(0.5) * twice_energy);
        self.linear_momentum += inertial_momentum;
        self.angular_momentum += about_center;
        self.linear_momentum_scale += inertial_momentum.norm();
        self.angular_momentum_scale += about_center.norm();
    }
}

impl Recursive<f64> {
    /// |x̄|² of one line, when `beta` gives the angle of each free hinge that moves its end; of several states
    /// side by side if the angles are.
    ///
    /// # Panics
    /// When there are not so many lines.
    #[inline(always)]
    pub fn line_length_squared<N: Real>(&self, line: usize, beta: impl Fn(usize) -> N) -> N {
        let line = &self.elements.lines()[line];
        let mut end = Vec3::constant(line.point);
        for j in self.path_inward(line.link) {
            end = self.constants[j].carried(self.tree.links[j].point, beta(j), end);
        }
        (end - Vec3::constant(line.main_body_point)).norm_squared()
    }
}
