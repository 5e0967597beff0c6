use nboom_elements::{HingeLaw, KickOffLaw};
use nboom_model::{MassProperties, Mode, Scene};
use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Vec3};

/// The tree with every held hinge welded: one link for each free hinge, and the main link.
#[derive(Clone, Debug)]
pub(crate) struct MergedTree<R> {
    /// All bodies that are rigid with the main body, about O.
    pub main: RigidInertia<R>,
    /// The links, inboard before outboard.
    pub links: Vec<LinkModel<R>>,
    /// For each body of the scene, where it sits in its link.
    pub members: Vec<Member<R>>,
    /// The kick-off springs that push and whose ends move against each other.
    pub pushing: Vec<PushingSpring<R>>,
}

/// Constants of one link: a body outboard of a free hinge and all that is welded to it.
#[derive(Clone, Debug)]
pub(crate) struct LinkModel<R> {
    /// The free hinge, as numbered in the scene.
    pub hinge: usize,
    /// The inboard link; `None` is the main link.
    pub inboard: Option<usize>,
    /// The hinge point from the inboard link's origin, inboard link's axes.
    pub point: Vec3<R>,
    /// The hinge axis, inboard link's axes.
    pub axis: Vec3<R>,
    /// Link axes seen from the inboard link: `still + along_cos cos β + along_sin sin β`.
    pub still: Mat3<R>,
    pub along_cos: Mat3<R>,
    pub along_sin: Mat3<R>,
    /// Mass properties about the hinge, link axes.
    pub inertia: RigidInertia<R>,
    /// Spring and dashpot about the hinge.
    pub law: HingeLaw<R>,
}

/// Where a body of the scene sits in its link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Member<R> {
    /// The link; `None` is the main link.
    pub link: Option<usize>,
    /// The body's origin from the link's, link axes.
    pub point: Vec3<R>,
    /// Turns body components into link components.
    pub rot: Mat3<R>,
}

/// A kick-off spring that pushes a link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PushingSpring<R> {
    pub link: usize,
    /// Attachment on the link, from its hinge, link axes.
    pub point: Vec3<R>,
    /// Attachment on the main body, from O.
    pub main_body_point: Vec3<R>,
    pub law: KickOffLaw<R>,
}

impl<R: Real> MergedTree<R> {
    /// Welds the hinges that `mode` holds, at their angles in `beta` (one for each hinge).
    pub fn new(scene: &Scene, mode: &Mode, beta: &[R]) -> Self {
        let mut tree = Self {
            main: rigid(&scene.main_body),
            links: Vec::new(),
            members: Vec::with_capacity(scene.bodies.len()),
            pushing: Vec::new(),
        };
        for i in 0..scene.bodies.len() {
            tree.place(scene, mode.is_free(i), i, beta[i]);
        }
        for i in (0..scene.bodies.len()).filter(|&i| mode.kick_off[i]) {
            tree.push_with(scene, i);
        }
        tree
    }

    fn place(&mut self, scene: &Scene, free: bool, i: usize, beta: R) {
        let body = &scene.bodies[i];
        let inboard = match body.inboard {
            Some(inboard) => self.members[inboard],
            None => Member { link: None, point: Vec3::zero(), rot: Mat3::identity() },
        };
        let point = inboard.point + inboard.rot * Vec3::constant(body.mount.point);
        let rot_at_zero = inboard.rot * Mat3::constant(body.mount.rot_inboard_from_hinge);
        let axis = Vec3::constant(body.axis);
        let inertia = rigid(&body.mass_properties);
        if free {
            let along = axis.outer(axis);
            self.members.push(Member {
                link: Some(self.links.len()),
                point: Vec3::zero(),
                rot: Mat3::identity(),
            });
            self.links.push(LinkModel {
                hinge: i,
                inboard: inboard.link,
                point,
                axis: rot_at_zero * axis,
                still: rot_at_zero * along,
                along_cos: rot_at_zero * (Mat3::identity() - along),
                along_sin: rot_at_zero * Mat3::skew(axis),
                inertia,
                law: HingeLaw::new(&body.hinge.spring, &body.hinge.dashpot),
            });
        } else {
            let rot = rot_at_zero * Mat3::about_axis(axis, beta);
            self.members.push(Member { link: inboard.link, point, rot });
            let welded = inertia.rotated(&rot).seen_from(point);
            match inboard.link {
                Some(link) => self.links[link].inertia.add(welded),
                None => self.main.add(welded),
            }
        }
    }

    fn push_with(&mut self, scene: &Scene, i: usize) {
        let member = self.members[i];
        if let (Some(spring), Some(link)) = (scene.bodies[i].hinge.kick_off, member.link) {
            self.pushing.push(PushingSpring {
                link,
                point: member.point + member.rot * Vec3::constant(spring.body_point),
                main_body_point: Vec3::constant(spring.main_body_point),
                law: KickOffLaw::new(spring.coefficients),
            });
        }
    }
}

fn rigid<R: Real>(body: &MassProperties) -> RigidInertia<R> {
    let center = Vec3::constant(body.center_of_mass);
    RigidInertia::new(R::constant(body.mass), center, Sym3::constant(body.inertia))
}
