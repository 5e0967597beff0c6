//! Whole tables: faults, latches, cases that did not run, tables that are too long.

use nboom_study::Requirement;
use nboom_study::statistics::{Extreme, Meaning, Role, Statistics, Summary, Worse};
use nboom_tables::Cell;

use crate::{field, uniform};

const LOCK_TIME: &str = "lock_time of panel +x";

fn table(required: &[Requirement]) -> Statistics {
    let fields = vec![
        field("case", Role::Case),
        field("seed", Role::Seed),
        field("fault", Role::Fault),
        field("spring", Role::Variable),
        field(LOCK_TIME, Role::Result),
        field("status", Role::Status),
    ];
    Statistics::new(fields, required)
}

fn required(result: &str, at_least: Option<f64>, at_most: Option<f64>) -> Requirement {
    Requirement { result: result.to_owned(), at_least, at_most }
}

/// A table of draws, each without fault and with a fault in which the hinge never latches; without it the hinge
/// latches at twice the variable, but in every tenth draw not at all.
fn two_by_two(draws: u64) -> Summary {
    two_by_two_with(draws, &[])
}

/// The same, of which this is required.
fn two_by_two_with(draws: u64, requirements: &[Requirement]) -> Summary {
    let mut statistics = table(requirements);
    for (draw, spring) in (0..draws).zip(uniform(11)) {
        let head = |case: u64| [Cell::Integer(case as i64), Cell::Integer(draw as i64 + 77)];
        let time = if draw % 10 == 9 { Cell::Empty } else { Cell::Number(2.0 * spring) };
        let [case, seed] = head(2 * draw + 1);
        let spring = Cell::Number(spring);
        statistics.row(&[case, seed, Cell::Empty, spring, time, Cell::Text("ok")]);
        let [case, seed] = head(2 * draw + 2);
        let fault = Cell::Text("stuck");
        statistics.row(&[case, seed, fault, spring, Cell::Empty, Cell::Text("ok")]);
    }
    statistics.finish()
}

#[test]
fn faults_stand_apart_and_empty_cells_are_hinges_that_never_latch() {
    let found = two_by_two(1000);
    assert_eq!(found.faults, ["stuck"]);
    let [latch] = &found.latches[..] else { panic!("one hinge") };
    assert_eq!(latch.hinge, "panel +x");
    let ends: Vec<_> = latch.by_end.iter().map(|end| (end.count, end.of)).collect();
    assert_eq!(ends, [(900, 1000), (0, 1000)]);
    for at in &latch.times {
        // Nine in ten of the cases in which twice a uniform number is below the time.
        let share = 0.9 * 0.5 * at.time;
        let off = 4.5 * (share * (1.0 - share) / 1000.0).sqrt() + 1e-3;
        assert!((at.latched.count as f64 / 1000.0 - share).abs() < off, "{at:?}");
        assert!(at.latched.low <= at.latched.count as f64 / 1000.0);
    }
    let time = &found.columns[1];
    assert_eq!((time.spreads[0].count, time.spreads[1].count), (900, 0));
    let never = &time.spreads[1].percentiles;
    assert!(never.len() == 7 && never.iter().all(|of| of.value.is_infinite()), "{never:?}");
    let [driver] = time.drivers[..] else { panic!("one variable") };
    // Nine in ten rise with the variable, the others are tied above them whatever it is: 0.8104, of 1000 draws to 0.02
    // or so, of which three are allowed.
    assert_eq!(driver.variable, 0);
    assert!((driver.coefficient - 0.8104).abs() < 0.06, "{driver:?}");
    assert_eq!(time.histogram.as_ref().expect("times").counts.iter().sum::<u64>(), 900);
}

