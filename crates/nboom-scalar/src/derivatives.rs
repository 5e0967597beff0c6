//! Derivatives of the accelerations of a tree of one-axis joints, by the chain rule through its inverse dynamics.
//!
//! Accelerations a follow from M a + h = Q, with h the bias force and Q the external wrench and torques. One sweep
//! outward and one inward give all derivatives of the effort E = M a + h at fixed accelerations; those of the
//! accelerations are M⁻¹ (∂Q − ∂E). nboom's `docs/equations.md` has the equations, in the section on derivatives.

mod efforts;
mod mass_matrix;
mod tree;

use std::ops::Range;

use crate::batch::Eight;
use crate::{EightNumbers, RigidInertia, Vec3, WorkOnEight, Wrench, in_registers};

use efforts::{Changes, Moving};
use mass_matrix::MassMatrix;
use tree::{BodyOnMount, main_body, on_mount};
pub use tree::{TreeJoint, TreeLink, TreeMount};

/// Columns that are solved for at once.
const COLUMNS: usize = 8;

/// Numbers of a state before the external wrench: ω.
const OMEGA: usize = 3;

/// Numbers of a state before those of hinges: ω, external moment, external force.
const BEFORE_HINGES: usize = OMEGA + MAIN;

/// Rows of the main body: ω̇ and a_O among accelerations, moment and force among efforts.
const MAIN: usize = 6;

/// Exact derivatives of a satellite's accelerations with respect to its state: ω, external wrench, angles, rates and
/// torques. ω̇ and a_O are along the axes of the main body, as all of a state is; units are those of the parameters.
///
/// It loops over the links of any tree, so no code is generated or compiled for it. Its time grows with the links times
/// their depth times the numbers of the state that are asked for, and that of the mass matrix with the links times the
/// square of their depth. An evaluation allocates nothing.
///
/// ```
/// use nboom_scalar::{Derivatives, TreeJoint, TreeLink, TreeMount};
/// // A main body and one link, hinged at O about x, where its mass centre is on its y axis.
/// let main = [2.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
/// let mount = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
/// let body = [1.0, 0.0, 0.5, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
/// let parameters = [&main[..], &mount, &body].concat();
/// let link = TreeLink {
///     inboard: None,
///     joint: TreeJoint::Revolute,
///     mount: TreeMount::OnMain(10),
///     body: 22,
///     angle: 9,
///     rate: 10,
///     torque: 11,
///     acceleration: 6,
/// };
/// let mut derivatives = Derivatives::of(&[link], &parameters);
/// let (state, accelerations, by_torque) = ([0.0; 12], [0.0; 7], 11..12);
/// let mut found = [0.0; 7];
/// derivatives.write(&state, &accelerations, by_torque, &mut found);
/// // The torque gives the main body −1 and the link 12/11, not 1, since O gives way. Their difference is 23/11.
/// assert!((found[0] + 1.0).abs() < 1e-14);
/// assert!((found[6] - 23.0 / 11.0).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Derivatives {
    links: Vec<TreeLink>,
    main: RigidInertia<f64>,
    bodies: Vec<BodyOnMount>,
    moving: Vec<Moving>,
    matrix: MassMatrix,
    /// Right sides, [`COLUMNS`] of them side by side: [`MAIN`] rows of the main body, then one of each link.
    right: Vec<Eight>,
}

impl Derivatives {
    /// Those of a tree with these parameters; inboard links stand before outboard ones.
    ///
    /// # Panics
    /// When a link stands before the one that carries it, has numbers beyond the parameters, or shares a place in
    /// states or accelerations with another.
    pub fn of(links: &[TreeLink], parameters: &[f64]) -> Self {
        let bodies: Vec<_> = links.iter().map(|link| on_mount(link, parameters)).collect();
        let matrix = MassMatrix::of(links);
        let columns = BEFORE_HINGES + 3 * links.len();
        let in_states = links.iter().flat_map(|link| [link.angle, link.rate, link.torque]);
        assert!(
            are_all(in_states, BEFORE_HINGES..columns),
            "each number of a state is of one link"
        );
        let rows = links.iter().map(|link| link.acceleration);
        assert!(are_all(rows, MAIN..MAIN + links.len()), "each acceleration is of one link");
        let right = vec![Eight::default(); columns.div_ceil(COLUMNS) * (MAIN + links.len())];
        let moving = vec![Moving::at_rest(RigidInertia::zero()); links.len()];
        let main = main_body(parameters);
        Self { links: links.to_vec(), main, bodies, moving, matrix, right }
    }

    /// Writes the derivatives in a `state` where the satellite has these `accelerations`: for each acceleration, in their
    /// order, a row with one number for each of the coordinates `by`.
    ///
    /// Numbers are not finite where a link and all outboard of it have no inertia about its joint.
    ///
    /// # Panics
    /// When a slice does not have the length that the tree asks for, or `by` is beyond the state.
    pub fn write(
        &mut self,
        state: &[f64],
        accelerations: &[f64],
        by: Range<usize>,
        derivatives: &mut [f64],
    ) {
        let links = self.links.len();
        assert_eq!(state.len(), BEFORE_HINGES + 3 * links, "numbers of a state");
        assert_eq!(accelerations.len(), MAIN + links, "numbers of accelerations");
        assert!(by.end <= state.len(), "derivatives are by coordinates");
        assert_eq!(derivatives.len(), accelerations.len() * by.len(), "room for each derivative");
        in_registers(Evaluation { of: self, state, accelerations, by, derivatives });
    }
}

