//! The elimination of [`articulated`](crate::articulated) cut into the steps of its sweeps.
//!
//! Each step maps flat groups of numbers to flat groups of numbers, so that it can be traced
//! once and emitted as one function that a loop calls for every link.

use nboom_scalar::{ArticulatedInertia, Mat3, Real, Sym3, Twist, Vec3, Wrench};

use crate::articulated::{at_origin, first_hinge};
use crate::base::AtOrigin;
use crate::chain::{self, Eliminated, Outward, Shown, Spin, Turned};
use crate::paddle::{self, ArmRates, Paddle};
use crate::parameters::{Layout, Reader};

/// A step: what it reads and writes, each a named group of so many numbers.
#[derive(Clone, Copy, Debug)]
pub struct Stage<R: 'static> {
    /// Name, used in generated code.
    pub name: &'static str,
    /// Groups read that are parameters.
    pub parameters: &'static [Group],
    /// Groups read that vary.
    pub inputs: &'static [Group],
    /// Groups written.
    pub outputs: &'static [Group],
    /// The step: parameters and inputs one after the other to outputs one after the other.
    pub run: fn(&[R]) -> Vec<R>,
}

/// A named group of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Name.
    pub name: &'static str,
    /// How many numbers.
    pub size: usize,
}

const fn group(name: &'static str, size: usize) -> Group {
    Group { name, size }
}

/// ω, main-body axes.
pub const OMEGA: Group = group("omega", 3);
/// ω, appendage axes.
pub const W: Group = group("w", 3);
/// External moment and force on the main body.
pub const EXTERNAL: Group = group("external", 6);
/// Parameters of an appendage before its links.
pub const BRANCH: Group = group("branch", Layout::BRANCH);
/// Parameters of a link.
pub const LINK: Group = group("link", Layout::LINK);
/// Parameters of a paddle's second link.
pub const PADDLE_LINK: Group = group("paddle_link", Layout::LINK);
/// Parameters of the main body.
pub const MAIN: Group = group("main", Layout::MAIN);
/// Sine and cosine of a link's absolute angle.
pub const TURN: Group = group("turn", 2);
/// τ of a hinge.
pub const TAU: Group = group("tau", 1);
/// β, τ and torque of arm and paddle.
pub const PADDLE_HINGES: Group = group("hinges", 6);
/// Torque of a hinge less that of the next one.
pub const EXCESS: Group = group("excess", 1);
/// Torque of the first hinge.
pub const TORQUE: Group = group("torque", 1);
/// How far the outward sweep has come: σ, and the bias acceleration of the next hinge.
pub const REACHED: Group = group("reached", 4);
/// A link in appendage axes.
pub const TURNED: Group = group("turned", 15);
/// What a link shows its inboard neighbour.
pub const SHOWN: Group = group("shown", 20);
/// What an eliminated hinge leaves.
pub const ELIMINATED: Group = group("eliminated", 9);
/// What an eliminated paddle hinge leaves.
pub const PADDLE: Group = group("paddle", 8);
/// What an appendage shows at O.
pub const AT_ORIGIN: Group = group("at_origin", 27);
/// ω̇ and a_O, main-body axes.
pub const MAIN_RATES: Group = group("main_rates", 6);
/// ω̇₁ or ε of the inboard link, and ω̇₂, ω̇₃.
pub const TURNING: Group = group("turning", 3);
/// Acceleration of a hinge.
pub const HINGE_RATES: Group = group("hinge_rates", 3);
/// τ̇ of a hinge.
pub const TAU_DOT: Group = group("tau_dot", 1);
/// τ̇ of arm and paddle.
pub const PADDLE_TAU_DOT: Group = group("tau_dot", 2);

/// ω in appendage axes and the beginning of the outward sweep.
pub fn start<R: Real>() -> Stage<R> {
    Stage {
        name: "start",
        parameters: &[BRANCH],
        inputs: &[OMEGA],
        outputs: &[W, REACHED],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let w = branch.rot_body_from_appendage.transpose_mul(reader.vector());
            let hinge = Spin::new(w).bias_of_main_point(branch.point);
            [w.to_array().to_vec(), vec![R::zero()], hinge.to_array().to_vec()].concat()
        },
    }
}

