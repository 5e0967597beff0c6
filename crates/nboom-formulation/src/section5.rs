//! The report's equations of motion, Section 5, with its corrections: matrix A and right side
//! over (v̇, ω̇, σ̇), as functions of ρ̄ and v̄ also.
//!
//! What the report writes with C̄, I about the mass centre and ℓ η̂ is written here with m C̄,
//! inertia about the hinge and a way L̄ of any direction square to ê₁, so that ℓ ζ̂ is ê₁ × L̄.
//! Hinges that are held may then be welded, and links need not have mass.

use nboom_model::{Shape, Topology};
use nboom_scalar::{Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::dense;
use crate::parameters::{Branch, Coordinates, HingeCoordinates, Parameters};
use crate::pose::{self, Posed, each};

/// Where O is and how fast it moves, as the report describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OriginMotion<R> {
    /// ρ̄, O from the inertial origin, main-body axes.
    pub rho: Vec3<R>,
    /// v̄, the rate of change of the components of ρ̄, main-body axes.
    pub v: Vec3<R>,
}

impl<R: Real> OriginMotion<R> {
    /// O at rest at the inertial origin, or passing it.
    pub fn origin() -> Self {
        Self { rho: Vec3::zero(), v: Vec3::zero() }
    }

    /// 2 ω × v̄ + ω × (ω × ρ̄): what a_O has besides v̄˙ + ω̇ × ρ̄.
    pub fn carried(&self, omega: Vec3<R>) -> Vec3<R> {
        let coriolis = omega.cross(self.v);
        coriolis + coriolis + omega.cross(omega.cross(self.rho))
    }
}

/// A square matrix and a right side.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations<R> {
    /// (6 + n)² entries, row by row.
    pub matrix: Vec<R>,
    /// 6 + n entries.
    pub forcing: Vec<R>,
}

impl<R: Real> Equations<R> {
    /// The unknowns.
    pub(crate) fn solve(&self) -> Vec<R> {
        R::remark(|| "The system solved, hinges first.".to_owned());
        dense::solve(&self.matrix, &self.forcing, &dense::hinges_first(self.forcing.len()))
    }
}

/// A and u of eq. (5.1) over (v̇, ω̇, σ̇); u is what eqs. (4.24), (4.36) and (4.38) to (4.43) have
/// besides. corrected: notes 1, 2, 11. Hinges stand appendage by appendage, O at `place`; without gravity.
pub fn equations_at<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
    place: &OriginMotion<R>,
) -> Equations<R> {
    let omega = coordinates.omega;
    let size = 6 + topology.hinges();
    let mut out =
        Equations { matrix: vec![R::zero(); size * size], forcing: vec![R::zero(); size] };
    let mut total = parameters.main;
    let mut bias = parameters.main.inertia_wrench(omega, Twist::zero());
    let mut first = 6;
    let branches = topology.shapes().iter().zip(&parameters.branches);
    for (i, (shape, branch)) in branches.enumerate() {
        let hinges = &coordinates.hinges[first - 6..first - 6 + shape.hinges()];
        R::remark(|| format!("Appendage {}: rows and columns of its hinges.", i + 1));
        let share = Share::of(shape, branch, omega, hinges, place);
        let rot = &branch.rot_body_from_appendage;
        total.add(share.total.rotated(rot));
        bias.add(pose::rotated(share.bias, rot));
        share.put(rot, first, &mut out);
        first += shape.hinges();
    }
    R::remark(|| "Main body: its rows and right side.".to_owned());
    put_main_rows(&total, place, &mut out);
    let carried = place.carried(omega);
    let force = coordinates.external.force - bias.force - carried * total.mass;
    let moment = coordinates.external.moment - bias.moment - total.first_moment.cross(carried);
    out.forcing[..3].copy_from_slice(&force.to_array());
    out.forcing[3..6].copy_from_slice(&moment.to_array());
    out
}

