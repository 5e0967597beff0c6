
/// The largest deviation, relative to the largest number, or to `least` where all cancel to nothing.
fn off_numbers(found: &[f64], expected: &[f64], least: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(least, |most, e| most.max(e.abs()));
    found.iter().zip(expected).fold(0.0, |most, (found, expected)| {
        let off = (found - expected).abs() / scale;
        if off.is_nan() { f64::INFINITY } else { most.max(off) }
    })
}
