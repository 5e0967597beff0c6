use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Twist, Vec3, Wrench};

use crate::{Joint, MassProperties, Mode, RotorMotion, Scene, Spin, TurnOrder, TurnedInertia};

mod constant;

/// The tree with every held hinge welded: one link for each free hinge, and the main link.
#[derive(Clone, Debug, PartialEq)]
pub struct WeldedTree<R> {
    /// All bodies that are rigid with the main body, about O, main-body axes.
    pub main: RigidInertia<R>,
    /// (ω̇, a_O) without gravity of a main link that is held, main-body axes.
    pub held: Option<Twist<R>>,
    /// The links, inboard before outboard.
    pub links: Vec<Link<R>>,
    /// That of the rotors in what is rigid with the main body, if it has some; main-body axes.
    pub main_spin: Option<Spin<R>>,
    /// The rotors, as the scene lists them.
    pub rotors: Vec<LinkRotor<R>>,
    /// For each body of the scene, where it sits in its link.
    pub members: Vec<Member<R>>,
    /// β of every hinge of the scene at which the tree was welded; those that are held keep it.
    pub angles: Vec<R>,
    /// Links with a body whose inertia about its mass centre is not in theirs, and that inertia;
    /// none without [`Departures`](crate::Departures).
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
    /// That of its rotors, if it has some; link axes.
    pub spin: Option<Spin<R>>,
}

/// A rotor in a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkRotor<R> {
    /// The link; `None` is the main link.
    pub link: Option<usize>,
    /// Unit vector along its axis, link axes.
    pub axis: Vec3<R>,
    /// J: inertia about its axis, which is in that of the link.
    pub inertia: R,
    /// How it turns relative to the link.
    pub motion: RotorMotion<R>,
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

/// Mass and moments of inertia of what stands for a main link that is held, 2⁴⁰⁰: what hinges exert on it is lost in
/// rounding, and its square is a number.
const HELD: f64 = f64::from_bits((1023 + 400) << 52);

impl<R: Real> WeldedTree<R> {
    /// Welds the hinges that `mode` holds, at their angles in `beta` (one for each hinge). Rotors
    /// turn as fast as when the scene starts until they are [set](Self::set_rotors).
    pub fn new(scene: &Scene, mode: &Mode, beta: &[R]) -> Self {
        let mut tree = Self {
            main: RigidInertia::zero(),
            held: None,
            main_spin: None,
            rotors: Vec::with_capacity(scene.rotors.len()),
            links: Vec::with_capacity(scene.bodies.len()),
            members: Vec::with_capacity(scene.bodies.len()),
            angles: Vec::with_capacity(scene.bodies.len()),
            turned: Vec::new(),
        };
        tree.weld(scene, mode, beta);
        tree
    }

    /// Makes it the [new](Self::new) tree of any scene and mode, in the room that it has.
    pub fn weld(&mut self, scene: &Scene, mode: &Mode, beta: &[R]) {
        self.main = rigid(&scene.main_body);
        self.main.about_origin += Sym3::constant(scene.rotor_inertia_of(None));
        self.held = held(scene, mode);
        self.main_spin = None;
        self.links.clear();
        self.members.clear();
        self.turned.clear();
        self.angles.clear();
        self.angles.extend_from_slice(beta);
        for i in 0..scene.bodies.len() {
            self.place(scene, mode.is_free(i), i, beta[i]);
            for order in scene.departures().turned.iter().filter(|order| order.body == i) {
                self.turn_otherwise(order, scene, mode, beta);
            }
        }
        self.mount_rotors(scene, mode);
    }

    /// The main link as equations for a free one take it: itself, or in place of one that is held a body so heavy
    /// that only the [wrench that holds it](Self::holding_wrench) moves it.
    pub fn free_main(&self) -> RigidInertia<R> {
        self.held.map_or(self.main, |_| Self::heavy_main())
    }

    /// What stands for a main link that is held where equations take a free one, about O: a mass and moments of
    /// inertia of 2⁴⁰⁰.
    pub fn heavy_main() -> RigidInertia<R> {
        RigidInertia {
            mass: R::constant(HELD),
            first_moment: Vec3::zero(),
            about_origin: Sym3::constant(Sym3::diagonal(HELD, HELD, HELD)),
        }
    }

    /// The wrench about O, main-body axes, under which the [heavy main link](Self::free_main) moves as
    /// the one that is held does, if one is.
    pub fn holding_wrench(&self) -> Option<Wrench<R>> {
        let heavy = R::constant(HELD);
        self.held.map(|held| Wrench { moment: held.angular * heavy, force: held.linear * heavy })
    }

    /// Whether there are rotors.
    #[inline]
    pub fn has_rotors(&self) -> bool {
        !self.rotors.is_empty()
    }

    /// Makes the rotors turn like this, as the scene lists them; without allocation.
    pub fn set_rotors(&mut self, motions: impl Iterator<Item = RotorMotion<R>>) {
        for (rotor, motion) in self.rotors.iter_mut().zip(motions) {
            rotor.motion = motion;
        }
        self.spin();
    }

    /// Adds the rotors up link by link, as they turn.
    fn spin(&mut self) {
        let Self { main_spin, links, rotors, .. } = self;
        let spins = links.iter_mut().map(|link| &mut link.spin);
        spins.chain([&mut *main_spin]).flatten().for_each(|spin| *spin = Spin::zero());
        for rotor in rotors {
            let spin = rotor.link.map_or(&mut *main_spin, |link| &mut links[link].spin);
            let spin = spin.get_or_insert_with(Spin::zero);
            spin.add(rotor.axis * rotor.inertia, &rotor.motion);
        }
    }

    fn mount_rotors(&mut self, scene: &Scene, mode: &Mode) {
        self.rotors.clear();
        for (rotor, &piece) in scene.rotors.iter().zip(&mode.rotors) {
            let axis = Vec3::constant(rotor.axis);
            let member = rotor.body.map(|body| self.members[body]);
            let speed = R::constant(rotor.speed.at(scene.initial.time));
            self.rotors.push(LinkRotor {
                link: member.and_then(|member| member.link),
                axis: member.map_or(axis, |member| member.rot_link_from_body * axis),
                inertia: R::constant(rotor.inertia),
                motion: RotorMotion { speed, acceleration: rotor.speed.acceleration(piece) },
            });
        }
        self.spin();
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
        let mut inertia = rigid(&body.mass_properties);
        inertia.about_origin += Sym3::constant(scene.rotor_inertia_of(Some(i)));
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
                spin: None,
            });
        } else {
            let rot = rot_at_zero * body.joint.turn(axis, beta);
            let point = point + rot_at_zero * body.joint.travel(axis, beta);
            self.members.push(Member { link: inboard.link, point, rot_link_from_body: rot });
            let welded = inertia.rotated(&rot).seen_from(point);
            match inboard.link {
                Some(link) => self.links[link].inertia.add(welded),
                None => self.main.add(welded),
            }
        }
    }

    /// Turns the inertia about its mass centre of a body that has been placed otherwise than the
    /// body.
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
