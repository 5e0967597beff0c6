use std::path::Path;

use nboom_model::{Joint, Scene};
use nboom_results::{EVENTS_FILE, Outcome, PeakDigits, RunDescription, WorstLoads, event_order};
use nboom_sim::{CodeOfRun, Digits, Event, EventKind, HingeImpulse, Reference, Selection, Totals};
use nboom_strength::{Cause, HingeQuantity, Limit, Worst, WorstHingeLoad};

use crate::certify::Certified;
use crate::format::{count, moment, seconds, short};
use crate::verdict;

/// Most events that are printed; the file has all.
pub(crate) const EVENTS_SHOWN: usize = 100;

/// The text of a completed run for standard output.
pub(crate) struct Account<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) run: &'a RunDescription,
    pub(crate) outcome: &'a Outcome,
    /// The first events, without the end.
    pub(crate) events: Vec<Event>,
    /// The worst stresses and hinge loads, if any were computed.
    pub(crate) worst: WorstLoads,
    /// The result of a reference run, if there was one.
    pub(crate) certified: Option<Certified>,
}

impl Account<'_> {
    pub(crate) fn text(&self, directory: &Path) -> String {
        let mut lines = vec![self.scene_line(), String::new()];
        lines.extend(self.event_lines());
        lines.extend(verdict::lines(self.scene, &self.outcome.summary.verdict));
        lines.extend(self.impulse_line());
        lines.extend(self.worst.station().map(|worst| self.worst_line(worst)));
        lines.extend(self.margin_lines());
        lines.extend(self.without_margin_line());
        lines.extend(self.hinge_load_line());
        lines.extend(self.run.judged_by.iter().map(|by| format!("judged by     {by}")));
        lines.push(self.conservation_line());
        lines.push(self.effort_line());
        lines.extend(self.certified.as_ref().map(trust_line));
        lines.push(format!("files         {}", directory.display()));
        lines.join("\n") + "\n"
    }

    fn scene_line(&self) -> String {
        let RunDescription { scene, .. } = self.run;
        let integrator = self.methods();
        let CodeOfRun { path, formulation, generated_share } = self.outcome.summary.code();
        let bodies = count(1 + self.scene.bodies.len(), "body", "bodies");
        let freedom = count(self.run.degrees_of_freedom, "degree", "degrees");
        let share = match path {
            Selection::MIXED => format!(" ({} % generated)", short(100.0 * generated_share, 2)),
            _ => String::new(),
        };
        format!(
            "{scene}: {bodies}, {freedom} of freedom; {path} path{share}, {formulation} formulation, \
             integrator {integrator}"
        )
    }

    /// The methods that took the steps, in the order of their first steps.
    fn methods(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for integration in &self.outcome.summary.integrations {
            let name = integration.choice.method.name();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        // A run that ends where it starts takes no step.
        if names.is_empty() { "none".to_owned() } else { names.join(" and ") }
    }

    fn event_lines(&self) -> Vec<String> {
        // The end is counted but not shown.
        let total = self.outcome.summary.events.saturating_sub(1);
        if self.events.is_empty() {
            return vec!["no events".to_owned(), String::new()];
        }
        let mut events = self.events.clone();
        events.sort_by(event_order);
        let mut rows = vec![self.headings()];
        rows.extend(events.iter().map(|event| self.cells(event)));
        let mut lines = aligned(&rows);
        if total > events.len() {
            lines.push(format!("... and {} more in {EVENTS_FILE}", total - events.len()));
        }
        lines.push(String::new());
        lines
    }

    fn headings(&self) -> Vec<String> {
        let units = &self.run.units;
        vec![
            format!("time [{}]", units.time()),
            "event".to_owned(),
            "hinge".to_owned(),
            format!("impulse [{}]", units.angular_momentum()),
            format!("kinetic energy [{}]", units.energy()),
            format!("|H| [{}]", units.angular_momentum()),
            format!("|P| [{}]", units.momentum()),
        ]
    }

    fn cells(&self, event: &Event) -> Vec<String> {
        let energy = |totals: &Totals| totals.kinetic_energy;
        let h = |totals: &Totals| totals.angular_momentum_inertial.norm();
        let p = |totals: &Totals| totals.linear_momentum_inertial.norm();
        let mut cells = vec![
            moment(self.scene, event.time, 10),
            event.kind.name().replace('_', " "),
            event.hinge.map_or(String::new(), |i| self.scene.label(i).to_string()),
            event.impulse.map_or(String::new(), |impulse| self.impulse(event.hinge, impulse)),
            change(event, energy),
        ];
        if matches!(event.kind, EventKind::LockUp | EventKind::Impact) {
            cells.extend([change(event, h), change(event, p)]);
        }
        cells
    }

    /// An impulse, with its unit where it is not that of the heading.
    fn impulse(&self, hinge: Option<usize>, impulse: f64) -> String {
        let slides = hinge.is_some_and(|i| self.scene.bodies[i].joint.slides());
        let unit = if slides { format!(" {}", self.run.units.momentum()) } else { String::new() };
        format!("{}{unit}", short(impulse, 8))
    }

    fn impulse_line(&self) -> Option<String> {
        let HingeImpulse { hinge, time, impulse } = self.outcome.summary.verdict.largest_impulse?;
        let units = &self.run.units;
        let unit = match self.scene.bodies[hinge].joint {
            Joint::Revolute => units.angular_momentum(),
            Joint::Prismatic => units.momentum(),
        };
        let (hinge, time) = (self.scene.label(hinge), moment(self.scene, time, 10));
        let impulse = short(impulse, 8);
        Some(format!("worst impulse {impulse} {unit} in hinge {hinge}, at {time}"))
    }

    /// The largest von Mises stress of the run.
    fn worst_line(&self, worst: &Worst) -> String {
        let why = match worst.cause {
            Cause::Motion => "motion".to_owned(),
            Cause::Pulse { hinge, kind, share } => {
                let (percent, kind) = (short(100.0 * share, 3), kind.name().replace('_', " "));
                format!("{kind} of hinge {} ({percent} % of it)", self.scene.label(hinge))
            }
        };
        let mostly =
            worst.driver.map_or(", unloaded".to_owned(), |driver| format!(", mostly {driver}"));
        let margin = worst.margins.on_yield;
        let margin =
            margin.map_or(String::new(), |margin| format!(", margin {}", short(margin, 3)));
        format!(
            "worst stress  von Mises {} {} in segment {}, station {}, at {} by {why}{mostly}{margin}; of thin \
             walls, without corners and holes",
            short(worst.max_von_mises.stress.von_mises(), 5),
            self.run.units.stress(),
            worst.segment,
            worst.station + 1,
            moment(self.scene, worst.time, 10),
        )
    }

    /// The smallest margins, unless the line of the largest stress tells them.
    fn margin_lines(&self) -> impl Iterator<Item = String> {
        self.worst.weakest_of_each().filter_map(|(worst, margin, limit)| {
            // Stations that are loaded alike have one margin.
            let has_it = |told: &Worst| told.margins.on_yield == Some(margin);
            let is_told = limit == Limit::Yield && self.worst.station().is_some_and(has_it);
            let (margin, limit, station) = (short(margin, 3), limit.name(), worst.station + 1);
            let (segment, time) = (&worst.segment, moment(self.scene, worst.time, 10));
            (!is_told).then(|| {
                format!("margin        at least {margin} to {limit}, in segment {segment}, station {station}, at {time}")
            })
        })
    }

    /// What the smallest margins say nothing of.
    fn without_margin_line(&self) -> Option<String> {
        let (without, all) = (self.worst.without_margin(), self.worst.stations.len());
        (without > 0).then(|| {
            format!("margin        none for {without} of {all} stations, whose materials have no strength")
        })
    }

    fn hinge_load_line(&self) -> Option<String> {
        let [force, moment] = [HingeQuantity::Force, HingeQuantity::Moment]
            .map(|quantity| self.worst.hinge(quantity));
        let told = |worst: &WorstHingeLoad, unit: &str| {
            let (name, magnitude) = (worst.quantity.name(), short(worst.magnitude(), 5));
            format!("{name} {magnitude} {unit} in hinge {}", worst.hinge)
        };
        let units = &self.run.units;
        let (force, moment) = (told(force?, units.force()), told(moment?, &units.torque()));
        let left_out = match self.run.latch_pulses {
            Some(false) => {
                "; without pulses of latches and stops, which need pulse_constant of each body they act on"
            }
            _ => "",
        };
        Some(format!("hinge loads   at most {force}, {moment}{left_out}"))
    }

    fn conservation_line(&self) -> String {
        let residuals = self.outcome.summary.conservation;
        let momentum = |name: &str, residual: Option<f64>| {
            residual.map_or(String::new(), |found| format!("{name} momentum {}, ", short(found, 2)))
        };
        let linear = momentum("linear", residuals.linear_momentum);
        let angular = momentum("angular", residuals.angular_momentum);
        let energy = short(residuals.energy, 2);
        format!("conservation  {linear}{angular}energy {energy} (relative)")
    }

    fn effort_line(&self) -> String {
        let summary = &self.outcome.summary;
        let accepted = count(summary.steps_accepted, "step", "steps");
        let evaluations = count(summary.evaluations, "evaluation", "evaluations");
        let seconds = seconds(self.outcome.wall_seconds);
        format!(
            "effort        {accepted} and {} rejected, {evaluations}, {seconds} s",
            summary.steps_rejected
        )
    }
}

