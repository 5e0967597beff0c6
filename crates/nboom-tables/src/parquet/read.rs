use std::fs::File;
use std::path::Path;

use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{ByteArray, DataType};
use ::parquet::errors::{ParquetError, Result as ParquetResult};
use ::parquet::file::reader::{FileReader, SerializedFileReader};

use crate::group::{Cells, Group};
use crate::{Column, TablesError};

/// Hands on the groups of rows of a table.
///
/// # Errors
/// When it cannot be read or has other columns, and those of `take`.
pub(crate) fn each_group<E: From<TablesError>>(
    path: &Path,
    columns: &[Column],
    mut take: impl FnMut(&Group) -> Result<(), E>,
) -> Result<(), E> {
    let wrong = |found: String| TablesError::Table { path: path.to_owned(), found };
    let damaged = |error: ParquetError| wrong(error.to_string());
    let file = File::open(path).map_err(TablesError::reading(path))?;
    let reader = SerializedFileReader::new(file).map_err(damaged)?;
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let names = schema.columns().iter().map(|column| column.name());
    if !names.eq(columns.iter().map(|column| column.name.as_str())) {
        return Err(wrong("other names of columns".to_owned()).into());
    }
    for number in 0..reader.num_row_groups() {
        let mut group = Group::of(columns);
        let rows = reader.get_row_group(number).map_err(damaged)?;
        let count = usize::try_from(rows.metadata().num_rows()).unwrap_or(0);
        for (place, cells) in group.columns.iter_mut().enumerate() {
            let column = rows.get_column_reader(place).map_err(damaged)?;
            read_cells(column, count, cells).map_err(damaged)?;
        }
        group.rows = count;
        take(&group)?;
    }
    Ok(())
}

fn read_cells(column: ColumnReader, rows: usize, cells: &mut Cells) -> ParquetResult<()> {
    use ColumnReader::{ByteArrayColumnReader, DoubleColumnReader, Int64ColumnReader};
    match (column, cells) {
        (DoubleColumnReader(column), Cells::Numbers(cells)) => *cells = values(column, rows)?,
        (Int64ColumnReader(column), Cells::Integers(cells)) => *cells = values(column, rows)?,
        (ByteArrayColumnReader(column), Cells::Texts(cells)) => {
            let text = |bytes: ByteArray| bytes.as_utf8().map(str::to_owned);
            let texts = values(column, rows)?.into_iter();
            *cells = texts.map(|bytes| bytes.map(text).transpose()).collect::<Result<_, _>>()?;
        }
        _ => return Err(ParquetError::General("a column of another kind".to_owned())),
    }
    Ok(())
}

/// The values of a column where it has some.
fn values<T: DataType>(
    mut column: ColumnReaderImpl<T>,
    rows: usize,
) -> ParquetResult<Vec<Option<T::T>>> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    while levels.len() < rows {
        let left = rows - levels.len();
        if column.read_records(left, Some(&mut levels), None, &mut values)?.0 == 0 {
            return Err(ParquetError::General(format!("{} of {rows} rows", levels.len())));
        }
    }
    let mut values = values.into_iter();
    let value = |level: i16| if level == 1 { values.next() } else { None };
    Ok(levels.into_iter().map(value).collect())
}
