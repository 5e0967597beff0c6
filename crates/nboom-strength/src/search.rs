//! Largest values of gauges over an interval of time in which all loads are smooth.
//!
//! Loads are computed at a few points, and polynomials through these represent them: five points
//! where their bound shows that nothing becomes larger than before, nine otherwise, and halves of
//! the interval where nine are not enough. A gauge is a norm, hence convex, and a polynomial is a
//! mean of its Bernstein coefficients: over an interval the gauge of the polynomial is at most that
//! of its largest coefficient. The last two coefficients in Chebyshev's basis estimate what the
//! polynomial leaves out; where that is the rounding of loads, halves would leave out as much.
//!
//! The loads of a hinge whose body turns many times in a step are smooth only along axes that do not
//! turn with it. Their magnitudes do not depend on axes, so points are enough if they are along either.

mod curve;

use crate::StrengthError;
use crate::gauge::{Gauge, Turn};
use crate::nodes::{self, Basis, COARSE, FINE};
use curve::Curve;

/// From one coarse point to the next among the fine ones.
const STRIDE: usize = (FINE - 1) / (COARSE - 1);

/// Share by which a largest value may be missed.
const TOLERANCE: f64 = 1e-8;

/// Share of the largest value among gauges of one kind below which values are rounding.
const ROUNDING: f64 = 1e-13;

/// Most times that an interval is halved; the loads of a step need far fewer.
const MOST_HALVINGS: usize = 12;

/// The source of rows of loads, and the place where the largest are kept.
pub(crate) trait Loaded {
    /// Writes the loads at `u`.
    ///
    /// # Errors
    /// When they contradict the motion.
    fn write(&mut self, u: f64, row: &mut [f64]) -> Result<(), StrengthError>;

    /// The largest value of gauge `g` so far.
    fn largest(&self, g: usize) -> f64;

    /// The largest value so far among the gauges of the kind of gauge `g`.
    fn largest_of_kind(&self, g: usize) -> f64;

    /// Keeps a larger one of gauge `g`, which is `gauge`, at `u` under the loads in `row`.
    ///
    /// # Errors
    /// When it is infinite.
    fn keep(
        &mut self,
        g: usize,
        gauge: &Gauge,
        value: f64,
        u: f64,
        row: &[f64],
    ) -> Result<(), StrengthError>;
}

/// Places of a half at which rounding is measured: none where a grid of equal parts has a point, so that
/// what jumps at such points does not jump at all of them.
const PROBES: [f64; 3] = [0.137_283, 0.411_907, 0.738_561];

/// How far to both sides of a probe loads are compared, as a share of the half: what is smooth then differs by
/// less than can be seen, and what jumps almost never jumps there.
const REACH: f64 = 1.0 / (1 << 26) as f64;

/// The departure of loads from a line over a short way: shares of the way, and weights of the loads there.
const DEPARTURE: [(f64, f64); 3] = [(-REACH, 1.0), (0.0, -2.0), (REACH, 1.0)];

/// Searches largest values; allocates nothing after it is made.
#[derive(Clone, Debug)]
pub(crate) struct Search {
    pub gauges: Vec<Gauge>,
    width: usize,
    places: [f64; FINE],
    coarse: Basis<COARSE>,
    fine: Basis<FINE>,
    /// A row for each fine point.
    rows: Vec<f64>,
    /// A row in between.
    between: Vec<f64>,
    /// Rows beside and at each probe.
    probed: Vec<f64>,
    /// For each level of halving, the gauges that may become larger.
    open: Vec<Vec<usize>>,
}

/// Whether nine points are enough for a gauge.
#[derive(PartialEq)]
enum Verdict {
    Done,
    TooLong,
}

impl Search {
    /// For rows of so many numbers.
    pub fn new(gauges: Vec<Gauge>, width: usize) -> Self {
        let open = (0..=MOST_HALVINGS).map(|_| Vec::with_capacity(gauges.len())).collect();
        Self {
            gauges,
            width,
            places: nodes::places(),
            coarse: Basis::new(),
            fine: Basis::new(),
            rows: vec![0.0; FINE * width],
            between: vec![0.0; width],
            probed: vec![0.0; PROBES.len() * DEPARTURE.len() * width],
            open,
        }
    }

    /// Keeps every value between two times that is larger than before.
    ///
    /// # Errors
    /// Those of `loaded`.
    pub fn over(&mut self, span: [f64; 2], loaded: &mut dyn Loaded) -> Result<(), StrengthError> {
        self.open[0].clear();
        self.open[0].extend(0..self.gauges.len());
        self.at_level(0, span, loaded)
    }

