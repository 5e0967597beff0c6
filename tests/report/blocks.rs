//! Every legible number of the seven printed blocks of motion.
//!
//! Of 392 numbers, the 156 that agree with correct physics are compared with the print, within
//! one unit of its last digit. In the others the 1970 run itself was off: it left the outboard
//! segment's share out of the kick-off moments, let no kick-off spring act on the paddle, turned
//! the paddle's inertia in the wrong order, and interpolated states linearly across its
//! millisecond steps at events; block B, moreover, shows the attitude of the step before. There
//! the print is asserted to be off, and our number is compared with a reference of 80-bit
//! arithmetic instead. So every number is compared with one or the other, and all of ours with
//! the reference.
//!
//! The blocks stand on the pages from 18-9 on, before the plots that begin on p. 18-36. Of their
//! page numbers only that of block F, p. 18-28, is legible in the scan.

use nboom::model::HingeState::{self, Free, Locked, Unreleased};
use nboom::sim::{EventKind, Snapshot};
use serde_json::Value;

use crate::collect::{run, tight};
use crate::quantity::{split, value};
use crate::sample_run::{motion_at, scene};
use crate::support::{data, number};

struct Block {
    name: &'static str,
    /// Page of the report, where it is legible.
    page: &'static str,
    /// Printed time; the last block's is not legible.
    time: Option<f64>,
    /// Hinge states as printed. Those of block B are the ones its accelerations belong to, which
    /// were computed before its release.
    hinges: [HingeState; 4],
    /// Legible numbers, and how many of them agree with correct physics.
    numbers: usize,
    matching: usize,
}

const BLOCKS: [Block; 7] = [
    Block {
        name: "A_t0",
        page: "first block of motion, after p. 18-9",
        time: Some(0.0),
        hinges: [Unreleased; 4],
        numbers: 46,
        matching: 41,
    },
    Block {
        name: "B_t007",
        page: "second block",
        time: Some(0.007),
        hinges: [Unreleased; 4],
        numbers: 48,
        matching: 30,
    },
    Block {
        name: "C_t019028",
        page: "third block",
        time: Some(0.019_028_37),
        hinges: [Free, Unreleased, Free, Unreleased],
        numbers: 56,
        matching: 26,
    },
    Block {
        name: "D_t019146",
        page: "fourth block",
        time: Some(0.019_146_58),
        hinges: [Free, Free, Free, Unreleased],
        numbers: 62,
        matching: 28,
    },
    Block {
        name: "E_t03756",
        page: "fifth block, before p. 18-28",
        time: Some(0.037_564_69),
        hinges: [Free; 4],
        numbers: 65,
        matching: 6,
    },
    Block {
        name: "F_t1667",
        page: "p. 18-28",
        time: Some(0.166_775),
        hinges: [Locked, Free, Free, Free],
        numbers: 62,
        matching: 7,
    },
    Block {
        name: "G_final",
        page: "last block, before p. 18-36",
        time: None,
        hinges: [Locked; 4],
        numbers: 53,
        matching: 18,
    },
];

impl Block {
    fn motion(&self) -> Snapshot {
        let Some(time) = self.time else { return after_last_lock_up() };
        let now = motion_at(time, &self.hinges);
        if self.name == "B_t007" {
            with_attitude_of(&motion_at(0.006, &self.hinges), now)
        } else {
            now
        }
    }

    fn rows(&self, file: &Value) -> Vec<Value> {
        let all = file["numbers"].as_array().expect("a list").iter();
        all.filter(|row| row["block"] == self.name).cloned().collect()
    }
}

fn after_last_lock_up() -> Snapshot {
    let (found, _) = run(&scene(), &tight(1));
    let mut lock_ups = found.events.into_iter().filter(|(e, _)| e.kind == EventKind::LockUp);
    lock_ups.next_back().expect("the sample run locks four hinges").1
}

/// Block B prints attitude and nutation of the step before, at 0.006 s, and with that attitude
/// turns the body components of positions, which are those of 0.007 s.
fn with_attitude_of(before: &Snapshot, mut now: Snapshot) -> Snapshot {
    let turn = before.attitude.to_matrix() * now.attitude.to_matrix().transpose();
    now.position_inertial = turn * now.position_inertial;
    let detail = now.detail.as_mut().expect("details were asked for");
    detail.mass_center_inertial = turn * detail.mass_center_inertial;
    (now.attitude, now.nutation) = (before.attitude, before.nutation);
    now
}

fn matches_truth(row: &Value) -> bool {
    row["verdict"].as_str().expect("a verdict").starts_with("match (true physics")
}

/// One unit of the last printed digit; sums printed with eight digits were formed in single
/// precision, which leaves 2.5e-6 of them.
fn allowance(row: &Value) -> f64 {
    let text = row["printed_text"].as_str().expect("a text");
    let mantissa = text.split('E').next().expect("split gives something");
    let digits = mantissa.chars().filter(char::is_ascii_digit).count();
    let is_sum = matches!(split(row["quantity"].as_str().expect("a name")).0, "P" | "T");
    let of_sum = if is_sum && digits >= 8 { 2.5e-6 * number(row, "printed").abs() } else { 0.0 };
    // The unit itself and the printed number are decimal, hence the share of 1e-9.
    number(row, "print_unit").max(of_sum) * (1.0 + 1e-9)
}

/// The largest true value among a quantity's components in a block.
fn scale(row: &Value, rows: &[Value]) -> f64 {
    let kind = |row: &Value| split(row["quantity"].as_str().expect("a name")).0.to_owned();
    let same = rows.iter().filter(|other| kind(other) == kind(row));
    same.map(|other| number(other, "oracle_true").abs()).fold(0.0, f64::max)
}

#[test]
fn printed_numbers_are_met_and_slips_of_the_print_are_not() {
    let file = data("printed_output.json");
    let mut worst = 0.0_f64;
    for block in &BLOCKS {
        let rows = block.rows(&file);
        let (mut met, at) = (0, block.motion());
        for row in &rows {
            let name = row["quantity"].as_str().expect("a name");
            let (found, printed, truth) =
                (value(name, &at), number(row, "printed"), number(row, "oracle_true"));
            let place = format!("{} ({}), {name}", block.name, block.page);

            // Rounding and truncation of our run and of the reference: both below 1e-11.
            let error = (found - truth).abs() / scale(row, &rows).max(1e-3);
            worst = worst.max(error);
            assert!(error < 1e-9, "{place}: {found}, true value {truth}");

            let is_met = (found - printed).abs() <= allowance(row);
            assert_eq!(is_met, matches_truth(row), "{place}: {found}, printed {printed}");
            met += usize::from(is_met);
        }
        println!("{}: {met} of {} as printed", block.name, rows.len());
        assert_eq!((rows.len(), met), (block.numbers, block.matching), "{}", block.name);
    }
    println!("worst difference from the reference {worst:.1e}");
}

#[test]
fn all_rows_belong_to_a_block() {
    let file = data("printed_output.json");
    let in_blocks: usize = BLOCKS.iter().map(|block| block.rows(&file).len()).sum();
    assert_eq!(in_blocks, file["numbers"].as_array().expect("a list").len());
    assert_eq!(BLOCKS.iter().map(|block| block.matching).sum::<usize>(), 156);
}
