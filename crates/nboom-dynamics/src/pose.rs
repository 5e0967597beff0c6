use nboom_elements::Placed;
use nboom_model::{Joint, Link, Spin, WeldedTree};
use nboom_scalar::{Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

/// Constants of one link that follow from the tree.
#[derive(Clone, Debug)]
pub(crate) struct LinkConstants<R> {
    joint: Joint,
    /// The hinge axis, inboard link's axes.
    axis_inboard: Vec3<R>,
    /// Link axes seen from the inboard link: `still + along_cos cos β + along_sin sin β`; of a link
    /// that slides `still` alone.
    still: Mat3<R>,
    along_cos: Mat3<R>,
    along_sin: Mat3<R>,
}

impl<R: Real> LinkConstants<R> {
    pub fn new(link: &Link<R>) -> Self {
        let (rot, axis) = (link.rot_inboard_at_zero, link.axis);
        let along = match link.joint {
            Joint::Revolute => axis.outer(axis),
            Joint::Prismatic => Mat3::identity(),
        };
        Self {
            joint: link.joint,
            axis_inboard: rot * axis,
            still: rot * along,
            along_cos: rot * (Mat3::identity() - along),
            along_sin: rot * Mat3::skew(axis),
        }
    }

    /// Turns link components into components in the inboard link's axes, at the hinge angle `beta`.
    #[inline(always)]
    pub fn turned(&self, beta: R) -> Mat3<R> {
        match self.joint {
            Joint::Revolute => {
                let (s, c) = beta.sin_cos();
                self.still + self.along_cos * c + self.along_sin * s
            }
            Joint::Prismatic => self.still,
        }
    }

    /// Constant, cosine's and sine's part of a vector of a link that [turns](Self::turned), inboard link's axes.
    pub fn turned_parts(&self, vector: Vec3<R>) -> [Vec3<R>; 3] {
        [&self.still, &self.along_cos, &self.along_sin].map(|part| *part * vector)
    }

    /// The link's origin from the inboard link's, when it is at `point` at β = 0; inboard link's
    /// axes.
    #[inline(always)]
    pub fn offset(&self, point: Vec3<R>, beta: R) -> Vec3<R> {
        match self.joint {
            Joint::Revolute => point,
            Joint::Prismatic => point + self.axis_inboard * beta,
        }
    }

    /// What the joint leaves free.
    #[inline(always)]
    pub fn joint(&self) -> Joint {
        self.joint
    }

    /// Unit vector along the hinge axis, inboard link's axes.
    #[inline(always)]
    pub fn axis_inboard(&self) -> Vec3<R> {
        self.axis_inboard
    }
}

impl LinkConstants<f64> {
    /// A point of the link from the inboard link's origin, in that link's axes, at the hinge angle `beta`, when it is
    /// at `end` from the link's origin, which is at `origin` at β = 0.
    #[inline(always)]
    pub fn carried<N: Real>(&self, origin: Vec3<f64>, beta: N, end: Vec3<N>) -> Vec3<N> {
        let still = Vec3::constant(origin) + times(&self.still, end);
        match self.joint {
            Joint::Revolute => {
                let (s, c) = beta.sin_cos();
                still + times(&self.along_cos, end) * c + times(&self.along_sin, end) * s
            }
            Joint::Prismatic => still + Vec3::constant(self.axis_inboard) * beta,
        }
    }
}

#[inline(always)]
fn times<N: Real>(matrix: &Mat3<f64>, vector: Vec3<N>) -> Vec3<N> {
    let [x, y, z] = &matrix.rows;
    Vec3::new(dot(x, vector), dot(y, vector), dot(z, vector))
}

#[inline(always)]
fn dot<N: Real>(row: &Vec3<f64>, vector: Vec3<N>) -> N {
    let first = N::constant(row.x) * vector.x;
    N::constant(row.z).mul_add(vector.z, N::constant(row.y).mul_add(vector.y, first))
}

/// Where one link is, main-body axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkPose<R> {
    /// Turns link components into main-body components.
    pub rot: Mat3<R>,
    /// The hinge from the inboard link's hinge (from O for the first ones).
    pub offset: Vec3<R>,
    /// The hinge from O.
    pub position: Vec3<R>,
    /// What the joint leaves free.
    pub joint: Joint,
    /// Unit vector along the hinge axis.
    pub axis: Vec3<R>,
    /// Mass properties about the hinge.
    pub inertia: RigidInertia<R>,
    /// That of its rotors, if it has some.
    pub spin: Option<Spin<R>>,
}

impl<R: Real> LinkPose<R> {
    pub fn unset() -> Self {
        Self {
            rot: Mat3::identity(),
            offset: Vec3::zero(),
            position: Vec3::zero(),
            joint: Joint::Revolute,
            axis: Vec3::zero(),
            inertia: RigidInertia::zero(),
            spin: None,
        }
    }

    /// The share of a wrench on the link, about its hinge, that acts on β.
    #[inline(always)]
    pub fn along(&self, wrench: &Wrench<R>) -> R {
        self.joint.along(self.axis, wrench)
    }

    /// Motion relative to the inboard link, of the link and its hinge, at the rate `tau`.
    #[inline(always)]
    pub fn motion(&self, tau: R) -> Twist<R> {
        self.joint.motion(self.axis, tau)
    }
}

impl<R: Real> Placed<R> for LinkPose<R> {
    #[inline(always)]
    fn rot(&self) -> &Mat3<R> {
        &self.rot
    }

    #[inline(always)]
    fn position(&self) -> Vec3<R> {
        self.position
    }

    #[inline(always)]
    fn axis(&self) -> Vec3<R> {
        self.axis
    }
}

/// Places every link at the hinge angles `beta` (one for each link).
#[inline(always)]
pub(crate) fn place<R: Real>(
    tree: &WeldedTree<R>,
    constants: &[LinkConstants<R>],
    beta: &[R],
    poses: &mut [LinkPose<R>],
) {
    for (j, (link, of_link)) in tree.links.iter().zip(constants).enumerate() {
        let (rot_inboard, position_inboard) = match link.inboard {
            Some(i) => (poses[i].rot, poses[i].position),
            None => (Mat3::identity(), Vec3::zero()),
        };
        let (turned, offset) = (of_link.turned(beta[j]), of_link.offset(link.point, beta[j]));
        let pose = &mut poses[j];
        pose.joint = of_link.joint;
        if link.inboard.is_none() {
            (pose.rot, pose.offset, pose.axis) = (turned, offset, of_link.axis_inboard);
        } else {
            pose.rot = rot_inboard * turned;
            pose.offset = rot_inboard * offset;
            pose.axis = rot_inboard * of_link.axis_inboard;
        }
        pose.position = position_inboard + pose.offset;
    }
}

/// Turns the mass properties of every link along with it, at the hinge angles `beta`.
#[inline(always)]
pub(crate) fn turn_inertias<R: Real>(tree: &WeldedTree<R>, beta: &[R], poses: &mut [LinkPose<R>]) {
    for (link, pose) in tree.links.iter().zip(&mut *poses) {
        pose.inertia = link.inertia.rotated(&pose.rot);
    }
    if tree.has_rotors() {
        for (link, pose) in tree.links.iter().zip(&mut *poses) {
            pose.spin = match &link.spin {
                Some(spin) => Some(spin.rotated(&pose.rot)),
                None => None,
            };
        }
    }
    for (link, turned) in &tree.turned {
        poses[*link].inertia.about_origin += turned.inertia(beta);
    }
}