/// eqs. (5.4), (5.5), (5.7) and (5.8) over v̇ and ω̇, corrected: note 2.
fn put_main_rows<R: Real>(
    total: &RigidInertia<R>,
    place: &OriginMotion<R>,
    out: &mut Equations<R>,
) {
    let (moments, mass) = (Mat3::skew(total.first_moment), total.mass);
    let a12 = -(Mat3::skew(place.rho) * mass + moments);
    let a22 = total.about_origin.to_matrix() - moments * Mat3::skew(place.rho);
    let size = out.forcing.len();
    for i in 0..3 {
        out.matrix[i * size + i] = mass;
        for j in 0..3 {
            out.matrix[i * size + 3 + j] = a12.rows[i].to_array()[j];
            out.matrix[(3 + i) * size + j] = moments.rows[i].to_array()[j];
            out.matrix[(3 + i) * size + 3 + j] = a22.rows[i].to_array()[j];
        }
    }
}

/// What one appendage adds, appendage axes.
struct Share<R> {
    /// All links about O.
    total: RigidInertia<R>,
    /// Moment about O and force when no rate changes.
    bias: Wrench<R>,
    /// A₁s (force) and A₂s (moment about O) of each hinge.
    columns: Vec<Wrench<R>>,
    /// Aᵣ₁ (force) and Aᵣ₂ (moment) of each hinge.
    rows: Vec<Wrench<R>>,
    /// Aᵣₛ.
    hinges: Vec<Vec<R>>,
    /// uᵣ.
    right: Vec<R>,
}

impl<R: Real> Share<R> {
    fn of(
        shape: &Shape,
        branch: &Branch<R>,
        omega: Vec3<R>,
        hinges: &[HingeCoordinates<R>],
        place: &OriginMotion<R>,
    ) -> Self {
        let rot = &branch.rot_body_from_appendage;
        let w = rot.transpose_mul(omega);
        let links = pose::place(shape, branch, &each(hinges, |hinge| hinge.beta));
        let sigma = pose::absolute(shape, &each(hinges, |hinge| hinge.tau));
        let outboard = outboard_sums(&links);
        let bias = outboard_bias(&links, &bias_wrenches(shape, &links, w, &sigma));
        let columns = columns(shape, &links, &outboard);
        let rho = rot.transpose_mul(place.rho);
        let carried = rot.transpose_mul(place.carried(omega));
        let row = |(link, outer): (&Posed<R>, &RigidInertia<R>)| {
            let force = link.axis.cross(outer.first_moment);
            let moment = (rho + link.hinge).cross(force) + outer.about_origin * link.axis;
            Wrench { moment, force }
        };
        let right = |i: usize| {
            let moment = outboard[i].first_moment.cross(carried) + bias[i].moment;
            hinges[i].torque - links[i].axis.dot(moment)
        };
        Self {
            total: outboard[0].seen_from(branch.point),
            bias: bias[0].seen_from(branch.point),
            columns: links.iter().zip(&columns).map(|(l, c)| c.seen_from(l.hinge)).collect(),
            rows: links.iter().zip(&outboard).map(row).collect(),
            hinges: hinge_block(shape, &links, &outboard, &columns),
            right: (0..links.len()).map(right).collect(),
        }
    }

    fn put(&self, rot: &Mat3<R>, first: usize, out: &mut Equations<R>) {
        let size = out.forcing.len();
        for (i, (row, column)) in self.rows.iter().zip(&self.columns).enumerate() {
            let row = six(pose::rotated(*row, rot));
            let column = six(pose::rotated(*column, rot));
            for k in 0..6 {
                out.matrix[(first + i) * size + k] = row[k];
                out.matrix[k * size + first + i] = column[k];
            }
            for (j, &entry) in self.hinges[i].iter().enumerate() {
                out.matrix[(first + i) * size + first + j] = entry;
            }
            out.forcing[first + i] = self.right[i];
        }
    }
}

