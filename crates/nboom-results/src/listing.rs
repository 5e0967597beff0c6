use std::io::{self, Write};

use nboom_elements::Kind;
use nboom_model::{HingeLabel, Joint, UnitSystem};
use nboom_sim::{Detail, Event, Snapshot};

use crate::layout::{
    Columns, DIGITS, Units, inertial_columns, inertial_vectors, number, number_to, row_name, title,
};
use crate::{euler_angles, event_order, time_digits};

const HINGE_MOTION: Columns = Columns { first: 8, others: 20 };
const HINGE_FORCES: Columns = Columns { first: 8, others: 30 };
const SYSTEM: Columns = Columns { first: 6, others: 23 };

/// Writes the printout in the form of the report's output, Table 18.1: a block for each output
/// time and for each instant with events, angles in degrees, ten digits, of times that are large
/// beside the length of the run more.
///
/// Snapshots must have [`Snapshot::detail`]; without it the writer panics.
#[derive(Debug)]
pub struct ListingWriter<W> {
    out: W,
    hinges: Vec<HingeLabel>,
    units: UnitSystem,
    span: [f64; 2],
    /// Time of the last block, so that an output time at an event is printed once.
    printed: Option<f64>,
    /// Output times so far.
    samples: usize,
    /// After the first ones, one in this many output times is printed.
    interval: usize,
}

/// Output times that are always printed.
const FIRST: usize = 20;

impl<W: Write> ListingWriter<W> {
    /// Writes the title; `hinges` has the label of every hinge of the scene, which runs over `span` \[T\].
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn new(
        mut out: W,
        scene: &str,
        hinges: Vec<HingeLabel>,
        units: UnitSystem,
        span: [f64; 2],
    ) -> io::Result<Self> {
        writeln!(out, "N-BOOM DYNAMICS   SCENE {scene}   UNITS {}", units.name())?;
        Ok(Self { out, hinges, units, span, printed: None, samples: 0, interval: 1 })
    }

    /// Prints only every `interval`th output time after the twentieth, as the original printed its
    /// steps; all instants with events are printed.
    #[must_use]
    pub fn thinned(self, interval: usize) -> Self {
        Self { interval: interval.max(1), ..self }
    }

