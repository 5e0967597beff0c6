//! Stresses along all walls of a polygon under unit numbers, made once with the polygon.

use crate::WallStress;
use crate::max_von_mises::Square;

/// For each wall, what the six numbers that describe stresses contribute to it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ordinates {
    walls: Vec<OfWall>,
    /// The largest magnitude of a contribution of each number.
    largest: [f64; 6],
}

/// Contributions to the coefficients in Bernstein's basis: of the first three numbers to normal
/// stress, of the others to shear stress.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OfWall {
    normal: [[f64; 2]; 3],
    shear: [[f64; 3]; 3],
}

impl Ordinates {
    /// None yet.
    pub const NONE: Self = Self { walls: Vec::new(), largest: [0.0; 6] };

    /// Those of the stresses along walls that `unit` has for each number alone.
    pub fn new(walls: usize, unit: impl Fn(usize, usize) -> WallStress) -> Self {
        let of_wall = |wall: usize| OfWall {
            normal: std::array::from_fn(|j| unit(j, wall).normal_ordinates()),
            shear: std::array::from_fn(|j| unit(3 + j, wall).shear_ordinates()),
        };
        let walls: Vec<OfWall> = (0..walls).map(of_wall).collect();
        let most = |all: &[f64]| all.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        let largest = std::array::from_fn(|j| {
            let of_wall = |wall: &OfWall| match j {
                0..3 => most(&wall.normal[j]),
                _ => most(&wall.shear[j - 3]),
            };
            walls.iter().map(of_wall).fold(0.0, f64::max)
        });
        Self { walls, largest }
    }

    /// A unit of stress, and the squares of the stresses along all walls in it.
    ///
    /// Each stress is the sum of three terms, none of which is larger than the unit.
    pub fn squares(&self, numbers: [f64; 6]) -> (f64, impl Iterator<Item = Square> + Clone) {
        let terms =
            self.largest.iter().zip(&numbers).map(|(largest, number)| largest * number.abs());
        let unit = terms.fold(f64::MIN_POSITIVE, f64::max);
        let numbers = numbers.map(|number| number / unit);
        (unit, self.walls.iter().map(move |wall| wall.square(&numbers)))
    }
}

impl OfWall {
    fn square(&self, [a, b, c, d, e, f]: &[f64; 6]) -> Square {
        let ([n0, n1, n2], [s0, s1, s2]) = (&self.normal, &self.shear);
        Square {
            normal: std::array::from_fn(|i| a * n0[i] + (b * n1[i] + c * n2[i])),
            shear: std::array::from_fn(|i| d * s0[i] + e * s1[i] + f * s2[i]),
        }
    }
}
