//! What is in tables of Parquet and HDF5. `.ci/tables` reads them by other programs.

#![cfg(any(feature = "parquet", feature = "hdf5"))]

use std::fmt::Write;
use std::iter::successors;

use nboom_tables::{Format, Run};

use crate::Place;

/// More rows than are held at once.
const MANY: usize = 70_000;

/// Any bits that are finite numbers: a generator of Marsaglia's.
fn numbers() -> impl Iterator<Item = f64> {
    let random = successors(Some(0x9e37_79b9_7f4a_7c15_u64), |&bits| {
        let bits = bits ^ (bits << 13);
        let bits = bits ^ (bits >> 7);
        Some(bits ^ (bits << 17))
    });
    let awkward = [-0.0, 0.0, 5e-324, f64::MAX, f64::MIN_POSITIVE, 9_007_199_254_740_993.0];
    let random = random.map(f64::from_bits).filter(|value| value.is_finite());
    awkward.into_iter().chain(random)
}

/// A run with a long table.
fn long() -> Place {
    let place = Place::new();
    let mut text = "t,beta_1_1\n".to_owned();
    for (row, value) in numbers().take(MANY).enumerate() {
        let _ = writeln!(text, "{row},{value:?}");
    }
    place.write("states.csv", &text);
    place
}

/// Writes the tables of a format; what is wrong with the first that cannot be.
fn write(place: &Place, format: Format) -> Result<(), String> {
    let run = Run::read(&place.path("")).expect("a run");
    let mut outputs = run.outputs(format).expect("built").into_iter();
    outputs
        .try_for_each(|output| output.write(&place.path(output.name)))
        .map_err(|error| error.to_string())
}

fn built() -> impl Iterator<Item = Format> {
    Format::ALL.into_iter().filter(|format| format.require().is_ok())
}

#[test]
fn a_table_that_no_run_has_written_is_refused() {
    for (file, text, words) in [
        ("states.csv", "t,beta_1_1\n0,0\n1,0.", "states.csv, line 3: the line is cut off"),
        ("states.csv", "t,beta_1_1\n0,0\n1\n", "states.csv, line 3: 1 fields found, 2 expected"),
        (
            "states.csv",
            "t,beta_1_1\n0,1e999\n",
            "states.csv, line 2: column beta_1_1: `1e999` found",
        ),
        (
            "states.csv",
            "t,beta_1_2\n",
            "line 1: the column `beta_1_2` found, the column `beta_1_1` expected",
        ),
        ("states.csv", "t\n", "line 1: the end of the line found, the column `beta_1_1` expected"),
        (
            "events.csv",
            "t,event,appendage\n0,end,1.5\n",
            "events.csv, line 2: column appendage: `1.5` found",
        ),
        (
            "events.csv",
            "t,event,appendage\n0,end,9007199254740993\n",
            "a whole number up to 9007199254740992",
        ),
    ] {
        for format in built() {
            let place = Place::new();
            place.write(file, text);
            let message = write(&place, format).expect_err(words);
            assert!(message.contains(words), "{message}");
        }
    }
    for format in built() {
        let place = Place::new();
        std::fs::remove_file(place.path("events.csv")).expect("it is there");
        let message = write(&place, format).expect_err("a table is missing");
        assert!(message.contains("no events.csv found"), "{message}");
    }
}

#[cfg(feature = "hdf5")]
mod of_hdf5 {
    use hdf5_pure::{AttrValue, File};

    use super::*;

    fn open(place: &Place) -> File {
        write(place, Format::Hdf5).expect("right");
        File::open(place.path("run.h5")).expect("a file of HDF5")
    }

    #[test]
    fn numbers_keep_their_bits_in_any_number_of_rows() {
        let file = open(&long());
        let values = file.dataset("states/beta_1_1").expect("there").read_f64().expect("numbers");
        assert!(
            values.iter().map(|value| value.to_bits()).eq(numbers().take(MANY).map(f64::to_bits))
        );
    }

