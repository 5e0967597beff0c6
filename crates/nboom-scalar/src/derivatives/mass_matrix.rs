//! The mass matrix of a tree. The row of a link has entries with itself, with the links that carry it and with the main
//! body; the others are zero.

use std::array;

use super::MAIN;
use super::tree::TreeLink;
use crate::{Real, RigidInertia, Twist, Vec3, Wrench};

/// A matrix, and after [`factor`](Self::factor) Lᵀ D L of it, with 1 / D and −L: links are eliminated from the tips inward, the
/// main body last, so that zeros stay zero.
#[derive(Clone, Debug)]
pub(super) struct MassMatrix {
    /// For each link where its row begins among `carriers` and `rows`; one more at the end.
    starts: Vec<usize>,
    /// For each link those that carry it, the nearest first.
    carriers: Vec<usize>,
    /// Entries with these.
    rows: Vec<f64>,
    /// Entries with the main body.
    with_main: Vec<[f64; MAIN]>,
    diagonal: Vec<f64>,
    main: [[f64; MAIN]; MAIN],
}

/// A row that is to be set.
pub(super) struct Row<'a> {
    pub carriers: &'a [usize],
    pub entries: &'a mut [f64],
    pub diagonal: &'a mut f64,
    pub with_main: &'a mut [f64; MAIN],
}

impl MassMatrix {
    /// Of a tree, all entries zero.
    ///
    /// # Panics
    /// When a link stands before the one that carries it.
    pub fn of(links: &[TreeLink]) -> Self {
        let (mut starts, mut carriers) = (vec![0], Vec::<usize>::new());
        for (i, link) in links.iter().enumerate() {
            if let Some(inboard) = link.inboard {
                assert!(inboard < i, "link {inboard} carries link {i} and stands before it");
                carriers.push(inboard);
                carriers.extend_from_within(starts[inboard]..starts[inboard + 1]);
            }
            starts.push(carriers.len());
        }
        let rows = vec![0.0; carriers.len()];
        let (with_main, diagonal) = (vec![[0.0; MAIN]; links.len()], vec![0.0; links.len()]);
        Self { starts, carriers, rows, with_main, diagonal, main: [[0.0; MAIN]; MAIN] }
    }

    /// The row of link `i`: those that carry it, the nearest first, entries with these, on the diagonal, and with the main
    /// body.
    #[inline(always)]
    pub fn row(&mut self, i: usize) -> Row<'_> {
        let row = self.starts[i]..self.starts[i + 1];
        Row {
            carriers: &self.carriers[row.clone()],
            entries: &mut self.rows[row],
            diagonal: &mut self.diagonal[i],
            with_main: &mut self.with_main[i],
        }
    }

    /// Sets the six by six of the main body with all that it carries.
    #[inline(always)]
    pub fn set_main(&mut self, all: &RigidInertia<f64>) {
        let unit = |i: usize| {
            let one: [f64; MAIN] = array::from_fn(|j| f64::from(u8::from(i == j)));
            let [a, b, c, x, y, z] = one;
            Twist { angular: Vec3::new(a, b, c), linear: Vec3::new(x, y, z) }
        };
        self.main = array::from_fn(|i| in_order(all.momentum(unit(i))));
    }

    /// Factors it in its place.
    #[inline(always)]
    pub fn factor(&mut self) {
        let Self { starts, carriers, rows, with_main, diagonal, main } = self;
        for i in (0..diagonal.len()).rev() {
            let (before, row) = rows.split_at_mut(starts[i]);
            let row = &mut row[..starts[i + 1] - starts[i]];
            let carriers = &carriers[starts[i]..starts[i + 1]];
            let inverse = 1.0 / diagonal[i];
            let of_main = with_main[i];
            for (k, &carrier) in carriers.iter().enumerate() {
                let factor = -row[k] * inverse;
                diagonal[carrier] += factor * row[k];
                let others = &mut before[starts[carrier]..starts[carrier + 1]];
                others
                    .iter_mut()
                    .zip(&row[k + 1..])
                    .for_each(|(entry, other)| *entry += factor * other);
                let others = &mut with_main[carrier];
                others.iter_mut().zip(&of_main).for_each(|(entry, other)| *entry += factor * other);
                row[k] = factor;
            }
            let factors = of_main.map(|entry| -entry * inverse);
            for (row, factor) in main.iter_mut().zip(factors) {
                row.iter_mut().zip(&of_main).for_each(|(entry, other)| *entry += factor * other);
            }
            with_main[i] = factors;
            diagonal[i] = inverse;
        }
        for i in (0..MAIN).rev() {
            let row = main[i];
            let inverse = 1.0 / row[i];
            for k in 0..i {
                let factor = -row[k] * inverse;
                (0..i).for_each(|l| main[k][l] += factor * row[l]);
                main[i][k] = factor;
            }
            main[i][i] = inverse;
        }
    }

    /// Solves for columns side by side, in their place: rows of the main body, then of the links.
    #[inline(always)]
    pub fn solve<R: Real>(&self, columns: &mut [R]) {
        let (of_main, of_links) = columns.split_at_mut(MAIN);
        let of_main: &mut [R; MAIN] = of_main.try_into().expect("six rows");
        // In registers, since each link adds to it.
        let mut main = *of_main;
        for i in (0..of_links.len()).rev() {
            let own = of_links[i];
            let row = self.starts[i]..self.starts[i + 1];
            for (&factor, &carrier) in self.rows[row.clone()].iter().zip(&self.carriers[row]) {
                of_links[carrier] = own.mul_add(R::constant(factor), of_links[carrier]);
            }
            for k in 0..MAIN {
                main[k] = own.mul_add(R::constant(self.with_main[i][k]), main[k]);
            }
            of_links[i] = own * R::constant(self.diagonal[i]);
        }
        for i in (0..MAIN).rev() {
            for k in 0..i {
                main[k] = main[i].mul_add(R::constant(self.main[i][k]), main[k]);
            }
        }
        for i in 0..MAIN {
            main[i] = main[i] * R::constant(self.main[i][i]);
            for k in 0..i {
                main[i] = main[k].mul_add(R::constant(self.main[i][k]), main[i]);
            }
        }
        *of_main = main;
        for i in 0..of_links.len() {
            // Two sums, so that products do not wait for each other.
            let (mut sum, mut other) = (of_links[i], R::zero());
            for k in 0..MAIN / 2 {
                sum = main[k].mul_add(R::constant(self.with_main[i][k]), sum);
                let k = k + MAIN / 2;
                other = main[k].mul_add(R::constant(self.with_main[i][k]), other);
            }
            let row = self.starts[i]..self.starts[i + 1];
            for (&factor, &carrier) in self.rows[row.clone()].iter().zip(&self.carriers[row]) {
                sum = of_links[carrier].mul_add(R::constant(factor), sum);
            }
            of_links[i] = sum + other;
        }
    }
}

/// Moment, then force.
#[inline(always)]
pub(super) fn in_order(wrench: Wrench<f64>) -> [f64; MAIN] {
    let ([a, b, c], [x, y, z]) = (wrench.moment.to_array(), wrench.force.to_array());
    [a, b, c, x, y, z]
}