/// The fewest digits of event times, of impulses, of each quantity at the end, and of peaks.
fn trust_line(Certified { trust, peaks }: &Certified) -> String {
    let mut known: Vec<String> = Vec::new();
    let mut say = |what: &str, digits: Option<u32>| {
        known.extend(digits.map(|digits| format!("{what} {digits}")));
    };
    say("event times", trust.events.iter().map(|event| event.time.count()).min());
    let impulses = trust.events.iter().filter_map(|event| event.impulse.as_ref());
    say("impulses", impulses.map(Digits::count).min());
    trust.end.iter().for_each(|digits| say(digits.quantity, Some(digits.count())));
    let (stations, hinges): (Vec<&PeakDigits>, Vec<_>) =
        peaks.iter().partition(|peak| peak.station.is_some());
    for (what, peaks) in [("peak stresses", stations), ("peak hinge loads", hinges)] {
        say(what, peaks.iter().map(|peak| peak.digits.count()).min());
    }
    let known = known.join(", ");
    if !trust.same_events {
        return format!("not certified the reference has other events; digits until then: {known}");
    }
    match trust.reference {
        Reference::TighterTolerance => {
            format!("certified     digits against rtol {:.0e}: {known}", trust.rtol)
        }
        Reference::DoubleDouble => format!("certified     digits against double-double: {known}"),
    }
}

