//! The largest value of each gauge so far.

use nboom_scalar::Wrench;

use crate::Cause;
use crate::gauge::{Gauge, Measure};
use crate::pulse::Pulses;

/// The largest value of one gauge, and how it came about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    /// Below anything before the first look.
    pub value: f64,
    pub time: f64,
    pub cause: Cause,
    pub load: Wrench<f64>,
    /// The numbers of the gauge.
    pub numbers: [f64; 6],
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

    /// Nothing seen any more.
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

    /// The record of gauge `g`; none before the first look.
    pub fn get(&self, g: usize) -> Option<&Record> {
        Some(&self.all[g]).filter(|record| record.value >= 0.0)
    }

    /// The largest value of gauge `g`; below anything before the first look.
    pub fn largest(&self, g: usize) -> f64 {
        self.all[g].value
    }

    /// The largest value among gauges of the kind of gauge `g`.
    pub fn largest_of_kind(&self, g: usize) -> f64 {
        self.largest_of_kind[self.kinds[g]]
    }

    /// Keeps the value of gauge `g`, which is `gauge`, at `u` under the loads in `row`, which pulses
    /// that go on from `from` on are part of.
    pub fn keep(
        &mut self,
        (g, gauge): (usize, &Gauge),
        value: f64,
        (pulses, from, u): (&Pulses, f64, f64),
        row: &[f64],
    ) {
        self.all[g] = Record {
            value,
            time: pulses.since + u,
            cause: cause(gauge, row, (pulses, from, u)),
            load: gauge.load(row),
            numbers: gauge.numbers(row),
        };
        let largest = &mut self.largest_of_kind[self.kinds[g]];
        *largest = largest.max(value);
    }

    /// Keeps what is larger than it has been under the loads in `row`.
    pub fn look(&mut self, gauges: &[Gauge], (pulses, u): (&Pulses, f64), row: &[f64]) {
        for (g, gauge) in gauges.iter().enumerate() {
            let numbers = gauge.numbers(row);
            if gauge.bound(&numbers) > self.largest(g) {
                let value = gauge.value(&numbers);
                if value > self.largest(g) {
                    self.keep((g, gauge), value, (pulses, u, u), row);
                }
            }
        }
    }
}

/// The pulse that has the largest share in a value, if any adds to it.
fn cause(gauge: &Gauge, row: &[f64], (pulses, from, u): (&Pulses, f64, f64)) -> Cause {
    if pulses.is_empty() {
        return Cause::Motion;
    }
    let shares = gauge.shares(row, pulses.going_on(from).map(|pulse| &pulse.peak[..]));
    let parts = pulses.going_on(from).zip(shares);
    let of_hinges = parts.map(|(pulse, share)| (pulse.hinge, share * pulses.share(pulse, u)));
    match of_hinges.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((hinge, share)) if share > 0.0 => Cause::LockUp { hinge, share },
        _ => Cause::Motion,
    }
}
