use std::fs;

use crate::directory::{Chain, page_of};

/// Everything that ends or begins an element of a script, and marks that turn the direction of text.
const HOSTILE: &str = "</script><script>alert('1')</script><!--\u{202e}\" & \u{2028}@DATA@ ${x}";

#[test]
fn no_text_of_a_run_becomes_markup() {
    let chain = Chain { segments: 2, samples: 10, stations: 1 };
    let place = chain.write();
    let plain = page_of(place.path());
    let at = |name: &str, text: &str| fs::write(place.path().join(name), text).expect("writable");
    at("summary.json", &chain.summary(HOSTILE));
    let scene = fs::read_to_string(place.path().join("scene.toml")).expect("a scene");
    at("scene.toml", &format!("# {HOSTILE}\n{scene}").replace("segment 1", "</script><b>"));
    at(
        "events.csv",
        "t,kind,appendage,segment,impulse,energy_before,energy_after\n1.0,</script><i>,,,,1.0,1.0\n",
    );
    let page = page_of(place.path());
    let data = page.split_once("type=\"application/json\">").expect("data").1;
    let (data, rest) = data.split_once("</script>").expect("its end");
    assert!(!data.contains(['<', '>', '&', '\u{2028}']));
    let keys: serde_json::Value = serde_json::from_str(data).expect("JSON");
    assert_eq!(keys["runs"][0]["label"], HOSTILE);
    assert_eq!(keys["runs"][0]["hinges"][0]["label"], "</script><b>");
    assert_eq!(keys["runs"][0]["events"][0]["kind"], "</script><i>");
    // Apart from data and title the page is what it always is.
    let bundle =
        |page: &str| page.rsplit_once("</script>\n<script>").expect("the script").1.to_owned();
    assert_eq!(bundle(&page), bundle(&plain));
    assert!(rest.starts_with("\n<script>"));
    let title = page
        .split_once("<title>")
        .and_then(|(_, rest)| rest.split_once("</title>"))
        .expect("a title")
        .0;
    assert!(!title.contains(['<', '>', '"', '\'', '\u{202e}', '\u{2028}']), "{title}");
}
