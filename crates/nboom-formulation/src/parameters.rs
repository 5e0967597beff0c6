use nboom_model::{Limb, LimbJoint, LimbLink, Shape, Topology, WeldedTree};
use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Twist, Vec3, Wrench};

use crate::chain::ChainLink;

/// Constants of a satellite of one topology.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters<R> {
    /// The main body about O, main-body axes.
    pub main: RigidInertia<R>,
    /// Whether the main body is held. Then `main` is [so heavy](WeldedTree::heavy_main) that nothing but the external
    /// wrench moves it, and `articulated` does not ask what else would.
    pub main_is_held: bool,
    /// The appendages in the topology's order.
    pub branches: Vec<Branch<R>>,
}

/// Constants of one appendage.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch<R> {
    /// Turns appendage components into main-body components; ê₁ is along the first hinge.
    pub rot_body_from_appendage: Mat3<R>,
    /// The first hinge from O, appendage axes.
    pub point: Vec3<R>,
    /// The links, inboard before outboard. A paddle's two links are the arm and the paddle,
    /// whose hinge is along η. Links of a limb have no way to a next hinge, but mounts.
    pub links: Vec<ChainLink<R>>,
    /// Where each link of a limb but the first is mounted on its inboard link; of limbs alone.
    pub mounts: Option<Vec<Mount<R>>>,
}

/// Where a link of a limb is mounted on its inboard link, which has turned about its own axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount<R> {
    /// Both links turn about parallel axes: second and third component of the way from joint to joint.
    Parallel([R; 2]),
    /// Any other.
    Across {
        /// Turns components along the axes of the joint into components of the inboard link; ê₁ is along
        /// the joint.
        rot: Mat3<R>,
        /// The joint from that of the inboard link, along the axes of the inboard link.
        point: Vec3<R>,
    },
}

impl<R: Real> Branch<R> {
    /// Where link `i` of a limb is mounted: the first on the main body.
    pub(crate) fn mount(&self, i: usize) -> Mount<R> {
        let mounts = self.mounts.as_deref().unwrap_or_default();
        let (rot, point) = (self.rot_body_from_appendage, self.point);
        i.checked_sub(1).map_or(Mount::Across { rot, point }, |before| mounts[before])
    }
}

/// One state of a satellite and what acts on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinates<R> {
    /// ω, main-body axes \[rad/T\].
    pub omega: Vec3<R>,
    /// External wrench about O, main-body axes.
    pub external: Wrench<R>,
    /// β, τ and generalised force of each hinge, appendage by appendage.
    pub hinges: Vec<HingeCoordinates<R>>,
}

/// Angle, rate and generalised force of one hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeCoordinates<R> {
    /// Angle relative to the inboard link \[rad\].
    pub beta: R,
    /// Rate relative to the inboard link \[rad/T\].
    pub tau: R,
    /// Generalised force conjugate to β.
    pub torque: R,
}

/// Accelerations in the order (ω̇, a_O, τ̇ of each hinge).
#[derive(Clone, Debug, PartialEq)]
pub struct Solution<R> {
    /// ω̇ and a_O, main-body axes.
    pub main: Twist<R>,
    /// τ̇ of each hinge.
    pub tau_dot: Vec<R>,
}

/// Where the numbers of [`Parameters`], [`Coordinates`] and [`Solution`] stand when they are
/// written one after the other.
///
/// Parameters are written appendage by appendage. In a state and in accelerations the hinges
/// of equal appendages stand side by side, so that they can be taken together.
#[derive(Clone, Copy, Debug)]
pub struct Layout;

impl Layout {
    /// Numbers of the main body.
    pub const MAIN: usize = 10;
    /// Numbers of an appendage before its links.
    pub const BRANCH: usize = 12;
    /// Numbers of a link of a chain or paddle.
    pub const LINK: usize = 12;
    /// Numbers of a body.
    pub const BODY: usize = 10;
    /// Numbers of a link's way to the next hinge, or from its inboard one where axes are parallel.
    pub const WAY: usize = 2;
    /// Numbers of a state before the hinges: ω, external moment, external force.
    pub const STATE: usize = 9;
    /// Numbers of a hinge in a state: β, τ, torque.
    pub const HINGE: usize = 3;
    /// Numbers of accelerations before the hinges: ω̇, a_O.
    pub const OUTPUT: usize = 6;

    /// The numbers of a main body that is held.
    pub fn held_main() -> Vec<f64> {
        let mut numbers = Vec::with_capacity(Self::MAIN);
        write_rigid(&WeldedTree::heavy_main(), &mut numbers);
        numbers
    }

    /// How many numbers parameters take.
    pub fn parameters(topology: &Topology) -> usize {
        let appendages = topology.shapes().iter();
        Self::MAIN + appendages.map(Self::appendage).sum::<usize>()
    }

    /// How many numbers the parameters of an appendage take.
    pub fn appendage(shape: &Shape) -> usize {
        Self::BRANCH + (0..shape.hinges()).map(|link| Self::link(shape, link)).sum::<usize>()
    }

