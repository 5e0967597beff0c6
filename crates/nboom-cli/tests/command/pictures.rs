//! `nboom check --picture`.

use std::collections::HashSet;
use std::fs;

use crate::{Place, code, stderr};

fn picture(place: &Place, scene: &str) -> String {
    let check = place.nboom(&["check", scene, "--picture", "picture.svg", "--force"]);
    assert_eq!(code(&check), 0, "{}", stderr(&check));
    fs::read_to_string(place.path("picture.svg")).expect("a picture")
}

/// The values of an attribute of the elements that are written so.
fn values<'t>(text: &'t str, element: &str, attribute: &str) -> Vec<&'t str> {
    let elements = text.lines().filter(|line| line.contains(element));
    let value = |line: &'t str| line.split(attribute).nth(1)?.split('"').nth(1);
    elements.filter_map(value).collect()
}

#[test]
fn a_wing_is_drawn_stowed_and_deployed_with_panels_and_labels_off_each_other() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let picture = picture(&place, "wing.toml");
    for words in ["wing: stowed", "wing: deployed", "outer panel 2", "axes of each body", ">1 m<"] {
        assert!(picture.contains(words), "{words}: {picture}");
    }
    let halves: Vec<&str> = picture.split("<g ").skip(1).collect();
    assert_eq!(halves.len(), 2);
    for half in &halves {
        assert!(half.matches("<polygon ").count() > 20, "box and panels: {half}");
        // Each label twice, with its white ground: six bodies and three axes.
        let labels = half.lines().filter(|line| line.contains("fill=\"#111111\""));
        let labels: HashSet<&str> = labels.filter_map(|line| line.split("style").next()).collect();
        assert_eq!(labels.len(), 12, "{labels:?}");
        let places: HashSet<(&str, &str)> = values(half, "fill=\"#111111\"", " x=")
            .into_iter()
            .zip(values(half, "fill=\"#111111\"", " y="))
            .collect();
        assert_eq!(places.len(), 6, "no two labels at one place");
    }
    // Deployed, the wings reach farther to either side.
    let span = |half: &str| {
        let points =
            values(half, "<polygon ", "points=").into_iter().flat_map(|all| all.split(' '));
        let x = points.filter_map(|point| point.split(',').next()?.parse::<f64>().ok());
        let (least, most) =
            x.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        most - least
    };
    assert!(span(halves[1]) > 2.0 * span(halves[0]));
}

#[test]
fn the_mass_centre_is_marked() {
    let place = Place::new();
    // A body as heavy as the main body, with its mass where its hinge is: half way from O to there.
    place.write(
        "two.toml",
        "[run]\nend = 1\n\n[main_body]\nmass = 2\ninertia = [1, 1, 1]\n\n[[body]]\nname = \"a\"\nmass = 2\n\
         mass_centre = [0, 0, 0]\ninertia = [1, 1, 1]\ntip = [0, 1, 0]\n\n[body.hinge]\nat = [0.4, 2, 0.6]\naxis = \"x\"\n",
    );
    let picture = picture(&place, "two.toml");
    let halves: Vec<&str> = picture.split("<g transform").skip(1).collect();
    assert_eq!(halves.len(), 2);
    for half in halves {
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let mark = half.split("mass-centre\" transform=\"translate(").nth(1).expect("a mark");
        let mark: Vec<f64> = mark.split(')').next().expect("two").split(' ').map(number).collect();
        let one = |element, attribute| number(values(half, element, attribute)[0]);
        // The axes of the main body begin at O; the hinge is a white disc.
        let axis = "stroke=\"#c0392b\" stroke-width=\"1.5\"";
        let origin = [one(axis, " x1="), one(axis, " y1=")];
        let disc = "r=\"3\" fill=\"white\"";
        let hinge = [one(disc, " cx="), one(disc, " cy=")];
        for i in 0..2 {
            assert!(
                (mark[i] - 0.5 * (origin[i] + hinge[i])).abs() < 0.11,
                "{mark:?} {origin:?} {hinge:?}"
            );
        }
    }
}

/// A thrust along z, a torque along an inertial axis, and two panels that are coupled; the first has a kick-off spring that
/// lets go as it opens.
const ACTED_ON: &str = "[run]\nend = 1\n\n[thrust]\nforce = [0, 0, 5]\npoint = [0, 0, -1]\nfrom = 0\nuntil = 1\n\n\
    [main_body]\nmass = 2\ninertia = [1, 1, 1]\n\
    [[main_body.torque]]\ntorque = [0, 0, 1]\naxes = \"inertial\"\n\n\
    [[body]]\nname = \"a\"\nmass = 2\nmass_centre = [0, 0.5, 0]\ninertia = [1, 1, 1]\ntip = [0, 1, 0]\n\
    kick_off = { main_body_end = [0, 0.2, 0], end = [0, 0.5, 0], force = [3, 0, 0, 0], limit = 0.7 }\n\
    [body.hinge]\nat = [0, 0.5, 0]\naxis = \"x\"\nstart_deg = 90\nlatch_deg = 0\nspring = { stiffness = 1, rest_deg = -9 }\n\n\
    [[body]]\nname = \"b\"\non = \"a\"\nmass = 2\nmass_centre = [0, 0.5, 0]\ninertia = [1, 1, 1]\ntip = [0, 1, 0]\n\
    coupling = [{ to = \"a\", stiffness = 4 }]\n\
    [body.hinge]\nat = [0, 1, 0]\naxis = \"x\"\n";

