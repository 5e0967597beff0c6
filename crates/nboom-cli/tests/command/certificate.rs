//! What `--certify` says and writes.

use std::fs;

use crate::Place;

#[test]
fn a_certificate_in_double_double_says_so() {
    let place = Place::new();
    let output = place.nboom(&[
        "run",
        "--certify=double-double",
        "boom.nml",
        "-o",
        "out",
        "--rtol",
        "1e-12",
    ]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let account = String::from_utf8(output.stdout).expect("text");
    assert!(
        account.contains("certified     digits against double-double: event times "),
        "{account}"
    );
    let text = fs::read_to_string(place.path("out").join("certificate.json")).expect("it is there");
    let certificate: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(certificate["reference"], "double-double");
    assert_eq!(certificate["same_events"], true);
    assert_eq!(certificate["end"].as_array().expect("a list").len(), 6);

    let refused = place.nboom(&["run", "--certify=kane", "boom.nml"]);
    assert_eq!(refused.status.code(), Some(2), "{refused:?}");
    let complaint = String::from_utf8(refused.stderr).expect("text");
    assert!(complaint.contains("tighter-tolerance, double-double"), "{complaint}");
}

#[test]
fn a_certificate_tells_the_digits_and_goes_with_the_next_run() {
    let place = Place::new();
    let output = place.nboom(&["run", "boom.nml", "-o", "out", "--rtol", "1e-7", "--certify"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let account = String::from_utf8(output.stdout).expect("text");
    assert!(account.contains("certified     digits against rtol 1e-10: event times "), "{account}");

    let path = place.path("out").join("certificate.json");
    let text = fs::read_to_string(&path).expect("the certificate is there");
    let certificate: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(certificate["reference"], "tighter-tolerance");
    assert_eq!(certificate["same_events"], true);
    let kinds: Vec<_> =
        certificate["events"].as_array().expect("a list").iter().map(|e| &e["kind"]).collect();
    assert_eq!(kinds, ["release", "lock_up"]);
    let lock_up = &certificate["events"][1];
    for digits in [&lock_up["time"], &lock_up["impulse"], &certificate["end"][1]] {
        // About as many as the tolerance has, and not all that a number can have.
        let known = digits["digits"].as_u64().expect("a number");
        assert!((5..16).contains(&known), "{digits}");
    }

    assert_eq!(place.nboom(&["run", "boom.nml", "-o", "out"]).status.code(), Some(0));
    assert!(!path.exists(), "it was of another run");
}
