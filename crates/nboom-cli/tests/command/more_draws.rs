//! A sweep that gets more draws.

use std::fs;

use crate::sweeps::{STUDY, cases, sweep};
use crate::{Place, refused};

#[test]
fn a_finished_sweep_gets_more_draws() {
    let place = Place::new();
    place.write("study.toml", &STUDY.replacen("draws = 40", "draws = 9", 1));
    sweep(&place, &["-o", "grown"]);
    let more = STUDY.replacen("draws = 40", "draws = 14", 1);
    // Another change on a later line is what is told.
    place.write("study.toml", &more.replacen("rtol = 1e-8", "rtol = 1e-7", 1));
    let other = place.nboom(&["sweep", "study.toml", "-o", "grown", "--resume"]);
    refused(&other, 2, &["another text of the study", "`rtol = 1e-8` then, `rtol = 1e-7` now"]);
    place.write("study.toml", &more);
    refused(&place.nboom(&["sweep", "study.toml", "-o", "grown"]), 2, &["9 draws", "--resume"]);
    sweep(&place, &["-o", "grown", "--resume"]);
    sweep(&place, &["-o", "alone"]);
    for name in ["cases.csv", "study.json", "study.toml", "statistics.json"] {
        let [grown, alone] = ["grown", "alone"]
            .map(|of| fs::read_to_string(place.path(of).join(name)).expect("written"));
        assert_eq!(grown, alone, "{name}");
    }
    assert_eq!(cases(&place, "grown").len(), 3 * 14);
}