    /// How many numbers the parameters of a link take: those of its body, and the way to the next hinge; in a
    /// limb, before those of its body, where it is mounted.
    pub fn link(shape: &Shape, link: usize) -> usize {
        let Shape::Limb(limb) = shape else { return Self::LINK };
        Self::mount(limb, link) + Self::BODY
    }

    /// Where the numbers of each link of chains and paddles begin.
    pub fn links(topology: &Topology) -> Vec<usize> {
        let mut at = Self::MAIN;
        let mut links = Vec::new();
        for shape in topology.shapes() {
            let first = at + Self::BRANCH;
            at += Self::appendage(shape);
            if !matches!(shape, Shape::Limb(_)) {
                links.extend((first..at).step_by(Self::LINK));
            }
        }
        links
    }

    /// How many numbers tell where a link of a limb is mounted; those of the first are the branch's.
    pub fn mount(limb: &Limb, link: usize) -> usize {
        match limb.links()[link].joint {
            _ if link == 0 => 0,
            LimbJoint::Parallel => Self::WAY,
            LimbJoint::Revolute | LimbJoint::Prismatic => Self::BRANCH,
        }
    }

    /// How many numbers a state takes.
    pub fn coordinates(topology: &Topology) -> usize {
        Self::STATE + Self::HINGE * topology.hinges()
    }

    /// How many numbers accelerations take.
    pub fn outputs(topology: &Topology) -> usize {
        Self::OUTPUT + topology.hinges()
    }

    /// For each hinge, appendage by appendage, where it stands: hinge `i` of appendage `a` of a
    /// group of `count` equal ones is at `start + i · count + a`, where `start` counts the
    /// hinges of the groups before.
    pub fn places(topology: &Topology) -> Vec<usize> {
        let mut places = Vec::with_capacity(topology.hinges());
        let mut start = 0;
        for (shape, count) in topology.groups() {
            for a in 0..count {
                places.extend((0..shape.hinges()).map(|i| start + i * count + a));
            }
            start += shape.hinges() * count;
        }
        places
    }

    /// Where β, τ and torque of the hinge at `place` of a group stand in a state: the group's
    /// β, τ and torques of one hinge follow each other.
    pub fn hinge_in_state(topology: &Topology, place: usize) -> [usize; 3] {
        let mut start = 0;
        for (shape, count) in topology.groups() {
            let hinges = shape.hinges() * count;
            if place < start + hinges {
                let (i, a) = ((place - start) / count, (place - start) % count);
                let at = Self::STATE + Self::HINGE * (start + i * count) + a;
                return [at, at + count, at + 2 * count];
            }
            start += hinges;
        }
        panic!("hinge {place} of {start}")
    }
}

/// Reads numbers one after the other.
pub(crate) struct Reader<I>(pub I);

impl<R: Real, I: Iterator<Item = R>> Reader<I> {
    pub fn next(&mut self) -> R {
        self.0.next().expect("the layout counts the numbers")
    }

    pub fn vector(&mut self) -> Vec3<R> {
        let (x, y, z) = (self.next(), self.next(), self.next());
        Vec3::new(x, y, z)
    }

    pub fn rigid(&mut self) -> RigidInertia<R> {
        let (mass, first_moment) = (self.next(), self.vector());
        let (diagonal, products) = (self.vector(), self.vector());
        let about_origin = Sym3 {
            xx: diagonal.x,
            yy: diagonal.y,
            zz: diagonal.z,
            xy: products.x,
            xz: products.y,
            yz: products.z,
        };
        RigidInertia { mass, first_moment, about_origin }
    }

    pub fn branch(&mut self, shape: &Shape) -> Branch<R> {
        if let Shape::Limb(limb) = shape {
            return self.limb(limb.links());
        }
        let branch = self.branch_without_links();
        Branch { links: (0..shape.hinges()).map(|_| self.link()).collect(), ..branch }
    }

    /// A limb of these links.
    pub fn limb(&mut self, links: &[LimbLink]) -> Branch<R> {
        let mut branch = self.branch_without_links();
        let mut mounts = Vec::with_capacity(links.len());
        for (i, link) in links.iter().enumerate() {
            if i > 0 {
                mounts.push(self.mount(link.joint));
            }
            branch.links.push(ChainLink { inertia: self.rigid(), next: [R::zero(); 2] });
        }
        Branch { mounts: Some(mounts), ..branch }
    }

    pub fn mount(&mut self, joint: LimbJoint) -> Mount<R> {
        match joint {
            LimbJoint::Parallel => Mount::Parallel([self.next(), self.next()]),
            LimbJoint::Revolute | LimbJoint::Prismatic => {
                let rows = (self.vector(), self.vector(), self.vector());
                let rot = Mat3::from_rows(rows.0, rows.1, rows.2);
                Mount::Across { rot, point: self.vector() }
            }
        }
    }

