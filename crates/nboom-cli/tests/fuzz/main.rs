//! Decks, scenes, robots, sections and command lines changed at random, each given to the whole program with
//! little memory: however wrong the input, it ends as the contract says.
//!
//! `cargo test -p nboom-cli --test fuzz` tries some hundred inputs. A long run by hand:
//!
//! ```sh
//! TMPDIR=/dev/shm NBOOM_FUZZ=100000 NBOOM_FUZZ_SEED=7 \
//!     cargo test --release -p nboom-cli --test fuzz -- --nocapture
//! ```
//!
//! An input follows from the seed and its own number, so that `NBOOM_FUZZ_ONLY=4711` beside the
//! same seed repeats one. What has failed is kept in cargo's folder for such files.
#![cfg(unix)]

mod deck;
mod input;
mod place;
mod record;
mod scene;
mod section;
mod text;
mod verdict;
mod words;

use std::ops::Range;

use input::Corpus;
use place::Place;
use record::Record;

/// Inputs of the gate.
const INPUTS: u64 = 400;

/// The year of the report.
const SEED: u64 = 1970;

/// Failures after which the rest is not tried.
const MOST_FAILURES: usize = 50;

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name}={text}: a whole number expected")))
}

#[test]
fn whatever_the_input_the_program_ends_as_the_contract_says() {
    let (by_hand, only) = (number("NBOOM_FUZZ"), number("NBOOM_FUZZ_ONLY"));
    let seed = number("NBOOM_FUZZ_SEED").unwrap_or(SEED);
    let numbers: Range<u64> =
        only.map_or(0..by_hand.unwrap_or(INPUTS), |number| number..number + 1);
    let corpus = Corpus::read();
    let mut record = Record::new(seed);
    for number in numbers {
        let input = corpus.input(seed, number);
        let place = Place::with(&input);
        let ended = place.run(&input.words, number);
        let mut complaints = verdict::of(&input, &place, &ended);
        // A busy machine makes every time longer: times are judged by whoever asks for them.
        if by_hand.is_some() {
            complaints.extend(verdict::on_time(&ended));
        }
        record.add(number, &input, &ended, &complaints);
        if by_hand.is_some() && (number + 1) % 1000 == 0 {
            eprintln!("{}", record.line());
        }
        if record.failures() >= MOST_FAILURES {
            break;
        }
    }
    println!("{}", record.table());
    assert_eq!(record.failures(), 0, "{}", record.table());
}
