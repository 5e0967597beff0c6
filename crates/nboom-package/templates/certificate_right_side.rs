
/// The largest deviation, each relative to the largest number of its kind: rates of the attitude, accelerations, of
/// which `least` is the least scale, rates of the hinges, and the power, whose scale comes last in `expected`.
fn off_rates(found: &[f64], expected: &[f64], least: f64) -> f64 {
    let hinges = (found.len() - 7) / 2;
    let (beta, tau, power) = (7, 7 + hinges, 7 + 2 * hinges);
    let of_power = expected[power + 1].max(f64::MIN_POSITIVE);
    let off = |places: Vec<usize>, least: f64| {
        let of = |numbers: &[f64]| -> Vec<f64> { places.iter().map(|&at| numbers[at]).collect() };
        off_numbers(&of(found), &of(expected), least)
    };
    off((0..4).collect(), f64::MIN_POSITIVE)
        .max(off((4..7).chain(tau..power).collect(), least))
        .max(off((beta..tau).collect(), f64::MIN_POSITIVE))
        .max(off(vec![power], of_power))
}