#[test]
fn a_latch_that_never_closes_is_later_than_all_others_and_the_worst() {
    let found = two_by_two(1000);
    let time = &found.columns[1];
    let [.., late, latest] = &time.spreads[0].percentiles[..] else { panic!("seven") };
    // A tenth never latches.
    assert_eq!((late.value, latest.value), (f64::INFINITY, f64::INFINITY));
    let never = Some(f64::INFINITY);
    assert_eq!([late.low, late.high, latest.low, latest.high], [never; 4], "they are never too");
    // Which a file tells from too few cases for an end.
    let few = two_by_two(2);
    let median = few.columns[1].spreads[0].percentiles[3];
    assert_eq!([median.low, median.high], [None; 2]);
    for (summary, number, expected) in
        [(&found, 6, Some(&serde_json::Value::Null)), (&few, 3, None)]
    {
        let text = serde_json::to_string(summary).expect("JSON");
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let percentile = &json["columns"][1]["spreads"][0]["percentiles"][number];
        assert_eq!([percentile.get("low"), percentile.get("high")], [expected; 2], "{percentile}");
        let read: Summary = serde_json::from_str(&text).expect("statistics");
        assert_eq!(read.columns[1].spreads, summary.columns[1].spreads);
    }
    // Half of all cases have latched by a time at which 5/9 of those that latch have.
    let median = time.spreads[0].percentiles[3];
    let off = 2.0 * 4.5 * (0.25_f64 / 900.0).sqrt();
    assert!((median.value - 2.0 * 5.0 / 9.0).abs() < off, "{median:?}");
    assert_eq!(time.meaning.hinge_that_locks(), Some("panel +x"));
    assert!(time.worst().iter().all(|worst| worst.value == f64::INFINITY));
    assert_eq!(time.worst()[0].case, 2, "the first with a fault");
}

#[test]
fn what_keeps_a_latch_from_closing_drives_when_it_closes() {
    let mut statistics = table(&[]);
    for (draw, spring) in (0..500).zip(uniform(3)) {
        // Weak springs never close it; the others do at a time that has nothing to do with them.
        let time = Cell::Number(f64::from((draw * 37) % 500));
        let time = if spring < 0.5 { Cell::Empty } else { time };
        let case = Cell::Integer(draw.into());
        statistics.row(&[case, case, Cell::Empty, Cell::Number(spring), time, Cell::Text("ok")]);
    }
    let found = statistics.finish();
    let [driver] = found.columns[1].drivers[..] else { panic!("one variable") };
    // Of ranks from 0 to 1 the covariance is -1/16, the variances are 1/12 and 7/96: -0.8018, as closely as above.
    assert!((driver.coefficient + 0.8018).abs() < 0.06, "{driver:?}");
}

/// Statistics of a result with these numbers.
fn of_result(label: &str, numbers: &[f64], required: &[Requirement]) -> Summary {
    let mut statistics = Statistics::new(vec![field(label, Role::Result)], required);
    numbers.iter().for_each(|&number| statistics.row(&[Cell::Number(number)]));
    statistics.finish()
}

#[test]
fn the_worst_of_numbers_with_a_sign_is_the_largest_in_size() {
    let numbers = [-6.0, -1.0, 0.5, 4.0, -5.0, 2.0, -0.1];
    for (label, expected, worse) in [
        ("impulse of boom", [-6.0, -5.0, 4.0, 2.0, -1.0], Worse::Both),
        ("margin of boom", [-6.0, -5.0, -1.0, -0.1, 0.5], Worse::Small),
        ("smallest omega_x", [-6.0, -5.0, -1.0, -0.1, 0.5], Worse::Small),
        ("largest omega_x", [4.0, 2.0, 0.5, -0.1, -1.0], Worse::Large),
    ] {
        let found = of_result(label, &numbers, &[]);
        let worst = found.columns[0].worst();
        assert_eq!(worst.iter().map(|worst| worst.value).collect::<Vec<_>>(), expected, "{label}");
        assert_eq!(found.columns[0].worse(), worse, "{label}");
    }
    assert_eq!(of_result("impulse of boom", &[3.0, 1.0], &[]).columns[0].worse(), Worse::Large);
    // Where and when a margin is smallest is no margin.
    for (label, is_margin) in [
        ("verdict.smallest_margin", true),
        ("verdict.smallest_ultimate_margin", true),
        ("verdict.smallest_margin_at.time", false),
        ("verdict.smallest_yield_margin_at.station", false),
    ] {
        let meaning = &of_result(label, &[3.0, 1.0], &[]).columns[0].meaning;
        assert_eq!(*meaning == Meaning::Margin, is_margin, "{label}");
    }
}

