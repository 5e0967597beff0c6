use std::ops::Range;

/// Derivatives at past times of equal distance, and at the end of the step being taken.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    /// A ring of rows.
    rows: Vec<f64>,
    size: usize,
    /// Row of the step's start.
    newest: usize,
    /// How many past derivatives there are, that at the step's start included.
    known: usize,
    /// Their distance; zero when there is but one.
    spacing: f64,
}

/// Past derivatives that doubling needs: every other one is one of the predictor's four.
pub(super) const FOR_DOUBLING: usize = 7;
const ROWS: usize = FOR_DOUBLING + 1;
/// Share of a step by which distances may differ and count as equal.
const ROUNDING: f64 = 1e-9;

impl History {
    /// Makes room for `size` variables and forgets everything.
    pub fn start(&mut self, size: usize) {
        *self = Self { rows: std::mem::take(&mut self.rows), size, ..Self::default() };
        self.rows.clear();
        self.rows.resize(ROWS * size, 0.0);
    }

    /// Takes the derivative at the end for the first one.
    pub fn begin(&mut self) {
        self.newest = (self.newest + 1) % ROWS;
        (self.known, self.spacing) = (1, 0.0);
    }

    /// The derivatives `back` distances before the step's start.
    pub fn past(&self, back: usize) -> &[f64] {
        &self.rows[self.row(back)]
    }

    /// The derivatives at the step's end.
    pub fn at_end(&self) -> &[f64] {
        self.past(ROWS - 1)
    }

    /// Where the derivatives at the step's end are to be written.
    pub fn at_end_mut(&mut self) -> &mut [f64] {
        let row = self.row(ROWS - 1);
        &mut self.rows[row]
    }

    fn row(&self, back: usize) -> Range<usize> {
        let at = (self.newest + ROWS - back) % ROWS * self.size;
        at..at + self.size
    }

    /// Distance of past derivatives, when there are some before the step's start.
    pub fn spacing(&self) -> Option<f64> {
        (self.known > 1).then_some(self.spacing)
    }

    /// Whether `count` past derivatives, that at the step's start included, stand one `step`
    /// apart; leaves out every other one if that makes it so.
    pub fn prepare(&mut self, step: f64, count: usize) -> bool {
        if self.known == FOR_DOUBLING && is_same(step, 2.0 * self.spacing) {
            for back in 1..=FOR_DOUBLING / 2 {
                let (from, to) = (self.row(2 * back), self.row(back));
                self.rows.copy_within(from, to.start);
            }
            (self.known, self.spacing) = (FOR_DOUBLING / 2 + 1, step);
        }
        self.known >= count && is_same(step, self.spacing)
    }

    /// How many derivatives there will be at distance `step` once the end is the new start.
    pub fn known_with_end(&self, step: f64) -> usize {
        if is_same(step, self.spacing) { (self.known + 1).min(FOR_DOUBLING) } else { 2 }
    }

    /// Makes the end of a step of length `step` the start of the next one.
    pub fn advance(&mut self, step: f64) {
        self.known = self.known_with_end(step);
        self.spacing = step;
        self.newest = (self.newest + 1) % ROWS;
    }

    /// Multiplies variables `range` of all past derivatives by `factor`.
    pub fn scale(&mut self, range: Range<usize>, factor: f64) {
        for row in self.rows.chunks_exact_mut(self.size) {
            row[range.clone()].iter_mut().for_each(|f| *f *= factor);
        }
    }
}

fn is_same(step: f64, other: f64) -> bool {
    (step - other).abs() <= ROUNDING * other
}