fn six<R: Real>(wrench: Wrench<R>) -> [R; 6] {
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

/// For each hinge all links outboard as one body about it: its first moment is β̄⁽²⁾ of
/// eq., its mass μ of the link before, and the tensor the sum in eq. (5.10).
fn outboard_sums<R: Real>(links: &[Posed<R>]) -> Vec<RigidInertia<R>> {
    let mut sum = RigidInertia::zero();
    let mut sums = Vec::new();
    for link in links.iter().rev() {
        sum = sum.seen_from(link.hinge_offset);
        sum.add(link.inertia);
        sums.push(sum);
    }
    sums.reverse();
    sums
}

/// The bias of all links outboard of each hinge: moment about it, and force.
fn outboard_bias<R: Real>(links: &[Posed<R>], own: &[Wrench<R>]) -> Vec<Wrench<R>> {
    let mut sum = Wrench::zero();
    let mut sums = Vec::new();
    for (link, own) in links.iter().zip(own).rev() {
        sum = sum.seen_from(link.hinge_offset);
        sum.add(*own);
        sums.push(sum);
    }
    sums.reverse();
    sums
}

/// m ḡ and the moment of each link about its hinge when no rate changes: eqs., (A-17)
/// and, corrected: note 11. ρ̄ and v̄ are left out.
fn bias_wrenches<R: Real>(
    shape: &Shape,
    links: &[Posed<R>],
    w: Vec3<R>,
    sigma: &[R],
) -> Vec<Wrench<R>> {
    let centripetal = |x: Vec3<R>| w.cross(w.cross(x));
    let (mut relative_rate, mut relative_bias) = (Vec3::zero(), Vec3::zero());
    let mut wrenches = Vec::new();
    for (i, (link, &sigma_i)) in links.iter().zip(sigma).enumerate() {
        let coriolis = w.cross(relative_rate);
        let hinge = centripetal(link.hinge) + coriolis + coriolis - relative_bias;
        let (turning, changing) = relative_rotation(shape, links, sigma, i);
        let bias = Twist { angular: w.cross(turning) + changing, linear: hinge };
        wrenches.push(link.inertia.inertia_wrench(w + turning, bias));
        relative_rate += Vec3::unit_x().cross(link.hinge_offset) * sigma_i;
        relative_bias += link.hinge_offset * (sigma_i * sigma_i);
    }
    wrenches
}

/// Ω̄ of link `i`, and what it changes by along appendage axes while σ̇ is zero.
fn relative_rotation<R: Real>(
    shape: &Shape,
    links: &[Posed<R>],
    sigma: &[R],
    i: usize,
) -> (Vec3<R>, Vec3<R>) {
    let e1 = Vec3::unit_x();
    if *shape != Shape::Paddle || i == 0 {
        return (e1 * sigma[i], Vec3::zero());
    }
    let eta = links[1].axis;
    (e1 * sigma[0] + eta * sigma[1], e1.cross(eta) * (sigma[0] * sigma[1]))
}

/// Force, and moment about its own hinge, for unit σ̇ of each hinge: eqs. (4.21), (5.6) and
/// (5.9).
fn columns<R: Real>(
    shape: &Shape,
    links: &[Posed<R>],
    outboard: &[RigidInertia<R>],
) -> Vec<Wrench<R>> {
    let e1 = Vec3::unit_x();
    let spun =
        |body: &RigidInertia<R>, axis| body.momentum(Twist { angular: axis, linear: Vec3::zero() });
    let column = |(i, link): (usize, &Posed<R>)| {
        let mut column = spun(&link.inertia, link.axis);
        if let Some(outer) = outboard.get(i + 1) {
            let carried = Twist { angular: Vec3::zero(), linear: e1.cross(link.hinge_offset) };
            column.add(outer.momentum(carried).seen_from(link.hinge_offset));
        }
        if *shape == Shape::Paddle && i == 0 {
            column.add(spun(&links[1].inertia, e1).seen_from(link.hinge_offset));
        }
        column
    };
    links.iter().enumerate().map(column).collect()
}

/// Aᵣₛ of eqs. (5.11) and (5.12).
fn hinge_block<R: Real>(
    shape: &Shape,
    links: &[Posed<R>],
    outboard: &[RigidInertia<R>],
    columns: &[Wrench<R>],
) -> Vec<Vec<R>> {
    let e1 = Vec3::unit_x();
    let entry = |i: usize, j: usize| {
        let (row, column) = (&links[i], &links[j]);
        if j >= i {
            return row.axis.dot(columns[j].seen_from(column.hinge - row.hinge).moment);
        }
        let mut moment = outboard[i].first_moment.cross(e1.cross(column.hinge_offset));
        if *shape == Shape::Paddle {
            moment += outboard[i].about_origin * e1;
        }
        row.axis.dot(moment)
    };
    (0..links.len()).map(|i| (0..links.len()).map(|j| entry(i, j)).collect()).collect()
}
