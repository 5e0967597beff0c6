//! Some rows of a table, by column.

use crate::{Cell, Column, Kind};

/// Cells that are held at once.
const MOST_CELLS: usize = 1 << 20;

/// Most rows that are held at once.
const MOST_ROWS: usize = 1 << 16;

/// Rows that wait until there are enough of them.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub columns: Vec<Cells>,
    pub rows: usize,
}

/// What stands in a column; nothing where the table says nothing.
#[derive(Clone, Debug)]
pub(crate) enum Cells {
    Numbers(Vec<Option<f64>>),
    Integers(Vec<Option<i64>>),
    Texts(Vec<Option<String>>),
}

impl Group {
    /// Without rows.
    pub fn of(columns: &[Column]) -> Self {
        let cells = |column: &Column| match column.kind {
            Kind::Number => Cells::Numbers(Vec::new()),
            Kind::Integer => Cells::Integers(Vec::new()),
            Kind::Text => Cells::Texts(Vec::new()),
        };
        Self { columns: columns.iter().map(cells).collect(), rows: 0 }
    }

    /// Rows of a whole group of a table of so many columns.
    pub fn size(columns: usize) -> usize {
        (MOST_CELLS / columns.max(1)).clamp(1, MOST_ROWS)
    }

    pub fn is_full(&self) -> bool {
        self.rows >= Self::size(self.columns.len())
    }

    /// Adds a row of cells that their columns admit.
    pub fn push(&mut self, cells: &[Cell<'_>]) {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            match (column, *cell) {
                (Cells::Numbers(column), Cell::Number(value)) => column.push(Some(value)),
                (Cells::Integers(column), Cell::Integer(value)) => column.push(Some(value)),
                (Cells::Texts(column), Cell::Text(text)) => column.push(Some(text.to_owned())),
                (Cells::Numbers(column), _) => column.push(None),
                (Cells::Integers(column), _) => column.push(None),
                (Cells::Texts(column), _) => column.push(None),
            }
        }
        self.rows += 1;
    }

    /// The cells of a row.
    pub fn row(&self, row: usize) -> Vec<Cell<'_>> {
        self.columns.iter().map(|cells| cells.cell(row)).collect()
    }

    pub fn clear(&mut self) {
        for column in &mut self.columns {
            match column {
                Cells::Numbers(cells) => cells.clear(),
                Cells::Integers(cells) => cells.clear(),
                Cells::Texts(cells) => cells.clear(),
            }
        }
        self.rows = 0;
    }
}

impl Cells {
    fn cell(&self, row: usize) -> Cell<'_> {
        match self {
            Self::Numbers(cells) => cells[row].map_or(Cell::Empty, Cell::Number),
            Self::Integers(cells) => cells[row].map_or(Cell::Empty, Cell::Integer),
            Self::Texts(cells) => cells[row].as_deref().map_or(Cell::Empty, Cell::Text),
        }
    }
}
