use nboom_model::{Joint, WeldedTree};
use nboom_scalar::{ArticulatedInertia, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::base::BaseFactor;
use crate::pose::LinkPose;

/// What eliminating one hinge leaves behind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HingeFactor<R> {
    /// A S: the wrench that unit acceleration of the joint alone takes.
    pub column: Wrench<R>,
    /// 1 / (Sᵀ A S).
    pub inverse_pivot: R,
}

impl<R: Real> HingeFactor<R> {
    pub fn unset() -> Self {
        Self { column: Wrench::zero(), inverse_pivot: R::zero() }
    }
}

/// Eliminates the hinges from the tips inward; the poses' inertias must be turned.
#[inline(always)]
pub(crate) fn factor<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    articulated: &mut [ArticulatedInertia<R>],
    hinges: &mut [HingeFactor<R>],
) -> BaseFactor<R> {
    for (pose, inertia) in poses.iter().zip(articulated.iter_mut()) {
        *inertia = ArticulatedInertia::of(&pose.inertia);
    }
    let mut main = ArticulatedInertia::of(&tree.main);
    for j in (0..tree.links.len()).rev() {
        let (pose, inertia) = (&poses[j], articulated[j]);
        let column = match pose.joint {
            Joint::Revolute => Wrench {
                moment: inertia.angular * pose.axis,
                force: inertia.coupling.transpose_mul(pose.axis),
            },
            Joint::Prismatic => {
                Wrench { moment: inertia.coupling * pose.axis, force: inertia.linear * pose.axis }
            }
        };
        let inverse_pivot = R::one() / pose.along(&column);
        hinges[j] = HingeFactor { column, inverse_pivot };
        let transmitted = inertia.without(&column, inverse_pivot).seen_from(pose.offset);
        match tree.links[j].inboard {
            Some(i) => articulated[i].add(&transmitted),
            None => main.add(&transmitted),
        }
    }
    if tree.held.is_some() { BaseFactor::unset() } else { BaseFactor::new(&main) }
}

/// Solves B₀ (ω̇, a_O, τ̇) = right side with the factors of [`factor`].
///
/// `wrenches[j]` is what acts against link j about its hinge, `main` what acts against the main
/// link about O, and `tau_dot[j]` the hinge torque on entry and the hinge acceleration on exit.
/// `wrenches` is used up. Returns (ω̇, a_O), which are those of `held` where the main link is held.
#[inline(always)]
pub(crate) fn solve<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    hinges: &[HingeFactor<R>],
    base: &BaseFactor<R>,
    load: Load<'_, R>,
) -> Twist<R> {
    let Load { wrenches, mut main, tau_dot, twists, held } = load;
    for j in (0..tree.links.len()).rev() {
        let (pose, hinge) = (&poses[j], &hinges[j]);
        let net_torque = tau_dot[j] - pose.along(&wrenches[j]);
        tau_dot[j] = net_torque;
        let ratio = net_torque * hinge.inverse_pivot;
        let transmitted = Wrench {
            moment: wrenches[j].moment + hinge.column.moment * ratio,
            force: wrenches[j].force + hinge.column.force * ratio,
        }
        .seen_from(pose.offset);
        match tree.links[j].inboard {
            Some(i) => wrenches[i].add(transmitted),
            None => main.add(transmitted),
        }
    }
    let of_main = match held {
        Some(held) => held,
        None => base.solve(Wrench { moment: -main.moment, force: -main.force }),
    };
    for (j, link) in tree.links.iter().enumerate() {
        let (pose, hinge) = (&poses[j], &hinges[j]);
        let inboard = match link.inboard {
            Some(i) => twists[i],
            None => of_main,
        };
        let inboard = inboard.at(pose.offset);
        let carried =
            hinge.column.moment.dot(inboard.angular) + hinge.column.force.dot(inboard.linear);
        tau_dot[j] = (tau_dot[j] - carried) * hinge.inverse_pivot;
        twists[j] = inboard;
        twists[j].add(pose.motion(tau_dot[j]));
    }
    of_main
}

/// The right side of [`solve`] and its work space.
pub(crate) struct Load<'a, R> {
    pub wrenches: &'a mut [Wrench<R>],
    pub main: Wrench<R>,
    /// (ω̇, a_O) of a main link that is held.
    pub held: Option<Twist<R>>,
    pub tau_dot: &'a mut [R],
    pub twists: &'a mut [Twist<R>],
}

/// Rates of every link, and what inertia alone would take to keep ω̇, a_O and τ̇ at zero.
///
/// `twists` and `omegas` are work space; `wrenches[j]` is about the hinge of link j. Returns
/// the main link's share, about O.
#[inline(always)]
pub(crate) fn bias<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    omega_body: Vec3<R>,
    tau: &[R],
    omegas: &mut [Vec3<R>],
    twists: &mut [Twist<R>],
    wrenches: &mut [Wrench<R>],
) -> Wrench<R> {
    for (j, link) in tree.links.iter().enumerate() {
        let pose = &poses[j];
        let (omega_inboard, inboard) = match link.inboard {
            Some(i) => (omegas[i], twists[i]),
            None => (omega_body, Twist::zero()),
        };
        let Twist { angular, linear } = inboard.at(pose.offset);
        let centripetal = omega_inboard.cross(omega_inboard.cross(pose.offset));
        let own = pose.axis * tau[j];
        // A body that slides keeps its rate; its origin has the Coriolis acceleration.
        let gyroscopic = omega_inboard.cross(own);
        (omegas[j], twists[j]) = match pose.joint {
            Joint::Revolute => (
                omega_inboard + own,
                Twist { angular: angular + gyroscopic, linear: linear + centripetal },
            ),
            Joint::Prismatic => {
                let coriolis = gyroscopic + gyroscopic;
                (omega_inboard, Twist { angular, linear: linear + centripetal + coriolis })
            }
        };
        wrenches[j] = pose.inertia.inertia_wrench(omegas[j], twists[j]);
    }
    let mut of_main = inertia_wrench_at_rest(&tree.main, omega_body);
    if tree.has_rotors() {
        for (wrench, (pose, omega)) in wrenches.iter_mut().zip(poses.iter().zip(&*omegas)) {
            if let Some(spin) = pose.spin {
                wrench.moment += spin.moment(*omega);
            }
        }
        if let Some(spin) = tree.main_spin {
            of_main.moment += spin.moment(omega_body);
        }
    }
    of_main
}

#[inline(always)]
fn inertia_wrench_at_rest<R: Real>(body: &RigidInertia<R>, omega: Vec3<R>) -> Wrench<R> {
    Wrench {
        moment: omega.cross(body.about_origin * omega),
        force: omega.cross(omega.cross(body.first_moment)),
    }
}
