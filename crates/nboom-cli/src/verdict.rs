//! The final states of the hinges, in words.

use std::f64::consts::TAU;

use nboom_model::{HingeState, Scene};
use nboom_results::WorstLoads;
use nboom_sim::{Doubt, HingeVerdict, Miss, Summary, Verdict};
use nboom_strength::{Limit, Worst};

use crate::format::{moment, short};

/// Hinges beyond these are only counted.
const SHOWN: usize = 12;

/// A line with the locked hinges and the times of their lock-ups, and one with the others and their
/// angles; nothing for a scene without hinges.
pub(crate) fn lines(scene: &Scene, verdict: &Verdict) -> Vec<String> {
    let each = || verdict.hinges.iter().enumerate();
    let is_locked = |hinge: &HingeVerdict| hinge.state == HingeState::Locked;
    let locked = each().filter(|(_, hinge)| is_locked(hinge));
    let locked = listed(locked.map(|(i, hinge)| locked_hinge(scene, i, hinge)).collect());
    let others = each().filter(|(_, hinge)| !is_locked(hinge));
    let others = listed(others.map(|(i, hinge)| other_hinge(scene, i, hinge)).collect());
    match (locked, others) {
        (None, None) => Vec::new(),
        (Some(locked), None) => vec![format!("all locked    {locked}")],
        (None, Some(others)) => vec![format!("none locked   {others}")],
        (Some(locked), Some(others)) => {
            vec![format!("locked        {locked}"), format!("not locked    {others}")]
        }
    }
}

/// The first of them, and how many more there are.
fn listed(hinges: Vec<String>) -> Option<String> {
    let shown = hinges.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>().join("; ");
    match hinges.len().saturating_sub(SHOWN) {
        _ if hinges.is_empty() => None,
        0 => Some(shown),
        more => Some(format!("{shown}; and {more} more")),
    }
}

fn locked_hinge(scene: &Scene, i: usize, hinge: &HingeVerdict) -> String {
    let label = scene.label(i);
    match hinge.since {
        Some(time) => format!("{label} at {}", moment(scene, time, 10)),
        None => format!("{label} from the start"),
    }
}

fn other_hinge(scene: &Scene, i: usize, hinge: &HingeVerdict) -> String {
    let stops = &scene.bodies[i].hinge.stops;
    let state = match hinge.state {
        HingeState::Stuck if stops.at(hinge.angle).is_some() => "against its stop",
        HingeState::Stuck => "stuck by friction",
        HingeState::Free => "free",
        HingeState::Unreleased | HingeState::Locked => "unreleased",
    };
    let label = scene.label(i);
    let place = label.coordinate(hinge.angle);
    let Some(lock) = scene.bodies[i].hinge.lock_angle else {
        return format!("{label} {state} at {place}, has no lock");
    };
    let told = format!("{label} {state} at {place}, locks at {}", label.coordinate(lock));
    match hinge.miss.filter(|miss| miss.by < (lock - hinge.angle).abs()) {
        Some(Miss { by, time }) => {
            format!("{told}, nearest at {}: {} away", moment(scene, time, 6), label.coordinate(by))
        }
        None => told,
    }
}

/// Why the results of a run at this tolerance are not to be trusted, or not to be liked: a motion that runs away, laws
/// that do not hold, latches of which errors of the run may decide, pulses that are no short ones, and parts that fail.
pub fn troubles(scene: &Scene, summary: &Summary, rtol: f64, worst: &WorstLoads) -> Vec<String> {
    let poor = summary.conservation.poor(rtol).map(|law| law.to_string());
    let doubtful = summary.verdict.doubts(scene, rtol).map(|(i, doubt)| in_doubt(scene, i, doubt));
    let hinges = summary.verdict.hinges.iter().zip(&worst.pulses).enumerate();
    let slow = hinges.filter_map(|(i, (hinge, lasts))| slow_pulse(scene, i, hinge, *lasts));
    let negative = worst.weakest_of_each().filter_map(negative_margin);
    let runaway = summary.runaway.iter().map(ToString::to_string);
    runaway.chain(poor).chain(doubtful).chain(slow).chain(negative).collect()
}

fn in_doubt(scene: &Scene, i: usize, doubt: Doubt) -> String {
    let label = scene.label(i);
    match doubt {
        Doubt::Missed(Miss { by, time }) => format!(
            "hinge {label} is {} from its lock angle at {} and does not lock: errors of the run may decide that",
            short(by, 2),
            moment(scene, time, 6)
        ),
        Doubt::HardlyLocks(rate) => format!(
            "hinge {label} hardly locks, at a rate of {}: errors of the run may decide whether and when it locks",
            short(rate, 2)
        ),
    }
}

/// A pulse in whose course the hinge would turn all around, or slide once more as far as from its start, at the mean of
/// zero and the rate at which it locked or hit its stop: loads are those of the posture at that instant.
fn slow_pulse(scene: &Scene, i: usize, hinge: &HingeVerdict, lasts: f64) -> Option<String> {
    let closing = hinge.closing_rate.map(|rate| (rate.abs(), "latch"));
    let impact = hinge.impact_rate.map(|rate| (rate, "stop"));
    let (rate, what) = closing.into_iter().chain(impact).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let way = 0.5 * rate * lasts;
    let most = if scene.bodies[i].joint.slides() { scene.coordinate_scale(i) } else { TAU };
    let label = scene.label(i);
    (way > most).then(|| {
        format!(
            "hinge {label} would move on by {} in the pulse of its {what}, which lasts {}: a pulse that is short against \
             the motion expected, by a smaller pulse constant",
            label.coordinate(way),
            short(lasts, 3)
        )
    })
}

fn negative_margin((worst, margin, limit): (&Worst, f64, Limit)) -> Option<String> {
    let (segment, station) = (&worst.segment, worst.station + 1);
    let limit = if limit == Limit::Yield { "" } else { " to the ultimate stress" };
    let margin = Some(margin).filter(|margin| *margin < 0.0).map(|margin| short(margin, 3))?;
    Some(format!("negative margin: {margin}{limit} in segment {segment}, station {station}"))
}

#[cfg(test)]
mod tests {
    use nboom_io::words::{body, hinge, main_body, scene};

    use super::*;

    #[test]
    fn a_stuck_hinge_is_against_its_stop_or_held_by_friction() {
        let main = main_body().mass(1.0).inertia([1.0; 3]);
        let joint = hinge().at([0.0; 3]).axis("x").stops_deg([-10.0, f64::INFINITY]);
        let joint = joint.latch_deg(45.0).friction(1.0);
        let boom = body("boom").mass(1.0).mass_centre([0.0, 1.0, 0.0]).inertia([1.0; 3]);
        let scene = scene("a").end(1.0).main_body(main).body(boom.hinge(joint)).build();
        let scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
        let told = |angle: f64| {
            let hinges = vec![HingeVerdict::new(HingeState::Stuck, angle)];
            lines(&scene, &Verdict { hinges, largest_impulse: None }).concat()
        };
        let at_stop = told(-10.0_f64.to_radians());
        assert!(at_stop.contains(" against its stop at -10 deg, locks at 45 deg"), "{at_stop}");
        let elsewhere = told(-9.0_f64.to_radians());
        assert!(elsewhere.contains(" stuck by friction at -9 deg"), "{elsewhere}");
    }
}