/// Whether places are all of these, each once.
fn are_all(places: impl Iterator<Item = usize>, all: Range<usize>) -> bool {
    let mut places: Vec<usize> = places.collect();
    places.sort_unstable();
    places.into_iter().eq(all)
}

/// One evaluation.
struct Evaluation<'a> {
    of: &'a mut Derivatives,
    state: &'a [f64],
    accelerations: &'a [f64],
    by: Range<usize>,
    derivatives: &'a mut [f64],
}

impl WorkOnEight for Evaluation<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { of, state, accelerations, by, derivatives } = self;
        let Derivatives { links, main, bodies, moving, matrix, right } = of;
        let rows = MAIN + links.len();
        let right = &mut right[..by.len().div_ceil(COLUMNS) * rows];
        right.fill(Eight::default());
        let omega = Vec3::new(state[0], state[1], state[2]);
        let mut columns = Columns { right, rows, by: by.clone() };

        let main = &mut Moving::at_rest(*main);
        efforts::outward(links, bodies, main, moving, [state, accelerations]);
        efforts::inward(links, main, moving, |moving, i| {
            columns.of_link(links, moving, omega, matrix, i);
        });
        columns.of_main(main);
        matrix.set_main(&main.inertia);
        matrix.factor();

        for (eight, first) in columns.right.chunks_exact_mut(rows).zip(by.clone().step_by(COLUMNS))
        {
            matrix.solve(R::all_mut(eight));
            let many = COLUMNS.min(by.end - first);
            let outputs = (0..MAIN).chain(links.iter().map(|link| link.acceleration));
            for (row, output) in eight.iter().zip(outputs) {
                let to = &mut derivatives[output * by.len() + (first - by.start)..][..many];
                match <&mut [f64; COLUMNS]>::try_from(&mut *to) {
                    Ok(to) => *to = row.0,
                    Err(_) => to.copy_from_slice(&row.0[..many]),
                }
            }
        }
    }
}

/// The right sides ∂Q − ∂E, one column for each coordinate.
struct Columns<'a> {
    right: &'a mut [Eight],
    rows: usize,
    by: Range<usize>,
}

impl Columns<'_> {
    /// Sets the entry of a row in the column of a coordinate, if that is asked for.
    #[inline(always)]
    fn set(&mut self, row: usize, coordinate: usize, entry: f64) {
        if self.by.contains(&coordinate) {
            let column = coordinate - self.by.start;
            self.right[column / COLUMNS * self.rows + row].0[column % COLUMNS] = entry;
        }
    }

    /// Sets the rows of the main body in the column of a coordinate.
    #[inline(always)]
    fn set_main(&mut self, coordinate: usize, effort: Wrench<f64>) {
        let entries = mass_matrix::in_order(effort);
        entries.into_iter().enumerate().for_each(|(row, entry)| self.set(row, coordinate, entry));
    }

    /// Sets the row of link `i` of the mass matrix, and the right sides in its columns and in its row, when all that is
    /// outboard has been added.
    #[inline(always)]
    fn of_link(
        &mut self,
        links: &[TreeLink],
        moving: &[Moving],
        omega: Vec3<f64>,
        matrix: &mut MassMatrix,
        i: usize,
    ) {
        let (link, own, row) = (&links[i], &moving[i], MAIN + i);
        let mut changes = own.changes();
        let of_link = matrix.row(i);
        *of_link.diagonal = own.axis.power(changes.by_acceleration);
        self.set_in_column(row, link, own, &changes);
        let mut joint = own.joint;
        for (&carrier, entry) in of_link.carriers.iter().zip(of_link.entries) {
            let moved = &moving[carrier];
            changes.seen_from(joint - moved.joint);
            joint = moved.joint;
            *entry = moved.axis.power(changes.by_acceleration);
            self.set_in_column(row, &links[carrier], moved, &changes);
            self.set(MAIN + carrier, link.angle, -moved.axis.power(changes.by_angle));
            self.set(MAIN + carrier, link.rate, -moved.axis.power(changes.by_rate));
        }
        changes.seen_from(joint);
        let Changes { by_acceleration, by_angle, by_rate, by_turning } = changes;
        *of_link.with_main = mass_matrix::in_order(by_acceleration);
        self.set_main(link.angle, -by_angle);
        self.set_main(link.rate, -by_rate);
        let of_omega = by_acceleration.moment.cross(omega) + by_turning;
        of_omega.to_array().into_iter().enumerate().for_each(|(axis, of)| self.set(row, axis, -of));
        self.set(row, link.torque, 1.0);
    }

    /// Sets how the effort of a joint, that of `row`, changes with angle and rate of one that carries it, or with its own.
    #[inline(always)]
    fn set_in_column(&mut self, row: usize, link: &TreeLink, moved: &Moving, of: &Changes) {
        let Moving { axis, carried, carried_twice, .. } = moved;
        let (inertial, turning) = (of.by_acceleration, of.by_turning);
        let of_angle = carried_twice.power(inertial) + turning.dot(carried.angular);
        let of_rate = 2.0 * carried.power(inertial) + turning.dot(axis.angular);
        self.set(row, link.angle, -of_angle);
        self.set(row, link.rate, -of_rate);
    }

    /// Sets the columns by ω in the rows of the main body, and those by the external wrench.
    #[inline(always)]
    fn of_main(&mut self, main: &Moving) {
        let along = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()];
        along
            .into_iter()
            .enumerate()
            .for_each(|(axis, along)| self.set_main(axis, -main.by_omega(along)));
        (0..MAIN).for_each(|row| self.set(row, OMEGA + row, 1.0));
    }
}
