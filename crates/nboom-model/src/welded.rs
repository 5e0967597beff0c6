use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Twist, Vec3};

use crate::{Joint, MassProperties, Mode, Scene, TurnOrder, TurnedInertia};

/// The tree with every held hinge welded: one link for each free hinge, and the main link.
#[derive(Clone, Debug, PartialEq)]
pub struct WeldedTree<R> {
    /// All bodies that are rigid with the main body, about O, main-body axes.
    pub main: RigidInertia<R>,
    /// (ω̇, a_O) without gravity of a main link that is held, main-body axes.
    pub held: Option<Twist<R>>,
    /// The links, inboard before outboard.
    pub links: Vec<Link<R>>,
    /// Angular momentum of the rotors in what is rigid with the main body, relative to it, main-body axes.
    pub main_spin: Vec3<R>,
    /// Whether there are rotors.
    pub has_rotors: bool,
    /// For each body of the scene, where it sits in its link.
    pub members: Vec<Member<R>>,
    /// β of every hinge of the scene at which the tree was welded; those that are held keep it.
    pub angles: Vec<R>,
    /// Links with a body whose inertia about its mass centre is not in theirs, and that inertia; none
    /// without [`Departures`](crate::Departures).
    pub turned: Vec<(usize, TurnedInertia<R>)>,
}

/// A body outboard of a free hinge and all that is welded to it. Its origin is on its hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<R> {
    /// The free hinge, as numbered in the scene.
    pub hinge: usize,
    /// The inboard link; `None` is the main link.
    pub inboard: Option<usize>,
    /// The hinge point at hinge angle zero from the inboard link's origin, inboard link's axes.
    pub point: Vec3<R>,
    /// Turns link components at hinge angle zero into inboard link components.
    pub rot_inboard_at_zero: Mat3<R>,
    /// Whether the link turns about the axis or slides along it.
    pub joint: Joint,
    /// Unit vector along the hinge axis, link axes.
    pub axis: Vec3<R>,
    /// Mass properties about the hinge, link axes; of rotors those at rest.
    pub inertia: RigidInertia<R>,
    /// Angular momentum of its rotors relative to it, link axes.
    pub spin: Vec3<R>,
}

/// Where a body of the scene sits in its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member<R> {
    /// The link; `None` is the main link.
    pub link: Option<usize>,
    /// The body's origin from the link's, link axes.
    pub point: Vec3<R>,
    /// Turns body components into link components.
    pub rot_link_from_body: Mat3<R>,
}

impl<R: Real> WeldedTree<R> {
    /// Welds the hinges that `mode` holds, at their angles in `beta` (one for each hinge).
    pub fn new(scene: &Scene, mode: &Mode, beta: &[R]) -> Self {
        let mut tree = Self {
            main: rigid(&scene.main_body),
            held: held(scene, mode),
            main_spin: Vec3::zero(),
            has_rotors: !scene.rotors.is_empty(),
            links: Vec::new(),
            members: Vec::with_capacity(scene.bodies.len()),
            angles: beta.to_vec(),
            turned: Vec::new(),
        };
        let of_main = scene.rotors_of(None);
        tree.main.about_origin += Sym3::constant(of_main.inertia);
        tree.main_spin = Vec3::constant(of_main.momentum);
        for i in 0..scene.bodies.len() {
            tree.place(scene, mode.is_free(i), i, beta[i]);
            for order in scene.departures().turned.iter().filter(|order| order.body == i) {
                tree.turn_otherwise(order, scene, mode, beta);
            }
        }
        tree
    }

    fn place(&mut self, scene: &Scene, free: bool, i: usize, beta: R) {
        let body = &scene.bodies[i];
        let inboard = match body.inboard {
            Some(inboard) => self.members[inboard],
            None => {
                Member { link: None, point: Vec3::zero(), rot_link_from_body: Mat3::identity() }
            }
        };
        let rot = inboard.rot_link_from_body;
        let point = inboard.point + rot * Vec3::constant(body.mount.point);
        let rot_at_zero = rot * Mat3::constant(body.mount.rot_inboard_from_hinge);
        let axis = Vec3::constant(body.axis);
        let rotors = scene.rotors_of(Some(i));
        let spin = Vec3::constant(rotors.momentum);
        let mut inertia = rigid(&body.mass_properties);
        inertia.about_origin += Sym3::constant(rotors.inertia);
        if free {
            self.members.push(Member {
                link: Some(self.links.len()),
                point: Vec3::zero(),
                rot_link_from_body: Mat3::identity(),
            });
            self.links.push(Link {
                hinge: i,
                inboard: inboard.link,
                point,
                rot_inboard_at_zero: rot_at_zero,
                joint: body.joint,
                axis,
                inertia,
                spin,
            });
        } else {
            let rot = rot_at_zero * body.joint.turn(axis, beta);
            let point = point + rot_at_zero * body.joint.travel(axis, beta);
            self.members.push(Member { link: inboard.link, point, rot_link_from_body: rot });
            let welded = inertia.rotated(&rot).seen_from(point);
            let (of_link, of_spin) = match inboard.link {
                Some(link) => {
                    let Link { inertia, spin, .. } = &mut self.links[link];
                    (inertia, spin)
                }
                None => (&mut self.main, &mut self.main_spin),
            };
            of_link.add(welded);
            *of_spin += rot * spin;
        }
    }

    /// Turns the inertia about its mass centre of a body that has been placed otherwise than the body.
    fn turn_otherwise(&mut self, order: &TurnOrder, scene: &Scene, mode: &Mode, beta: &[R]) {
        let link = |i: usize| self.members[i].link.filter(|_| mode.is_free(i));
        let turned = TurnedInertia::new(scene, order, beta, link);
        let member = self.members[order.body];
        let inertia = Sym3::constant(scene.bodies[order.body].mass_properties.inertia);
        let right = inertia.rotated(&member.rot_link_from_body);
        match member.link {
            Some(link) => {
                let of_link = &mut self.links[link].inertia.about_origin;
                *of_link = *of_link - right;
                self.turned.push((link, turned));
            }
            None => self.main.about_origin += turned.inertia(&[]) - right,
        }
    }
}

/// What holds a main body against gravity accelerates it upward beside a fall.
fn held<R: Real>(scene: &Scene, mode: &Mode) -> Option<Twist<R>> {
    let upward = scene.gravity.map_or(Vec3::zero(), |gravity| gravity.up * gravity.acceleration);
    let to_inertial = scene.initial.attitude.normalized().to_matrix();
    let [angular, linear] = scene.base.accelerations(mode.drive);
    let linear = linear + to_inertial.transpose_mul(upward);
    let [angular, linear] = [angular, linear].map(Vec3::constant);
    scene.base.is_held().then_some(Twist { angular, linear })
}

fn rigid<R: Real>(body: &MassProperties) -> RigidInertia<R> {
    let center = Vec3::constant(body.center_of_mass);
    RigidInertia::new(R::constant(body.mass), center, Sym3::constant(body.inertia))
}
