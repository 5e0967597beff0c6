use std::ops::Range;

use nboom_scalar::{Work, vectorised};

use super::HIGHEST;
use super::formulas::Formulas;
use crate::weighted_sum::BLOCK;

/// One more than the highest order of a predictor, by which the order above is judged.
const ROWS: usize = HIGHEST + 1;

/// Modified divided differences φ of the slopes where the last steps ended.
#[derive(Clone, Debug, Default)]
pub(super) struct Differences {
    /// Row by row, each with room for a whole number of blocks; the first one is the last slope.
    table: Vec<f64>,
    room: usize,
    rows: usize,
    /// From where the last step ended back to where those before did.
    since: [f64; HIGHEST + 2],
}

impl Differences {
    /// Forgets all, and makes room for so many variables, a whole number of blocks. The slope is then to be
    /// [written](Self::slope_mut).
    pub fn start(&mut self, room: usize) {
        self.room = room;
        self.table.clear();
        self.table.resize(room * ROWS, 0.0);
        self.rows = 1;
    }

    /// How many are known.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// From where the last step ended back to where those before did, from zero on.
    pub fn since(&self) -> &[f64; HIGHEST + 2] {
        &self.since
    }

    pub fn slope(&self) -> &[f64] {
        self.row(0)
    }

    pub fn slope_mut(&mut self) -> &mut [f64] {
        &mut self.table[..self.room]
    }

    /// That of a variable.
    pub fn of(&self, row: usize, variable: usize) -> f64 {
        self.table[row * self.room + variable]
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.table[row * self.room..][..self.room]
    }

    /// Goes on to the end of a step by these formulas, where the slope is this.
    pub fn advance(&mut self, formulas: &Formulas, slope: &[f64]) {
        self.rows = (formulas.order + 2).min(self.rows + 1).min(ROWS);
        self.since[1..=self.rows].copy_from_slice(&formulas.since[1..=self.rows]);
        let carried = &formulas.carried[..self.rows - 1];
        vectorised(Advance { table: &mut self.table, room: self.room, carried, slope });
    }

    pub fn scale(&mut self, range: Range<usize>, factor: f64) {
        for row in self.table.chunks_exact_mut(self.room) {
            row[range.clone()].iter_mut().for_each(|value| *value *= factor);
        }
    }
}

struct Advance<'a> {
    table: &'a mut [f64],
    room: usize,
    /// Of all rows but the last.
    carried: &'a [f64],
    slope: &'a [f64],
}

impl Work for Advance<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Self { table, room, carried, slope } = self;
        for (block, slope) in slope.as_chunks::<BLOCK>().0.iter().enumerate() {
            let mut new = *slope;
            for (j, carried) in carried.iter().enumerate() {
                let row = &mut table[j * room + block * BLOCK..][..BLOCK];
                for (new, row) in new.iter_mut().zip(row) {
                    let old = std::mem::replace(row, *new);
                    *new -= carried * old;
                }
            }
            table[carried.len() * room + block * BLOCK..][..BLOCK].copy_from_slice(&new);
        }
    }
}

/// The prediction of a step by formulas, from its start.
pub(super) struct Prediction<'a> {
    pub differences: &'a Differences,
    pub formulas: &'a Formulas,
    pub start: &'a [f64],
    /// Where the step ends.
    pub end: &'a mut [f64],
    /// The slope there.
    pub slope: &'a mut [f64],
}

impl Prediction<'_> {
    /// Writes it.
    pub fn make(self) {
        vectorised(self);
    }

    #[inline(always)]
    fn in_pieces<const N: usize>(self) {
        let Self { differences, formulas, start, end, slope } = self;
        let Formulas { order, step, carried, weights, .. } = *formulas;
        let pieces = end.as_chunks_mut::<N>().0.iter_mut().zip(slope.as_chunks_mut::<N>().0);
        for ((piece, start), (end, slope)) in
            start.as_chunks::<N>().0.iter().enumerate().zip(pieces)
        {
            let (mut changes, mut slopes) = ([0.0; N], [0.0; N]);
            for j in (0..order).rev() {
                let weight = carried[j] * weights[j];
                let row = &differences.table[j * differences.room + piece * N..][..N];
                for i in 0..N {
                    changes[i] += weight * row[i];
                    slopes[i] += carried[j] * row[i];
                }
            }
            for i in 0..N {
                end[i] = start[i] + step * changes[i];
            }
            *slope = slopes;
        }
    }
}

