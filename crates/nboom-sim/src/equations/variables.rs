use nboom_dynamics::{Momenta, Motion, Recursive};
use nboom_elements::gravity;
use nboom_model::{Base, Mode, Scene};
use nboom_scalar::{Eight, Number, Quaternion, Real, Vec3};

use crate::equations::layout::{Unknowns, VariableLayout};
use crate::equations::state::{PointMotion, State};

/// The way between the variables of a mode and states.
#[derive(Clone, Debug)]
pub(crate) struct Variables<R> {
    pub layout: VariableLayout,
    /// The state in which the mode began; held hinges keep its angles.
    pub origin: State<R>,
    /// Acceleration of what is [carried](Self::carried), inertial axes.
    carrying: Vec3<R>,
    total_mass: R,
    /// τ of the free hinges where it is no variable.
    tau: Vec<R>,
}

impl<R: Number> Variables<R> {
    /// Of a mode of `scene` that begins at `origin`.
    pub fn new(scene: &Scene, mode: &Mode, layout: VariableLayout, origin: &State<R>) -> Self {
        let total_mass = R::constant(scene.total_mass());
        let tau = vec![R::zero(); layout.free];
        let carrying = carrying_acceleration(scene, mode);
        Self { layout, origin: origin.clone(), carrying, total_mass, tau }
    }

    /// Goes on with a mode of a scene with as many hinges, which begins at `origin`, without allocation.
    pub fn begin(&mut self, scene: &Scene, mode: &Mode, layout: VariableLayout, origin: &State<R>) {
        self.layout = layout;
        self.total_mass = R::constant(scene.total_mass());
        self.carrying = carrying_acceleration(scene, mode);
        self.origin.copy_from(origin);
        self.tau.resize(layout.free, R::zero());
    }

    /// Writes those with which the mode of `dynamics` begins.
    pub fn write(&mut self, dynamics: &mut Recursive<R>, y: &mut Vec<R>) {
        let Self { layout, origin, .. } = self;
        y.clear();
        y.push(origin.attitude.scalar);
        y.extend(origin.attitude.vector.to_array());
        let motion = origin.motion(dynamics);
        if layout.unknowns == Unknowns::Velocities {
            y.extend(motion.omega_body.to_array());
        }
        y.extend(motion.beta);
        y.extend(motion.tau);
        y.resize(layout.len(), R::zero());
        if layout.has_momenta() {
            let hinges = &mut y[layout.hinge_motion()];
            dynamics.momenta(&motion, hinges);
            for (pi, &i) in hinges.iter_mut().zip(dynamics.free_hinges()) {
                *pi = origin.momenta.hinges[i].unwrap_or(*pi);
            }
        }
    }

    /// The motion that the variables `y` stand for; `dynamics` is in their mode.
    pub fn motion<'a>(&'a mut self, dynamics: &mut Recursive<R>, y: &'a [R]) -> Motion<'a, R> {
        motion(&self.layout, dynamics, y, &mut self.tau)
    }

    /// The state that the variables `y` at time `t` stand for; `dynamics` is in their mode.
    pub fn read(&mut self, dynamics: &mut Recursive<R>, t: R, y: &[R], state: &mut State<R>) {
        let layout = &self.layout;
        state.time = t;
        state.attitude = attitude(y).normalized();
        let motion = motion(layout, dynamics, y, &mut self.tau);
        state.omega_body = motion.omega_body;
        state.beta.clone_from(&self.origin.beta);
        state.tau.fill(R::zero());
        state.momenta.forget();
        for (j, &i) in dynamics.free_hinges().iter().enumerate() {
            state.beta[i] = motion.beta[j];
            state.tau[i] = motion.tau[j];
        }
        if let Unknowns::Momenta(at_start) = layout.unknowns {
            state.momenta.angular_inertial = Some(angular_momentum(layout, at_start, y));
            for (&pi, &i) in y[layout.hinge_motion()].iter().zip(dynamics.free_hinges()) {
                state.momenta.hinges[i] = Some(pi);
            }
        }
        state.center = self.center(t, y);
        let since = t - self.origin.time;
        state.rotors.clear();
        state.rotors.extend(self.origin.rotors.iter().map(|motion| motion.after(since)));
        state.work = self.origin.work;
        if let [work] = y[layout.spin_up_work()] {
            state.work.spin_up += work;
        }
        if let [work] = y[layout.dashpot_work()] {
            state.work.dashpots += work;
        }
        if let [work] = y[layout.thrust_work()] {
            state.work.thrust += work;
        }
        if let [mx, my, mz] = y[layout.angular_impulse()] {
            state.work.thrust_angular_impulse += Vec3::new(mx, my, mz);
        }
        if let [_, _, _, vx, vy, vz] = y[layout.thrust_motion()] {
            state.work.thrust_impulse += Vec3::new(vx, vy, vz) * self.total_mass;
        }
        state.held = self.origin.held.map(|_| self.carried(t));
        state.follow_hinges(dynamics);
    }

