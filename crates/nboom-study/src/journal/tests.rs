use std::fs;

use nboom_tables::Kind;
use proptest::prelude::*;

use super::*;
use crate::frame::{Batch, Columns};
use crate::{Outcome, Row, Value};

fn columns() -> Vec<Column> {
    let case = Column::new("case", Kind::Integer, "the case");
    vec![case, Column::new("status", Kind::Text, "what became of it")]
}

fn frame(cases: RangeInclusive<u64>) -> Vec<u8> {
    let mut batch = Batch::from_case(*cases.start());
    for case in cases {
        let status = Value::Text("ok".to_owned());
        let cells = vec![Value::Integer(case.cast_signed()), status];
        let row = Row { cells, states: Vec::new(), outcome: Outcome::Ok };
        batch.push(&row, &Columns { cases: &columns(), states: &[] });
    }
    batch.frame().concat()
}

fn read(bytes: &[u8]) -> Result<Journal, StudyError> {
    let place = tempfile::tempdir().expect("a directory");
    let path = place.path().join("journal.txt");
    fs::write(&path, bytes).expect("writable");
    let journal = Journal::read(&path, 1..=100)?;
    let columns = columns();
    for part in [Part::Case, Part::States] {
        journal.each(part, &columns, |_| Ok(()))?;
    }
    Ok(journal)
}

/// The checksum is the CRC-32 of the first words and the rows, as other programs compute it.
#[test]
fn a_frame_is_as_documented() {
    let frame = String::from_utf8(frame(7..=8)).expect("text");
    // By Python: zlib.crc32(b"batch 7 8 10 0" + b"7,ok\n8,ok\n").
    assert_eq!(frame, "batch 7 8 10 0 23f39a13\n7,ok\n8,ok\n");
}

#[test]
fn cases_come_in_order_and_gaps_are_known() {
    let frames = [50..=60, 2..=9, 10..=10].map(frame);
    let journal = read(&frames.concat()).expect("it is whole");
    assert_eq!(journal.missing(), [1..=1, 11..=49, 61..=100]);
    assert_eq!(journal.done(), 20);
}

#[test]
fn cases_that_are_there_twice_or_elsewhere_are_refused() {
    let of = |batches: [RangeInclusive<u64>; 2]| {
        read(&batches.map(frame).concat()).expect_err("refused").to_string()
    };
    let second = frame(1..=5).len();
    let found = of([1..=5, 5..=6]);
    assert!(found.contains(&format!("byte {second}: case 5 for the second time")), "{found}");
    let found = of([1..=5, 99..=101]);
    assert!(found.contains(&format!("byte {second}: cases 99 to 101")), "{found}");
}

/// A frame whose checksum is right and whose rows are anything.
fn sealed(first: u64, last: u64, rows: &[u8], states: &[u8]) -> Vec<u8> {
    let (rows_len, states_len) = (rows.len() as u64, states.len() as u64);
    let mut head = Head { first, last, rows: rows_len, states: states_len, checksum: 0 };
    head.checksum = crc32fast::hash(&[head.said().as_bytes(), rows, states].concat());
    [head.text().as_bytes(), rows, states].concat()
}

#[test]
fn rows_that_are_not_those_of_the_head_are_refused() {
    let wrong: [(&str, &str); 6] = [
        ("1,ok\n", "no row of case 2"),
        ("1,ok\n3,ok\n", "a row of case `3` where 2 is due"),
        ("1,ok\n2\n", "a row of 1 fields, 2 expected"),
        ("1,ok\n2,ok\n3,ok\n", "a row of case `3`"),
        ("1,ok\nx,ok\n", "column case"),
        ("", "no row of case 1"),
    ];
    for (rows, expected) in wrong {
        let found = read(&sealed(1, 2, rows.as_bytes(), b"")).expect_err("refused").to_string();
        assert!(found.contains("byte 0") && found.contains(expected), "{found}");
    }
    for states in ["2,a\n1,a\n", "3,a\n", ",a\n"] {
        let found = read(&sealed(1, 2, b"1,ok\n2,ok\n", states.as_bytes())).expect_err("refused");
        assert!(found.to_string().contains("is due"), "{found}");
    }
}

/// Lines as of a journal, with any numbers and any checksum.
fn lines() -> impl Strategy<Value = Vec<u8>> {
    let number = prop_oneof![0_u64..40, Just(u64::MAX), Just(1 << 63), any::<u64>()];
    let numbers = [number.clone(), number.clone(), number.clone(), number];
    let head = (numbers, any::<u32>()).prop_map(|([a, b, c, d], checksum)| {
        format!("batch {a} {b} {c} {d} {checksum:08x}\n").into_bytes()
    });
    let rows = proptest::collection::vec(any::<u8>(), 0..40);
    let sealed_rows = (0_u64..40, 0_u64..4, rows.clone(), rows.clone())
        .prop_map(|(first, more, rows, states)| sealed(first, first + more, &rows, &states));
    let whole = (1_u64..40, 0_u64..4).prop_map(|(first, more)| frame(first..=first + more));
    let pieces = prop_oneof![head, rows, sealed_rows, whole];
    proptest::collection::vec(pieces, 0..12).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read_or_refused(bytes in lines()) {
        if let Ok(journal) = read(&bytes) {
            prop_assert!(journal.end <= bytes.len() as u64);
            let missing: u64 = journal.missing().iter().map(|gap| gap.end() - gap.start() + 1).sum();
            prop_assert_eq!(journal.done() + missing, 100);
        }
    }
}
