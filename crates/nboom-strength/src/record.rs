//! The largest value of each gauge so far.

use nboom_scalar::Wrench;

use crate::gauge::{Gauge, Measure};
use crate::pulse::Acting;
use crate::{Cause, StationLoad, StrengthError};

/// The largest value of one gauge, and its cause.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    /// Below every value before the first one.
    pub value: f64,
    pub time: f64,
    pub cause: Cause,
    pub load: Wrench<f64>,
    /// The numbers of the gauge.
    pub numbers: [f64; 6],
}

impl Record {
    /// Load and numbers of a station.
    pub fn station_load(&self) -> StationLoad {
        StationLoad { load: self.load, numbers: self.numbers }
    }
}

/// Those of all gauges.
#[derive(Clone, Debug)]
pub(crate) struct Records {
    all: Vec<Record>,
    /// Kind of each gauge.
    kinds: Vec<usize>,
    largest_of_kind: [f64; 3],
}

impl Records {
    /// Nothing seen yet.
    pub fn new(gauges: &[Gauge]) -> Self {
        let kind = |gauge: &Gauge| match gauge.measure {
            Measure::Stress(_) => 0,
            Measure::Force => 1,
            Measure::Moment => 2,
        };
        let mut records = Self {
            all: Vec::new(),
            kinds: gauges.iter().map(kind).collect(),
            largest_of_kind: [0.0; 3],
        };
        records.forget();
        records
    }

    /// Clears all values.
    pub fn forget(&mut self) {
        let none = Record {
            value: f64::NEG_INFINITY,
            time: f64::NAN,
            cause: Cause::Motion,
            load: Wrench::zero(),
            numbers: [0.0; 6],
        };
        self.all.clear();
        self.all.resize(self.kinds.len(), none);
        self.largest_of_kind = [0.0; 3];
    }

    /// The record of gauge `g`; `None` before the first value.
    pub fn get(&self, g: usize) -> Option<&Record> {
        Some(&self.all[g]).filter(|record| record.value >= 0.0)
    }

    /// The largest value of gauge `g`; below every value before the first one.
    pub fn largest(&self, g: usize) -> f64 {
        self.all[g].value
    }

    /// The largest value among gauges of the kind of gauge `g`.
    pub fn largest_of_kind(&self, g: usize) -> f64 {
        self.largest_of_kind[self.kinds[g]]
    }

    /// Keeps the value of gauge `g`, which is `gauge`, at `u` under the loads in `row`, those of
    /// pulses included.
    ///
    /// # Errors
    /// When it is infinite.
    pub fn keep(
        &mut self,
        (g, gauge): (usize, &Gauge),
        value: f64,
        (acting, u): (Acting<'_>, f64),
        row: &[f64],
    ) -> Result<(), StrengthError> {
        let time = acting.time(u);
        if !value.is_finite() {
            return Err(StrengthError::NotFinite { time });
        }
        let cause = cause(gauge, row, (acting, u));
        let (load, numbers) = (gauge.load(row), gauge.numbers(row));
        self.set(g, Record { value, time, cause, load, numbers });
        Ok(())
    }

    fn set(&mut self, g: usize, record: Record) {
        let largest = &mut self.largest_of_kind[self.kinds[g]];
        *largest = largest.max(record.value);
        self.all[g] = record;
    }

    /// Keeps what is larger in `other`.
    pub fn merge(&mut self, other: &Self) {
        for (g, record) in other.all.iter().enumerate() {
            if record.value > self.largest(g) {
                self.set(g, *record);
            }
        }
    }

    /// Keeps each value at `u` under the loads in `row` that is larger than before.
    ///
    /// # Errors
    /// When one is infinite.
    pub fn look(
        &mut self,
        gauges: &[Gauge],
        (acting, u): (Acting<'_>, f64),
        row: &[f64],
    ) -> Result<(), StrengthError> {
        for (g, gauge) in gauges.iter().enumerate() {
            if let Some(value) = gauge.above(self.largest(g), &gauge.numbers(row)) {
                self.keep((g, gauge), value, (acting, u), row)?;
            }
        }
        Ok(())
    }
}

/// The pulse that has the largest share in a value, if any adds to it.
fn cause(gauge: &Gauge, row: &[f64], (acting, u): (Acting<'_>, f64)) -> Cause {
    if acting.pulses().next().is_none() {
        return Cause::Motion;
    }
    let shares = gauge.shares(row, acting.pulses().map(|pulse| &pulse.peak[..]));
    let parts = acting.pulses().zip(shares);
    let of_pulses = parts.map(|(pulse, share)| (pulse, share * acting.share(pulse, u)));
    match of_pulses.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((pulse, share)) if share > 0.0 => {
            Cause::Pulse { hinge: pulse.hinge, kind: pulse.kind, share }
        }
        _ => Cause::Motion,
    }
}
