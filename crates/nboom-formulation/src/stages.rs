//! The elimination of [`articulated`](crate::articulated) cut into the steps of its sweeps.
//!
//! Each step maps flat groups of numbers to flat groups of numbers, so that it can be traced
//! once and emitted as one function that a loop calls for every link.

use std::fmt;

use nboom_scalar::{ArticulatedInertia, Mat3, Real, Sym3, Twist, Vec3, Wrench};

use crate::articulated::{at_origin, first_hinge};
use crate::base::AtOrigin;
use crate::chain::{self, Eliminated, OutboardShare, Outward, Spin, Turned};
use crate::paddle::{self, ArmRates, Paddle};
use crate::parameters::{Layout, Reader};

mod base;
mod forces;
mod group;
mod joint;
mod limb;
mod trunk;

pub use crate::limb::Standing;
pub use base::{base, base_in_mode, held_base, held_base_in_mode};
pub use forces::{
    ATTITUDE, ATTITUDE_RATE, BETA, COUPLING, INBOARD_BETA, INBOARD_TAU, INBOARD_TORQUE, LAW, LINE,
    POWER, attitude, coupling, law,
};
pub use group::Group;
pub use joint::{
    BIAS, JOINT, Mounting, OUTBOARD, RATES, SHARE, STANCE, joint_back, joint_inward, joint_outward,
    limb_root, mount_back, mount_inward, mount_outward,
};
pub use limb::{LIMB, LIMB_HINGES, LIMB_TAU_DOT, limb_back, limb_in, of_limb};
pub use trunk::{
    CARRIER, CARRIER_RATES, KEPT, Trunk, part_back, part_inward, trunk_back, trunk_inward,
    trunk_outward,
};

/// From numbers one after the other to numbers one after the other.
pub type Run<R> = dyn Fn(&[R]) -> Vec<R>;

/// A step: what it reads and writes, each a named group of so many numbers.
pub struct Stage<R: 'static> {
    /// Name, used in generated code.
    pub name: &'static str,
    /// What it computes, in one line.
    pub about: &'static str,
    /// Groups read that are parameters.
    pub parameters: Vec<Group>,
    /// Groups read that vary.
    pub inputs: Vec<Group>,
    /// Groups written.
    pub outputs: Vec<Group>,
    /// The step: parameters and inputs one after the other to outputs one after the other.
    pub run: Box<Run<R>>,
}

impl<R> fmt::Debug for Stage<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stage").field("name", &self.name).finish_non_exhaustive()
    }
}

impl<R: Real> Stage<R> {
    /// The step without a group that it writes.
    pub fn without(self, group: Group) -> Self {
        let Self { outputs, run, .. } = self;
        let is_written = |other: &Group| *other != group;
        let kept: Vec<bool> =
            outputs.iter().flat_map(|of| std::iter::repeat_n(is_written(of), of.size())).collect();
        let outputs = outputs.into_iter().filter(is_written).collect();
        let run = move |numbers: &[R]| {
            let written = run(numbers).into_iter().zip(&kept);
            written.filter(|(_, kept)| **kept).map(|(number, _)| number).collect()
        };
        Self { outputs, run: Box::new(run), ..self }
    }
}

/// Mass, first moment and inertia about a body's own point.
const BODY: [&str; Layout::MAIN] =
    ["mass", "cx", "cy", "cz", "jxx", "jyy", "jzz", "jxy", "jxz", "jyz"];

/// ω, main-body axes.
pub const OMEGA: Group = Group::new("omega", &["omega_x", "omega_y", "omega_z"]);
/// ω, appendage axes.
pub const W: Group = Group::new("w", &["wx", "wy", "wz"]);
/// External moment and force on the main body.
pub const EXTERNAL: Group =
    Group::new("external", &["moment_x", "moment_y", "moment_z", "force_x", "force_y", "force_z"]);
/// Angular momentum of rotors on the main body relative to it.
pub const SPIN: Group = Group::new("spin", &["spin_x", "spin_y", "spin_z"]);
/// Parameters of an appendage before its links: its rotation by rows and its first hinge.
pub const BRANCH: Group = Group::new(
    "branch",
    &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33", "dx", "dy", "dz"],
);
/// Parameters of a link: its body and the way to the next hinge.
pub const LINK: Group = Group::new(
    "link",
    &["mass", "cx", "cy", "cz", "jxx", "jyy", "jzz", "jxy", "jxz", "jyz", "ly", "lz"],
);
/// Parameters of a paddle's second link.
pub const PADDLE_LINK: Group = Group::new("paddle_link", LINK.numbers);
/// Parameters of the main body.
pub const MAIN: Group = Group::new("main", &BODY);
/// Sine and cosine of a link's absolute angle.
pub const TURN: Group = Group::new("turn", &["sin", "cos"]);
/// τ of a hinge.
pub const TAU: Group = Group::new("tau", &["tau"]);
/// β, τ and torque of arm and paddle.
pub const PADDLE_HINGES: Group =
    Group::new("hinges", &["beta_1", "tau_1", "torque_1", "beta_2", "tau_2", "torque_2"]);
