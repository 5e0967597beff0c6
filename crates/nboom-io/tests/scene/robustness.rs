//! No text makes the reader panic, hang or take memory without end.

use nboom_io::{InputError, ReadOptions, parse_scene};
use proptest::prelude::*;

use super::support::{edited, edits};
use super::{BUS, body, read};

const WING: &str = include_str!("../../../../examples/wing.toml");
const N_BOOM: &str = include_str!("../../../../examples/n-boom.toml");

/// Pieces of text that mean something somewhere.
const WORDS: [&str; 24] = [
    "[[body]]\n",
    "[body.hinge]\n",
    "[[body.station]]\n",
    "name = \"a\"\n",
    "on = \"a\"\n",
    "[",
    "]",
    "{",
    "}",
    "=",
    "\"",
    "'''",
    "\n",
    ",",
    "$",
    "1e999",
    "-",
    "nan",
    "inf",
    "0x10",
    "1979-05-27",
    "true",
    "repeat = { count = 3, about = \"x\" }\n",
    "include = [\"a.toml\"]\n",
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1500) })]

    #[test]
    fn edited_scenes_are_read_or_refused(
        is_wing in any::<bool>(),
        edits in edits(WORDS.len()),
    ) {
        let text = edited(if is_wing { WING } else { N_BOOM }, &edits, &WORDS);
        if let Err(error) = read(&text) {
            prop_assert!(matches!(error, InputError::Content(_)));
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn any_text_is_read_or_refused(text in "\\PC{0,200}") {
        let _ = read(&text);
    }
}

#[test]
fn depth_and_length_have_bounds() {
    let nested = "[".repeat(100_000);
    let deep = format!("a = {nested}");
    let expression = format!("[parameters]\na = \"{}1\"\n{BUS}", "(".repeat(100_000));
    let chain: String =
        (1..5000).map(|i| format!("p{i} = \"$p{} + 1\"\n", i + 1)).collect::<String>();
    let chain = format!("[parameters]\n{chain}p5000 = 1\n{BUS}");
    let bodies: String = (0..20_000).map(|i| format!("[[body]]\nname = \"{i}\"\n")).collect();
    let errors = format!("{BUS}\n{bodies}");
    let repeated = BUS.to_owned()
        + &body("a", "repeat = { count = 9999, about = \"x\" }", "")
        + &body("b", "on = \"a\"", "");
    for text in [deep, expression, chain, errors, repeated] {
        let options = ReadOptions::default();
        let error = parse_scene("a.toml", &text, "a", None, &options).expect_err("too much");
        assert!(error.to_string().lines().count() < 500, "{}", error.to_string().len());
    }
}

#[test]
fn a_long_chain_of_bodies_is_a_scene() {
    let links: String = (1..5000)
        .map(|i| body(&format!("link {i}"), &format!("on = \"link {}\"", i - 1), ""))
        .collect();
    let file = read(&(BUS.to_owned() + &body("link 0", "", "") + &links)).expect("a chain");
    assert_eq!(file.scene.bodies.len(), 5000);
}
