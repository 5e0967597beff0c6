//! HDF5: one file, with a group for each table and a dataset for each column.

use std::path::Path;

use hdf5_pure::{
    AttrValue, Error, File, FileAccessProperties, FileBuilder, FormatError, GroupBuilder,
    MaxExtent, SyncPolicy,
};

use crate::group::{Cells, Group};
use crate::run::Table;
use crate::{Column, Kind, Run, TablesError};

/// How large a table is.
struct Extent {
    rows: usize,
    /// Bytes of the longest text of each column.
    widths: Vec<usize>,
}

/// Writes the tables of a run to `path`: first all columns without rows, then the rows.
pub(crate) fn write(run: &Run, path: &Path) -> Result<(), TablesError> {
    let extents = run.tables.iter().map(|table| extent(run, table));
    let extents: Vec<Extent> = extents.collect::<Result<_, _>>()?;
    let built = build(run, &extents).map_err(Error::Format);
    built.and_then(|file| file.write(path)).map_err(TablesError::writing(path))?;
    // One wait for the disk at the end instead of one for each column and group of rows.
    let access = FileAccessProperties::new().with_sync_policy(SyncPolicy::OnClose);
    let file = File::open_rw_with_options(path, access).map_err(TablesError::writing(path))?;
    for (table, extent) in run.tables.iter().zip(&extents) {
        table.groups(run, |group| {
            append(&file, table, extent, group).map_err(TablesError::writing(path))
        })?;
    }
    file.close().map_err(TablesError::writing(path))
}

fn extent(run: &Run, table: &Table) -> Result<Extent, TablesError> {
    let mut extent = Extent { rows: 0, widths: vec![1; table.columns.len()] };
    table.groups(run, |group| {
        extent.rows += group.rows;
        for (width, cells) in extent.widths.iter_mut().zip(&group.columns) {
            if let Cells::Texts(cells) = cells {
                let longest = cells.iter().flatten().map(String::len).max();
                *width = longest.unwrap_or(0).max(*width);
            }
        }
        Ok(())
    })?;
    Ok(extent)
}

fn build(run: &Run, extents: &[Extent]) -> Result<FileBuilder, FormatError> {
    let mut builder = FileBuilder::new();
    for (name, text) in run.texts() {
        builder.set_attr(name, AttrValue::VarLenString(text.to_owned()));
    }
    for (table, extent) in run.tables.iter().zip(extents) {
        let mut group = builder.create_group(table.name());
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        // A list would be too long for an attribute of a thousand hinges.
        group.set_attr("columns", AttrValue::VarLenString(names.join(",")));
        let rows = Group::size(table.columns.len()).min(extent.rows).max(1);
        for (column, width) in table.columns.iter().zip(&extent.widths) {
            add(&mut group, column, *width, rows)?;
        }
        builder.add_group(group.finish());
    }
    Ok(builder)
}

fn add(
    group: &mut GroupBuilder,
    column: &Column,
    width: usize,
    rows: usize,
) -> Result<(), FormatError> {
    let data = group.create_dataset(&column.name);
    match column.kind {
        Kind::Number | Kind::Integer => data.with_f64_data(&[]),
        Kind::Text => {
            let width = u32::try_from(width).expect("a line is shorter");
            data.with_strings_sized(&[], width)?
        }
    };
    data.with_shape(&[0]).with_maxshape(&[MaxExtent::Unlimited]).with_chunks(&[rows as u64]);
    let attributes = [
        ("unit", column.unit.as_ref()),
        ("description", Some(&column.description)),
        ("body", column.body.as_ref()),
    ];
    for (name, value) in attributes {
        if let Some(value) = value {
            data.set_attr(name, AttrValue::VarLenString(value.clone()));
        }
    }
    Ok(())
}

fn append(file: &File, table: &Table, extent: &Extent, group: &Group) -> Result<(), Error> {
    let columns = table.columns.iter().zip(&extent.widths).zip(&group.columns);
    for ((column, width), cells) in columns {
        let mut data = file.dataset(&format!("{}/{}", table.name(), column.name))?;
        match cells {
            Cells::Numbers(cells) => data.append(&with_nan(cells, |value| value))?,
            // Exact, since whole numbers of tables are small enough.
            Cells::Integers(cells) => data.append(&with_nan(cells, |value| value as f64))?,
            Cells::Texts(cells) => data.append_raw(&padded(cells, *width))?,
        }
    }
    Ok(())
}

/// NaN where there is nothing.
fn with_nan<T: Copy>(cells: &[Option<T>], number: impl Fn(T) -> f64) -> Vec<f64> {
    cells.iter().map(|cell| cell.map_or(f64::NAN, &number)).collect()
}

/// Texts of one width, with zeros behind them.
fn padded(cells: &[Option<String>], width: usize) -> Vec<u8> {
    let mut bytes = vec![0; cells.len() * width];
    for (place, cell) in bytes.chunks_mut(width).zip(cells) {
        let text = cell.as_deref().unwrap_or_default().as_bytes();
        place[..text.len()].copy_from_slice(text);
    }
    bytes
}