fn change(event: &Event, of: impl Fn(&Totals) -> f64) -> String {
    format!("{} -> {}", short(of(&event.before), 8), short(of(&event.after), 8))
}

/// Rows with aligned cells, two spaces apart.
fn aligned(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width_of = |j: usize| {
        let cells = rows.iter().filter_map(|row| row.get(j));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width_of).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}  "));
        cells.collect::<String>().trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_model::{
        Appendage, Hinge, HingeState, MassProperties, Mount, SceneDescription, Segment, UnitSystem,
    };
    use nboom_scalar::{Sym3, Vec3};
    use nboom_sim::{
        Choice, Conservation, HingeVerdict, Integration, Method, Options, Summary, Verdict,
    };

    fn scene() -> Scene {
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let segment = Segment { length: 1.0, mass_properties: body, hinge: Hinge::free() };
        let mut description = SceneDescription::at_rest("boom", body, 1.0);
        let mount = Mount::at(Vec3::zero());
        description.attach(&Appendage::Regular { mount, segments: vec![segment] });
        Scene::new(description).expect("the bodies are physical")
    }

    fn lock_up(time: f64) -> Event {
        let totals = |kinetic_energy, momentum| Totals {
            kinetic_energy,
            linear_momentum_inertial: Vec3::zero(),
            angular_momentum_inertial: Vec3::unit_y() * momentum,
        };
        Event {
            time,
            kind: EventKind::LockUp,
            hinge: Some(0),
            impulse: Some(-0.125),
            before: totals(2.0, 3.0),
            after: totals(1.5, 3.0),
        }
    }

    fn account(events: Vec<Event>, counted: usize) -> String {
        let scene = scene();
        let run = RunDescription::new(&scene, &Options::default(), UnitSystem::FtLbfS);
        let conservation = Conservation {
            linear_momentum: Some(0.0),
            angular_momentum: Some(1.25e-15),
            energy: 3e-13,
        };
        let summary = Summary {
            end_time: 1.0,
            steps_accepted: 10,
            steps_rejected: 2,
            evaluations: 144,
            jacobians: 0,
            factorizations: 0,
            events: counted,
            conservation,
            has_angular_momentum: true,
            integrator: "auto",
            integrations: [Method::Dop853, Method::Radau5, Method::Dop853]
                .map(|method| Integration { since: 0.0, choice: Choice { method, reason: "" } })
                .to_vec(),
            attitude_drift: 0.0,
            selections: Vec::new(),
            verdict: Verdict {
                hinges: vec![HingeVerdict {
                    since: Some(0.25),
                    ..HingeVerdict::new(HingeState::Locked, 0.0)
                }],
                largest_impulse: Some(HingeImpulse { hinge: 0, time: 0.25, impulse: -0.125 }),
            },
            runaway: None,
        };
        let (wall_seconds, troubles) = (0.012345, Vec::new());
        let outcome = Outcome { summary, wall_seconds, error: None, troubles };
        Account {
            scene: &scene,
            run: &run,
            outcome: &outcome,
            events,
            worst: WorstLoads::default(),
            certified: None,
        }
        .text(Path::new("out/boom"))
    }

    #[test]
    fn an_account_names_bodies_events_residuals_effort_and_files() {
        let expected = "\
boom: 2 bodies, 7 degrees of freedom; generic path, recursive formulation, integrator dop853 and radau5

time [s]  event    hinge  impulse [ft lbf s]  kinetic energy [ft lbf]  |H| [ft lbf s]  |P| [lbf s]
0.25      lock up  1,1    -0.125              2 -> 1.5                 3 -> 3          0 -> 0

all locked    1,1 at 0.25
worst impulse -0.125 ft lbf s in hinge 1,1, at 0.25
conservation  linear momentum 0, angular momentum 1.2e-15, energy 3e-13 (relative)
effort        10 steps and 2 rejected, 144 evaluations, 0.0123 s
files         out/boom
";
        assert_eq!(account(vec![lock_up(0.25)], 2), expected);
        // An impact is told as a lock-up is.
        let impact = Event { kind: EventKind::Impact, ..lock_up(0.25) };
        let expected = expected.replace("event    ", "event   ").replace("lock up  ", "impact  ");
        assert_eq!(account(vec![impact], 2), expected);
    }

    #[test]
    fn events_that_are_not_shown_are_counted() {
        assert!(account(vec![lock_up(0.25)], 9).contains("\n... and 7 more in events.csv\n"));
        assert!(account(Vec::new(), 1).contains("\nno events\n"));
    }
}