    /// Writes the block of an output time.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn write(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.samples += 1;
        let is_due = self.samples.saturating_sub(FIRST).is_multiple_of(self.interval);
        if !is_due || self.printed == Some(snapshot.time) {
            return Ok(());
        }
        self.write_time(snapshot)?;
        self.write_block(snapshot)
    }

    /// Writes what happened in an instant and the block after it.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn write_instant(&mut self, events: &[Event], after: &Snapshot) -> io::Result<()> {
        let mut sorted = events.to_vec();
        sorted.sort_by(event_order);
        let is_new = self.printed != Some(after.time);
        if is_new {
            self.write_time(after)?;
        }
        sorted.iter().try_for_each(|event| self.write_event(event))?;
        if is_new { self.write_block(after) } else { Ok(()) }
    }

    /// Passes everything written so far on to the system.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    fn write_time(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let digits = time_digits(snapshot.time, self.span, DIGITS);
        let (time, step) = (number_to(snapshot.time, digits), number(snapshot.next_step));
        let steps = snapshot.steps;
        writeln!(self.out, "\nTIME {time}   NUMBER OF STEPS {steps}   TIME STEP {step}")
    }

    fn write_event(&mut self, event: &Event) -> io::Result<()> {
        write!(self.out, "EVENT: {}", title(event.kind))?;
        if let Some(i) = event.hinge {
            write!(self.out, " {}", self.hinges[i])?;
        }
        if let Some(impulse) = event.impulse {
            let joint = event.hinge.map_or(Joint::Revolute, |i| self.hinges[i].joint);
            let (what, unit) = Units::of(&self.units).impulse_at(joint);
            write!(self.out, "   IMPULSIVE {what} {} ({unit})", number(impulse))?;
        }
        writeln!(self.out)
    }

    fn write_block(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let detail = snapshot.detail.as_ref().expect("a listing asks for details");
        let units = Units::of(&self.units);
        if !self.hinges.is_empty() {
            self.write_hinge_motion(snapshot, detail, &units)?;
            self.write_hinge_forces(snapshot, detail, &units)?;
        }
        self.write_system(snapshot, detail, &units)?;
        self.write_attitude(snapshot)?;
        self.printed = Some(snapshot.time);
        Ok(())
    }

    fn write_hinge_motion(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
        units: &Units,
    ) -> io::Result<()> {
        let (rate, acceleration) = (units.rate_of("DEG"), units.acceleration_of("DEG"));
        writeln!(self.out, "\nAPPENDAGE MOTION")?;
        let columns = [
            ("BETA", "DEG"),
            ("BETA DOT", &rate),
            ("BETA DDOT", &acceleration),
            ("ALPHA", "DEG"),
            ("ALPHA DOT", &rate),
            ("ALPHA DDOT", &acceleration),
        ];
        HINGE_MOTION.heading(&mut self.out, "APP SEG", &columns)?;
        for (i, label) in self.hinges.iter().enumerate() {
            let Snapshot { beta, tau, alpha, sigma, .. } = snapshot;
            let Detail { beta_ddot, alpha_ddot, .. } = detail;
            let of_lists = [beta, tau, beta_ddot, alpha, sigma, alpha_ddot];
            let shown = of_lists.map(|list| match label.joint {
                Joint::Revolute => list[i].to_degrees(),
                Joint::Prismatic => list[i],
            });
            HINGE_MOTION.numbers(&mut self.out, &row_name(label), &shown)?;
        }
        if self.slides() {
            writeln!(self.out, "SEGMENTS THAT SLIDE HAVE LENGTHS ({}), NOT DEG", units.length)?;
        }
        Ok(())
    }

    fn write_hinge_forces(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
        units: &Units,
    ) -> io::Result<()> {
        let mut columns = vec![
            ("RELEASE LOCK-UP STATE VECTOR", ""),
            ("SPRING DASHPOT TORQUE", units.torque.as_str()),
        ];
        let lines = || Kind::ALL.into_iter().filter_map(|kind| Some((kind, kind.names().line?)));
        for (_, names) in lines() {
            let force = (names.force_column, units.force.as_str());
            columns.extend([force, (names.length_column, &units.length)]);
        }
        writeln!(self.out)?;
        HINGE_FORCES.heading(&mut self.out, "APP SEG", &columns)?;
        for (i, label) in self.hinges.iter().enumerate() {
            let mut cells =
                vec![snapshot.hinges[i].code().to_string(), number(detail.hinge_torque[i])];
            for (kind, _) in lines() {
                let line = detail.lines.iter().find(|line| (line.hinge, line.kind) == (i, kind));
                let [force, length] = line.map_or([0.0; 2], |line| [line.force, line.length]);
                cells.extend([force, length].map(number));
            }
            HINGE_FORCES.row(&mut self.out, &row_name(label), &cells)?;
        }
        if self.slides() {
            let Units { force, torque, .. } = units;
            writeln!(
                self.out,
                "SEGMENTS THAT SLIDE HAVE FORCES ({force}), NOT TORQUES ({torque})"
            )?;
        }
        Ok(())
    }

    /// Whether any segment does.
    fn slides(&self) -> bool {
        self.hinges.iter().any(|label| label.joint.slides())
    }

    fn write_system(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
        units: &Units,
    ) -> io::Result<()> {
        let out = &mut self.out;
        writeln!(out, "\nSYSTEM MOTION\nIN MAIN BODY COORDINATES")?;
        let columns = [
            ("OMEGA", units.rate_of("RAD")),
            ("OMEGA DOT", units.acceleration_of("RAD")),
            ("MASS CTR POSITION", units.length.clone()),
        ];
        heading(out, &columns)?;
        let vectors = [snapshot.omega_body, detail.omega_dot_body, detail.mass_center_body];
        SYSTEM.components(out, &vectors)?;
        writeln!(out, "\nIN INERTIAL COORDINATES")?;
        heading(out, &inertial_columns(units))?;
        SYSTEM.components(out, &inertial_vectors(snapshot, detail))?;
        writeln!(out, "\nKINETIC ENERGY  {} ({})", number(snapshot.kinetic_energy), units.energy)
    }

    fn write_attitude(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let out = &mut self.out;
        writeln!(out, "\nNUTATION ANGLE (DEG)  {}", number(snapshot.nutation.to_degrees()))?;
        let angles = euler_angles(snapshot.attitude).map(f64::to_degrees);
        let names = ["PSI", "THETA", "PHI"].map(str::to_owned);
        writeln!(out, "\nEULER ANGLES (DEG)")?;
        SYSTEM.row(out, "", &names)?;
        SYSTEM.numbers(out, "", &angles)?;
        let rot_inertial_from_body = snapshot.attitude.to_matrix();
        writeln!(out, "\nMAIN BODY FIXED UNIT VECTORS IN INERTIAL COORDINATES")?;
        SYSTEM.row(out, "", &["X", "Y", "Z"].map(str::to_owned))?;
        SYSTEM.components(out, &[0, 1, 2].map(|j| rot_inertial_from_body.column(j)))
    }
}

