use nboom_model::TorqueTable;
use nboom_scalar::Real;

use crate::{EventName, Names};

/// What torque tables are called.
pub(crate) const NAMES: Names = Names {
    name: "torque table",
    rise: EventName {
        in_files: "torque_table_up",
        in_listing: "POINT OF TORQUE TABLE PASSED UPWARD AT HINGE",
    },
    fall: EventName {
        in_files: "torque_table_down",
        in_listing: "POINT OF TORQUE TABLE PASSED DOWNWARD AT HINGE",
    },
    line: None,
};

/// One piece of the torque that a table gives: between two of its points the cubic that has their
/// torques and slopes, before the first and beyond the last the tangent there.
///
/// By the [slopes](TorqueTable::slopes) that a table has, the torque between two points lies between those
/// of the points. It and its slope are continuous.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TablePiece<R> {
    /// The angle from which the piece is written.
    pub from: R,
    /// Torque by ascending powers of the angle from there; positive when it increases β.
    pub coefficients: [R; 4],
    /// Potential energy there; zero at the table's first point.
    pub stored: R,
}

impl<R: Real> TablePiece<R> {
    /// Piece number `piece` of a table: 0 lies before the first point.
    ///
    /// # Panics
    /// When the table has fewer points than pieces before this one.
    pub fn new(table: &TorqueTable, piece: usize) -> Self {
        let (points, slopes) = (&table.points, table.slopes());
        let start = piece.saturating_sub(1);
        let stored = (0..start).fold(0.0, |sum, k| {
            let (_, coefficients) = table.cubic(&slopes, k);
            sum - integral(coefficients, points[k + 1][0] - points[k][0])
        });
        let (from, coefficients) = if (1..points.len()).contains(&piece) {
            table.cubic(&slopes, start)
        } else {
            (points[start][0], [points[start][1], slopes[start], 0.0, 0.0])
        };
        Self {
            from: R::constant(from),
            coefficients: coefficients.map(R::constant),
            stored: R::constant(stored),
        }
    }
}

/// The most energy that a table can store between its points, every torque taken by its magnitude.
pub(crate) fn stored(table: &TorqueTable) -> f64 {
    let pairs = table.points.windows(2);
    pairs.map(|pair| (pair[1][0] - pair[0][0]) * pair[0][1].abs().max(pair[1][1].abs())).sum()
}

/// The integral of a polynomial from zero to `s`.
fn integral([c0, c1, c2, c3]: [f64; 4], s: f64) -> f64 {
    (((c3 / 4.0 * s + c2 / 3.0) * s + c1 / 2.0) * s + c0) * s
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HingeLaw;

    /// Uneven, with a turn, a level part and a step.
    fn table() -> TorqueTable {
        let points = [[-1.0, 2.0], [-0.4, -0.5], [0.1, -0.5], [0.2, 3.0], [1.5, 3.5], [2.0, -1.0]];
        TorqueTable { hinge: 0, points: points.to_vec() }
    }

    fn piece_at(table: &TorqueTable, beta: f64) -> TablePiece<f64> {
        let piece = table.points.iter().filter(|point| beta > point[0]).count();
        TablePiece::new(table, piece)
    }

    impl TablePiece<f64> {
        fn law(&self) -> HingeLaw<f64> {
            HingeLaw::of_numbers([0.0; 7]).with_cubic(self.from, self.coefficients)
        }

        fn torque(&self, beta: f64) -> f64 {
            self.law().torque(beta, 0.0)
        }

        fn potential(&self, beta: f64) -> f64 {
            self.law().potential(beta) + self.stored
        }
    }

    #[test]
    fn it_has_the_torques_of_its_points_and_between_them_no_others() {
        let table = table();
        for (k, pair) in table.points.windows(2).enumerate() {
            let ([from, start], [to, end]) = (pair[0], pair[1]);
            let piece = TablePiece::<f64>::new(&table, k + 1);
            // Roundings of a polynomial whose coefficients reach 1e3.
            assert!((piece.torque(from) - start).abs() < 1e-13);
            assert!((piece.torque(to) - end).abs() < 1e-12);
            for i in 0..=100 {
                let torque = piece.torque(from + (to - from) * f64::from(i) / 100.0);
                let (low, high) = (start.min(end), start.max(end));
                assert!(torque > low - 1e-12 && torque < high + 1e-12, "{k}: {torque}");
            }
        }
    }

    #[test]
    fn pieces_meet_with_their_slopes_and_potentials() {
        let table = table();
        for (k, &[at, _]) in table.points.iter().enumerate() {
            let pieces = [k, k + 1].map(|piece| TablePiece::<f64>::new(&table, piece));
            let slope = |p: &TablePiece<f64>| (p.torque(at + 1e-5) - p.torque(at - 1e-5)) / 2e-5;
            let differences = [
                pieces[0].torque(at) - pieces[1].torque(at),
                pieces[0].potential(at) - pieces[1].potential(at),
            ];
            assert!(differences.iter().all(|d| d.abs() < 1e-12), "{k}: {differences:?}");
            // Central differences err by h² times a third derivative below 1e5.
            assert!((slope(&pieces[0]) - slope(&pieces[1])).abs() < 1e-5, "{k}");
        }
    }

    #[test]
    fn torque_is_the_slope_of_the_potential_downwards() {
        let (table, h) = (table(), 1e-4);
        for beta in [-3.0, -0.9, -0.2, 0.13, 0.18, 0.7, 1.9, 4.0] {
            let piece = piece_at(&table, beta);
            let slope = (piece.potential(beta + h) - piece.potential(beta - h)) / (2.0 * h);
            // They err by h² M''/6, with M'' below 1e4.
            assert!((slope + piece.torque(beta)).abs() < 2e-5, "{beta}");
        }
    }

    #[test]
    fn points_on_a_line_give_the_line() {
        for angles in [vec![-1.0, 2.0], vec![-1.0, -0.7, 0.4, 2.0]] {
            let points = angles.iter().map(|&angle| [angle, 0.3 - 1.7 * angle]).collect();
            let table = TorqueTable { hinge: 0, points };
            for beta in [-4.0, -0.8, 0.0, 1.1, 5.0] {
                let torque = piece_at(&table, beta).torque(beta);
                // Some roundings of numbers below 10.
                assert!((torque - (0.3 - 1.7 * beta)).abs() < 2e-14, "{beta}: {torque}");
            }
        }
    }
}
