use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_model::Scene;
use nboom_scalar::{Real, Vec3};

use crate::equations::layout::{Unknowns, VariableLayout};
use crate::equations::variables::{attitude, momenta, motion};

/// What computes accelerations in a mode.
pub(crate) trait Accelerate<R> {
    /// Writes ω̇, a_O without gravity and τ̇ of `motion` to `out`.
    fn accelerate(
        self,
        dynamics: &mut Recursive<R>,
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
    );
}

impl<R, F: FnOnce(&mut Recursive<R>, &Motion<'_, R>, &mut Accelerations<R>)> Accelerate<R> for F {
    #[inline(always)]
    fn accelerate(
        self,
        dynamics: &mut Recursive<R>,
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
    ) {
        self(dynamics, motion, out);
    }
}

/// The recursion, inlined where it is asked for: closures need not be.
pub(crate) struct ByRecursion;

impl<R: Real> Accelerate<R> for ByRecursion {
    #[inline(always)]
    fn accelerate(
        self,
        dynamics: &mut Recursive<R>,
        motion: &Motion<'_, R>,
        out: &mut Accelerations<R>,
    ) {
        dynamics.accelerations(motion, out);
    }
}

/// The rates of change of all variables of a mode, over any scalar.
pub(crate) struct Rates<R> {
    pub layout: VariableLayout,
    total_mass: R,
    /// τ where it is no variable.
    tau: Vec<R>,
    accelerations: Accelerations<R>,
}

impl<R: Real> Rates<R> {
    /// Of a mode whose variables stand as in `layout`.
    pub fn new(scene: &Scene, layout: VariableLayout) -> Self {
        Self {
            layout,
            total_mass: R::constant(scene.total_mass()),
            tau: vec![R::zero(); layout.free],
            accelerations: Accelerations::for_hinges(layout.free),
        }
    }

    /// Goes on with another mode of the scene.
    pub fn set_layout(&mut self, layout: VariableLayout) {
        self.layout = layout;
        self.tau.resize(layout.free, R::zero());
        self.accelerations.tau_dot.resize(layout.free, R::zero());
    }

    /// Writes ẏ at `y` to `dy`. `dynamics` is in the same mode, `by` computes accelerations
    /// there, and at `time` the velocity of what is
    /// [carried](crate::equations::variables::Variables::carried) is `carried`, inertial axes.
    #[inline(always)]
    pub fn write(
        &mut self,
        dynamics: &mut Recursive<R>,
        by: impl Accelerate<R>,
        (time, carried): (R, Vec3<R>),
        y: &[R],
        dy: &mut [R],
    ) {
        let Self { layout, total_mass, tau, accelerations } = self;
        dynamics.set_outside(attitude(y), time);
        let motion = if let Unknowns::Momenta(at_start) = layout.unknowns {
            let momenta = momenta(layout, at_start, y);
            let rates = &mut dy[layout.hinge_motion()];
            let omega_body = dynamics.momentum_rates(&momenta, tau, rates);
            Motion { omega_body, beta: momenta.beta, tau }
        } else {
            let motion = motion(layout, dynamics, y, tau);
            if layout.needs_elimination() {
                by.accelerate(dynamics, &motion, accelerations);
            }
            if let [x, y, z] = &mut dy[layout.omega()] {
                [*x, *y, *z] = accelerations.omega_dot_body.to_array();
            }
            dy[layout.hinge_motion()].copy_from_slice(&accelerations.tau_dot);
            motion
        };
        let rate = attitude(y).rate(motion.omega_body);
        dy[0] = rate.scalar;
        dy[1..4].copy_from_slice(&rate.vector.to_array());
        dy[layout.beta()].copy_from_slice(motion.tau);
        if let [work] = &mut dy[layout.dashpot_work()] {
            let free = dynamics.free_hinges();
            *work = dynamics.elements().rate_power(free, [motion.beta, motion.tau]);
        }
        if let [work] = &mut dy[layout.spin_up_work()] {
            *work = dynamics.spin_up_power(&motion);
        }
        if layout.thrust {
            let of_motion = (&motion, &*accelerations);
            write_outside(layout, dynamics, of_motion, (*total_mass, carried), y, dy);
        }
    }

    /// Writes what is left of ẏ at `y` where the rates of attitude, ω, β and τ stand in `dy`
    /// already, and the parts of hinge torques that depend on rates have the power `power`; the velocity of
    /// what is [carried](crate::equations::variables::Variables::carried) is `carried`, inertial axes.
    #[inline(always)]
    pub fn complete(
        &mut self,
        dynamics: &mut Recursive<R>,
        power: R,
        carried: Vec3<R>,
        y: &[R],
        dy: &mut [R],
    ) {
        let Self { layout, total_mass, accelerations, .. } = self;
        if let [work] = &mut dy[layout.dashpot_work()] {
            *work = power;
        }
        if !layout.thrust {
            return;
        }
        let omega_body = Vec3::new(y[4], y[5], y[6]);
        let (beta, tau) = (&y[layout.beta()], &y[layout.hinge_motion()]);
        let motion = Motion { omega_body, beta, tau };
        if layout.held {
            dynamics.hold(accelerations);
            accelerations.tau_dot.copy_from_slice(&dy[layout.hinge_motion()]);
        }
        write_outside(layout, dynamics, (&motion, accelerations), (*total_mass, carried), y, dy);
    }
}

/// Power of what acts from outside and of what moves a held main body, whose O has the velocity
/// `velocity`, main-body axes.
#[inline(always)]
fn power_on_held<R: Real>(
    dynamics: &mut Recursive<R>,
    motion: &Motion<'_, R>,
    accelerations: &Accelerations<R>,
    velocity: Vec3<R>,
) -> R {
    let reaction = dynamics.reaction(motion, accelerations);
    let of_reaction = reaction.force.dot(velocity) + reaction.moment.dot(motion.omega_body);
    let mut found = dynamics.invariants(motion, Vec3::zero());
    found.origin_velocity = velocity;
    dynamics.outside(motion, &found).power + of_reaction
}

/// Writes the rates of what is integrated where something acts from outside or moves a held main body.
#[inline(always)]
fn write_outside<R: Real>(
    layout: &VariableLayout,
    dynamics: &mut Recursive<R>,
    (motion, accelerations): (&Motion<'_, R>, &Accelerations<R>),
    (total_mass, carried): (R, Vec3<R>),
    y: &[R],
    dy: &mut [R],
) {
    if layout.held {
        let velocity = attitude(y).normalized().to_matrix().transpose_mul(carried);
        dy[layout.thrust_work().start] = power_on_held(dynamics, motion, accelerations, velocity);
        return;
    }
    let to_inertial = attitude(y).normalized().to_matrix();
    let displacement = layout.thrust_motion().start;
    let added = &y[displacement + 3..][..3];
    let velocity = carried + Vec3::new(added[0], added[1], added[2]);
    let found = dynamics.invariants(motion, to_inertial.transpose_mul(velocity));
    let outside = dynamics.outside(motion, &found);
    let acceleration = to_inertial * outside.force * (R::one() / total_mass);
    let moment = to_inertial * outside.moment;
    dy[displacement..][..3].copy_from_slice(added);
    dy[displacement + 3..][..3].copy_from_slice(&acceleration.to_array());
    dy[layout.thrust_work().start] = outside.power;
    dy[layout.angular_impulse()].copy_from_slice(&moment.to_array());
}