impl Work for Prediction<'_> {
    #[inline(always)]
    fn carry_out(self) {
        if self.end.len().is_multiple_of(16) {
            self.in_pieces::<16>()
        } else {
            self.in_pieces::<BLOCK>()
        }
    }
}

/// What a slope has more than was expected, by which a step by these formulas is corrected and judged.
#[derive(Clone, Copy)]
pub(super) struct Correction<'a> {
    pub differences: &'a Differences,
    pub formulas: &'a Formulas,
    pub slope: &'a [f64],
    pub expected: &'a [f64],
    pub per_tolerance: &'a [f64],
}

impl Correction<'_> {
    /// Writes it, and sums the squares of it and of the differences by which the orders below by one and by two are
    /// judged, in units of the tolerance.
    pub fn make(self, correction: &mut [f64]) -> [f64; 3] {
        let below = [1, 2].map(|by| self.formulas.order.saturating_sub(by));
        let mut squares = [0.0; 3];
        let squares_mut = &mut squares;
        vectorised(Squares { of: self, rows: below, correction, squares: squares_mut });
        squares
    }

    /// The sum of the squares of the difference by which the order above is judged, if there is one.
    pub fn square_above(self) -> Option<f64> {
        let order = self.formulas.order;
        (order < HIGHEST && order < self.differences.rows).then(|| {
            let mut square = 0.0;
            vectorised(SquareAbove { of: self, square: &mut square });
            square
        })
    }
}

struct Squares<'a> {
    of: Correction<'a>,
    rows: [usize; 2],
    correction: &'a mut [f64],
    squares: &'a mut [f64; 3],
}

impl Work for Squares<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Self { of: Correction { differences, formulas, .. }, rows, .. } = self;
        let carried = rows.map(|row| formulas.carried[row]);
        let rows = rows.map(|row| differences.row(row).as_chunks::<BLOCK>().0);
        let Correction { slope, expected, per_tolerance, .. } = self.of;
        let given = [slope, expected, per_tolerance].map(|values| values.as_chunks::<BLOCK>().0);
        let mut sums = [[0.0; BLOCK]; 3];
        for (b, correction) in self.correction.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            for i in 0..BLOCK {
                let own = given[0][b][i] - given[1][b][i];
                let below = own + carried[0] * rows[0][b][i];
                let further = below + carried[1] * rows[1][b][i];
                correction[i] = own;
                for (sum, value) in sums.iter_mut().zip([own, below, further]) {
                    let value = value * given[2][b][i];
                    sum[i] += value * value;
                }
            }
        }
        *self.squares = sums.map(|sum| sum.iter().sum());
    }
}

struct SquareAbove<'a> {
    of: Correction<'a>,
    square: &'a mut f64,
}

impl Work for SquareAbove<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Correction { differences, formulas, slope, expected, per_tolerance } = self.of;
        let carried = formulas.carried[formulas.order];
        let row = differences.row(formulas.order);
        let [slope, expected, per_tolerance, row] =
            [slope, expected, per_tolerance, row].map(|values| values.as_chunks::<BLOCK>().0);
        let mut sum = [0.0; BLOCK];
        for b in 0..row.len() {
            for i in 0..BLOCK {
                let above = slope[b][i] - expected[b][i] - carried * row[b][i];
                let value = above * per_tolerance[b][i];
                sum[i] += value * value;
            }
        }
        *self.square = sum.iter().sum();
    }
}

/// Writes one over the errors allowed between two values of each variable.
pub(super) fn allow(relative: f64, [absolute, start, end]: [&[f64]; 3], per_tolerance: &mut [f64]) {
    vectorised(Allow { relative, absolute, start, end, per_tolerance });
}

struct Allow<'a> {
    relative: f64,
    absolute: &'a [f64],
    start: &'a [f64],
    end: &'a [f64],
    per_tolerance: &'a mut [f64],
}

impl Work for Allow<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Self { relative, absolute, start, end, per_tolerance } = self;
        let given = [absolute, start, end].map(|values| values.as_chunks::<BLOCK>().0);
        for (b, per_tolerance) in per_tolerance.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            for i in 0..BLOCK {
                let value = given[1][b][i].abs().max(given[2][b][i].abs());
                per_tolerance[i] = 1.0 / (given[0][b][i] + relative * value);
            }
        }
    }
}
