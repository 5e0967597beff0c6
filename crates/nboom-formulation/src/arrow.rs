//! Symmetric elimination of hinges onto the main body.

use nboom_scalar::{Real, Twist, Wrench};

use crate::base::AtOrigin;

/// Hinges and the main body coupled as an arrow,
///
/// ```text
/// [ base      columns ] [ (ω̇, a_O) ]   [ −wrench ]
/// [ columnsᵀ  hinges  ] [ rates    ] = [ right   ]
/// ```
///
/// where two hinges are coupled only if one is on the way from the other to the main body.
#[derive(Clone, Debug)]
pub(crate) struct Arrow<R> {
    /// For each hinge the next one inward, which has a smaller number.
    pub inboard: Vec<Option<usize>>,
    /// Row i has the entries 0 to i.
    pub hinges: Vec<Vec<R>>,
    /// Moment about O and force for a unit rate of each hinge.
    pub columns: Vec<Wrench<R>>,
    /// Right side of each hinge.
    pub right: Vec<R>,
    /// The base's own 6×6 and wrench.
    pub base: AtOrigin<R>,
}

/// What is left of an [`Arrow`] for the way back.
#[derive(Clone, Debug)]
pub(crate) struct Eliminated<R> {
    arrow: Arrow<R>,
    inverse_pivots: Vec<R>,
}

impl<R: Real> Arrow<R> {
    /// The hinges on the way from `i` to the main body, `i` left out.
    fn inward(inboard: &[Option<usize>], i: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(inboard[i], |&j| inboard[j])
    }

    /// Eliminates the hinges, outermost first, so that no coupling arises where there was none.
    /// Returns what the main body then sees.
    pub fn eliminate(mut self) -> (AtOrigin<R>, Eliminated<R>) {
        let mut inverse_pivots = vec![R::zero(); self.right.len()];
        for i in (0..self.right.len()).rev() {
            let inverse = R::one() / self.hinges[i][i];
            inverse_pivots[i] = inverse;
            self.fold_into_base(i, inverse);
            self.fold_into_hinges(i, inverse);
        }
        (self.base, Eliminated { arrow: self, inverse_pivots })
    }

    fn fold_into_base(&mut self, i: usize, inverse: R) {
        let column = self.columns[i];
        let share = self.right[i] * inverse;
        self.base.inertia = self.base.inertia.without(&column, inverse);
        self.base.wrench.add(times(column, share));
    }

    fn fold_into_hinges(&mut self, i: usize, inverse: R) {
        let row = self.hinges[i].clone();
        let (column, right) = (self.columns[i], self.right[i]);
        let on_the_way: Vec<usize> = Self::inward(&self.inboard, i).collect();
        for (at, &j) in on_the_way.iter().enumerate() {
            let factor = row[j] * inverse;
            for &k in &on_the_way[at..] {
                self.hinges[j][k] -= factor * row[k];
            }
            self.columns[j].subtract(times(column, factor));
            self.right[j] -= right * factor;
        }
    }

    /// The whole matrix, row by row, in the order a_O, ω̇, rates.
    pub fn dense(&self) -> Vec<R> {
        let size = 6 + self.right.len();
        let mut matrix = vec![R::zero(); size * size];
        let mut put = |row: usize, column: usize, value: R| {
            matrix[row * size + column] = value;
            matrix[column * size + row] = value;
        };
        let (angular, linear) =
            (self.base.inertia.angular.to_matrix(), self.base.inertia.linear.to_matrix());
        for i in 0..3 {
            let coupling = self.base.inertia.coupling.rows[i].to_array();
            for j in 0..3 {
                put(i, j, linear.rows[i].to_array()[j]);
                put(3 + i, 3 + j, angular.rows[i].to_array()[j]);
                put(3 + i, j, coupling[j]);
            }
        }
        for (i, (row, column)) in self.hinges.iter().zip(&self.columns).enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                put(6 + i, 6 + j, entry);
            }
            for (j, entry) in force_then_moment(*column).into_iter().enumerate() {
                put(6 + i, j, entry);
            }
        }
        matrix
    }

    /// The whole right side in the order of [`dense`](Self::dense).
    pub fn dense_right(&self) -> Vec<R> {
        let mut right = force_then_moment(times(self.base.wrench, -R::one())).to_vec();
        right.extend(&self.right);
        right
    }
}

impl<R: Real> Eliminated<R> {
    /// Rates of the hinges when the main body accelerates as `main`, same axes as the arrow.
    pub fn back(&self, main: Twist<R>) -> Vec<R> {
        let Arrow { inboard, hinges, columns, right, .. } = &self.arrow;
        let mut rates = vec![R::zero(); right.len()];
        for i in 0..right.len() {
            let mut left = right[i] - main.power(columns[i]);
            for j in Arrow::<R>::inward(inboard, i) {
                left -= hinges[i][j] * rates[j];
            }
            rates[i] = left * self.inverse_pivots[i];
        }
        rates
    }
}

fn times<R: Real>(wrench: Wrench<R>, factor: R) -> Wrench<R> {
    Wrench { moment: wrench.moment * factor, force: wrench.force * factor }
}

fn force_then_moment<R: Real>(wrench: Wrench<R>) -> [R; 6] {
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}
