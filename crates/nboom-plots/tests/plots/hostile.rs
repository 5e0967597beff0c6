use std::fs;

use nboom_plots::Format;
use roxmltree::Document;

use crate::directory::{directory, files, write};
use crate::reader::elements;

#[test]
fn texts_of_scenes_are_text() {
    let place = directory("x", "t,beta_1_1,beta_1_2\n0,0,0\n4,1,2\n");
    let name = "<script>alert(1)</script> \\\"'& \\u202e \\u0007 \\ufffe ]]>";
    let summary = format!("{{\"scene\": \"{name}\", \"complete\": true}}");
    write(&place, "summary.json", &summary);
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../nboom-report/page/test/hostile.toml");
    fs::copy(scene, place.path().join("scene.toml")).expect("a scene");
    let events = "t,kind,appendage,segment,impulse,energy_before,energy_after\n1,<i>&,1,1,,1,1\n";
    write(&place, "events.csv", events);
    let files = files(&place, Format::Svg);
    assert!(!files.is_empty());
    for file in files {
        let text = String::from_utf8(file.bytes).expect("text");
        let document =
            Document::parse(&text).unwrap_or_else(|error| panic!("{}: {error}", file.name));
        let known = ["svg", "title", "rect", "polyline", "circle", "text", "tspan"];
        let tags = document.descendants().filter(roxmltree::Node::is_element);
        tags.for_each(|node| assert!(known.contains(&node.tag_name().name()), "{node:?}"));
        assert!(!text.contains(['\u{202e}', '\u{2066}', '\u{7}', '\u{fffe}']), "{text}");
        let words: String = elements(&document, "text").filter_map(|node| node.text()).collect();
        for part in [
            "<script>alert(1)</script> \"'&",
            "<img src=x oner",
            "<i>& <img",
            "Angle [°]",
            "Time [<i>s]",
        ] {
            assert!(words.contains(part) || !file.name.starts_with("01"), "{part}: {words}");
        }
    }
}

#[test]
fn little_is_drawn_and_nothing_makes_no_figure() {
    let header = "t,chi,kappa_x,kappa_y,kappa_z,omega_x,omega_y,omega_z,beta_1_1,tau_1_1,nutation";
    for (rows, count) in [
        ("", 0),
        ("\n2,1,0,0,0,0,0,0,0.5,0,0", 4),
        ("\n2,1,0,0,0,0,0,0,0.5,0,0\n2,1,0,0,0,0,0,0,0.5,0,0", 4),
        ("\n0,1,0,0,0,1e-300,1e300,-1.7e308,1e-320,0,0\n1,1,0,0,0,0,0,1.7e308,1.7e308,5e-324,0", 4),
        ("\n-1e300,1,0,0,0,0,0,0,0.5,0,0\n1e300,1,0,0,0,0,0,0,0.5,0,0", 4),
    ] {
        let place = directory("little", &format!("{header}{rows}\n"));
        // Killed in the middle of a row, and before its summary was done.
        write(&place, "ledger.csv", "t,kinetic_energy\n0,1\n1,");
        write(&place, "summary.json", "{\"scene\": \"little\", \"complete\": false}");
        let files = files(&place, Format::Svg);
        let figures: Vec<_> = files.iter().filter(|file| !file.name.contains("energy")).collect();
        assert_eq!(figures.len(), count, "{rows}");
        for file in files {
            let text = String::from_utf8(file.bytes).expect("text");
            let document = Document::parse(&text).expect("well-formed");
            for node in document.descendants() {
                for name in ["x", "y", "cx", "cy", "points"] {
                    let all = node.attribute(name).unwrap_or("0").split([' ', ',']);
                    let numbers = all.map(|number| number.parse::<f64>());
                    let are_places = |number| matches!(number, Ok(x) if f64::abs(x) < 10_000.0);
                    assert!(numbers.into_iter().all(are_places), "{}: {node:?}", file.name);
                }
            }
            assert!(text.contains("The run did not come to its end."), "{text}");
        }
    }
}

#[test]
fn letters_that_the_font_lacks_are_known() {
    let place = directory("漢 a β 漢", "t,beta_1_1\n0,0\n4,1\n");
    let run = nboom_report::Run::read(place.path()).expect("a run");
    assert_eq!(nboom_plots::Plots::of(&run).letters_without_shape(), ['漢'].into());
    let place = directory("a β", "t,beta_1_1\n0,0\n4,1\n");
    let run = nboom_report::Run::read(place.path()).expect("a run");
    assert!(nboom_plots::Plots::of(&run).letters_without_shape().is_empty());
}
