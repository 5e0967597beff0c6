use nboom_model::{External, ExternalAxes, ExternalKind, Mode, Scene, WeldedTree};
use nboom_scalar::{Mat3, Real, Twist, Vec3, Wrench};

/// A force or torque from outside in a mode in which it acts, on the link that its body belongs to.
///
/// One that varies within the mode is as it was set last.
#[derive(Clone, Copy, Debug)]
pub struct Push<R> {
    /// Its place among the scene's forces and torques from outside.
    pub number: usize,
    /// The link; `None` is the main link.
    pub link: Option<usize>,
    /// Its place among the forces and torques on hinged bodies, if it is on one.
    hinged: Option<usize>,
    kind: ExternalKind,
    axes: ExternalAxes,
    /// Where it acts from the link's origin, link axes.
    point: Vec3<R>,
    rot_link_from_body: Mat3<R>,
    /// As given.
    amount: Vec3<R>,
    share: Option<Share<R>>,
    /// As it acts: body axes, or main-body axes where it is given along inertial ones.
    acting: Vec3<R>,
    /// As it acts: link axes, or main-body axes where it is given along inertial ones.
    in_link: Vec3<R>,
}

/// A share of the amount that goes straight over time: `at_first + rate (t − first)`.
#[derive(Clone, Copy, Debug)]
struct Share<R> {
    first: R,
    at_first: R,
    rate: R,
}

impl<R: Real> Share<R> {
    #[inline(always)]
    fn at(&self, time: R) -> R {
        self.at_first + self.rate * (time - self.first)
    }
}

impl<R: Real> Push<R> {
    /// Writes all that act on the links of `tree` in `mode`, as at the beginning of the scene, to `all`.
    pub(crate) fn write_all(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>, all: &mut Vec<Self>) {
        let mut hinged = 0;
        all.clear();
        let externals = scene.externals.iter().enumerate();
        for ((number, external), &piece) in externals.zip(&mode.externals) {
            let place = external.body.map(|_| hinged);
            hinged += usize::from(place.is_some());
            if external.course.acts(piece) {
                all.push(Self::new((number, external), piece, tree, place));
            }
        }
        let time = R::constant(scene.initial.time);
        all.iter_mut().for_each(|push| push.set(&Mat3::identity(), time));
    }

    fn new(
        (number, one): (usize, &External),
        piece: usize,
        tree: &WeldedTree<R>,
        hinged: Option<usize>,
    ) -> Self {
        let at = Vec3::constant(one.point);
        let (link, point, rot_link_from_body) = match one.body {
            None => (None, at, Mat3::identity()),
            Some(body) => {
                let member = &tree.members[body];
                let rot = member.rot_link_from_body;
                (member.link, member.point + rot * at, rot)
            }
        };
        let share = one.course.line(piece).map(|[[first, at_first], [last, at_last]]| Share {
            first: R::constant(first),
            at_first: R::constant(at_first),
            rate: R::constant((at_last - at_first) / (last - first)),
        });
        let amount = Vec3::constant(one.amount);
        Self {
            number,
            link,
            hinged,
            kind: one.kind,
            axes: one.axes,
            point,
            rot_link_from_body,
            amount,
            share,
            acting: amount,
            in_link: amount,
        }
    }

    /// The largest torque that it makes, if it acts no farther away than `reach`.
    pub(super) fn magnitude(&self, reach: R) -> R {
        let amount = self.acting.norm();
        match self.kind {
            ExternalKind::Force => amount * reach,
            ExternalKind::Torque => amount,
        }
    }

    /// Whether it is other at another time or attitude.
    #[inline(always)]
    pub fn varies(&self) -> bool {
        self.share.is_some() || self.axes == ExternalAxes::Inertial
    }

    /// Sets it to what it is at `time` when `rot_inertial_from_main` is the attitude.
    #[inline(always)]
    pub(crate) fn set(&mut self, rot_inertial_from_main: &Mat3<R>, time: R) {
        let amount = match &self.share {
            Some(share) => self.amount * share.at(time),
            None => self.amount,
        };
        (self.acting, self.in_link) = match (self.axes, self.hinged) {
            (ExternalAxes::Inertial, _) => {
                let acting = rot_inertial_from_main.transpose_mul(amount);
                (acting, acting)
            }
            (ExternalAxes::Body, Some(_)) => (amount, self.rot_link_from_body * amount),
            (ExternalAxes::Body, None) => (amount, amount),
        };
    }

    /// Where it acts from its link's hinge (from O on the main link), and as it acts; main-body axes. `rot` turns link
    /// components into main-body components; `None` on the main link.
    #[inline(always)]
    fn at(&self, rot: Option<&Mat3<R>>) -> (Vec3<R>, Vec3<R>) {
        match (rot, self.axes) {
            (Some(rot), ExternalAxes::Body) => (*rot * self.point, *rot * self.in_link),
            (Some(rot), ExternalAxes::Inertial) => (*rot * self.point, self.in_link),
            (None, _) => (self.point, self.in_link),
        }
    }

    /// What it is on its link about the link's hinge (about O on the main link), main-body axes; `rot` turns link
    /// components into main-body components, `None` on the main link.
    #[inline(always)]
    pub fn wrench(&self, rot: Option<&Mat3<R>>) -> Wrench<R> {
        let (arm, acting) = self.at(rot);
        self.kind.wrench(arm, acting)
    }

    /// Its power when its link's hinge (O on the main link) moves as `twist`, and its moment about `point`, which is
    /// seen from there; main-body axes, `rot` as for its [wrench](Self::wrench).
    #[inline(always)]
    pub fn power_and_moment(
        &self,
        rot: Option<&Mat3<R>>,
        twist: Twist<R>,
        point: Vec3<R>,
    ) -> (R, Vec3<R>) {
        let (arm, acting) = self.at(rot);
        match self.kind {
            ExternalKind::Force => {
                let at_point = twist.linear + twist.angular.cross(arm);
                (acting.dot(at_point), (arm - point).cross(acting))
            }
            ExternalKind::Torque => (acting.dot(twist.angular), acting),
        }
    }

    /// As it acts, with its place among the forces and torques on hinged bodies, if it is on one: body axes, or
    /// main-body axes where it is given along inertial ones.
    pub(crate) fn on_hinged(&self) -> Option<(usize, Vec3<R>)> {
        self.hinged.map(|place| (place, self.acting))
    }
}