#[test]
fn what_acts_is_drawn_where_it_does_and_the_legend_says_what_it_is() {
    let place = Place::new();
    place.write("acted.toml", ACTED_ON);
    let drawn = picture(&place, "acted.toml");
    let (drawings, legend) = drawn.rsplit_once("</g>").expect("two drawings");
    let halves: Vec<&str> = drawings.split("<g transform").skip(1).collect();
    for (kind, counts) in
        [("kick-off", [1, 0]), ("force", [1, 1]), ("torque", [1, 0]), ("coupling", [1, 1])]
    {
        let class = format!("class=\"{kind}\"");
        let found = [0, 1].map(|i| halves[i].matches(&class).count());
        assert_eq!(found, counts, "{kind}: {drawn}");
        assert_eq!(legend.matches(&class).count(), 1, "{kind}: {legend}");
    }
    assert!(legend.contains("kick-off spring, where it pushes") && !legend.contains("station"));
    // The head of the force's arrow is where it acts, below O, to which the arrow leads.
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let line = values(halves[0], "class=\"force\"", " d=")[0];
    let ends: Vec<Vec<f64>> = line[1..]
        .split(['M', 'L'])
        .take(2)
        .map(|end| end.split(' ').map(number).collect())
        .collect();
    let axis = "stroke=\"#2463ac\" stroke-width=\"1.5\"";
    let origin = number(values(halves[0], axis, " x1=")[0]);
    assert!(ends.iter().all(|end| (end[0] - origin).abs() < 0.2), "{ends:?} {origin}");
    assert!(ends[0][1] > ends[1][1], "it pushes upward: {ends:?}");
}

#[test]
fn stations_are_marked_and_a_scene_without_anything_has_no_legend() {
    let place = Place::new();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let copy = |name: &str| {
        fs::copy(format!("{scenes}/{name}"), place.path(name)).expect("an example");
    };
    copy("n-boom.toml");
    let drawn = picture(&place, "n-boom.toml");
    let halves: Vec<&str> = drawn.split("<g transform").skip(1).collect();
    let stations = fs::read_to_string(place.path("n-boom.toml"))
        .expect("it")
        .matches("[[body.station]]")
        .count();
    assert_eq!(halves[0].matches("class=\"station\"").count(), stations);
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let plain = picture(&place, "wing.toml");
    assert!(
        !plain.contains("class=\"station\"") && plain.contains("viewBox=\"0 0 960 474\""),
        "{plain}"
    );
}

#[test]
fn names_in_a_picture_are_text() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    let boom = fs::read_to_string(place.path("boom.toml")).expect("a scene");
    let hostile = boom.replace("name = \"boom\"", "name = \"<script>&\\u202e\"");
    place.write("hostile.toml", &hostile);
    let picture = picture(&place, "hostile.toml");
    assert!(!picture.contains("<script>") && picture.contains("&lt;script&gt;&amp;"), "{picture}");
    assert!(!picture.contains('\u{202e}'), "a mark that turns text");
}

#[test]
fn a_scene_of_one_body_and_one_without_latches_are_drawn() {
    let place = Place::new();
    place.write("bus.toml", "[run]\nend = 1\n\n[main_body]\nmass = 1\ninertia = [1, 1, 1]\n");
    assert!(picture(&place, "bus.toml").contains("nothing latches"));
    assert_eq!(code(&place.nboom(&["new", "gimbal"])), 0);
    assert!(picture(&place, "gimbal.toml").contains("gimbal: nothing latches"));
}

#[test]
fn a_picture_in_another_format_is_refused() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let check = place.nboom(&["check", "wing.toml", "--picture", "wing.png"]);
    assert_eq!(code(&check), 2);
    assert!(stderr(&check).contains("NAME.svg"), "{}", stderr(&check));
    assert!(!place.path("wing.png").exists());
}

#[test]
fn a_picture_replaces_no_file_unless_it_is_told_to() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    place.write("wing.svg", "drawn by hand");
    let check = ["check", "wing.toml", "--picture", "wing.svg"];
    let refused = place.nboom(&check);
    assert_eq!(code(&refused), 2);
    let told = "wing.svg: found a file of this name, expected none; --force replaces it";
    assert!(stderr(&refused).contains(told), "{}", stderr(&refused));
    let kept = || fs::read_to_string(place.path("wing.svg")).expect("a file");
    assert_eq!(kept(), "drawn by hand");
    assert_eq!(code(&place.nboom(&[&check[..], &["--force"]].concat())), 0);
    assert!(kept().starts_with("<svg"), "{}", kept());
    let idle = place.nboom(&["check", "wing.toml", "--force"]);
    assert_eq!(code(&idle), 2, "{}", stderr(&idle));
}

#[test]
fn places_beyond_all_drawings_are_refused() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let wing = fs::read_to_string(place.path("wing.toml")).expect("a scene");
    for far in ["1.7e308", "1e200"] {
        let text = wing.replace("at = [0.0, 0.6, -0.5]", &format!("at = [0.0, {far}, -0.5]"));
        assert_ne!(text, wing);
        fs::write(place.path("far.toml"), text).expect("writable");
        let check = place.nboom(&["check", "far.toml", "--picture", "far.svg"]);
        assert_eq!(code(&check), 2, "{}", stderr(&check));
        assert!(!place.path("far.svg").exists());
    }
}
