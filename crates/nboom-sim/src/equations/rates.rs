use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_elements::ThrustForce;
use nboom_model::Scene;
use nboom_scalar::{Real, Vec3};

use crate::equations::layout::VariableLayout;
use crate::equations::variables::attitude;

/// The rates of change of all variables of a mode, over any scalar, once accelerations are known.
pub(crate) struct Rates<R> {
    layout: VariableLayout,
    total_mass: R,
}

impl<R: Real> Rates<R> {
    /// Of a mode whose variables stand as in `layout`.
    pub fn new(scene: &Scene, layout: VariableLayout) -> Self {
        Self { layout, total_mass: R::constant(scene.total_mass()) }
    }

    /// Writes ẏ at `y`, which stands for `motion`, to `dy`; `dynamics` is in the same mode, and the
    /// mass centre would fall with the velocity `free_fall` (inertial axes) without thrust.
    pub fn write(
        &self,
        dynamics: &mut Recursive<R>,
        (motion, accelerations): (&Motion<'_, R>, &Accelerations<R>),
        free_fall: Vec3<R>,
        y: &[R],
        dy: &mut [R],
    ) {
        let layout = &self.layout;
        let rate = attitude(y).rate(motion.omega_body);
        dy[0] = rate.scalar;
        dy[1..4].copy_from_slice(&rate.vector.to_array());
        if let [x, y, z] = &mut dy[layout.omega()] {
            [*x, *y, *z] = accelerations.omega_dot_body.to_array();
        }
        dy[layout.beta()].copy_from_slice(motion.tau);
        dy[layout.tau()].copy_from_slice(&accelerations.tau_dot);
        if let [work] = &mut dy[layout.dashpot_work()] {
            *work = dynamics.elements().rate_power(dynamics.free_hinges(), motion.tau);
        }
        if let Some(&thrust) = dynamics.elements().thrust() {
            self.write_thrust(dynamics, thrust, motion, free_fall, y, dy);
        }
    }

    fn write_thrust(
        &self,
        dynamics: &mut Recursive<R>,
        thrust: ThrustForce<R>,
        motion: &Motion<'_, R>,
        free_fall: Vec3<R>,
        y: &[R],
        dy: &mut [R],
    ) {
        let layout = &self.layout;
        let ThrustForce { point, force: force_body, .. } = thrust;
        let to_inertial = attitude(y).normalized().to_matrix();
        let force = to_inertial * force_body;
        let (displacement, work) = (layout.thrust_motion().start, layout.thrust_work().start);
        let added = &y[displacement + 3..][..3];
        let velocity = free_fall + Vec3::new(added[0], added[1], added[2]);
        let found = dynamics.invariants(motion, to_inertial.transpose_mul(velocity));
        let at_point = found.origin_velocity + motion.omega_body.cross(point);
        let moment = to_inertial * (point - found.mass_center).cross(force_body);
        let acceleration = force * (R::one() / self.total_mass);
        dy[displacement..][..3].copy_from_slice(added);
        dy[displacement + 3..][..3].copy_from_slice(&acceleration.to_array());
        dy[work] = force_body.dot(at_point);
        dy[work + 1..][..3].copy_from_slice(&moment.to_array());
    }
}
