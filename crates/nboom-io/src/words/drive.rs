use nboom_model::{Drive, DrivePoint};
use nboom_scalar::Vec3;

use super::{Direction, WordsError};

/// A motion that is prescribed for the main body, in words: about an axis through O, and along it.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct DriveWords {
    axis: Direction,
    rate: Vec<[f64; 2]>,
    speed: Vec<[f64; 2]>,
}

/// A motion about and along this axis (main-body axes); none until it has a rate or a speed.
pub fn drive(axis: impl Into<Direction>) -> DriveWords {
    DriveWords { axis: axis.into(), rate: Vec::new(), speed: Vec::new() }
}

impl DriveWords {
    /// Rates about the axis \[degrees/T\] at ascending times, straight between them.
    pub fn rate_deg(self, rate: Vec<[f64; 2]>) -> Self {
        self.rate_rad(rate.into_iter().map(|[time, rate]| [time, rate.to_radians()]).collect())
    }

    /// Rates about the axis \[radians/T\] at ascending times, straight between them.
    pub fn rate_rad(self, rate: Vec<[f64; 2]>) -> Self {
        Self { rate, ..self }
    }

    /// Speeds along the axis at ascending times, straight between them.
    pub fn speed(self, speed: Vec<[f64; 2]>) -> Self {
        Self { speed, ..self }
    }

    pub(super) fn drive(&self, errors: &mut Vec<WordsError>) -> Option<Drive> {
        let axis = self.axis.unit().map_err(|(found, expected)| {
            let (of, key) = ("main_body.drive".to_owned(), "axis");
            errors.push(WordsError::Value { of, key, found, expected });
        });
        Some(along(axis.ok()?, &self.rate, &self.speed))
    }
}

/// The motion about and along `axis` with these rates and speeds over time, of which each may be none.
pub(crate) fn along(axis: Vec3<f64>, rate: &[[f64; 2]], speed: &[[f64; 2]]) -> Drive {
    let mut times: Vec<f64> = rate.iter().chain(speed).map(|[time, _]| *time).collect();
    // Times of one table that do not ascend must not be hidden by the other.
    let ascend = |of: &[[f64; 2]]| of.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if ascend(rate) && ascend(speed) {
        times.sort_by(f64::total_cmp);
        times.dedup();
    }
    let point = |time| DrivePoint { time, rate: value(rate, time), speed: value(speed, time) };
    Drive { axis, points: times.into_iter().map(point).collect() }
}

/// What a table has at `time`: straight between its times, constant before the first and after the last.
fn value(table: &[[f64; 2]], time: f64) -> f64 {
    let after = table.partition_point(|[at, _]| *at < time);
    match (after.checked_sub(1).map(|i| table[i]), table.get(after)) {
        (_, Some([at, value])) if *at == time => *value,
        (Some([from, a]), Some([to, b])) => a + (time - from) / (to - from) * (b - a),
        (None, Some([_, value])) => *value,
        (Some([_, value]), None) => value,
        (None, None) => 0.0,
    }
}