    /// Keeps every value at two times that is larger than before; the later time comes first.
    ///
    /// # Errors
    /// Those of `loaded`.
    pub fn at_ends(
        &mut self,
        [from, to]: [f64; 2],
        loaded: &mut dyn Loaded,
    ) -> Result<(), StrengthError> {
        for u in [to, from] {
            loaded.write(u, &mut self.between)?;
            for (g, gauge) in self.gauges.iter().enumerate() {
                if let Some(value) = gauge.above(loaded.largest(g), &gauge.numbers(&self.between)) {
                    loaded.keep(g, gauge, value, u, &self.between)?;
                }
            }
        }
        Ok(())
    }

    fn at_level(
        &mut self,
        level: usize,
        [from, to]: [f64; 2],
        loaded: &mut dyn Loaded,
    ) -> Result<(), StrengthError> {
        let mut open = std::mem::take(&mut self.open[level]);
        let time = |k: usize, places: &[f64; FINE]| from + (to - from) * places[k];
        let looked = (|| {
            for k in (0..FINE).step_by(STRIDE) {
                loaded.write(time(k, &self.places), row_mut(&mut self.rows, self.width, k))?;
            }
            retain(&mut open, |g| {
                if self.is_below(g, loaded) {
                    return Ok(false);
                }
                let coarse = (0..FINE).step_by(STRIDE);
                let is_raised = self.keep_largest(g, coarse, [from, to], loaded)?;
                Ok(!(is_raised && self.is_below(g, loaded)))
            })?;
            if open.is_empty() {
                return Ok(());
            }
            for k in (1..FINE).step_by(STRIDE) {
                loaded.write(time(k, &self.places), row_mut(&mut self.rows, self.width, k))?;
            }
            for &g in &open {
                self.keep_largest(g, (1..FINE).step_by(STRIDE), [from, to], loaded)?;
            }
            let span = [from, to];
            retain(&mut open, |g| Ok(self.climb(g, span, false, loaded)? == Verdict::TooLong))?;
            let middle = 0.5 * (from + to);
            if open.is_empty() || level == MOST_HALVINGS || middle <= from || to <= middle {
                return Ok(());
            }
            // Most intervals are halved once if at all, and are not probed.
            if level > 0 {
                self.probe(span, loaded)?;
                retain(&mut open, |g| Ok(self.climb(g, span, true, loaded)? == Verdict::TooLong))?;
            }
            for half in [[from, middle], [middle, to]] {
                self.open[level + 1].clear();
                self.open[level + 1].extend_from_slice(&open);
                self.at_level(level + 1, half, loaded)?;
            }
            Ok(())
        })();
        self.open[level] = open;
        looked
    }

    /// Finds the loads by which rounding is measured.
    fn probe(
        &mut self,
        [from, to]: [f64; 2],
        loaded: &mut dyn Loaded,
    ) -> Result<(), StrengthError> {
        let shares = PROBES.iter().flat_map(|place| DEPARTURE.map(|(aside, _)| place + aside));
        let rows = self.probed.chunks_exact_mut(self.width);
        shares.zip(rows).try_for_each(|(share, row)| loaded.write(from + (to - from) * share, row))
    }

    /// The rounding of gauge `g` as last measured, by what it departs from a line: that of neither the best
    /// nor the worst probe.
    fn rounding(&self, g: usize, turn: Option<Turn>) -> f64 {
        let gauge = &self.gauges[g];
        let at_probe = |rows: &[f64]| {
            let rows: [&[f64]; DEPARTURE.len()] =
                std::array::from_fn(|i| &rows[i * self.width..(i + 1) * self.width]);
            let numbers = rows.map(|row| gauge.numbers_along(turn, row));
            gauge.bound(&Basis::weigh(&DEPARTURE.map(|(_, weight)| weight), &numbers))
        };
        let rows_of_probe = DEPARTURE.len() * self.width;
        let mut found: [f64; PROBES.len()] = std::array::from_fn(|k| {
            at_probe(&self.probed[k * rows_of_probe..(k + 1) * rows_of_probe])
        });
        found.sort_by(f64::total_cmp);
        found[PROBES.len() / 2]
    }

    fn row(&self, k: usize) -> &[f64] {
        &self.rows[k * self.width..(k + 1) * self.width]
    }

    /// Keeps the largest value of gauge `g` at some of the points, if it is larger than before, and
    /// returns whether it is.
    fn keep_largest(
        &self,
        g: usize,
        points: impl Iterator<Item = usize>,
        [from, to]: [f64; 2],
        loaded: &mut dyn Loaded,
    ) -> Result<bool, StrengthError> {
        let gauge = &self.gauges[g];
        let (mut largest, mut at) = (loaded.largest(g), None);
        for k in points {
            if let Some(value) = gauge.above(largest, &gauge.numbers(self.row(k))) {
                (largest, at) = (value, Some(k));
            }
        }
        if let Some(k) = at {
            let u = from + (to - from) * self.places[k];
            loaded.keep(g, gauge, largest, u, self.row(k))?;
        }
        Ok(at.is_some())
    }

