//! Parquet: a file for each table.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnPath, Type};
use serde_json::{Map, Value, json};

use crate::group::{Cells, Group};
use crate::{Column, Kind, TablesError};

mod read;

pub(crate) use read::each_group;

/// Where pandas keeps what belongs to a table, and looks for it.
const OF_PANDAS: &str = "PANDAS_ATTRS";

/// A table that is being written.
#[derive(Debug)]
pub(crate) struct ParquetFile {
    path: PathBuf,
    writer: SerializedFileWriter<File>,
}

impl ParquetFile {
    /// Begins a table, with these texts by their names.
    pub fn create(
        path: &Path,
        columns: &[Column],
        texts: &[(&str, &str)],
    ) -> Result<Self, TablesError> {
        let file = File::create(path).map_err(TablesError::writing(path))?;
        let schema = schema(columns).map_err(TablesError::writing(path))?;
        let properties = properties(columns, texts).into();
        let writer = SerializedFileWriter::new(file, schema, properties);
        let writer = writer.map_err(TablesError::writing(path))?;
        Ok(Self { path: path.to_owned(), writer })
    }

    /// Adds rows.
    pub fn write(&mut self, group: &Group) -> Result<(), TablesError> {
        if group.rows == 0 {
            return Ok(());
        }
        let mut write = || {
            let mut rows = self.writer.next_row_group()?;
            for cells in &group.columns {
                let mut column = rows.next_column()?.expect("a column of the schema");
                write_cells(&mut column, cells)?;
                column.close()?;
            }
            rows.close().map(|_| ())
        };
        write().map_err(TablesError::writing(&self.path))
    }

    /// Ends the table and waits for the disk.
    pub fn close(self) -> Result<(), TablesError> {
        let file = self.writer.into_inner().map_err(TablesError::writing(&self.path))?;
        file.sync_all().map_err(TablesError::writing(&self.path))
    }
}

fn schema(columns: &[Column]) -> Result<Arc<Type>, ParquetError> {
    let field = |column: &Column| {
        let (physical, logical) = match column.kind {
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Integer => (Physical::INT64, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical);
        field.build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    Type::group_type_builder("table").with_fields(fields).build().map(Arc::new)
}

fn properties(columns: &[Column], texts: &[(&str, &str)]) -> WriterProperties {
    let of = |value: &dyn Fn(&Column) -> Option<String>| {
        let entry = |column: &Column| Some((column.name.clone(), Value::from(value(column)?)));
        Value::Object(columns.iter().filter_map(entry).collect::<Map<_, _>>())
    };
    let units = of(&|column| column.unit.clone());
    let descriptions = of(&|column| Some(column.description.clone()));
    let bodies = of(&|column| column.body.clone());
    let of_pandas = json!({ "units": units, "descriptions": descriptions, "bodies": bodies });
    let entry = |(name, text): (&str, String)| KeyValue::new(name.to_owned(), text);
    let of_columns = [("units", units), ("descriptions", descriptions), ("bodies", bodies)];
    let of_columns = of_columns.into_iter().chain([(OF_PANDAS, of_pandas)]);
    let entries = of_columns.map(|(name, value)| (name, value.to_string()));
    let entries = entries.chain(texts.iter().map(|(name, text)| (*name, (*text).to_owned())));
    let properties = WriterProperties::builder()
        .set_created_by(concat!("nboom version ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_key_value_metadata(Some(entries.map(entry).collect()))
        // Numbers of a motion hardly ever come twice.
        .set_dictionary_enabled(false)
        .set_compression(Compression::SNAPPY);
    // Signs and exponents of neighbours are alike: byte by byte they pack better.
    let numbers = columns.iter().filter(|column| column.kind == Kind::Number);
    let by_bytes = numbers.fold(properties, |properties, column| {
        let path = ColumnPath::new(vec![column.name.clone()]);
        properties.set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT)
    });
    by_bytes.build()
}

fn write_cells(column: &mut SerializedColumnWriter<'_>, cells: &Cells) -> Result<(), ParquetError> {
    match cells {
        Cells::Numbers(cells) => {
            let given: Vec<f64> = cells.iter().flatten().copied().collect();
            column.typed::<DoubleType>().write_batch(&given, Some(&levels(cells)), None)?;
        }
        Cells::Integers(cells) => {
            let given: Vec<i64> = cells.iter().flatten().copied().collect();
            column.typed::<Int64Type>().write_batch(&given, Some(&levels(cells)), None)?;
        }
        Cells::Texts(cells) => {
            let bytes = |text: &String| ByteArray::from(text.as_str());
            let given: Vec<ByteArray> = cells.iter().flatten().map(bytes).collect();
            column.typed::<ByteArrayType>().write_batch(&given, Some(&levels(cells)), None)?;
        }
    }
    Ok(())
}

/// 1 where there is something, else 0.
fn levels<T>(cells: &[Option<T>]) -> Vec<i16> {
    cells.iter().map(|cell| cell.is_some().into()).collect()
}