/// One step of the outward sweep.
pub fn outward<R: Real>() -> Stage<R> {
    Stage {
        name: "outward",
        parameters: &[LINK],
        inputs: &[W, TURN, TAU, REACHED],
        outputs: &[TURNED, REACHED],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let link = reader.link();
            let spin = Spin::new(reader.vector());
            let turn = (reader.next(), reader.next());
            let tau = reader.next();
            let from = (reader.next(), reader.vector());
            let (turned, sigma, hinge) = chain::outward_at(&spin, &link, turn, tau, from);
            [turned.flat(), vec![sigma], hinge.to_array().to_vec()].concat()
        },
    }
}

/// One step of the inward sweep.
pub fn inward<R: Real>() -> Stage<R> {
    Stage {
        name: "inward",
        parameters: &[LINK],
        inputs: &[TURNED, EXCESS, SHOWN],
        outputs: &[SHOWN, ELIMINATED],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let link = reader.link();
            let turned = Turned::read(&link, &mut reader);
            let excess = reader.next();
            let outboard = Shown::read(&mut reader);
            let (shown, eliminated) = chain::inward(&turned, excess, &outboard);
            [shown.flat(), eliminated.flat()].concat()
        },
    }
}

/// What a chain shows at O.
pub fn root<R: Real>() -> Stage<R> {
    Stage {
        name: "root",
        parameters: &[BRANCH],
        inputs: &[SHOWN, TORQUE],
        outputs: &[AT_ORIGIN],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let shown = Shown::read(&mut reader);
            let torque = reader.next();
            at_origin(&shown, torque, branch.point, &branch.rot_body_from_appendage).flat()
        },
    }
}

/// Accelerations of the main body from the sum of what all appendages show.
pub fn base<R: Real>() -> Stage<R> {
    Stage {
        name: "base",
        parameters: &[MAIN],
        inputs: &[OMEGA, EXTERNAL, AT_ORIGIN],
        outputs: &[MAIN_RATES],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let main = reader.rigid();
            let omega = reader.vector();
            let external = Wrench { moment: reader.vector(), force: reader.vector() };
            let mut total = AtOrigin::of_main_body(&main, omega, &external);
            total.add(&AtOrigin::read(&mut reader));
            let rates = total.accelerations();
            [rates.angular.to_array(), rates.linear.to_array()].concat()
        },
    }
}

/// ω̇ and the first hinge's acceleration in appendage axes.
pub fn first<R: Real>() -> Stage<R> {
    Stage {
        name: "first",
        parameters: &[BRANCH],
        inputs: &[MAIN_RATES],
        outputs: &[TURNING, HINGE_RATES],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let main = Twist { angular: reader.vector(), linear: reader.vector() };
            let (w, a) = first_hinge(branch.point, &branch.rot_body_from_appendage, main);
            [w.to_array(), a.to_array()].concat()
        },
    }
}

/// One step of the way back.
pub fn back<R: Real>() -> Stage<R> {
    Stage {
        name: "back",
        parameters: &[],
        inputs: &[ELIMINATED, TURNING, HINGE_RATES],
        outputs: &[TAU_DOT, TURNING, HINGE_RATES],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let eliminated = Eliminated::read(&mut reader);
            let (turning, a) = (reader.vector(), reader.vector());
            let (epsilon, next) = chain::back(&eliminated, [turning.y, turning.z], a);
            let passed = [epsilon, turning.y, turning.z];
            [vec![epsilon - turning.x], passed.to_vec(), next.to_array().to_vec()].concat()
        },
    }
}

