//! Where numbers stand along an axis, and which of them are written.

/// How many ticks an axis has, about.
const FEW: f64 = 5.0;

/// Round steps within a decade.
const ROUND: [f64; 4] = [1.0, 2.0, 5.0, 10.0];

/// Steps that are round for angles in degrees.
const ROUND_DEGREES: [f64; 5] = [15.0, 30.0, 45.0, 90.0, 180.0];

/// Beyond these sizes numbers are written with a power of ten beside the axis.
const WRITTEN: [f64; 2] = [1e-3, 1e5];

/// Numbers beyond have no room on any axis, and a range shorter than the reciprocal is none.
const LARGEST: f64 = 1e290;

/// Share of its largest number below which the range of an axis would show rounding.
const ROUNDING: f64 = 1e-9;

/// What the numbers of an axis are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    Degrees,
    Logarithmic,
}

/// An axis from one number to another, in places from one to another.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    is_logarithmic: bool,
    /// Numbers at both ends, of a logarithmic axis their logarithms.
    ends: [f64; 2],
    places: [f64; 2],
    /// Numbers that are written, in the same way.
    ticks: Vec<f64>,
    step: f64,
    /// Numbers are written without this power of ten.
    pub power: i32,
}

impl Axis {
    /// An axis with room for all of `values`, of which those that are not finite do not count, and of a
    /// logarithmic one those that are not positive; its ends are ticks. `least` is the shortest range that shows
    /// more than rounding.
    pub fn over(values: impl Iterator<Item = f64>, scale: Scale, least: f64) -> Self {
        let is_logarithmic = scale == Scale::Logarithmic;
        let number = |value: f64| if is_logarithmic { value.log10() } else { value };
        let [low, high] = extremes(values.map(number));
        if is_logarithmic {
            return Self::of_decades(low, high);
        }
        let [low, high] = widened(low, high, least);
        let step = step(high - low, scale);
        let ends = [(low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step];
        Self::with_ticks(ends, step)
    }

    /// An axis that ends at the first and the last of `values`.
    pub fn exactly(values: impl Iterator<Item = f64>) -> Self {
        let [low, high] = extremes(values);
        let ends = widened(low, high, 0.0);
        Self { ends, ..Self::with_ticks(ends, step(ends[1] - ends[0], Scale::Linear)) }
    }

    fn with_ticks(ends: [f64; 2], step: f64) -> Self {
        let [first, last] =
            [(ends[0] / step - 1e-9).ceil() as i64, (ends[1] / step + 1e-9).floor() as i64];
        let ticks: Vec<f64> = (first..=last).map(|tick| tick as f64 * step).collect();
        let largest = ticks.iter().fold(0.0, |most: f64, tick| most.max(tick.abs()));
        let is_written = largest == 0.0 || (WRITTEN[0]..WRITTEN[1]).contains(&largest);
        let power = if is_written { 0 } else { 3 * (largest.log10() / 3.0).floor() as i32 };
        Self { is_logarithmic: false, ends, places: [0.0, 1.0], ticks, step, power }
    }

    /// Whole decades, every so many of them a tick.
    fn of_decades(low: f64, high: f64) -> Self {
        let [low, high] = if low > high { [-1.0, 0.0] } else { [low.floor(), high.ceil()] };
        let high = high.max(low + 1.0);
        let step = ((high - low) / FEW).ceil();
        let high = low + ((high - low) / step).ceil() * step;
        let count = ((high - low) / step).round() as usize;
        let ticks = (0..=count).map(|tick| low + tick as f64 * step).collect();
        let (ends, places) = ([low, high], [0.0, 1.0]);
        Self { is_logarithmic: true, ends, places, ticks, step, power: 0 }
    }

    /// The axis between two places of a sheet.
    pub fn between(self, from: f64, to: f64) -> Self {
        Self { places: [from, to], ..self }
    }

    /// Where a number stands; not finite for one that a logarithmic axis has no place for.
    pub fn place(&self, value: f64) -> f64 {
        self.place_of(if self.is_logarithmic { value.log10() } else { value })
    }

    /// Where the axis begins (0) or ends (1).
    pub fn place_of_end(&self, end: usize) -> f64 {
        self.places[end]
    }

    fn place_of(&self, number: f64) -> f64 {
        let ([low, high], [from, to]) = (self.ends, self.places);
        from + (to - from) * ((number - low) / (high - low))
    }

    /// Places of ticks, with the text of their numbers and its exponent.
    pub fn ticks(&self) -> impl Iterator<Item = (f64, String, String)> {
        self.ticks.iter().map(|&tick| {
            let (text, raised) = if self.is_logarithmic {
                ("10".to_owned(), minus(&format!("{tick:.0}")))
            } else {
                (self.text(tick), String::new())
            };
            (self.place_of(tick), text, raised)
        })
    }

    fn text(&self, tick: f64) -> String {
        let unit = 10.0_f64.powi(self.power);
        let decimals = -((self.step / unit).log10() + 1e-9).floor() as i32;
        // Steps of 1, 2 and 5 need no digit beyond their first, whatever rounding has done to them.
        let decimals = usize::try_from(decimals).unwrap_or(0);
        let tick = if tick.abs() < 0.5 * self.step { 0.0 } else { tick / unit };
        minus(&format!("{tick:.decimals$}"))
    }
}

/// A number with a minus sign instead of a hyphen.
fn minus(number: &str) -> String {
    number.replace('-', "\u{2212}")
}

fn extremes(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let first = [f64::INFINITY, f64::NEG_INFINITY];
    values
        .filter(|value| value.abs() <= LARGEST)
        .fold(first, |[low, high], value| [low.min(value), high.max(value)])
}

/// A range that can be drawn around one that may have no length, or none that means anything.
fn widened(low: f64, high: f64, least: f64) -> [f64; 2] {
    if low > high {
        return [0.0, 1.0];
    }
    let largest = low.abs().max(high.abs());
    let shortest = least.max(ROUNDING * largest).max(1.0 / LARGEST);
    if high - low > shortest {
        return [low, high];
    }
    let half = match (least > 0.0, largest > 1.0 / LARGEST) {
        (true, _) => least,
        (false, true) => 0.1 * largest,
        (false, false) => 1.0,
    };
    let middle = 0.5 * low + 0.5 * high;
    [middle - half, middle + half]
}

/// A round step for a few ticks in a range.
fn step(range: f64, scale: Scale) -> f64 {
    let rough = range / FEW;
    if scale == Scale::Degrees {
        let near = |step: &&f64| **step >= 0.8 * rough;
        if let Some(step) = ROUND_DEGREES.iter().find(near).filter(|_| rough > 8.0) {
            return *step;
        }
    }
    let decade = 10.0_f64.powf(rough.log10().floor());
    let round = ROUND.into_iter().find(|round| round * decade >= 0.8 * rough).unwrap_or(10.0);
    round * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.ticks().map(|(_, text, raised)| text + &raised).collect()
    }

