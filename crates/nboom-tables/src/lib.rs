//! The tables of a run: read row by row, and written in formats of other programs.
//!
//! [`Rows`] reads a table as text. [`Run`] is the tables of a run's directory with the names, units and meanings
//! of their columns, which are those of its `datapackage.json`; [`Run::outputs`] writes them for Parquet or
//! HDF5. [`TableWriter`] writes a table of any columns, made row by row, in CSV or Parquet, and [`read_table`] reads
//! it. A format is there only if this crate is built with the feature of its name. Rows are read and written in
//! groups, so that memory does not grow with the length of a table. Numbers keep all their bits.
//!
//! ```
//! use nboom_tables::{Cell, Column, Kind, TableWriter};
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("cases.csv");
//! let case = Column::new("case", Kind::Integer, "number of the case");
//! let time = Column::new("t_lock", Kind::Number, "time of the last lock-up").in_units_of("s");
//! let mut cases = TableWriter::csv(&path, vec![case, time])?;
//! cases.row(&[Cell::Integer(1), Cell::Number(0.3241403182)])?;
//! cases.row(&[Cell::Integer(2), Cell::Empty])?;
//! cases.finish()?;
//! assert_eq!(std::fs::read_to_string(path)?, "case,t_lock\n1,0.3241403182\n2,\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod column;
mod error;
mod format;
mod group;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(not(feature = "hdf5"))]
#[path = "without/hdf5.rs"]
mod hdf5;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(not(feature = "parquet"))]
#[path = "without/parquet.rs"]
mod parquet;
mod reader;
mod rows;
mod run;
mod writer;

pub use column::{Cell, Column, Kind};
pub use error::TablesError;
pub use format::Format;
pub use reader::{CsvRows, read_table};
pub use rows::{Fields, Rows, RowsError, count, number};
pub use run::{Output, Run};
pub use writer::TableWriter;
