use nboom_dynamics::{Motion, Recursive};
use nboom_elements::gravity;
use nboom_model::Scene;
use nboom_scalar::{Number, Quaternion, Real, Vec3};

use crate::equations::layout::VariableLayout;
use crate::equations::state::{MassCenter, State};

/// The way between the variables of a mode and states.
#[derive(Clone, Debug)]
pub(crate) struct Variables<R> {
    pub layout: VariableLayout,
    /// The state in which the mode began; held hinges keep its angles.
    pub origin: State<R>,
    gravity: Vec3<R>,
    total_mass: R,
}

impl<R: Number> Variables<R> {
    /// Of a mode of `scene` that begins at `origin`.
    pub fn new(scene: &Scene, layout: VariableLayout, origin: &State<R>) -> Self {
        let total_mass = R::constant(scene.total_mass());
        Self { layout, origin: origin.clone(), gravity: gravity(scene), total_mass }
    }

    /// Writes those with which the mode begins, in which the hinges `free` turn.
    pub fn write(&self, free: &[usize], y: &mut Vec<R>) {
        let Self { layout, origin, .. } = self;
        y.clear();
        y.push(origin.attitude.scalar);
        y.extend(origin.attitude.vector.to_array());
        if layout.momentum.is_none() {
            y.extend(origin.omega_body.to_array());
        }
        y.extend(free.iter().map(|&i| origin.beta[i]));
        y.extend(free.iter().map(|&i| origin.tau[i]));
        y.resize(layout.len(), R::zero());
    }

    /// The state that the variables `y` at time `t` stand for; `dynamics` is in their mode.
    pub fn read(&self, dynamics: &mut Recursive<R>, t: R, y: &[R], state: &mut State<R>) {
        let layout = &self.layout;
        state.time = t;
        state.attitude = attitude(y).normalized();
        state.omega_body = motion(layout, dynamics, y).omega_body;
        state.beta.clone_from(&self.origin.beta);
        state.tau.fill(R::zero());
        for (j, &i) in dynamics.free_hinges().iter().enumerate() {
            state.beta[i] = y[layout.beta()][j];
            state.tau[i] = y[layout.tau()][j];
        }
        state.center = self.center(t, y);
        state.work = self.origin.work;
        if let [work] = y[layout.dashpot_work()] {
            state.work.dashpots += work;
        }
        if let [work, mx, my, mz] = y[layout.thrust_work()] {
            state.work.thrust += work;
            state.work.thrust_angular_impulse += Vec3::new(mx, my, mz);
        }
        if let [_, _, _, vx, vy, vz] = y[layout.thrust_motion()] {
            state.work.thrust_impulse += Vec3::new(vx, vy, vz) * self.total_mass;
        }
    }

    /// The system mass centre: free fall since the mode began, and what the thrust added.
    fn center(&self, t: R, y: &[R]) -> MassCenter<R> {
        let mut center = self.free_fall(t);
        if let [x, y, z, vx, vy, vz] = y[self.layout.thrust_motion()] {
            center.position += Vec3::new(x, y, z);
            center.velocity += Vec3::new(vx, vy, vz);
        }
        center
    }

    /// The system mass centre as if there were no thrust.
    pub fn free_fall(&self, t: R) -> MassCenter<R> {
        self.origin.center.after(t - self.origin.time, self.gravity)
    }
}

/// The motion that the variables stand for; `dynamics` is in their mode.
pub(crate) fn motion<'a, R: Real>(
    layout: &VariableLayout,
    dynamics: &mut Recursive<R>,
    y: &'a [R],
) -> Motion<'a, R> {
    let (beta, tau) = (&y[layout.beta()], &y[layout.tau()]);
    let omega_body = match layout.momentum {
        None => Vec3::new(y[4], y[5], y[6]),
        Some(momentum) => {
            let to_inertial = attitude(y).normalized().to_matrix();
            let momentum_body = to_inertial.transpose_mul(Vec3::constant(momentum));
            dynamics.angular_rate(momentum_body, beta, tau)
        }
    };
    Motion { omega_body, beta, tau }
}

/// The attitude among the variables, whose norm is near 1.
pub(crate) fn attitude<R: Real>(y: &[R]) -> Quaternion<R> {
    Quaternion { scalar: y[0], vector: Vec3::new(y[1], y[2], y[3]) }
}