    fn over(low: f64, high: f64, scale: Scale) -> Axis {
        Axis::over([low, high].into_iter(), scale, 0.0).between(0.0, 100.0)
    }

    #[test]
    fn ticks_are_few_round_numbers() {
        let axis = over(0.0, 0.97, Scale::Linear);
        assert_eq!(texts(&axis), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(&over(-0.4, 0.4, Scale::Linear)), ["−0.4", "−0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(texts(&over(0.0, 135.0, Scale::Degrees)), ["0", "30", "60", "90", "120", "150"]);
        assert_eq!(
            texts(&over(2e-9, 3e-5, Scale::Logarithmic)).join(" "),
            "10−9 10−8 10−7 10−6 10−5 10−4"
        );
        let large = over(0.0, 241_000.0, Scale::Linear);
        assert_eq!((texts(&large).join(" "), large.power), ("0 50 100 150 200 250".to_owned(), 3));
        let small = over(0.0, 4e-7, Scale::Linear);
        assert_eq!((texts(&small).join(" "), small.power), ("0 100 200 300 400".to_owned(), -9));
    }

    #[test]
    fn numbers_stand_in_proportion() {
        let axis = over(0.0, 1.0, Scale::Linear);
        assert_eq!([0.0, 0.25, 1.0].map(|value| axis.place(value)), [0.0, 25.0, 100.0]);
        let axis = over(1e-4, 1.0, Scale::Logarithmic);
        assert!((axis.place(1e-3) - 25.0).abs() < 1e-12);
        assert!(!axis.place(0.0).is_finite());
    }

    #[test]
    fn every_axis_has_a_range() {
        for (values, scale) in [
            (vec![], Scale::Linear),
            (vec![3.0], Scale::Linear),
            (vec![0.0, 0.0], Scale::Degrees),
            (vec![1.0, 1.0 + 1e-15], Scale::Linear),
            (vec![-1e290, 1e290], Scale::Linear),
            (vec![5e-324, 0.0], Scale::Linear),
            (vec![1e290], Scale::Linear),
            (vec![0.0], Scale::Logarithmic),
            (vec![1e-300, 1e300], Scale::Logarithmic),
        ] {
            let axis = Axis::over(values.iter().copied(), scale, 0.0).between(0.0, 100.0);
            assert!((2..12).contains(&axis.ticks().count()), "{values:?}: {:?}", texts(&axis));
            assert!(axis.ticks().all(|(place, _, _)| place.is_finite()), "{values:?}: {axis:?}");
            // Nobody has such numbers, but no axis gives up over them.
            assert!(Axis::over([f64::MAX].into_iter(), scale, 0.0).ticks().count() > 1);
            for value in values.iter().filter(|_| scale != Scale::Logarithmic) {
                let place = axis.place(*value);
                assert!((-1e-6..=100.000_001).contains(&place), "{value}: {place} on {axis:?}");
            }
        }
    }
}