fn heading(out: &mut impl Write, columns: &[(&str, String)]) -> io::Result<()> {
    let columns: Vec<(&str, &str)> =
        columns.iter().map(|(name, unit)| (*name, unit.as_str())).collect();
    SYSTEM.heading(out, "COMP", &columns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_sim::EventKind;

    use crate::fixture::{self, event, snapshot};

    const SPAN: [f64; 2] = [0.0, 30.0];

    fn listing(units: UnitSystem, write: impl Fn(&mut ListingWriter<&mut Vec<u8>>)) -> String {
        let mut bytes = Vec::new();
        let mut writer = ListingWriter::new(&mut bytes, "booms", fixture::labels(), units, SPAN)
            .expect("memory");
        write(&mut writer);
        String::from_utf8(bytes).expect("text")
    }

    fn block() -> String {
        listing(UnitSystem::FtLbfS, |w| w.write(&snapshot(0.5)).expect("memory"))
    }

    #[test]
    fn of_output_times_after_the_twentieth_every_third_is_printed_and_all_instants() {
        let mut bytes = Vec::new();
        let units = UnitSystem::None;
        let writer = ListingWriter::new(&mut bytes, "booms", fixture::labels(), units, SPAN);
        let mut writer = writer.expect("memory").thinned(3);
        for time in (1..=30_u32).map(f64::from) {
            writer.write(&snapshot(time)).expect("memory");
            if time == 24.0 {
                let release = event(24.5, EventKind::Release, Some(0));
                writer.write_instant(&[release], &snapshot(24.5)).expect("memory");
            }
        }
        let text = String::from_utf8(bytes).expect("text");
        let times = text.lines().filter_map(|line| line.strip_prefix("TIME ")?.split(' ').next());
        let times: Vec<f64> = times.map(|time| time.parse().expect("a number")).collect();
        let first = (1..=20_u32).map(f64::from);
        assert_eq!(times, first.chain([23.0, 24.5, 26.0, 29.0]).collect::<Vec<_>>());
    }

    #[test]
    fn headings_stand_in_the_report_s_order() {
        let text = block();
        let headings = [
            "TIME 5.000000000E-01",
            "NUMBER OF STEPS 42",
            "TIME STEP 1.250000000E-01",
            "APPENDAGE MOTION",
            "APP SEG",
            "BETA",
            "BETA DOT",
            "BETA DDOT",
            "ALPHA",
            "ALPHA DOT",
            "ALPHA DDOT",
            "(DEG/SEC SQ)",
            "RELEASE LOCK-UP STATE VECTOR",
            "SPRING DASHPOT TORQUE",
            "KICKOFF SPRING FORCE",
            "EXTENSION OF KICKOFF SPRING",
            "(FT LBF)",
            "SYSTEM MOTION",
            "IN MAIN BODY COORDINATES",
            "OMEGA",
            "OMEGA DOT",
            "MASS CTR POSITION",
            "IN INERTIAL COORDINATES",
            "REFERENCE PT POSITION",
            "MASS CTR POSITION",
            "MASS CTR VELOCITY",
            "MASS CTR ACCELERATION",
            "ANGULAR MOMENTUM",
            "LINEAR MOMENTUM",
            "(FT LBF SEC)",
            "KINETIC ENERGY",
            "NUTATION ANGLE (DEG)",
            "EULER ANGLES (DEG)",
            "PSI",
            "THETA",
            "PHI",
            "MAIN BODY FIXED UNIT VECTORS IN INERTIAL COORDINATES",
        ];
        let mut rest = text.as_str();
        for heading in headings {
            let found = rest.find(heading).unwrap_or_else(|| panic!("{heading} in\n{rest}"));
            rest = &rest[found + heading.len()..];
        }
    }

    #[test]
    fn both_tables_of_hinges_say_what_slides_have() {
        let said = |hinges: Vec<HingeLabel>| -> Vec<String> {
            let (mut bytes, units) = (Vec::new(), UnitSystem::FtLbfS);
            let writer = ListingWriter::new(&mut bytes, "masts", hinges, units, SPAN);
            writer.expect("memory").write(&snapshot(0.5)).expect("memory");
            let text = String::from_utf8(bytes).expect("text");
            let lines = text.lines().filter_map(|l| l.strip_prefix("SEGMENTS THAT SLIDE HAVE "));
            lines.map(str::to_owned).collect()
        };
        let mut hinges = fixture::labels();
        assert!(said(hinges.clone()).is_empty());
        hinges[1].joint = Joint::Prismatic;
        assert_eq!(said(hinges), ["LENGTHS (FT), NOT DEG", "FORCES (LBF), NOT TORQUES (FT LBF)"]);
    }

    #[test]
    fn angles_are_degrees_and_states_the_report_s() {
        let text = block();
        let row = |start: &str, nth: usize| -> Vec<String> {
            let line = text.lines().filter(|l| l.starts_with(start)).nth(nth).expect("a row");
            line.split_whitespace().map(str::to_owned).collect()
        };
        let motion = row("  1   2", 0);
        assert_eq!(motion[2..5], ["9.000000000E+01", "1.800000000E+02", "3.600000000E+02"]);
        assert_eq!(row("  1   1", 1)[2..4], ["-1", "-4.000000000E-01"]);
        assert_eq!(row("  2   1", 1)[2], "1");
        assert!(text.contains("NUTATION ANGLE (DEG)  4.500000000E+01"));
    }

    #[test]
    fn unit_vectors_are_the_columns_of_the_attitude() {
        let text = block();
        let x = text.lines().rfind(|line| line.starts_with('X')).expect("a row");
        let found: Vec<&str> = x.split_whitespace().skip(1).collect();
        let first_row = snapshot(0.5).attitude.to_matrix().rows[0].to_array().map(number);
        assert_eq!(found, first_row);
    }

    #[test]
    fn an_output_time_at_an_event_is_printed_once() {
        let text = listing(UnitSystem::None, |w| {
            let events =
                [event(0.5, EventKind::Release, Some(1)), event(0.5, EventKind::LockUp, Some(0))];
            w.write_instant(&events, &snapshot(0.5)).expect("memory");
            w.write(&snapshot(0.5)).expect("memory");
            w.write_instant(&[event(0.5, EventKind::End, None)], &snapshot(0.5)).expect("memory");
        });
        assert_eq!(text.matches("SYSTEM MOTION").count(), 1);
        let events: Vec<&str> = text.lines().filter(|l| l.starts_with("EVENT")).collect();
        assert_eq!(
            events,
            [
                "EVENT: LOCK-UP OF HINGE 1,1   IMPULSIVE TORQUE -2.500000000E-01 (L F T)",
                "EVENT: RELEASE OF HINGE 1,2",
                "EVENT: END OF RUN",
            ]
        );
    }
}
