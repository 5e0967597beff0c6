//! Whatever the text, reading ends soon and without a panic.

use std::time::{Duration, Instant};

use nboom_io::parse_deck;
use proptest::prelude::*;

use super::{REPORT_DECK, with_cards};

/// Far more than any deck needs, even unoptimised on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

fn ends_soon(text: &str) {
    let start = Instant::now();
    let _ = parse_deck("a.nml", text, "a").map_err(|error| error.to_string());
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
}

proptest! {
    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        ends_soon(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_sequence_of_pieces(pieces in prop::collection::vec(0..PIECES.len(), 0..200)) {
        let text: String = pieces.iter().map(|&i| PIECES[i]).collect();
        ends_soon(&text);
    }

    #[test]
    fn the_report_deck_with_characters_changed(
        changes in prop::collection::vec((0..REPORT_DECK.len(), 0..PIECES.len()), 1..8),
    ) {
        let mut text = REPORT_DECK.to_owned();
        for (at, piece) in changes {
            let boundary = |&i: &usize| text.is_char_boundary(i);
            let from = (0..=at.min(text.len() - 1)).rev().find(boundary).unwrap_or(0);
            let to = (from + 1..=text.len()).find(boundary).unwrap_or(text.len());
            text.replace_range(from..to, PIECES[piece]);
        }
        ends_soon(&text);
    }

    #[test]
    fn the_report_deck_cut_and_doubled(a in 0..REPORT_DECK.len(), b in 0..REPORT_DECK.len()) {
        ends_soon(&format!("{}{}", &REPORT_DECK[..a], &REPORT_DECK[b..]));
    }
}

#[test]
fn a_count_beyond_all_numbers_is_refused() {
    let deck = REPORT_DECK.replace("NK=2,2,", "NK=1E308,2,");
    assert_ne!(deck, REPORT_DECK);
    let error = parse_deck("a.nml", &deck, "a").expect_err("no deck has so many segments");
    assert!(error.to_string().contains("NK(1): found"), "{error}");
}

const PIECES: &[&str] = &[
    " ",
    "\n",
    "\n ",
    ",",
    "=",
    "(",
    ")",
    "*",
    "&",
    "+",
    "-",
    ".",
    "!",
    "0",
    "1",
    "9",
    "1E9",
    "1E308",
    "-1E308",
    "1E-320",
    "99999999999999999999*",
    "O",
    "Ø",
    "É",
    "&DIM",
    "&NXPUT",
    "&ROCK",
    "&DYNSTA",
    "&DYNSTB",
    "&END",
    "\n &END\n",
    "NA=",
    "IXK=",
    "NK=",
    "EMM=",
    "HM=",
    "HIIK",
    "QNIK(1,1)=",
    "DLI11=",
    "T1=",
    "X=",
    "NAN",
    "FTSM=",
    "RHO=",
    "OMEG=",
];

#[test]
fn long_texts_of_one_kind() {
    const LENGTH: usize = 4 << 20;
    for piece in [
        "1,", "A", "9", "A=", "A(", "?", "\n", "&", "+", "1,\n", "EMM=1,", "&DIM\n", "!", "((((",
        "A \n",
    ] {
        let text = piece.repeat(LENGTH / piece.len());
        ends_soon(&text);
        ends_soon(&with_cards(&text));
        ends_soon(&with_cards(&format!(" THETIK={text}")));
    }
}

#[test]
fn many_large_assignments() {
    let deck = with_cards(&" RIK1=12*0.0,AES=16*0.0,\n".repeat(200_000));
    ends_soon(&deck);
    let error = parse_deck("a.nml", &deck, "a").unwrap_err().to_string();
    assert!(error.contains("more than 4000000 values in the deck"), "{error}");
}
