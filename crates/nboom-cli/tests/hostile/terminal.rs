//! Names with orders to a terminal in them are shown and not obeyed.

use super::interrupts::SWINGING;
use super::place::Place;

#[test]
fn names_give_no_orders_to_a_terminal() {
    let place = Place::new("terminal");
    let evil = "a\u{1b}[2Jb\u{9b}31mc\u{202e}d\r";
    let deck = format!("{evil}.nml");
    let sections = |id: &str, radius: f64| {
        let case = serde_json::json!({ "id": id, "kind": "circular", "R": radius, "t": 0.1 });
        serde_json::json!({ "cases": [case] }).to_string()
    };
    place.write(&deck, SWINGING);
    let wrong = format!("{evil}wrong.nml");
    place.write(&wrong, SWINGING.replace("EMIK=3.0", "EMIK=-3.0"));
    place.write("good.json", sections(evil, 1.0));
    place.write("bad.json", sections(evil, -1.0));
    let into = format!("{evil}out");
    let commands: [&[&str]; 13] = [
        &["run", &deck],
        &["run", &deck, "-o", &into],
        &["run", &deck, "-o", &format!("{evil}.partial")],
        &["run", &deck, evil],
        &["run", evil],
        &["run", &wrong],
        &["check", &deck],
        &["check", &wrong],
        &["verify", &deck, "--states", "2"],
        &["bench", &deck, "--seconds", "0.001"],
        &["section", "good.json"],
        &["section", "bad.json"],
        &[evil],
    ];
    for args in commands {
        let finished = place.nboom(args);
        for text in [finished.stdout(), finished.stderr()] {
            let is_order = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
            assert!(!text.contains(is_order), "{args:?}: {text:?}");
        }
        assert!([Some(0), Some(2)].contains(&finished.code()), "{args:?}: {}", finished.stderr());
    }
    // What is escaped is there all the same.
    let message = place.nboom(&["run", evil]).stderr();
    assert!(message.contains("a\\u001b[2Jb\\u009b31mc\\u202ed\\u000d"), "{message}");
    // And a listing goes to a terminal some day.
    let finished = place.nboom(&["run", &deck, "-o", "listing", "--listing"]);
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    let listing = place.read("listing/listing.txt");
    assert!(!listing.contains(|c: char| c.is_control() && c != '\n'), "{listing:?}");
}