/// Torque of a hinge less that of the next one.
pub const NET_TORQUE: Group = Group::new("net_torque", &["net_torque"]);
/// Torque of the first hinge.
pub const TORQUE: Group = Group::new("torque", &["torque"]);
/// How far the outward sweep has come: σ, and the bias acceleration of the next hinge.
pub const REACHED: Group = Group::new("reached", &["sigma", "bx", "by", "bz"]);
/// A link in appendage axes: what varies of first moment, inertia and way to the next hinge, bias
/// moment and force.
pub const TURNED: Group = Group::new(
    "turned",
    &[
        "cy", "cz", "jyy", "jzz", "jxy", "jxz", "jyz", "ly", "lz", "nx", "ny", "nz", "fx", "fy",
        "fz",
    ],
);
/// The share of a link and everything outboard of it: moments 2 and 3 per ω̇₂, ω̇₃ and per a, force per a,
/// moments 2 and 3, force.
pub const OUTBOARD_SHARE: Group = Group::new(
    "share",
    &[
        "ayy", "azz", "ayz", "byx", "byy", "byz", "bzx", "bzy", "bzz", "mxx", "myy", "mzz", "mxy",
        "mxz", "myz", "qy", "qz", "px", "py", "pz",
    ],
);
/// What an eliminated hinge leaves: couplings of ε to ω̇₂, ω̇₃ and a, the inverse pivot, the moment
/// left for ε, the way to the next hinge.
pub const ELIMINATED: Group =
    Group::new("eliminated", &["uy", "uz", "vx", "vy", "vz", "inverse", "left", "ly", "lz"]);
/// What an eliminated paddle hinge leaves: its column, the inverse pivot, the moment left.
pub const PADDLE: Group =
    Group::new("paddle", &["hx", "hy", "hz", "gx", "gy", "gz", "paddle_inverse", "paddle_left"]);
/// What an appendage shows at O: moment per ω̇ and per a, force per a, moment, force.
pub const AT_ORIGIN: Group = Group::new(
    "at_origin",
    &[
        "axx", "ayy", "azz", "axy", "axz", "ayz", "bxx", "bxy", "bxz", "byx", "byy", "byz", "bzx",
        "bzy", "bzz", "mxx", "myy", "mzz", "mxy", "mxz", "myz", "qx", "qy", "qz", "px", "py", "pz",
    ],
);
/// ω̇ and a_O, main-body axes.
pub const MAIN_RATES: Group =
    Group::new("main_rates", &["omega_dot_x", "omega_dot_y", "omega_dot_z", "a_x", "a_y", "a_z"]);
/// ω̇₁ or ε of the inboard link, and ω̇₂, ω̇₃.
pub const TURNING: Group = Group::new("turning", &["epsilon", "w_dot_y", "w_dot_z"]);
/// Acceleration of a hinge.
pub const HINGE_RATES: Group = Group::new("hinge_rates", &["a_x", "a_y", "a_z"]);
/// τ̇ of a hinge.
pub const TAU_DOT: Group = Group::new("tau_dot", &["tau_dot"]);
/// τ̇ of arm and paddle.
pub const PADDLE_TAU_DOT: Group = Group::new("tau_dot", &["tau_dot_1", "tau_dot_2"]);

/// ω in appendage axes and the beginning of the outward sweep.
pub fn start<R: Real>() -> Stage<R> {
    Stage {
        name: "start",
        about: "ω in appendage axes, and the bias acceleration of the first hinge.",
        parameters: vec![BRANCH],
        inputs: vec![OMEGA],
        outputs: vec![W, REACHED],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let w = branch.rot_body_from_appendage.transpose_mul(reader.vector());
            let hinge = Spin::new(w).bias_of_main_point(branch.point);
            [w.to_array().to_vec(), vec![R::zero()], hinge.to_array().to_vec()].concat()
        }),
    }
}

/// One step of the outward sweep.
pub fn outward<R: Real>() -> Stage<R> {
    Stage {
        name: "outward",
        about: "A link turned by its absolute angle, with its bias, and how the next hinge moves.",
        parameters: vec![LINK],
        inputs: vec![W, TURN, TAU, REACHED],
        outputs: vec![TURNED, REACHED],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let link = reader.link();
            let spin = Spin::new(reader.vector());
            let turn = (reader.next(), reader.next());
            let tau = reader.next();
            let from = (reader.next(), reader.vector());
            let (turned, sigma, hinge) = chain::outward_at(&spin, &link, turn, tau, from);
            [turned.flat(), vec![sigma], hinge.to_array().to_vec()].concat()
        }),
    }
}