    /// The system mass centre of a free main body: free fall since the mode began, and what the
    /// thrust added.
    fn center(&self, t: R, y: &[R]) -> PointMotion<R> {
        let mut center = self.carried(t);
        if let [x, y, z, vx, vy, vz] = y[self.layout.thrust_motion()] {
            center.position += Vec3::new(x, y, z);
            center.velocity += Vec3::new(vx, vy, vz);
        }
        center
    }

    /// The system mass centre as if there were no thrust, or O of a main body that is held.
    pub fn carried(&self, t: R) -> PointMotion<R> {
        self.origin.carried().after(t - self.origin.time, self.carrying)
    }
}

impl Variables<f64> {
    /// The velocity of what is [carried](Self::carried) at eight times; without thrust nothing asks for it.
    pub fn carried_at(&self, times: &Eight) -> Vec3<Eight> {
        let mut found = [Eight::default(); 3];
        if self.layout.thrust {
            for (lane, &time) in times.0.iter().enumerate() {
                let velocity = self.carried(time).velocity.to_array();
                for (all, one) in found.iter_mut().zip(velocity) {
                    all.0[lane] = one;
                }
            }
        }
        let [x, y, z] = found;
        Vec3 { x, y, z }
    }
}

/// Acceleration of free fall, or of O of a main body that is held, inertial axes.
pub(crate) fn carrying_acceleration<R: Real>(scene: &Scene, mode: &Mode) -> Vec3<R> {
    match &scene.base {
        Base::Free => gravity(scene),
        held => {
            let [_, of_origin] = held.accelerations(mode.drive);
            Vec3::constant(scene.initial.attitude.normalized().to_matrix() * of_origin)
        }
    }
}

/// The motion that the variables stand for; `dynamics` is in their mode. `tau` is room for τ of the
/// free hinges, where it is no variable.
#[inline(always)]
pub(crate) fn motion<'a, R: Real>(
    layout: &VariableLayout,
    dynamics: &mut Recursive<R>,
    y: &'a [R],
    tau: &'a mut [R],
) -> Motion<'a, R> {
    let (beta, hinge_motion) = (&y[layout.beta()], &y[layout.hinge_motion()]);
    match layout.unknowns {
        Unknowns::Velocities => {
            Motion { omega_body: Vec3::new(y[4], y[5], y[6]), beta, tau: hinge_motion }
        }
        Unknowns::HingeRates(momentum) => {
            let momentum_body = along_body_axes(y, Vec3::constant(momentum));
            let omega_body = dynamics.angular_rate(momentum_body, beta, hinge_motion);
            Motion { omega_body, beta, tau: hinge_motion }
        }
        Unknowns::Momenta(at_start) => {
            let omega_body = dynamics.velocities(&momenta(layout, at_start, y), tau);
            Motion { omega_body, beta, tau }
        }
    }
}

/// The momenta among variables that have them; H̄_c was `at_start` when the mode began.
#[inline(always)]
pub(crate) fn momenta<'a, R: Real>(
    layout: &VariableLayout,
    at_start: Vec3<f64>,
    y: &'a [R],
) -> Momenta<'a, R> {
    Momenta {
        angular_body: along_body_axes(y, angular_momentum(layout, at_start, y)),
        beta: &y[layout.beta()],
        hinges: &y[layout.hinge_motion()],
    }
}

/// H̄_c, inertial axes, which was `at_start` when the mode began.
#[inline(always)]
fn angular_momentum<R: Real>(layout: &VariableLayout, at_start: Vec3<f64>, y: &[R]) -> Vec3<R> {
    match y[layout.angular_impulse()] {
        [x, y, z] => Vec3::constant(at_start) + Vec3::new(x, y, z),
        _ => Vec3::constant(at_start),
    }
}

#[inline(always)]
fn along_body_axes<R: Real>(y: &[R], inertial: Vec3<R>) -> Vec3<R> {
    attitude(y).normalized().to_matrix().transpose_mul(inertial)
}

/// The attitude among the variables, whose norm is near 1.
#[inline(always)]
pub(crate) fn attitude<R: Real>(y: &[R]) -> Quaternion<R> {
    Quaternion { scalar: y[0], vector: Vec3::new(y[1], y[2], y[3]) }
}
