//! What is straight between the times of a table, and constant before the first and after the last.

/// A row of such a table.
pub(crate) trait Row: Copy {
    /// Its time \[T\].
    fn time(&self) -> f64;
}

impl Row for [f64; 2] {
    fn time(&self) -> f64 {
        self[0]
    }
}

/// The piece that holds at `time`: 0 before the first row.
pub(crate) fn piece_at<P: Row>(rows: &[P], time: f64) -> usize {
    rows.iter().take_while(|row| row.time() <= time).count()
}

/// When a piece ends, unless it is the last one.
pub(crate) fn end_of<P: Row>(rows: &[P], piece: usize) -> Option<f64> {
    rows.get(piece).map(Row::time)
}

/// The rows between which a piece is straight, the same one twice where it is constant.
///
/// # Panics
/// When there are no rows.
pub(crate) fn around<P: Row>(rows: &[P], piece: usize) -> [P; 2] {
    let last = rows.len() - 1;
    [piece.saturating_sub(1), piece].map(|i| rows[i.min(last)])
}

/// How fast a value changes from one pair of time and value to another; not at all in no time.
pub(crate) fn slope([[start, from], [end, to]]: [[f64; 2]; 2]) -> f64 {
    if end > start { (to - from) / (end - start) } else { 0.0 }
}

/// The value at `time` on the line through two pairs of time and value.
pub(crate) fn value_at(pairs: [[f64; 2]; 2], time: f64) -> f64 {
    let [[start, from], [end, to]] = pairs;
    let share = if end > start { (time - start) / (end - start) } else { 0.0 };
    from + share * (to - from)
}
