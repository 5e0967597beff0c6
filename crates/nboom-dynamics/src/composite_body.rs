use nboom_model::{Joint, WeldedTree};
use nboom_scalar::{Mat3, Real, RigidInertia, Vec3, Wrench};

use crate::Recursive;
use crate::pose::LinkPose;

impl<R: Real> Recursive<R> {
    /// How large the inertia of all that each free hinge moves is in any direction, in the posture of the
    /// [mass matrix](Self::mass_matrix) that was computed last: half the trace of its tensor about the hinge, which no
    /// moment of inertia of a body with mass exceeds; its mass where the hinge slides.
    pub fn moved_inertias(&self) -> impl Iterator<Item = R> {
        self.poses.iter().zip(&self.composite).map(|(pose, moved)| match pose.joint {
            Joint::Revolute => moved.about_origin.trace() * R::constant(0.5),
            Joint::Prismatic => moved.mass,
        })
    }
}

/// Fills the kinetic-energy matrix B₀ of (V, ω, τ), row by row, both triangles.
///
/// `composite` is work space; the poses' inertias must be turned. `out` has (6 + links)²
/// entries.
pub(crate) fn mass_matrix<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    composite: &mut [RigidInertia<R>],
    out: &mut [R],
) {
    let size = 6 + tree.links.len();
    let mut put = |row: usize, column: usize, value: R| {
        out[row * size + column] = value;
        out[column * size + row] = value;
    };
    for (pose, inertia) in poses.iter().zip(composite.iter_mut()) {
        *inertia = pose.inertia;
    }
    let mut main = tree.main;
    for j in (0..tree.links.len()).rev() {
        let moved = composite[j].seen_from(poses[j].offset);
        match tree.links[j].inboard {
            Some(i) => composite[i].add(moved),
            None => main.add(moved),
        }
        let mut wrench = composite[j].momentum(poses[j].motion(R::one()));
        let mut at = j;
        put(6 + j, 6 + j, poses[j].along(&wrench));
        while let Some(i) = tree.links[at].inboard {
            wrench = wrench.seen_from(poses[at].offset);
            put(6 + i, 6 + j, poses[i].along(&wrench));
            at = i;
        }
        wrench = wrench.seen_from(poses[at].offset);
        put_column(&mut put, 6 + j, wrench);
    }
    put_base(&mut put, &main);
}

fn put_column<R: Real>(put: &mut impl FnMut(usize, usize, R), column: usize, wrench: Wrench<R>) {
    let (f, m) = (wrench.force.to_array(), wrench.moment.to_array());
    for i in 0..3 {
        put(i, column, f[i]);
        put(3 + i, column, m[i]);
    }
}

fn put_base<R: Real>(put: &mut impl FnMut(usize, usize, R), main: &RigidInertia<R>) {
    let angular = main.about_origin.to_matrix().rows.map(Vec3::to_array);
    let coupling = Mat3::skew(main.first_moment).rows.map(Vec3::to_array);
    for i in 0..3 {
        for j in 0..3 {
            put(i, j, if i == j { main.mass } else { R::zero() });
            put(3 + i, 3 + j, angular[i][j]);
            put(3 + i, j, coupling[i][j]);
        }
    }
}

/// Gathers what acts against each link into one right side: `torques[j]` is the hinge torque
/// on entry and u₀ of hinge j on exit. Returns the total against the main link, about O.
pub(crate) fn gather<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    wrenches: &mut [Wrench<R>],
    main: Wrench<R>,
    torques: &mut [R],
) -> Wrench<R> {
    let main = carry_inward(tree, poses, wrenches, main);
    for (torque, (pose, outboard)) in torques.iter_mut().zip(poses.iter().zip(wrenches)) {
        *torque -= pose.along(outboard);
    }
    main
}

/// Adds the wrenches of all links outboard to each link's own, about its hinge, and those of all
/// links to `main`, about O, which it returns.
#[inline(always)]
pub(crate) fn carry_inward<R: Real>(
    tree: &WeldedTree<R>,
    poses: &[LinkPose<R>],
    wrenches: &mut [Wrench<R>],
    mut main: Wrench<R>,
) -> Wrench<R> {
    for j in (0..tree.links.len()).rev() {
        let moved = wrenches[j].seen_from(poses[j].offset);
        match tree.links[j].inboard {
            Some(i) => wrenches[i].add(moved),
            None => main.add(moved),
        }
    }
    main
}
