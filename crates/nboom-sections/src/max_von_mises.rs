//! Where along walls the von Mises stress is largest.

use crate::polynomial::{Polynomial, SignChanges};

/// Most times that a wall is halved to show that a level is not exceeded.
const MOST_HALVINGS: usize = 4;

/// The wall, by its number in `walls`, and the place on it with the largest von Mises stress.
///
/// Its square is a polynomial of degree four along a wall, largest at an end or where the
/// derivative changes sign. The search begins with all ends. It skips the inside of a wall if
/// [`Square::is_at_most`] shows that it has no larger value. Ends come before places between
/// them; of equal places the first counts.
pub(crate) fn max_von_mises(walls: impl Iterator<Item = Square> + Clone) -> (usize, f64) {
    let walls = walls.enumerate();
    let mut worst = Worst { square: f64::NEG_INFINITY, wall: 0, x: 0.0 };
    for (wall, square) in walls.clone() {
        worst.consider(&square, wall, 0.0);
        worst.consider(&square, wall, 1.0);
    }
    for (wall, square) in walls {
        if !square.is_at_most(worst.square) {
            square.stationary().for_each(|x| worst.consider(&square, wall, x));
        }
    }
    (worst.wall, worst.x)
}

struct Worst {
    square: f64,
    wall: usize,
    x: f64,
}

impl Worst {
    fn consider(&mut self, square: &Square, wall: usize, x: f64) {
        let square = square.at(x);
        if square > self.square {
            *self = Self { square, wall, x };
        }
    }
}

/// σ² + 3 τ² along a wall, with stresses in a unit in which squares neither overflow nor vanish.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Square {
    /// Coefficients in Bernstein's basis.
    pub normal: [f64; 2],
    pub shear: [f64; 3],
}

impl Square {
    fn at(&self, x: f64) -> f64 {
        let Self { normal: [s0, s1], shear: [t0, t1, t2] } = self;
        let y = 1.0 - x;
        let normal = y * s0 + x * s1;
        let shear = y * (y * t0 + x * t1) + x * (y * t1 + x * t2);
        normal * normal + 3.0 * (shear * shear)
    }

    /// Whether its coefficients in Bernstein's basis, on the wall or on parts of it, show that it is
    /// nowhere above `level`.
    pub fn is_at_most(&self, level: f64) -> bool {
        is_at_most(&self.coefficients(), level, MOST_HALVINGS)
    }

    /// Coefficients in Bernstein's basis, of which the first and the last are the values at the ends.
    fn coefficients(&self) -> Polynomial {
        let Self { normal: [s0, s1], shear: [t0, t1, t2] } = self;
        let [n0, n1, n2] = [s0 * s0, s0 * s1, s1 * s1];
        [
            n0 + 3.0 * (t0 * t0),
            0.5 * (n0 + n1) + 3.0 * t0 * t1,
            (n0 + 4.0 * n1 + n2) / 6.0 + t0 * t2 + 2.0 * t1 * t1,
            0.5 * (n1 + n2) + 3.0 * t1 * t2,
            n2 + 3.0 * (t2 * t2),
        ]
    }

    /// Where its derivative changes sign.
    fn stationary(&self) -> impl Iterator<Item = f64> {
        let Self { normal: [s0, s1], shear: [t0, t1, t2] } = self;
        let (s, ds) = (s0, s1 - s0);
        let (a, b, c) = (t0, 2.0 * (t1 - t0), t0 - 2.0 * t1 + t2);
        let half_derivative: Polynomial = [
            s * ds + 3.0 * a * b,
            ds * ds + 3.0 * (b * b + 2.0 * a * c),
            9.0 * b * c,
            6.0 * c * c,
            0.0,
        ];
        SignChanges::of(&half_derivative, 0.0, 1.0).into_points()
    }
}

/// Whether a polynomial with these coefficients in Bernstein's basis is at most `level`, if that
/// shows within so many halvings: it is a mean of its coefficients.
fn is_at_most(coefficients: &Polynomial, level: f64, halvings: usize) -> bool {
    let [start, inside @ .., end] = coefficients;
    if !(*start <= level && *end <= level) {
        return false;
    }
    let is_below = |coefficient: &f64| *coefficient <= level;
    inside.iter().all(is_below)
        || (halvings > 0
            && halves(coefficients).iter().all(|half| is_at_most(half, level, halvings - 1)))
}

/// The coefficients on both halves (de Casteljau).
fn halves(whole: &Polynomial) -> [Polynomial; 2] {
    let (mut left, mut right) = (*whole, *whole);
    for done in 1..whole.len() {
        for i in (done..whole.len()).rev() {
            left[i] = 0.5 * (left[i - 1] + left[i]);
        }
        for i in 0..whole.len() - done {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    [left, right]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A few walls with stresses of any sign.
    fn walls() -> impl Strategy<Value = Vec<Square>> {
        let stress = (prop::array::uniform2(-9.0..9.0), prop::array::uniform3(-9.0..9.0));
        let wall = stress.prop_map(|(normal, shear)| Square { normal, shear });
        prop::collection::vec(wall, 1..5)
    }

    /// All places at which one of the walls may be stressed most.
    fn places(square: &Square) -> impl Iterator<Item = f64> {
        [0.0, 1.0].into_iter().chain(square.stationary())
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

        #[test]
        fn what_is_left_out_is_not_the_largest(squares in walls()) {
            let all = squares.iter().flat_map(|square| places(square).map(|x| square.at(x)));
            let largest = all.fold(0.0, f64::max);
            let (wall, x) = max_von_mises(squares.iter().copied());
            // A few roundings of terms that the largest one is made of.
            prop_assert!(squares[wall].at(x) >= largest * (1.0 - 1e-14));
        }

        #[test]
        fn only_what_keeps_a_level_is_said_to(squares in walls(), share in 0.9..1.5) {
            let square = squares[0];
            let largest = places(&square).map(|x| square.at(x)).fold(0.0, f64::max);
            let is_shown = square.is_at_most(share * largest);
            prop_assert!(!is_shown || share >= 1.0 - 1e-14);
            // On a sixteenth of a wall coefficients depart from the curve by the order of 1/256 of
            // those of the wall, which are several times larger than the curve.
            prop_assert!(is_shown || share < 1.2);
        }

        #[test]
        fn the_coefficients_are_those_of_the_square(squares in walls(), x in 0.0..1.0) {
            let square = squares[0];
            let mut mean = square.coefficients();
            for level in (1..mean.len()).rev() {
                for i in 0..level {
                    mean[i] = (1.0 - x) * mean[i] + x * mean[i + 1];
                }
            }
            // Roundings of terms of up to 3 · 81.
            prop_assert!((mean[0] - square.at(x)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_wall_that_is_stressed_alike_everywhere_needs_no_search() {
        let square = Square { normal: [0.3, 0.3], shear: [-0.7; 3] };
        let [start, inside @ .., end] = square.coefficients();
        for coefficient in inside.into_iter().chain([end]) {
            // A few roundings.
            assert!((coefficient / start - 1.0).abs() < 1e-15);
        }
    }
}