    /// The level below which a gauge need not be searched.
    fn enough(g: usize, loaded: &dyn Loaded) -> f64 {
        loaded.largest(g) * (1.0 + TOLERANCE) + loaded.largest_of_kind(g) * ROUNDING
    }

    /// Whether five points show along any axes that gauge `g` stays below its largest value so far.
    fn is_below(&self, g: usize, loaded: &dyn Loaded) -> bool {
        let (gauge, enough) = (&self.gauges[g], Self::enough(g, loaded));
        gauge.turns().any(|turn| {
            let values: [[f64; 6]; COARSE] =
                std::array::from_fn(|k| gauge.numbers_along(turn, self.row(STRIDE * k)));
            let coefficients = self.coarse.coefficients(&values);
            stays_below(gauge, &coefficients, &self.coarse.tails(&values), enough)
        })
    }

    /// Keeps the largest value of gauge `g` by nine points, if they are enough along any axes and it is
    /// larger than before. Once probes have told the rounding they are enough where they leave out no more.
    fn climb(
        &mut self,
        g: usize,
        span: [f64; 2],
        is_probed: bool,
        loaded: &mut dyn Loaded,
    ) -> Result<Verdict, StrengthError> {
        for turn in self.gauges[g].turns() {
            if self.climb_along(turn, g, span, is_probed, loaded)? == Verdict::Done {
                return Ok(Verdict::Done);
            }
        }
        Ok(Verdict::TooLong)
    }

    fn climb_along(
        &mut self,
        turn: Option<Turn>,
        g: usize,
        [from, to]: [f64; 2],
        is_probed: bool,
        loaded: &mut dyn Loaded,
    ) -> Result<Verdict, StrengthError> {
        let gauge = &self.gauges[g];
        let values: [[f64; 6]; FINE] =
            std::array::from_fn(|k| gauge.numbers_along(turn, self.row(k)));
        let (coefficients, tails) = (self.fine.coefficients(&values), self.fine.tails(&values));
        let enough = Self::enough(g, loaded);
        if stays_below(gauge, &coefficients, &tails, enough) {
            return Ok(Verdict::Done);
        }
        let rounding = if is_probed { self.rounding(g, turn) } else { 0.0 };
        if left_out(gauge, &tails) > rounding.max(enough - loaded.largest(g)) {
            return Ok(Verdict::TooLong);
        }
        let curve = Curve { basis: &self.fine, places: &self.places, gauge };
        let (mut largest, mut at) = (loaded.largest(g), None);
        let slack = loaded.largest_of_kind(g) * ROUNDING;
        let found = &mut (&mut largest, &mut at);
        curve.climb(&coefficients, &values, [0.0, 1.0], 0, slack, found);
        if let Some(x) = at {
            let weights = nodes::weights(&self.places, x);
            self.between.fill(0.0);
            for (weight, row) in weights.iter().zip(self.rows.chunks_exact(self.width)) {
                self.between.iter_mut().zip(row).for_each(|(sum, number)| *sum += weight * number);
            }
            gauge.put_along(turn, Basis::weigh(&weights, &values), &mut self.between);
            loaded.keep(g, gauge, largest, from + (to - from) * x, &self.between)?;
        }
        Ok(Verdict::Done)
    }
}

/// Keeps the gauges of which `is_kept` says so, until it fails.
fn retain(
    gauges: &mut Vec<usize>,
    mut is_kept: impl FnMut(usize) -> Result<bool, StrengthError>,
) -> Result<(), StrengthError> {
    let mut outcome = Ok(());
    gauges.retain(|&g| {
        outcome.is_ok()
            && is_kept(g).unwrap_or_else(|error| {
                outcome = Err(error);
                false
            })
    });
    outcome
}

fn row_mut(rows: &mut [f64], width: usize, k: usize) -> &mut [f64] {
    &mut rows[k * width..(k + 1) * width]
}

/// Whether bounds show that a gauge is at most `level` for polynomials with these coefficients, and
/// what they leave out, over all of their interval.
fn stays_below(gauge: &Gauge, coefficients: &[[f64; 6]], tails: &[[f64; 6]], level: f64) -> bool {
    let (left_out, degree) = (left_out(gauge, tails), coefficients.len() - 1);
    let is_below =
        |(i, share): (usize, f64)| gauge.is_at_most(level - share * left_out, &coefficients[i]);
    // Loads that grow decide at the end.
    let places = (0..=degree).rev();
    places.clone().map(|i| (i, 1.0)).all(is_below)
        || left_out > 0.0 && places.map(|i| (i, nodes::share_left_out(degree, i))).all(is_below)
}

/// An upper bound of the gauge of all of these.
fn left_out(gauge: &Gauge, tails: &[[f64; 6]]) -> f64 {
    tails.iter().map(|tail| gauge.bound(tail)).sum()
}

#[cfg(test)]
mod tests;
