//! Consecutive cases that runs side by side take one after the other, and whose rows go on in their order.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::ops::RangeInclusive;

use crate::Row;

/// Cases of one thread.
pub(crate) struct Cases<'a> {
    next: Cell<u64>,
    last: u64,
    interrupted: &'a dyn Fn() -> bool,
    /// The case that goes on at present.
    present: Cell<u64>,
    rows: RefCell<Rows<'a>>,
}

struct Rows<'a> {
    /// The case whose row goes on next.
    next: u64,
    /// Rows of this case and those after it, as far as they are there.
    there: VecDeque<Option<Row>>,
    /// Takes a row, and says whether it takes more.
    take: &'a mut dyn FnMut(Row) -> bool,
    is_open: bool,
}

impl<'a> Cases<'a> {
    /// The cases of `range`, whose rows `take` gets until it returns false.
    pub fn new(
        range: RangeInclusive<u64>,
        interrupted: &'a dyn Fn() -> bool,
        take: &'a mut dyn FnMut(Row) -> bool,
    ) -> Self {
        let (first, last) = range.into_inner();
        let rows = Rows { next: first, there: VecDeque::new(), take, is_open: true };
        Self {
            next: Cell::new(first),
            last,
            interrupted,
            present: Cell::new(first),
            rows: RefCell::new(rows),
        }
    }

    /// Takes a case; none when all are taken, and once it is interrupted or nobody takes rows.
    pub fn next(&self) -> Option<u64> {
        let case = self.next.get();
        if case > self.last || !self.rows.borrow().is_open || (self.interrupted)() {
            return None;
        }
        self.next.set(case + 1);
        self.go_on(case);
        Some(case)
    }

    /// Whether runs are to stop.
    pub fn interrupted(&self) -> &'a dyn Fn() -> bool {
        self.interrupted
    }

    /// Notes that this case goes on.
    pub fn go_on(&self, case: u64) {
        self.present.set(case);
    }

    /// The case that went on last.
    pub fn present(&self) -> u64 {
        self.present.get()
    }

    /// Adds the row of a case; none if it was interrupted, after which no row goes on.
    pub fn add(&self, case: u64, row: Option<Row>) {
        let mut rows = self.rows.borrow_mut();
        rows.is_open &= row.is_some();
        let place = usize::try_from(case - rows.next).expect("a case is taken once");
        if rows.there.len() <= place {
            rows.there.resize_with(place + 1, || None);
        }
        rows.there[place] = row;
        while let Some(row) = rows.there.front_mut().and_then(Option::take) {
            rows.there.pop_front();
            rows.next += 1;
            rows.is_open &= (rows.take)(row);
        }
    }

    /// Whether all rows have gone on.
    pub fn are_done(&self) -> bool {
        self.rows.borrow().next > self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row::{Outcome, Value};

    fn row(case: u64) -> Option<Row> {
        let cells = vec![Value::Integer(case.cast_signed())];
        Some(Row { cells, states: Vec::new(), outcome: Outcome::Ok })
    }

    /// The cases whose rows go on when those of `order` come in this order.
    fn taken(order: &[u64], without: Option<u64>) -> Vec<u64> {
        let mut found = Vec::new();
        let mut take = |row: Row| {
            let Value::Integer(case) = row.cells[0] else { panic!("no case") };
            found.push(case.cast_unsigned());
            true
        };
        let cases = Cases::new(3..=6, &|| false, &mut take);
        while cases.next().is_some() {}
        for &case in order {
            cases.add(case, row(case).filter(|_| without != Some(case)));
        }
        assert_eq!(cases.are_done(), without.is_none());
        found
    }

    #[test]
    fn rows_go_on_in_the_order_of_cases() {
        for order in [[3, 4, 5, 6], [6, 5, 4, 3], [4, 3, 6, 5]] {
            assert_eq!(taken(&order, None), [3, 4, 5, 6]);
            assert_eq!(taken(&order, Some(5)), [3, 4]);
        }
    }
}
