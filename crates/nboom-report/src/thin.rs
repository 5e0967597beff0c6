//! Which rows of a table an eye can tell from a straight line between others.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

/// Share of a curve's range that cannot be seen in a figure a few hundred points high.
const INVISIBLE: f64 = 1.0 / 4000.0;

/// Rows that stay.
#[derive(Debug, PartialEq)]
pub struct Thinned {
    /// Ascending.
    pub rows: Vec<usize>,
    /// How far any row that does not is from the line between its neighbours that do, as a share of the range of
    /// its column.
    pub deviation: f64,
}

/// A gap between two rows that stay, and the row in it that is farthest from the line between them.
struct Span {
    from: usize,
    to: usize,
    worst: usize,
    deviation: f64,
}

impl PartialEq for Span {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Span {}

impl PartialOrd for Span {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Span {
    fn cmp(&self, other: &Self) -> Ordering {
        self.deviation.total_cmp(&other.deviation).then(other.from.cmp(&self.from))
    }
}

/// About `most` rows of columns of which the first is time: both ends, the rows `needed`, both extremes of every
/// column, and then always the row that is farthest from the line between its neighbours, as a share of its
/// column's place in `ranges`, until nothing is left that can be seen. Where that is zero a column has no say.
///
/// Extremes stay even if they are more than `most`; of needed rows those that find room beside them.
pub fn thinned(columns: &[Vec<f64>], ranges: &[f64], needed: &[usize], most: usize) -> Thinned {
    let count = columns.first().map_or(0, Vec::len);
    if count <= most.max(2) {
        return Thinned { rows: (0..count).collect(), deviation: 0.0 };
    }
    let mut kept = BTreeSet::from([0, count - 1]);
    for column in &columns[1..] {
        let extreme = |better: Ordering| {
            (0..count).reduce(|best, row| {
                if column[row].total_cmp(&column[best]) == better { row } else { best }
            })
        };
        let [lowest, highest] =
            [Ordering::Less, Ordering::Greater].map(|better| extreme(better).unwrap_or(0));
        // Of a constant no row is extreme.
        if column[highest] > column[lowest] {
            kept.extend([lowest, highest]);
        }
    }
    let room = most.saturating_sub(kept.len());
    kept.extend(needed.iter().take(room));
    let span = |from, to| span(columns, ranges, from, to);
    let all: Vec<usize> = kept.iter().copied().collect();
    let mut spans: BinaryHeap<Span> = all.windows(2).map(|pair| span(pair[0], pair[1])).collect();
    while kept.len() < most && spans.peek().is_some_and(|worst| worst.deviation > INVISIBLE) {
        let Some(Span { from, to, worst, .. }) = spans.pop() else { break };
        kept.insert(worst);
        spans.extend([span(from, worst), span(worst, to)]);
    }
    let deviation = spans.peek().map_or(0.0, |worst| worst.deviation);
    Thinned { rows: kept.into_iter().collect(), deviation }
}

fn span(columns: &[Vec<f64>], ranges: &[f64], from: usize, to: usize) -> Span {
    let times = &columns[0];
    let length = times[to] - times[from];
    let mut found = Span { from, to, worst: from, deviation: 0.0 };
    if to - from < 2 {
        return found;
    }
    for (column, &range) in columns[1..].iter().zip(ranges) {
        if range <= 0.0 {
            continue;
        }
        let (start, end) = (column[from], column[to]);
        let slope = if length > 0.0 { (end - start) / length } else { 0.0 };
        for row in from + 1..to {
            let deviation =
                (column[row] - start - slope * (times[row] - times[from])).abs() / range;
            if deviation > found.deviation {
                found = Span { worst: row, deviation, ..found };
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(count: usize) -> Vec<f64> {
        (0..count).map(|i| i as f64).collect()
    }

    fn thinned(columns: &[Vec<f64>], needed: &[usize], most: usize) -> Thinned {
        let range = |column: &Vec<f64>| {
            let fold =
                |pick: fn(f64, f64) -> f64| column.iter().copied().reduce(pick).unwrap_or(0.0);
            fold(f64::max) - fold(f64::min)
        };
        let ranges: Vec<f64> = columns[1..].iter().map(range).collect();
        super::thinned(columns, &ranges, needed, most)
    }

    #[test]
    fn straight_lines_need_their_ends_alone() {
        let line: Vec<f64> = times(1000).iter().map(|t| 3.0 - 0.5 * t).collect();
        assert_eq!(thinned(&[times(1000), line], &[], 100).rows, [0, 999]);
        let needed = thinned(&[times(1000), vec![1.0; 1000]], &[17], 100);
        assert_eq!(needed.rows, [0, 17, 999]);
    }

    #[test]
    fn extremes_of_every_column_stay() {
        let mut columns = vec![times(10_000)];
        for i in 0..20 {
            let mut column = vec![0.0; 10_000];
            column[100 + 17 * i] = 1.0;
            column[7000 + i] = -1.0;
            columns.push(column);
        }
        let kept = thinned(&columns, &[], 50).rows;
        for column in &columns[1..] {
            let values: Vec<f64> = kept.iter().map(|&row| column[row]).collect();
            assert!(values.contains(&1.0) && values.contains(&-1.0));
        }
    }

    #[test]
    fn what_is_left_out_cannot_be_seen() {
        let wave: Vec<f64> =
            times(20_000).iter().map(|t| (t / 300.0).sin() + 0.2 * (t / 37.0).cos()).collect();
        let columns = [times(20_000), wave];
        let Thinned { rows, deviation } = thinned(&columns, &[], 5000);
        assert!(deviation <= INVISIBLE && rows.len() < 5000, "{deviation} {}", rows.len());
        let range = 2.4;
        for pair in rows.windows(2) {
            for row in pair[0]..pair[1] {
                let share = (row - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
                let (a, b) = (columns[1][pair[0]], columns[1][pair[1]]);
                let off = (columns[1][row] - a - (b - a) * share).abs();
                assert!(off <= 1.01 * INVISIBLE * range, "row {row}: {off}");
            }
        }
        // With less room the deviation is told.
        let little = thinned(&columns, &[], 100);
        assert!(little.rows.len() == 100 && little.deviation > INVISIBLE);
    }
}
