//! What `--certify` says and writes.

use std::fs;

use serde_json::Value;

use crate::{Place, code, rows, stderr, stdout};

/// The sample deck: seven stations on four segments.
const SAMPLE: &str = include_str!("../../../../examples/n-boom-1970.nml");

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
fn a_run_whose_reference_fails_has_its_account() {
    let place = Place::new();
    let options = ["--rtol", "1e-2", "--integrator", "dop853", "--max-steps", "8", "-o", "out"];
    let args = [&["run", "boom.nml", "--certify=double-double"], &options[..]].concat();
    let output = place.nboom(&args);
    assert_eq!(code(&output), 3, "{output:?}");
    assert!(stderr(&output).contains("the reference run: at time "), "{output:?}");
    let account = stdout(&output);
    assert!(account.contains("all locked    1,1 at 0.78"), "{account}");
    assert!(
        account.ends_with("files         out\n") && !account.contains("certified"),
        "{account}"
    );
    let quiet = place.nboom(&[&args[..], &["--quiet"]].concat());
    assert_eq!((code(&quiet), stdout(&quiet)), (3, String::new()));
}

#[test]
fn a_reference_that_is_hardly_tighter_is_said_to_be_even_quietly() {
    let place = Place::new();
    let warnings = |rtol| {
        let args = ["run", "boom.nml", "-o", "out", "--rtol", rtol, "--certify", "--quiet"];
        let output = place.nboom(&args);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stderr).expect("text")
    };
    assert!(warnings("1e-13").contains("the reference is 10 times tighter, not a thousand times"));
    assert!(!warnings("1e-11").contains("certificate"));
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

/// Appendage, segment, station of one; what it is; and how large, from an envelope's file.
fn peaks(place: &Place, directory: &str) -> Vec<([Value; 3], String, f64)> {
    let table = |file: &str| -> Vec<Vec<String>> {
        let lines = rows(&place.path(directory).join(file));
        lines[1..].iter().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let count = |cell: &str| Value::from(cell.parse::<usize>().expect("a count"));
    let stations = table("stress_envelope.csv").into_iter().map(|row| {
        let at = [count(&row[0]), count(&row[1]), count(&row[2])];
        (at, "von_mises".to_owned(), number(&row[12]))
    });
    let hinges = table("hinge_load_envelope.csv").into_iter().map(|row| {
        ([count(&row[0]), count(&row[1]), Value::Null], row[2].clone(), number(&row[7]))
    });
    stations.chain(hinges).collect()
}

/// The reference has tolerances a thousand times tighter: it is run by hand too.
#[test]
fn peaks_of_stresses_and_hinge_loads_have_their_digits() {
    let place = Place::new();
    place.write("sample.nml", SAMPLE);
    let run = |directory: &str, rtol: &str, atol: &str, more: &[&str]| {
        let words = ["run", "sample.nml", "-o", directory, "--rtol", rtol, "--atol", atol];
        let output = place.nboom(&[&words[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        stdout(&output)
    };
    let account = run("loose", "1e-5", "1e-7", &["--certify"]);
    run("tight", "1e-8", "1e-10", &[]);
    let text = fs::read_to_string(place.path("loose").join("certificate.json"));
    let certificate: Value = serde_json::from_str(&text.expect("it is there")).expect("JSON");
    let said = certificate["peaks"].as_array().expect("a list");
    let (loose, tight) = (peaks(&place, "loose"), peaks(&place, "tight"));
    assert_eq!((said.len(), loose.len(), tight.len()), (15, 15, 15));
    let mut fewest = [16, 16];
    for ((said, (at, quantity, ours)), (_, _, truth)) in said.iter().zip(loose).zip(tight) {
        assert_eq!(at, [&said["appendage"], &said["segment"], &said["station"]].map(Clone::clone));
        assert_eq!(said["quantity"], quantity.as_str());
        let difference = said["difference"].as_f64().expect("a number");
        let off = (ours - truth).abs() / truth.abs();
        // The end of each chain carries nothing, and its stress is rounding.
        if truth > 1e-3 {
            // Tolerances a thousandth of each other differ in their last digit, and so do runs.
            assert!((difference - off).abs() <= 1e-9 + 1e-3 * off, "{said}: {off:e}");
        }
        let digits = said["digits"].as_u64().expect("a count");
        let kind = usize::from(said["station"].is_null());
        fewest[kind] = digits.min(fewest[kind]);
    }
    // What was asked for is off by more than rounding, and by less than it could be.
    assert!(fewest.iter().all(|digits| (2..12).contains(digits)), "{fewest:?}");
    let [stresses, loads] = fewest;
    let words = format!("peak stresses {stresses}, peak hinge loads {loads}\n");
    assert!(account.contains(&words), "{account}: {words}");
}

#[test]
fn loads_that_are_none_have_their_digits() {
    let place = Place::new();
    let at_rest =
        crate::BOOM.replace("OMEG=1.0,2.0,-1.0", "OMEG=3*0.0").replace("RELTB=0.25", "RELTB=1.0E7");
    place.write("rest.nml", &at_rest);
    let output = place.nboom(&["run", "rest.nml", "-o", "out", "--hinge-loads", "--certify"]);
    let account = stdout(&output);
    assert!(account.contains("peak hinge loads 16\n"), "{account}");
    let line = account.lines().find(|line| line.starts_with("certified ")).expect("told");
    for quantity in ["attitude", "omega", "beta", "tau", "rho", "v"] {
        assert!(line.contains(&format!(" {quantity} 16")), "{line}");
    }
}

/// A run of no length has neither steps nor instants with events.
#[test]
fn peaks_of_a_moment_have_their_digits() {
    let place = Place::new();
    let moment = ["--end-time", "0", "--hinge-loads", "--certify"];
    let output = place.nboom(&[&["run", "boom.nml", "-o", "out"], &moment[..]].concat());
    let account = stdout(&output);
    assert!(account.contains("peak hinge loads 16\n"), "{account}");
}
