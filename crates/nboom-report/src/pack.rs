//! Tables as the page has them: base64 of numbers, column after column.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use crate::table::Table;
use crate::thin::thinned;

/// A table in the page.
#[derive(Serialize)]
pub(crate) struct Packed<'a> {
    columns: &'a [String],
    rows: usize,
    /// Of each number but times, which always have eight.
    bytes: usize,
    data: String,
}

/// How the tables of a page are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Packing {
    /// Bytes of a number.
    bytes: usize,
    /// Most rows of a table.
    rows: usize,
}

/// Fewest rows that a table keeps; beyond that a page grows.
const FEWEST_ROWS: usize = 100;

impl Packing {
    /// For all tables of a page together within so many bytes of base64: whole numbers if they fit, else short
    /// ones, and at last fewer rows.
    pub fn of<'a>(tables: impl Iterator<Item = &'a Table> + Clone, most_bytes: usize) -> Self {
        let most = most_bytes / 4 * 3;
        let rows = tables.clone().map(Table::rows).max().unwrap_or(0);
        let size = |bytes: usize| -> usize {
            tables.clone().map(|table| table.rows() * (8 + bytes * (table.names.len() - 1))).sum()
        };
        if let Some(bytes) = [8, 4].into_iter().find(|bytes| size(*bytes) <= most) {
            return Self { bytes, rows };
        }
        let of_a_row: usize = tables.map(|table| 8 + 4 * (table.names.len() - 1)).sum();
        Self { bytes: 4, rows: (most / of_a_row.max(1)).max(FEWEST_ROWS) }
    }

    /// Leaves out rows that cannot be seen, if there are too many; `needed` are rows that should stay. Returns how
    /// far curves then are from what they were, as a share of their range.
    pub fn thin(self, table: &mut Table, needed: &[usize]) -> Option<f64> {
        if table.rows() <= self.rows {
            return None;
        }
        let kept = thinned(&table.columns, &table.ranges(), needed, self.rows);
        table.keep(&kept.rows);
        Some(kept.deviation)
    }

    pub fn pack(self, table: &Table) -> Packed<'_> {
        let mut bytes = Vec::with_capacity(self.bytes * table.rows() * table.names.len());
        for (i, column) in table.columns.iter().enumerate() {
            if i == 0 || self.bytes == 8 {
                bytes.extend(column.iter().flat_map(|value| value.to_le_bytes()));
            } else {
                bytes.extend(column.iter().flat_map(|value| (*value as f32).to_le_bytes()));
            }
        }
        Packed {
            columns: &table.names,
            rows: table.rows(),
            bytes: self.bytes,
            data: STANDARD.encode(bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: usize, columns: usize) -> Table {
        let mut table = Table::new((0..columns).map(|i| format!("c{i}")).collect());
        for row in 0..rows {
            let values: Vec<f64> = (0..columns).map(|i| ((row * (i + 1)) as f64).sin()).collect();
            table.push(&values);
        }
        table.columns[0] = (0..rows).map(|row| row as f64).collect();
        table
    }

    #[test]
    fn numbers_come_back_to_the_last_bit_where_there_is_room() {
        let table = table(3, 2);
        let packing = Packing::of([&table].into_iter(), 1000);
        let packed = packing.pack(&table);
        let bytes = STANDARD.decode(&packed.data).expect("base64");
        let numbers: Vec<f64> = bytes
            .chunks(8)
            .map(|eight| f64::from_le_bytes(eight.try_into().expect("eight")))
            .collect();
        assert_eq!(numbers, table.columns.concat());
    }

    #[test]
    fn tables_stay_within_their_room() {
        for most in [10_000, 100_000, 1_000_000] {
            let mut tables = [table(5000, 30), table(200, 3)];
            let packing = Packing::of(tables.iter(), most);
            for table in &mut tables {
                packing.thin(table, &[]);
            }
            let size: usize = tables.iter().map(|table| packing.pack(table).data.len()).sum();
            let least = FEWEST_ROWS * (8 + 4 * 29) * 4 / 3 + 10_000;
            assert!(size <= most.max(least) + 8, "{size} of {most}");
        }
    }
}
