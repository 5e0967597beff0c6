use std::cmp::Ordering;
use std::io::{self, Write};

use nboom_elements::Kind;
use nboom_model::HingeLabel;
use nboom_sim::{Event, EventKind};

use crate::Headings;
use crate::heads::{Head, Holds};
use crate::number::{field, number};

/// Columns of the table of events of these hinges.
pub fn event_heads(hinges: &[HingeLabel]) -> Vec<Head> {
    let slides = hinges.iter().filter(|hinge| hinge.joint.slides()).count();
    let impulse = match slides {
        0 => Holds::Number("F L T"),
        all if all == hinges.len() => Holds::Number("F T"),
        _ => Holds::Various,
    };
    vec![
        Head::time("time"),
        Head::text("kind", "what happens"),
        Head::count("appendage", "appendage of the hinge, from 1"),
        Head::count("segment", "segment of the hinge, from 1"),
        Head::of(
            "impulse",
            impulse,
            "impulsive torque of a lock-up or an impact, of a slide the impulsive force in the unit of \
             force times that of time",
        ),
        Head::number(
            "energy_before",
            "F L",
            "kinetic energy before; lock-ups and impacts of one instant share it",
        ),
        Head::number("energy_after", "F L", "kinetic energy after"),
    ]
}

/// Order of events in files: by time; within an instant lock-ups, impacts, releases, others, what friction and
/// stops do; then by hinge, those of no hinge last.
pub fn event_order(a: &Event, b: &Event) -> Ordering {
    let place = |event: &Event| {
        let hinge = event.hinge.unwrap_or(usize::MAX);
        (rank(event.kind), hinge, event.kind)
    };
    a.time.total_cmp(&b.time).then_with(|| place(a).cmp(&place(b)))
}

fn rank(kind: EventKind) -> u8 {
    match kind {
        EventKind::LockUp => 0,
        EventKind::Impact => 1,
        EventKind::Release => 2,
        EventKind::Stick
        | EventKind::Slip
        | EventKind::Rest
        | EventKind::Leave
        | EventKind::Rise(Kind::Friction)
        | EventKind::Fall(Kind::Friction) => 4,
        EventKind::Rise(_) | EventKind::Fall(_) | EventKind::ThrustOn | EventKind::ThrustOff => 3,
        EventKind::End => 5,
    }
}

/// Writes the table of events, and passes every row to the system at once.
#[derive(Debug)]
pub struct EventsWriter<W> {
    out: W,
    hinges: Vec<HingeLabel>,
}

impl<W: Write> EventsWriter<W> {
    /// Writes the header; `hinges` has the label of every hinge of the scene.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn new(mut out: W, hinges: Vec<HingeLabel>, headings: &Headings) -> io::Result<Self> {
        writeln!(out, "{}", headings.line(&event_heads(&hinges)))?;
        out.flush()?;
        Ok(Self { out, hinges })
    }

    /// Writes the events of one instant, sorted by [`event_order`].
    ///
    /// # Errors
    /// When `out` refuses them.
    pub fn write_instant(&mut self, events: &[Event]) -> io::Result<()> {
        let mut sorted = events.to_vec();
        sorted.sort_by(event_order);
        sorted.iter().try_for_each(|event| self.write(event))?;
        self.out.flush()
    }

    fn write(&mut self, event: &Event) -> io::Result<()> {
        let out = &mut self.out;
        number(out, event.time)?;
        write!(out, ",{}", event.kind.name())?;
        match event.hinge.map(|i| self.hinges[i].numbers()) {
            Some([appendage, segment]) => write!(out, ",{appendage},{segment}")?,
            None => write!(out, ",,")?,
        }
        match event.impulse {
            Some(impulse) => field(out, impulse)?,
            None => write!(out, ",")?,
        }
        field(out, event.before.kinetic_energy)?;
        field(out, event.after.kinetic_energy)?;
        writeln!(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{self, event};
    use nboom_elements::Kind;
    use nboom_model::{Joint, UnitSystem};

    fn table(instants: &[&[Event]]) -> String {
        let mut bytes = Vec::new();
        let mut writer =
            EventsWriter::new(&mut bytes, fixture::labels(), &Headings::default()).expect("memory");
        for instant in instants {
            writer.write_instant(instant).expect("memory");
        }
        String::from_utf8(bytes).expect("text")
    }

    #[test]
    fn rows_of_an_instant_are_sorted_by_what_happens_and_then_by_hinge() {
        use EventKind::{End, Impact, Leave, LockUp, Release, Rest, Rise, ThrustOff};
        let text = table(&[&[
            event(1.5, End, None),
            event(1.5, Leave, Some(1)),
            event(1.5, Rest, Some(0)),
            event(1.5, Rise(Kind::KickOff), Some(1)),
            event(1.5, ThrustOff, None),
            event(1.5, Release, Some(1)),
            event(1.5, Impact, Some(1)),
            event(1.5, LockUp, Some(2)),
            event(1.5, Impact, Some(0)),
            event(1.5, Release, Some(0)),
            event(1.5, LockUp, Some(0)),
        ]]);
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!(rows[0], "t,kind,appendage,segment,impulse,energy_before,energy_after");
        assert_eq!(
            rows[1..],
            [
                "1.5,lock_up,1,1,-0.25,3.0,2.0",
                "1.5,lock_up,2,1,-0.25,3.0,2.0",
                "1.5,impact,1,1,-0.25,3.0,2.0",
                "1.5,impact,1,2,-0.25,3.0,2.0",
                "1.5,release,1,1,,3.0,2.0",
                "1.5,release,1,2,,3.0,2.0",
                "1.5,kick_off_disengage,1,2,,3.0,2.0",
                "1.5,thrust_off,,,,3.0,2.0",
                "1.5,rest,1,1,,3.0,2.0",
                "1.5,leave,1,2,,3.0,2.0",
                "1.5,end,,,,3.0,2.0",
            ]
        );
    }

    #[test]
    fn an_impulse_has_a_unit_where_all_hinges_have_the_same() {
        let unit = |slides: [bool; 2]| {
            let hinges = slides.map(|slides| HingeLabel {
                joint: if slides { Joint::Prismatic } else { Joint::Revolute },
                ..HingeLabel::new(0, 0)
            });
            let heads = event_heads(&hinges);
            let impulse = heads.iter().find(|head| head.name == "impulse").expect("a column");
            impulse.unit(&UnitSystem::Si)
        };
        assert_eq!(unit([false; 2]).as_deref(), Some("N m s"));
        assert_eq!(unit([true; 2]).as_deref(), Some("N s"));
        assert_eq!(unit([true, false]), None);
    }

    #[test]
    fn time_comes_before_kind() {
        let early = event(1.0, EventKind::ThrustOn, None);
        let late = event(2.0, EventKind::LockUp, Some(0));
        assert_eq!(event_order(&early, &late), Ordering::Less);
    }
}