/// A whole paddle: what it shows at O, and what its two hinges leave.
pub fn paddle_in<R: Real>() -> Stage<R> {
    Stage {
        name: "paddle_in",
        parameters: &[BRANCH, LINK, PADDLE_LINK],
        inputs: &[OMEGA, PADDLE_HINGES],
        outputs: &[AT_ORIGIN, ELIMINATED, PADDLE],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let (arm, link) = (reader.link(), reader.link());
            let rot = branch.rot_body_from_appendage;
            let spin = Spin::new(rot.transpose_mul(reader.vector()));
            let [beta, tau, torque] = reader.vector().to_array();
            let from = Outward {
                alpha: R::zero(),
                sigma: R::zero(),
                hinge: spin.bias_of_main_point(branch.point),
            };
            let (arm, reached) = chain::outward(&spin, &arm, beta, tau, from);
            let of_paddle = reader.vector();
            let rates =
                ArmRates { arm: reached, beta: of_paddle.x, tau: of_paddle.y, torque: of_paddle.z };
            let (inertia, wrench, paddle) = paddle::eliminate(&spin, &link.inertia, &rates);
            let (shown, eliminated) = paddle::arm_inward(&arm, torque, &inertia, wrench);
            let seen = at_origin(&shown, torque, branch.point, &rot);
            [seen.flat(), eliminated.flat(), paddle.flat()].concat()
        },
    }
}

/// The way back through a paddle.
pub fn paddle_back<R: Real>() -> Stage<R> {
    Stage {
        name: "paddle_back",
        parameters: &[],
        inputs: &[ELIMINATED, PADDLE, TURNING, HINGE_RATES],
        outputs: &[PADDLE_TAU_DOT],
        run: |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let eliminated = Eliminated::read(&mut reader);
            let paddle = Paddle::read(&mut reader);
            let (turning, a) = (reader.vector(), reader.vector());
            let (epsilon, next) = chain::back(&eliminated, [turning.y, turning.z], a);
            let angular = Vec3::new(epsilon, turning.y, turning.z);
            let of_paddle = paddle::back(&paddle, Twist { angular, linear: next });
            vec![epsilon - turning.x, of_paddle]
        },
    }
}

type Numbers<'a, R> = Reader<std::iter::Copied<std::slice::Iter<'a, R>>>;

fn sym_flat<R: Real>(m: &Sym3<R>) -> [R; 6] {
    [m.xx, m.yy, m.zz, m.xy, m.xz, m.yz]
}

fn sym_read<R: Real>(reader: &mut Numbers<'_, R>) -> Sym3<R> {
    let (diagonal, products) = (reader.vector(), reader.vector());
    let [xx, yy, zz] = diagonal.to_array();
    let [xy, xz, yz] = products.to_array();
    Sym3 { xx, yy, zz, xy, xz, yz }
}

impl<R: Real> Shown<R> {
    fn flat(&self) -> Vec<R> {
        let mut flat = self.angular.to_vec();
        self.coupling.iter().for_each(|row| flat.extend(row.to_array()));
        flat.extend(sym_flat(&self.linear));
        flat.extend(self.moment);
        flat.extend(self.force.to_array());
        flat
    }

    fn read(reader: &mut Numbers<'_, R>) -> Self {
        Self {
            angular: reader.vector().to_array(),
            coupling: [reader.vector(), reader.vector()],
            linear: sym_read(reader),
            moment: [reader.next(), reader.next()],
            force: reader.vector(),
        }
    }
}

impl<R: Real> AtOrigin<R> {
    fn flat(&self) -> Vec<R> {
        let ArticulatedInertia { angular, coupling, linear } = &self.inertia;
        let mut flat = sym_flat(angular).to_vec();
        coupling.rows.iter().for_each(|row| flat.extend(row.to_array()));
        flat.extend(sym_flat(linear));
        flat.extend(self.wrench.moment.to_array());
        flat.extend(self.wrench.force.to_array());
        flat
    }

    fn read(reader: &mut Numbers<'_, R>) -> Self {
        let angular = sym_read(reader);
        let coupling = Mat3 { rows: [reader.vector(), reader.vector(), reader.vector()] };
        let inertia = ArticulatedInertia { angular, coupling, linear: sym_read(reader) };
        let wrench = Wrench { moment: reader.vector(), force: reader.vector() };
        Self { inertia, wrench }
    }
}