    pub fn branch_without_links(&mut self) -> Branch<R> {
        let rows = (self.vector(), self.vector(), self.vector());
        let rot_body_from_appendage = Mat3::from_rows(rows.0, rows.1, rows.2);
        let point = self.vector();
        Branch { rot_body_from_appendage, point, links: Vec::new(), mounts: None }
    }

    pub fn link(&mut self) -> ChainLink<R> {
        let inertia = self.rigid();
        ChainLink { inertia, next: [self.next(), self.next()] }
    }
}

impl<R: Real> Parameters<R> {
    /// Reads what [`write`](Self::write) writes: mass, first moment, moments xx, yy, zz and
    /// products xy, xz, yz of the main body; then for each appendage the rotation by rows and
    /// the first hinge, and for each link the same ten numbers and the way to the next hinge. Before the
    /// ten numbers of a limb's link stands where it is mounted: nothing for the first; the way from the
    /// inboard joint where the axes are parallel; else the rotation by rows and the joint. The main body is free.
    pub fn read(topology: &Topology, numbers: impl IntoIterator<Item = R>) -> Self {
        let mut reader = Reader(numbers.into_iter());
        let main = reader.rigid();
        let branches = topology.shapes().iter().map(|shape| reader.branch(shape)).collect();
        Self { main, main_is_held: false, branches }
    }

    /// The numbers in order.
    pub fn write(&self) -> Vec<R> {
        let mut numbers = Vec::new();
        write_rigid(&self.main, &mut numbers);
        for branch in &self.branches {
            write_place(&branch.rot_body_from_appendage, branch.point, &mut numbers);
            write_links(branch, &mut numbers);
        }
        numbers
    }
}

/// Writes the links of an appendage.
pub(crate) fn write_links<R: Real>(branch: &Branch<R>, numbers: &mut Vec<R>) {
    let Some(mounts) = &branch.mounts else {
        return branch.links.iter().for_each(|link| write_link(link, numbers));
    };
    for (i, link) in branch.links.iter().enumerate() {
        match i.checked_sub(1).map(|before| &mounts[before]) {
            None => {}
            Some(Mount::Parallel(way)) => numbers.extend(way),
            Some(Mount::Across { rot, point }) => write_place(rot, *point, numbers),
        }
        write_rigid(&link.inertia, numbers);
    }
}

/// Writes how an appendage is turned and where its first hinge is.
pub(crate) fn write_place<R: Real>(rot: &Mat3<R>, point: Vec3<R>, numbers: &mut Vec<R>) {
    numbers.extend(rot.rows.into_iter().flat_map(Vec3::to_array));
    numbers.extend(point.to_array());
}

pub(crate) fn write_link<R: Real>(link: &ChainLink<R>, numbers: &mut Vec<R>) {
    write_rigid(&link.inertia, numbers);
    numbers.extend(link.next);
}

pub(crate) fn write_rigid<R: Real>(body: &RigidInertia<R>, numbers: &mut Vec<R>) {
    let i = &body.about_origin;
    numbers.push(body.mass);
    numbers.extend(body.first_moment.to_array());
    numbers.extend([i.xx, i.yy, i.zz, i.xy, i.xz, i.yz]);
}

impl<R: Real> Coordinates<R> {
    /// Reads ω, external moment and force, then the hinges in the order of [`Layout`].
    pub fn read(topology: &Topology, numbers: &[R]) -> Self {
        let mut reader = Reader(numbers.iter().copied());
        let omega = reader.vector();
        let external = Wrench { moment: reader.vector(), force: reader.vector() };
        let hinge = |place| {
            let [beta, tau, torque] = Layout::hinge_in_state(topology, place).map(|at| numbers[at]);
            HingeCoordinates { beta, tau, torque }
        };
        let hinges = Layout::places(topology).into_iter().map(hinge).collect();
        Self { omega, external, hinges }
    }

    /// The numbers in order.
    pub fn write(&self, topology: &Topology) -> Vec<R> {
        let mut numbers = self.omega.to_array().to_vec();
        numbers.extend(self.external.moment.to_array());
        numbers.extend(self.external.force.to_array());
        numbers.resize(Layout::coordinates(topology), R::zero());
        for (hinge, place) in self.hinges.iter().zip(Layout::places(topology)) {
            let [beta, tau, torque] = Layout::hinge_in_state(topology, place);
            (numbers[beta], numbers[tau], numbers[torque]) = (hinge.beta, hinge.tau, hinge.torque);
        }
        numbers
    }
}

impl<R: Real> Solution<R> {
    /// The numbers in order: ω̇, a_O, then τ̇ in the order of [`Layout`].
    pub fn write(&self, topology: &Topology) -> Vec<R> {
        let mut numbers = self.main.angular.to_array().to_vec();
        numbers.extend(self.main.linear.to_array());
        numbers.resize(Layout::outputs(topology), R::zero());
        for (tau_dot, place) in self.tau_dot.iter().zip(Layout::places(topology)) {
            numbers[Layout::OUTPUT + place] = *tau_dot;
        }
        numbers
    }
}
