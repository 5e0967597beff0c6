//! Runs that are killed at random instants over a finished result.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Instant;

use super::files::{contents, half_rows, rows_are_whole, summary};
use super::interrupts::SWINGING;
use super::place::{Place, REPORT_DECK};

/// Kills in a test; `NBOOM_KILLS` asks for another number.
const KILLS: usize = 40;

/// What is left of a run, apart from times of the clock.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = contents(directory);
    files.remove("summary.json");
    // It is made from the others once they are in their place, and has these times.
    files.remove("report.html");
    files
}

/// A page in a directory is that of the run there.
fn page_is_of_the_run(directory: &Path, summary: &serde_json::Value, told: &str) {
    let Ok(page) = fs::read_to_string(directory.join("report.html")) else { return };
    let data = page.split_once("type=\"application/json\">").expect("data").1;
    let data = data.split_once("</script>").expect("its end").0;
    let keys: serde_json::Value = serde_json::from_str(data).expect("JSON");
    assert_eq!(keys["runs"][0]["summary"]["samples"], summary["samples"], "{told}");
}

/// How many kills found what.
#[derive(Debug, Default)]
struct Tally {
    before_the_run: usize,
    old: usize,
    old_and_partial: usize,
    half_way: usize,
    new: usize,
    half_rows: usize,
}

struct Campaign<'a> {
    place: &'a Place,
    old: BTreeMap<String, Vec<u8>>,
    new: BTreeMap<String, Vec<u8>>,
    tally: Tally,
}

impl Campaign<'_> {
    /// Checks what a kill has left: the old result or the new one, whole; or a mark.
    fn check(&mut self, signal: &str, told: &str) {
        let (run, partial) = (self.place.path("run"), self.place.path("run.partial"));
        assert_eq!(fs::read(run.join("notes.txt")).ok(), Some(b"mine".to_vec()), "{told}");
        rows_are_whole(&run);
        let half_rows = half_rows(&partial);
        // Only the system itself can cut a row, at the end of a page.
        assert!(half_rows == 0 || signal == "KILL", "{told}: half a row");
        self.tally.half_rows += usize::from(half_rows > 0);
        let found = summary(&run).expect("a summary at all times");
        let left = summary(&partial);
        let is_whole = |files_of: &BTreeMap<String, Vec<u8>>| files(&run) == *files_of;
        if found["complete"] == true {
            page_is_of_the_run(&run, &found, told);
            let is_new = is_whole(&self.new);
            assert!(is_new || is_whole(&self.old), "{told}: neither the old nor the new result");
            match left {
                _ if is_new => self.tally.new += 1,
                Some(_) => self.tally.old_and_partial += 1,
                None if partial.exists() => {
                    assert!(!partial.join("states.csv").exists(), "{told}: no mark");
                    self.tally.old += 1;
                }
                None => self.tally.before_the_run += 1,
            }
        } else {
            // The new result is complete and on its way.
            let left = left.expect("what is half way is told of in both places");
            assert_eq!(left["complete"], true, "{told}");
            self.tally.half_way += 1;
        }
    }

    /// The next run is let in and finishes.
    fn go_on(&self, told: &str) {
        let run = self.place.path("run");
        let args = ["run", "deck.nml", "-o", "run", "--samples", "3", "--end-time", "0.01"];
        let next = self.place.nboom(&[&args[..], &["--quiet"]].concat());
        assert_eq!(next.code(), Some(0), "{told}: {}", next.stderr());
        assert_eq!(summary(&run).expect("a summary")["complete"], true, "{told}");
        assert!(!self.place.path("run.partial").exists(), "{told}");
    }
}

/// Random numbers from 0 to 1, always the same ones: Marsaglia's.
pub fn random(bits: &mut u64) -> f64 {
    *bits ^= *bits << 13;
    *bits ^= *bits >> 7;
    *bits ^= *bits << 17;
    (*bits >> 11) as f64 / (1_u64 << 53) as f64
}

fn killed_at_random_instants(name: &str, deck: &str, options: &[&str], kills: usize) {
    let place = Place::new(&format!("kills-{name}"));
    place.write("deck.nml", deck);
    fs::create_dir(place.path("run")).expect("writable");
    place.write("run/notes.txt", "mine");
    let command = [&["run", "deck.nml", "-o", "run", "--quiet"], options].concat();
    let started = Instant::now();
    let finished = place.start(&command).end();
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
    let mut duration = started.elapsed();
    let new = files(&place.path("run"));
    let first = ["run", "deck.nml", "-o", "run", "--quiet", "--samples", "100", "--listing"];
    assert_eq!(place.nboom(&first).code(), Some(0));
    let old_summary = fs::read(place.path("run/summary.json")).expect("a summary");
    let old = files(&place.path("run"));
    assert_ne!(old, new);
    let mut campaign = Campaign { place: &place, old, new, tally: Tally::default() };
    let mut bits = 1970;
    for kill in 0..kills {
        let signal = ["KILL", "TERM", "INT"][kill % 3];
        let running = place.start(&command);
        let wait = duration.mul_f64(1.2 * random(&mut bits));
        sleep(wait);
        running.signal(signal);
        let code = running.end().code();
        // Other programs take their share of the machine; about a quarter of the kills come late.
        duration = duration.mul_f64(if code == Some(0) { 0.94 } else { 1.02 });
        let told = format!("{name}, kill {kill} by {signal} after {wait:?}");
        // No code: before the program had begun to listen, or by SIGKILL.
        assert!([None, Some(0), Some(3)].contains(&code), "{told}: {code:?}");
        campaign.check(signal, &told);
        campaign.go_on(&told);
        let _ = fs::remove_dir_all(place.path("run"));
        fs::create_dir(place.path("run")).expect("writable");
        for (file, content) in &campaign.old {
            place.write(&format!("run/{file}"), content);
        }
        place.write("run/summary.json", &old_summary);
    }
    println!("{name}: {kills} kills within {duration:?}: {:?}", campaign.tally);
    let Tally { old_and_partial, half_rows, .. } = campaign.tally;
    // Written in pieces of any length nearly all would be.
    assert!(6 * half_rows <= kills, "half rows after {half_rows} kills");
    assert!(old_and_partial > 0, "no kill came while a run was going on");
}

pub fn kills() -> usize {
    std::env::var("NBOOM_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(KILLS)
}

#[test]
fn a_run_of_many_steps() {
    let options = ["--end-time", "300", "--samples", "2000"];
    killed_at_random_instants("steps", SWINGING, &options, kills().div_ceil(2));
}

#[test]
fn a_run_of_many_tables() {
    let options = ["--samples", "3000"];
    killed_at_random_instants("tables", REPORT_DECK, &options, kills() / 2);
}
