//! No text makes the reader of robots panic, hang or take memory without end.

use std::fmt::Write;
use std::time::{Duration, Instant};

use nboom_io::{InputError, parse_robot};
use nboom_model::Base;
use proptest::prelude::*;

use super::support::{edited, edits};

const UR5: &str = include_str!("../../../../tests/data/robots/ur5.urdf");

/// Far more than reading takes, also on a machine that does much else.
const PATIENCE: Duration = Duration::from_secs(10);

/// Pieces of text that mean something somewhere.
const WORDS: [&str; 16] = [
    "<link name=\"a\"/>",
    "<joint name=\"a\" type=\"fixed\"><parent link=\"a\"/><child link=\"a\"/></joint>",
    "<mass value=\"0\"/>",
    "<inertial>",
    "</joint>",
    "<",
    ">",
    "/>",
    "\"",
    "&amp;",
    "&#0;",
    "<![CDATA[",
    "<!--",
    "1e999",
    "nan",
    "floating",
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1500) })]

    #[test]
    fn edited_robots_are_read_or_refused(edits in edits(WORDS.len())) {
        let text = edited(UR5, &edits, &WORDS);
        if let Err(error) = parse_robot("ur5.urdf", &text, "ur5", Base::Free) {
            prop_assert!(matches!(error, InputError::Content(_)));
            prop_assert!(!error.to_string().is_empty());
        }
    }
}

#[test]
fn depth_and_entities_have_bounds() {
    let deep = "<a>".repeat(1_000_000);
    let mut entities = "<!DOCTYPE r [<!ENTITY a0 \"aaaaaaaaaaaaaaaa\">".to_owned();
    for i in 1..12 {
        let inner = format!("&a{};", i - 1).repeat(16);
        write!(entities, "<!ENTITY a{i} \"{inner}\">").expect("a string takes all");
    }
    entities.push_str("]><robot name=\"&a11;\"/>");
    for text in [deep, entities] {
        assert!(matches!(
            parse_robot("a.urdf", &text, "a", Base::Free),
            Err(InputError::Content(_))
        ));
    }
}

/// The parser compares each attribute, and each namespace, with all others of the element.
#[test]
fn elements_have_a_bounded_number_of_attributes() {
    let robot = |tag: &str, name: &str, count: usize| {
        let attributes: String = (0..count).map(|i| format!(" {name}{i}=\"&gt; '\"")).collect();
        format!("<!-- <a b=\"> -->\n<robot name=\"a\">\n<{tag}{attributes}/></robot>")
    };
    for name in ["a", "xmlns:a"] {
        let told = parse_robot("a.urdf", &robot("link", name, 200_000), "a", Base::Free)
            .expect_err("too many");
        let message =
            "a.urdf:3:1: robot: found an element with more than 1000 attributes, expected at";
        assert!(told.to_string().starts_with(message), "{told}");
        let told = parse_robot("a.urdf", &robot("gazebo", name, 1000), "a", Base::Free)
            .expect_err("no link");
        assert!(told.to_string().contains("no link"), "{told}");
    }
}

/// A chain of this many links.
fn chain(links: usize) -> String {
    let body = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
                iyz=\"0\" izz=\"1\"/></inertial>";
    let mut text = format!("<robot name=\"chain\"><link name=\"l0\">{body}</link>");
    for i in 1..links {
        let inboard = i - 1;
        write!(
            text,
            "<link name=\"l{i}\">{body}</link><joint name=\"j{i}\" type=\"continuous\">\
             <parent link=\"l{inboard}\"/><child link=\"l{i}\"/></joint>"
        )
        .expect("a string takes all");
    }
    text.push_str("</robot>");
    text
}

#[test]
fn long_chains_are_read_up_to_the_most_bodies_of_a_scene() {
    let read = |links| parse_robot("chain.urdf", &chain(links), "chain", Base::Free);
    assert_eq!(read(5001).expect("a robot").scene.bodies.len(), 5000);
    let told = read(20_000).expect_err("too many").to_string();
    let message = "chain.urdf:1:1: robot: found 19999 joints that move, expected at most 10000";
    assert_eq!(told, message);
}

/// Each place of a line is as near as its start, and what is wrong beyond the errors that are told is not looked for.
#[test]
fn wrong_trees_of_one_line_are_told_at_once() {
    let links = |count: usize| -> String {
        (0..count).fold(String::new(), |links, i| links + &format!("<link name=\"l{i}\"/>"))
    };
    let joint = "<joint name=\"j\" type=\"fixed\"><parent link=\"x\"/><child link=\"y\"/></joint>";
    let many = links(100_000);
    for parts in [many.repeat(2), links(10_000) + &joint.repeat(20_000), many] {
        let text = format!("<robot name=\"a\">{parts}</robot>");
        let start = Instant::now();
        let read = parse_robot("a.urdf", &text, "a", Base::Free);
        assert!(matches!(read, Err(InputError::Content(errors)) if errors.len() == 1000));
        assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    }
}
