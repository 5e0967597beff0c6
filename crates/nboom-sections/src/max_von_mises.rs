//! Where along walls the von Mises stress is largest.

use crate::WallStress;
use crate::polynomial::{Polynomial, SignChanges};

/// The wall, by its number in `walls`, and the place on it with the largest von Mises stress.
///
/// Its square is a polynomial of degree four along a wall, largest at an end or where the
/// derivative changes sign. The search begins with all ends. It skips the inside of a wall if
/// [`Square::bound_inside`] shows that it has no larger value. Ends come before places between
/// them; of equal places the first counts.
pub(crate) fn max_von_mises(walls: impl Iterator<Item = WallStress> + Clone) -> (usize, f64) {
    let unit = walls.clone().map(|wall| wall.largest_coefficient()).fold(0.0, f64::max);
    let scale = 1.0 / unit.max(f64::MIN_POSITIVE);
    let squares = walls.map(|wall| Square::of(&wall, scale)).enumerate();
    let mut worst = Worst { square: f64::NEG_INFINITY, wall: 0, x: 0.0 };
    for (wall, square) in squares.clone() {
        worst.consider(&square, wall, 0.0);
        worst.consider(&square, wall, 1.0);
    }
    for (wall, square) in squares {
        if square.bound_inside() > worst.square {
            square.stationary().for_each(|x| worst.consider(&square, wall, x));
        }
    }
    (worst.wall, worst.x)
}

/// An upper bound of the von Mises stress on a wall: the root of the largest coefficient in
/// Bernstein's basis of its square.
pub(crate) fn bound(wall: &WallStress) -> f64 {
    let unit = wall.largest_coefficient().max(f64::MIN_POSITIVE);
    let square = Square::of(wall, 1.0 / unit);
    unit * square.at(0.0).max(square.at(1.0)).max(square.bound_inside()).sqrt()
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
struct Square {
    /// Coefficients in x, the constant first.
    normal: [f64; 2],
    shear: [f64; 3],
}

impl Square {
    fn of(stress: &WallStress, scale: f64) -> Self {
        Self { normal: stress.normal.map(|c| c * scale), shear: stress.shear.map(|c| c * scale) }
    }

    fn at(&self, x: f64) -> f64 {
        let Self { normal: [s, ds], shear: [a, b, c] } = self;
        let (normal, shear) = (s + x * ds, a + x * (b + x * c));
        normal * normal + 3.0 * shear * shear
    }

    /// An upper bound between the ends, unless an end has a larger value.
    ///
    /// On 0..1 a polynomial is a mean of its coefficients in Bernstein's basis, of which the first and
    /// the last are the values at the ends; this is the largest of the others.
    fn bound_inside(&self) -> f64 {
        let Self { normal: [s, ds], shear: [a, b, c] } = self;
        let (s0, s1) = (s, s + ds);
        let [n0, n1, n2] = [s0 * s0, s0 * s1, s1 * s1];
        let [t0, t1, t2] = [*a, a + 0.5 * b, a + b + c];
        let inside = [
            0.5 * (n0 + n1) + 3.0 * t0 * t1,
            (n0 + 4.0 * n1 + n2) / 6.0 + t0 * t2 + 2.0 * t1 * t1,
            0.5 * (n1 + n2) + 3.0 * t1 * t2,
        ];
        inside.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Where its derivative changes sign.
    fn stationary(&self) -> impl Iterator<Item = f64> {
        let Self { normal: [s, ds], shear: [a, b, c] } = self;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;
    use proptest::prelude::*;

    /// A few walls with stresses of any sign, in any unit.
    fn walls() -> impl Strategy<Value = Vec<WallStress>> {
        let stress = (prop::array::uniform2(-9.0..9.0), prop::array::uniform3(-9.0..9.0));
        let wall = stress.prop_map(|(normal, shear)| WallStress {
            normal,
            shear,
            direction: Point { xi: 1.0, zeta: 0.0 },
        });
        prop::collection::vec(wall, 1..5)
    }

    /// All places at which one of the walls may be stressed most.
    fn places(square: &Square) -> impl Iterator<Item = f64> {
        [0.0, 1.0].into_iter().chain(square.stationary())
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

        #[test]
        fn what_is_left_out_is_not_the_largest(walls in walls()) {
            let squares: Vec<Square> = walls.iter().map(|wall| Square::of(wall, 1.0)).collect();
            let all = squares.iter().flat_map(|square| places(square).map(|x| square.at(x)));
            let largest = all.fold(0.0, f64::max);
            let (wall, x) = max_von_mises(walls.iter().copied());
            // A few roundings of terms that the largest one is made of.
            prop_assert!(squares[wall].at(x) >= largest * (1.0 - 1e-14));
        }

        #[test]
        fn nothing_between_the_ends_exceeds_the_bound(walls in walls(), x in 0.0..1.0) {
            let square = Square::of(&walls[0], 1.0);
            let bound = square.bound_inside().max(square.at(0.0)).max(square.at(1.0));
            prop_assert!(square.at(x) <= bound * (1.0 + 1e-14));
            // The result as a stress, in another unit.
            prop_assert!((super::bound(&walls[0]) / bound.sqrt() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_wall_that_is_stressed_alike_everywhere_needs_no_search() {
        let square = Square { normal: [0.3, 0.0], shear: [-0.7, 0.0, 0.0] };
        // A few roundings.
        assert!((square.bound_inside() / square.at(0.5) - 1.0).abs() < 1e-15);
    }
}