    #[test]
    fn columns_say_what_they_are_and_empty_fields_are_nan() {
        let file = open(&Place::new());
        let time = file.dataset("states/t").expect("without its unit").attrs().expect("readable");
        assert_eq!(time.get("unit"), Some(&AttrValue::VarLenString("s".to_owned())));
        let event = file.dataset("events/event").expect("there").read_string().expect("words");
        assert_eq!(event, ["release", "end"]);
        let appendage =
            file.dataset("events/appendage").expect("there").read_f64().expect("numbers");
        assert!(appendage[0] == 1.0 && appendage[1].is_nan(), "{appendage:?}");
        let root = file.root().attrs().expect("readable");
        let AttrValue::VarLenString(scene) = &root["scene"] else { panic!("no text") };
        assert_eq!(scene, "name = \"boom\" # one hinge, of 3 °\n");
    }
}

#[cfg(feature = "parquet")]
mod of_parquet {
    use std::fs::File;

    use nboom_tables::{Cell, Column, Kind, TableWriter};
    use parquet::basic::{Compression, Encoding, Type};
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    fn rows(place: &Place, name: &str) -> Vec<Vec<Field>> {
        let file = File::open(place.path(name)).expect("readable");
        let file = SerializedFileReader::new(file).expect("a file of Parquet");
        let rows = file.get_row_iter(None).expect("readable").map(|row| row.expect("a row"));
        rows.map(|row| row.get_column_iter().map(|(_, field)| field.clone()).collect()).collect()
    }

    #[test]
    fn numbers_keep_their_bits_in_any_number_of_rows() {
        let place = long();
        write(&place, Format::Parquet).expect("right");
        let bits = |row: Vec<Field>| match row[1] {
            Field::Double(value) => value.to_bits(),
            _ => panic!("no number"),
        };
        let found = rows(&place, "states.parquet").into_iter().map(bits);
        assert!(found.eq(numbers().take(MANY).map(f64::to_bits)));
    }

    #[test]
    fn numbers_are_packed_byte_by_byte() {
        let place = long();
        write(&place, Format::Parquet).expect("it is built");
        let file = File::open(place.path("states.parquet")).expect("it is there");
        let file = SerializedFileReader::new(file).expect("a file of Parquet");
        for column in file.metadata().row_group(0).columns() {
            assert_eq!(column.compression(), Compression::SNAPPY);
            if column.column_type() == Type::DOUBLE {
                assert!(column.encodings().any(|one| one == Encoding::BYTE_STREAM_SPLIT));
            }
        }
    }

    #[test]
    fn empty_fields_are_nulls() {
        let place = Place::new();
        write(&place, Format::Parquet).expect("right");
        let event = |name: &str| Field::Str(name.to_owned());
        let first = vec![Field::Double(0.1), event("release"), Field::Long(1)];
        let last = vec![Field::Double(0.25), event("end"), Field::Null];
        assert_eq!(rows(&place, "events.parquet"), [first, last]);
    }

    #[test]
    fn a_table_made_row_by_row_is_one_like_others() {
        let place = Place::new();
        let path = place.path("cases.parquet");
        let time = Column::new("t", Kind::Number, "time").in_units_of("s");
        let columns = vec![Column::new("case", Kind::Integer, "number"), time];
        let mut table = TableWriter::parquet(&path, columns, &[("scene", "x")]).expect("writable");
        for case in 0..MANY as i64 {
            table.row(&[Cell::Integer(case), Cell::Number(0.5)]).expect("writable");
        }
        table.row(&[Cell::Integer(1), Cell::Integer(1)]).expect_err("it is no number");
        table.row(&[Cell::Integer(-1), Cell::Empty]).expect("writable");
        table.finish().expect("writable");
        let rows = rows(&place, "cases.parquet");
        assert_eq!(rows.len(), MANY + 1);
        assert_eq!(rows[MANY], [Field::Long(-1), Field::Null]);
        let file = SerializedFileReader::new(File::open(&path).expect("readable")).expect("right");
        let texts = file.metadata().file_metadata().key_value_metadata().expect("texts");
        let text = |key: &str| texts.iter().find(|text| text.key == key)?.value.clone();
        assert_eq!(text("units").as_deref(), Some("{\"t\":\"s\"}"));
        assert_eq!(text("scene").as_deref(), Some("x"));
    }
}