#[test]
fn bounds_are_met_up_to_themselves_and_by_no_case_without_a_number() {
    let numbers = [-6.0, -1.0, 0.5, 4.0, f64::NAN, 2.0, 1e160];
    for (at_least, at_most, count, first, worse) in [
        (Some(-1.0), None, 4, 1, Worse::Small),
        (None, Some(2.0), 4, 4, Worse::Large),
        // Of two bounds the numbers say it.
        (Some(-1.0), Some(2.0), 3, 1, Worse::Both),
        (Some(-6.0), Some(4.0), 5, 5, Worse::Both),
    ] {
        let required = [required("impulse of boom", at_least, at_most)];
        let found = of_result("impulse of boom", &numbers, &required);
        let [compliance] = &found.requirements[..] else { panic!("one requirement") };
        assert_eq!(compliance.requirement, required[0]);
        let [met] = compliance.met[..] else { panic!("no faults") };
        assert_eq!((met.count, met.of), (count, 7));
        assert_eq!(compliance.first_broken, [Some(first)]);
        assert_eq!(found.columns[0].worse(), worse);
        assert_eq!(found.meet_all, compliance.met);
    }
    assert!(of_result("impulse of boom", &numbers, &[]).meet_all.is_empty());
}

#[test]
fn requirements_are_met_by_fault_and_all_together_by_cases_that_meet_each() {
    let both = [
        required(LOCK_TIME, None, Some(1.5)),
        required("spring", Some(0.2), None),
        required("lock_time of another", Some(0.0), None),
    ];
    let found = two_by_two_with(1000, &both);
    // A variable is not a result, and the third has no column.
    let [late] = &found.requirements[..] else { panic!("one of a result") };
    let numbers: Vec<f64> = uniform(11).take(1000).collect();
    let latches = |draw: usize| draw % 10 != 9 && 2.0 * numbers[draw] <= 1.5;
    let expected = (0..1000).filter(|draw| latches(*draw)).count() as u64;
    let counts: Vec<_> = late.met.iter().map(|met| (met.count, met.of)).collect();
    assert_eq!(counts, [(expected, 1000), (0, 1000)]);
    assert!(
        late.met[0].low < expected as f64 / 1000.0 && late.met[0].high > expected as f64 / 1000.0
    );
    let first = (0..1000).find(|draw| !latches(*draw)).map(|draw| 2 * draw as u64 + 1);
    assert_eq!(late.first_broken, [first, Some(2)]);
    assert_eq!(found.meet_all, late.met);
    let text = serde_json::to_string(&found).expect("numbers and texts");
    assert_eq!(serde_json::from_str::<Summary>(&text).expect("the same"), found);

    let mut two = Statistics::new(
        vec![field("a", Role::Result), field("b", Role::Result)],
        &[required("a", Some(0.0), None), required("b", None, Some(0.0))],
    );
    for [a, b] in [[1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [-1.0, 1.0], [2.0, -2.0]] {
        two.row(&[Cell::Number(a), Cell::Number(b)]);
    }
    let two = two.finish();
    let counts: Vec<_> =
        two.requirements.iter().map(|of| (of.met[0].count, of.first_broken[0])).collect();
    assert_eq!(counts, [(3, Some(3)), (3, Some(2))]);
    assert_eq!((two.meet_all[0].count, two.meet_all[0].of), (2, 5));
}

#[test]
fn a_long_table_has_counts_and_extremes_of_all_rows_and_percentiles_of_a_share() {
    let draws = 150_000;
    let found = two_by_two(draws);
    assert_eq!(found.counts.cases, 2 * draws);
    assert_eq!(found.share, 2);
    assert!(found.held <= 200_000 && found.held > 140_000, "{}", found.held);
    assert_eq!(found.latches[0].by_end[0].count, draws / 10 * 9);
    let spring = &found.columns[0];
    let numbers: Vec<f64> = uniform(11).take(draws as usize).collect();
    let largest = numbers.iter().copied().fold(0.0, f64::max);
    let draw = numbers.iter().position(|x| *x == largest).expect("itself") as u64;
    assert_eq!(spring.largest[0], Extreme { case: 2 * draw + 1, fault: 0, value: largest });
    assert_eq!(spring.largest[1], Extreme { case: 2 * draw + 2, fault: 1, value: largest });
    for one in &spring.spreads[0].percentiles {
        let p = one.percent / 100.0;
        assert!((one.value - p).abs() < 4.5 * (p * (1.0 - p) / 70_000.0).sqrt(), "{one:?}");
    }
    assert_eq!(found.points.cases.len(), 2000);
    assert!(found.points.cases.is_sorted());
    for i in 0..2000 {
        let draw = (found.points.cases[i] - 1) / 2;
        let value = found.points.values[0][i].expect("a number");
        assert!((value - numbers[draw as usize]).abs() < 1e-5 * numbers[draw as usize]);
    }
}

#[test]
fn cases_that_did_not_run_are_counted_and_listed_and_have_no_results_but_what_was_drawn() {
    let mut statistics = table(&[]);
    for case in 1..=300 {
        let status = match case % 3 {
            0 => "ok",
            1 => "rejected: mass of panel +x: -1 found, a positive number expected",
            _ => "failed: step too small at t = 2",
        };
        let number = Cell::Number(f64::from(case));
        let case = Cell::Integer(case.into());
        statistics.row(&[case, case, Cell::Empty, number, number, Cell::Text(status)]);
    }
    let found = statistics.finish();
    let counts = found.counts;
    assert_eq!((counts.cases, counts.ok, counts.rejected, counts.failed), (300, 100, 100, 100));
    assert_eq!(found.troubles.len(), 100);
    assert_eq!(found.troubles[99].case, 149);
    assert_eq!(found.columns[1].spreads[0].count, 100);
    assert_eq!(
        found.columns[1].smallest.iter().map(|one| one.case).collect::<Vec<_>>(),
        [3, 6, 9, 12, 15]
    );
    assert_eq!(found.latches[0].by_end[0].of, 100);
    // The numbers from 1 to 300 were drawn, whatever became of them.
    let drawn = &found.columns[0];
    let spread = &drawn.spreads[0];
    assert_eq!((spread.cases, spread.count, spread.mean), (300, 300, Some(150.5)));
    assert_eq!(spread.percentiles[3].value, 150.5);
    assert_eq!(drawn.histogram.as_ref().expect("numbers").counts.iter().sum::<u64>(), 300);
    assert_eq!(found.points.cases, (1..=100).map(|i| 3 * i).collect::<Vec<_>>());
    // Those that ran say what drives them: the bound is 1.96 / sqrt(99).
    let [driver] = found.columns[1].drivers[..] else { panic!("one variable") };
    assert_eq!(driver.coefficient, 1.0);
    assert!((driver.bound - 0.197).abs() < 1e-3, "{driver:?}");
}

#[test]
fn a_latch_that_never_closes_is_one_of_a_case_that_ran() {
    let mut statistics = table(&[]);
    let statuses = ["ok", "failed: step too small at t = 2"].into_iter().cycle();
    for (case, status) in (1..=8).zip(statuses) {
        let number = Cell::Number(f64::from(case));
        let time = if case == 1 { number } else { Cell::Empty };
        let case = Cell::Integer(case.into());
        statistics.row(&[case, case, Cell::Empty, number, time, Cell::Text(status)]);
    }
    let found = statistics.finish();
    let time = &found.columns[1];
    let late: Vec<_> = time.largest.iter().map(|late| (late.case, late.value)).collect();
    let never = f64::INFINITY;
    assert_eq!(late, [(3, never), (5, never), (7, never), (1, 1.0)]);
    assert_eq!((time.spreads[0].cases, time.spreads[0].count), (4, 1));
    let first = found.latches[0].times[0].latched;
    assert_eq!((first.count, first.of), (1, 4));
}

#[test]
fn cases_that_are_not_to_be_trusted_are_counted_among_those_that_ran() {
    let mut statistics = table(&[]);
    for case in 1..=10 {
        let status = match case {
            4 | 8 => "ok, poor conservation",
            3 | 5 | 7 => "ok, latch in doubt",
            6 | 9 => "ok, runs away",
            _ => "ok",
        };
        let number = Cell::Number(f64::from(case));
        let case = Cell::Integer(case.into());
        statistics.row(&[case, case, Cell::Empty, number, number, Cell::Text(status)]);
    }
    let found = statistics.finish();
    assert_eq!((found.counts.ok, found.counts.failed), (10, 0));
    assert_eq!((found.counts.runaway, found.counts.first_runaway), (2, Some(6)));
    assert_eq!((found.counts.poor, found.counts.first_poor), (2, Some(4)));
    assert_eq!((found.counts.doubtful, found.counts.first_doubtful), (3, Some(3)));
    assert_eq!(found.columns[1].spreads[0].count, 10);
    assert!(found.troubles.is_empty());
}

#[test]
fn statistics_are_read_back_as_they_were_written() {
    let found = two_by_two(50);
    let text = serde_json::to_string(&found).expect("numbers and texts");
    assert_eq!(serde_json::from_str::<Summary>(&text).expect("the same"), found);
}
