
/// The largest residual of the matrix times `unknowns` less the right side, relative to the
/// magnitudes of what is added up, or to `least` where all of that cancels to nothing.
fn off_equations(found: &[f64], unknowns: &[f64], least: f64) -> f64 {
    let (matrix, right) = found.split_at(unknowns.len() * unknowns.len());
    let rows = matrix.chunks_exact(unknowns.len()).zip(right);
    rows.fold(0.0, |most, (row, right)| {
        let (mut sum, mut scale) = (-right, right.abs());
        for (entry, unknown) in row.iter().zip(unknowns) {
            sum += entry * unknown;
            scale += (entry * unknown).abs();
        }
        let off = sum.abs() / scale.max(least);
        if off.is_nan() { f64::INFINITY } else { most.max(off) }
    })
}