/// One step of the inward sweep.
pub fn inward<R: Real>() -> Stage<R> {
    Stage {
        name: "inward",
        about: "A link's hinge eliminated: what it shows inboard, and what is left for the way back.",
        parameters: vec![LINK],
        inputs: vec![TURNED, NET_TORQUE, OUTBOARD_SHARE],
        outputs: vec![OUTBOARD_SHARE, ELIMINATED],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let link = reader.link();
            let turned = Turned::read(&link, &mut reader);
            let net_torque = reader.next();
            let outboard = OutboardShare::read(&mut reader);
            let (share, eliminated) = chain::inward(&turned, net_torque, &outboard);
            [share.flat(), eliminated.flat()].concat()
        }),
    }
}

/// What a chain shows at O.
pub fn root<R: Real>() -> Stage<R> {
    Stage {
        name: "root",
        about: "What a chain shows at O, main-body axes.",
        parameters: vec![BRANCH],
        inputs: vec![OUTBOARD_SHARE, TORQUE],
        outputs: vec![AT_ORIGIN],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let share = OutboardShare::read(&mut reader);
            let torque = reader.next();
            at_origin(&share, torque, branch.point, &branch.rot_body_from_appendage).flat()
        }),
    }
}

/// ω̇ and the first hinge's acceleration in appendage axes.
pub fn first<R: Real>() -> Stage<R> {
    Stage {
        name: "first",
        about: "ω̇ and the acceleration of the first hinge in appendage axes.",
        parameters: vec![BRANCH],
        inputs: vec![MAIN_RATES],
        outputs: vec![TURNING, HINGE_RATES],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.branch_without_links();
            let main = Twist { angular: reader.vector(), linear: reader.vector() };
            let (w, a) = first_hinge(branch.point, &branch.rot_body_from_appendage, main);
            [w.to_array(), a.to_array()].concat()
        }),
    }
}

/// One step of the way back.
pub fn back<R: Real>() -> Stage<R> {
    Stage {
        name: "back",
        about: "τ̇ of a hinge, and the accelerations of the next one.",
        parameters: vec![],
        inputs: vec![ELIMINATED, TURNING, HINGE_RATES],
        outputs: vec![TAU_DOT, TURNING, HINGE_RATES],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let eliminated = Eliminated::read(&mut reader);
            let (turning, a) = (reader.vector(), reader.vector());
            let (epsilon, next) = chain::back(&eliminated, [turning.y, turning.z], a);
            let passed = [epsilon, turning.y, turning.z];
            [vec![epsilon - turning.x], passed.to_vec(), next.to_array().to_vec()].concat()
        }),
    }
}

/// A whole paddle: what it shows at O, and what its two hinges leave.
pub fn paddle_in<R: Real>() -> Stage<R> {
    Stage {
        name: "paddle_in",
        about: "Both hinges of a paddle eliminated: what it shows at O, and what they leave.",
        parameters: vec![BRANCH, LINK, PADDLE_LINK],
        inputs: vec![OMEGA, PADDLE_HINGES],
        outputs: vec![AT_ORIGIN, ELIMINATED, PADDLE],
        run: Box::new(|numbers| {
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
            let (share, eliminated) = paddle::arm_inward(&arm, torque, &inertia, wrench);
            let seen = at_origin(&share, torque, branch.point, &rot);
            [seen.flat(), eliminated.flat(), paddle.flat()].concat()
        }),
    }
}

/// The way back through a paddle.
pub fn paddle_back<R: Real>() -> Stage<R> {
    Stage {
        name: "paddle_back",
        about: "τ̇ of the two hinges of a paddle.",
        parameters: vec![],
        inputs: vec![ELIMINATED, PADDLE, TURNING, HINGE_RATES],
        outputs: vec![PADDLE_TAU_DOT],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let eliminated = Eliminated::read(&mut reader);
            let paddle = Paddle::read(&mut reader);
            let (turning, a) = (reader.vector(), reader.vector());
            let (epsilon, next) = chain::back(&eliminated, [turning.y, turning.z], a);
            let angular = Vec3::new(epsilon, turning.y, turning.z);
            let of_paddle = paddle::back(&paddle, Twist { angular, linear: next });
            vec![epsilon - turning.x, of_paddle]
        }),
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

impl<R: Real> OutboardShare<R> {
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
