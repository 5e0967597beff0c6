//! Latches and stops spread their impulses over time.

use std::f64::consts::{FRAC_PI_2, PI};

use nboom_sim::EventKind;

/// The assumed shape of pulses over time, eq. (10.13).
///
/// A pulse starts when its hinge locks or hits its stop, and its peak is the impulse over the pulse constant c.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PulseShape {
    /// Half a sine, which lasts π c/2.
    #[default]
    HalfSine,
    /// Anything from zero to the peak while a half-sine would last: pulses that overlap may peak
    /// together, and each may be zero, whichever is worst.
    AllAtOnce,
}

impl PulseShape {
    /// All.
    pub const ALL: [Self; 2] = [Self::HalfSine, Self::AllAtOnce];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::HalfSine => "half-sine",
            Self::AllAtOnce => "all-at-once",
        }
    }

    /// The one with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// How long a pulse of constant c lasts.
    pub fn duration(self, constant: f64) -> f64 {
        (FRAC_PI_2 * constant).min(LONGEST)
    }

    /// Share of the peak after `phase` of the duration, from 0 to 1.
    fn at(self, phase: f64) -> f64 {
        match self {
            Self::HalfSine => (PI * phase).sin().max(0.0),
            Self::AllAtOnce => 1.0,
        }
    }
}

/// An upper bound of all durations, so that sums of times are finite.
const LONGEST: f64 = f64::MAX / 4.0;

/// Something that began at a lock-up or an impact and lasts for some time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    /// Its age at the last instant in which a hinge locked or hit its stop.
    age: f64,
    duration: f64,
}

impl Course {
    fn end(&self) -> f64 {
        self.duration - self.age
    }
}

/// What a latch or a stop adds to all loads at the peak of its pulse.
#[derive(Clone, Debug)]
pub(crate) struct Pulse {
    pub hinge: usize,
    /// A lock-up or an impact.
    pub kind: EventKind,
    course: Course,
    pub peak: Vec<f64>,
}

/// Loads of the motion on one side of a lock-up or an impact, which represent those during its pulses.
#[derive(Clone, Debug)]
pub(crate) struct Side {
    course: Course,
    pub loads: Vec<f64>,
}

/// Current pulses, in times since the last instant in which a hinge locked or hit its stop, since a pulse may
/// be shorter than the spacing of times.
#[derive(Clone, Debug)]
pub(crate) struct Pulses {
    shape: PulseShape,
    /// The last instant in which a hinge locked or hit its stop.
    pub since: f64,
    active: Vec<Pulse>,
    sides: Vec<Side>,
}

impl Pulses {
    pub fn new(shape: PulseShape) -> Self {
        Self { shape, since: 0.0, active: Vec::new(), sides: Vec::new() }
    }

    /// Counts from the instant at `time`.
    pub fn start_at(&mut self, time: f64) {
        let passed = time - self.since;
        self.since = time;
        let courses = self.active.iter_mut().map(|pulse| &mut pulse.course);
        let of_sides = self.sides.iter_mut().map(|side| &mut side.course);
        courses.chain(of_sides).for_each(|course| course.age += passed);
        self.forget_until(0.0);
    }

    /// Drops what is over at `u`.
    pub fn forget_until(&mut self, u: f64) {
        self.active.retain(|pulse| pulse.course.end() > u);
        self.sides.retain(|side| side.course.end() > u);
    }

    /// Adds the pulse of a hinge at this instant, and returns how long it lasts.
    pub fn add(&mut self, (hinge, kind): (usize, EventKind), constant: f64, peak: Vec<f64>) -> f64 {
        let duration = self.shape.duration(constant);
        self.active.push(Pulse { hinge, kind, course: Course { age: 0.0, duration }, peak });
        duration
    }

    /// Lets the loads on one side of this instant represent those during pulses of this duration.
    pub fn add_side(&mut self, duration: f64, loads: Vec<f64>) {
        self.sides.push(Side { course: Course { age: 0.0, duration }, loads });
    }

    /// The pulses that may act together over an interval from `from` on in which no pulse starts,
    /// peaks or ends.
    ///
    /// Norms are convex, so with pulses between zero and their peaks the worst case has each at
    /// zero or at its peak.
    pub fn acting(&self, from: f64) -> impl Iterator<Item = Acting<'_>> {
        let apart = match self.shape {
            PulseShape::HalfSine => 0,
            PulseShape::AllAtOnce => self.going_on(from).count().min(MOST_APART),
        };
        (0..1 << apart).map(move |left_out| Acting { pulses: self, from, left_out })
    }

    fn going_on(&self, u: f64) -> impl Iterator<Item = &Pulse> {
        self.active.iter().filter(move |pulse| pulse.course.end() > u)
    }

    /// The sides that represent the motion from `u` on.
    pub fn sides(&self, u: f64) -> impl Iterator<Item = &Side> {
        self.sides.iter().filter(move |side| side.course.end() > u)
    }

    /// When the last of them ends.
    pub fn end(&self) -> f64 {
        self.active.iter().map(|pulse| pulse.course.end()).fold(0.0, f64::max)
    }

    /// The next peak or end of a pulse after `u`; none after all of them.
    pub fn next_after(&self, u: f64) -> Option<f64> {
        let courses = self.active.iter().map(|pulse| pulse.course);
        let peaks_and_ends = courses.flat_map(|c| [0.5 * c.duration - c.age, c.end()]);
        peaks_and_ends.filter(|next| *next > u).min_by(f64::total_cmp)
    }
}

/// Beyond this number, pulses act together or not at all in the search for the worst combination.
const MOST_APART: usize = 10;

/// Pulses that act together over an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Acting<'a> {
    pulses: &'a Pulses,
    /// Where the interval starts.
    from: f64,
    /// A bit for each current pulse that does not act.
    left_out: u32,
}

impl<'a> Acting<'a> {
    /// The time at `u`.
    pub fn time(&self, u: f64) -> f64 {
        self.pulses.since + u
    }

    /// Those that act.
    pub fn pulses(&self) -> impl Iterator<Item = &'a Pulse> + use<'a> {
        let left_out = self.left_out;
        let acts = move |i: usize| (left_out >> i.min(MOST_APART - 1)) & 1 == 0;
        let going_on = self.pulses.going_on(self.from).enumerate();
        going_on.filter(move |(i, _)| acts(*i)).map(|(_, pulse)| pulse)
    }

    /// Whether they rise and fall alike, so that together they are a multiple of one load, which
    /// only grows or only shrinks over the interval.
    pub fn share_a_course(&self) -> bool {
        let mut courses = self.pulses().map(|pulse| pulse.course);
        let first = courses.next();
        self.pulses.shape == PulseShape::AllAtOnce || courses.all(|course| Some(course) == first)
    }

    /// Share of its peak that a pulse has at `u`.
    pub fn share(&self, pulse: &Pulse, u: f64) -> f64 {
        let Course { age, duration } = pulse.course;
        self.pulses.shape.at((age + u) / duration)
    }

    /// Adds their loads at `u` to `row`.
    pub fn add_to(&self, row: &mut [f64], u: f64) {
        for pulse in self.pulses() {
            let share = self.share(pulse, u);
            row.iter_mut().zip(&pulse.peak).for_each(|(sum, part)| *sum += share * part);
        }
    }
}
