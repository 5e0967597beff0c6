//! Sobol sequences, with the direction numbers of Joe and Kuo, shifted at random.

use sobol::Sobol;
use sobol::params::JoeKuoD6;

use super::draw::{BITS_OF_A_SEED, Numbers, inside};

/// Dimensions for which there are direction numbers.
pub(crate) const MOST_VARIABLES: usize = 100;

/// A sequence of points that fill a cube evenly; each of its points is computed by itself.
#[derive(Clone, Debug)]
pub(crate) struct Sequence {
    /// Of each dimension the direction numbers, and what is added to all its points, bit by bit.
    dimensions: Vec<(Vec<u64>, u64)>,
}

impl Sequence {
    /// The sequence for so many variables, shifted by the seed; none if there are too many.
    pub fn new(seed: u64, variables: usize) -> Option<Self> {
        if variables > MOST_VARIABLES {
            return None;
        }
        let mut shifts = Numbers::new(seed);
        let parameters = JoeKuoD6::minimal();
        let bits = BITS_OF_A_SEED as usize;
        let directions = Sobol::<f64>::init_direction_vals(variables, bits, &parameters);
        let with_shift = directions.into_iter().map(|of| (of, shifts.bits()));
        Some(Self { dimensions: with_shift.collect() })
    }

    /// A point, from 0, of numbers above 0 and below 1.
    pub fn point(&self, number: u64) -> Vec<f64> {
        let gray = number ^ (number >> 1);
        let coordinate = |(directions, shift): &(Vec<u64>, u64)| {
            let chosen = directions.iter().enumerate().filter(|(bit, _)| gray >> bit & 1 == 1);
            let bits = chosen.fold(*shift, |bits, (_, direction)| bits ^ direction);
            inside(bits >> (64 - BITS_OF_A_SEED))
        };
        self.dimensions.iter().map(coordinate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first points as they are published, before any shift.
    #[test]
    fn unshifted_points_are_those_of_the_sequence() {
        let mut sequence = Sequence::new(1, 3).expect("few");
        sequence.dimensions.iter_mut().for_each(|(_, shift)| *shift = 0);
        let points = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
        ];
        for (number, expected) in points.iter().enumerate() {
            let found = sequence.point(number as u64);
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-15, "{number}: {found:?}");
            }
        }
    }

    #[test]
    fn each_dimension_has_one_point_in_each_of_equal_intervals() {
        let sequence = Sequence::new(9, MOST_VARIABLES).expect("few enough");
        for log in 0..=10 {
            let count = 1_u64 << log;
            let mut found = vec![vec![false; count as usize]; MOST_VARIABLES];
            for number in 0..count {
                for (of, u) in found.iter_mut().zip(sequence.point(number)) {
                    of[(u * count as f64) as usize] = true;
                }
            }
            assert!(found.iter().flatten().all(|is_there| *is_there), "{count}");
        }
    }

    /// The first two dimensions are a (0, m, 2)-net in base 2: each box of area 2^-m has one point.
    #[test]
    fn the_first_two_dimensions_fill_boxes_of_all_shapes() {
        let sequence = Sequence::new(2, 2).expect("few");
        for m in 0..=8_u32 {
            for of_first in 0..=m {
                let (across, up) = (1 << of_first, 1 << (m - of_first));
                let mut found = vec![0; across * up];
                for number in 0..1 << m {
                    let point = sequence.point(number);
                    let column = (point[0] * across as f64) as usize;
                    found[column * up + (point[1] * up as f64) as usize] += 1;
                }
                assert!(found.iter().all(|count| *count == 1), "{m} {of_first}");
            }
        }
    }
}
