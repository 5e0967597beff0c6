//! Decks read whole: right ones against what they should mean, wrong ones against what should
//! be said about them.

mod files;
mod ignored;
mod messages;
mod motion;
mod report;
mod robustness;
mod rules;
mod scenes;
mod stress;

use nboom_io::{Diagnostic, InputError, SceneFile, parse_deck};

/// The deck of Section 17.
const REPORT_DECK: &str = include_str!("../../../../examples/n-boom-1970.nml");

/// A chain of two and a paddle with nothing special about them; lines are counted from the
/// first character, `&DIM`'s card being line 1.
const SMALL_DECK: &str = " &DIM
 NA=2,NP=1,IXK=4,
 &END
 &NXPUT
 BETAIK=10.0,20.0,30.0,40.0,
 BSIK=4*1E6,
 NK=2,2,
 DBK=1.0,2.0,3.0,4.0,5.0,6.0,
 FTSIK=6*0.0,
 ELIK=1.0,2.0,3.0,4.0,
 EMIK=4*2.0,
 HIIK=3.0,3*0.0,4.0,3*0.0,5.0,3.0,3*0.0,4.0,3*0.0,5.0,
 3.0,3*0.0,4.0,3*0.0,5.0,3.0,3*0.0,4.0,3*0.0,5.0,
 EMM=100.0,
 HM=30.0,3*0.0,40.0,3*0.0,50.0,
 &END
 &ROCK
 TF=1.0,
 &END
";

fn read(deck: &str) -> SceneFile {
    parse_deck("a.nml", deck, "a").unwrap_or_else(|error| panic!("{error}"))
}

/// The errors of a deck; panics when there are none.
fn errors(deck: &str) -> Vec<Diagnostic> {
    match parse_deck("a.nml", deck, "a") {
        Err(InputError::Content(errors)) => errors,
        other => panic!("{other:?} found, errors expected"),
    }
}

/// The small deck with `cards` at the end of &NXPUT, from line 16 on.
fn with_cards(cards: &str) -> String {
    replaced(" &END\n &ROCK", &format!("{cards}\n &END\n &ROCK"))
}

/// The small deck with one piece of it replaced.
fn replaced(old: &str, new: &str) -> String {
    assert_eq!(SMALL_DECK.matches(old).count(), 1, "{old}");
    SMALL_DECK.replace(old, new)
}

fn lines(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(Diagnostic::to_string).collect()
}

/// The warnings of the small deck with these cards.
fn warnings(cards: &str) -> Vec<String> {
    lines(&read(&with_cards(cards)).warnings)
}
