//! How many digits tell the moments of a run apart.

/// Digits of a decimal that comes back from a double as it was.
const MOST: usize = 15;

/// How many significant digits tell a time of a run over a span, both \[T\]: `least`, and one more for each order by
/// which the time is larger than the span is long, up to fifteen. A clock may count from long ago.
///
/// ```
/// # use nboom_results::time_digits;
/// assert_eq!(time_digits(2.5, [0.0, 10.0], 10), 10);
/// assert_eq!(time_digits(10_002.5, [1e4, 10_010.0], 10), 13);
/// ```
pub fn time_digits(time: f64, [start, end]: [f64; 2], least: usize) -> usize {
    let order = |size: f64| size.log10().floor();
    let (size, length) = (time.abs(), end - start);
    if size > 0.0 && length > 0.0 {
        let orders = (order(size) - order(length)).max(0.0) as usize;
        (least + orders).min(MOST)
    } else {
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_runs_from_zero_have_the_least_and_late_ones_more() {
        for (time, span, digits) in [
            (0.0, [0.0, 4.0], 10),
            (3.9, [0.0, 4.0], 10),
            (1e3, [0.0, 1e3], 10),
            (1e-9, [0.0, 1e3], 10),
            (-2.0, [-2.0, 3.0], 10),
            (5e4, [5e4, 5e4], 10),
            (50_001.0, [5e4, 50_004.0], 14),
            (1.7e9 + 1.0, [1.7e9, 1.7e9 + 4.0], 15),
        ] {
            assert_eq!(time_digits(time, span, 10), digits, "{time} in {span:?}");
        }
    }
}
