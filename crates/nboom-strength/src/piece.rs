//! Intervals of time in which the loads of motion and pulses are smooth.

use nboom_sim::StepMotion;

use crate::StrengthError;
use crate::finder::LoadFinder;
use crate::gauge::Gauge;
use crate::pulse::{Acting, Pulses};
use crate::record::Records;
use crate::search::{Loaded, Search};

/// Loads of the motion alone.
pub(crate) enum OfMotion<'a> {
    /// Those of a step.
    Step(&'a mut dyn StepMotion, &'a mut LoadFinder),
    /// Always the same.
    Standing(&'a [f64]),
}

/// An interval in which the loads of the motion are smooth and no pulse starts, peaks or ends; in
/// times since the last instant in which a hinge locked.
struct Piece<'a> {
    motion: OfMotion<'a>,
    acting: Acting<'a>,
    records: &'a mut Records,
}

impl Loaded for Piece<'_> {
    fn write(&mut self, u: f64, row: &mut [f64]) -> Result<(), StrengthError> {
        match &mut self.motion {
            OfMotion::Standing(loads) => row.copy_from_slice(loads),
            OfMotion::Step(step, finder) => {
                let [start, end] = step.span();
                let time = self.acting.time(u).clamp(start, end);
                finder.write_within(*step, time, row)?;
            }
        }
        self.acting.add_to(row, u);
        Ok(())
    }

    fn largest(&self, g: usize) -> f64 {
        self.records.largest(g)
    }

    fn largest_of_kind(&self, g: usize) -> f64 {
        self.records.largest_of_kind(g)
    }

    fn keep(
        &mut self,
        g: usize,
        gauge: &Gauge,
        value: f64,
        u: f64,
        row: &[f64],
    ) -> Result<(), StrengthError> {
        self.records.keep((g, gauge), value, (self.acting, u), row)
    }
}

/// Searches the largest loads of motion and pulses in a step.
///
/// # Errors
/// When the loads contradict the motion, or are no numbers.
pub(crate) fn search_step(
    search: &mut Search,
    step: &mut dyn StepMotion,
    finder: &mut LoadFinder,
    pulses: &Pulses,
    records: &mut Records,
) -> Result<(), StrengthError> {
    let span = step.span().map(|time| time - pulses.since);
    for_each_piece(pulses, span, |from, to| {
        pulses.acting(from).try_for_each(|acting| {
            let motion = OfMotion::Step(&mut *step, &mut *finder);
            search.over([from, to], &mut Piece { motion, acting, records })
        })
    })
}

/// Searches the largest loads of pulses from the last instant in which a hinge locked to `end`, on the
/// loads that represent the motion.
///
/// # Errors
/// When a load or stress is infinite.
pub(crate) fn search_pulses(
    search: &mut Search,
    end: f64,
    pulses: &Pulses,
    records: &mut Records,
) -> Result<(), StrengthError> {
    let span = [0.0, end.min(pulses.end())];
    // Ends come first: little is larger in between.
    for_each_of_pulses(pulses, span, |ends, loads, acting| {
        search.at_ends(ends, &mut Piece { motion: OfMotion::Standing(loads), acting, records })
    })?;
    for_each_of_pulses(pulses, span, |ends, loads, acting| {
        // Along a line a norm is largest at an end.
        if acting.share_a_course() {
            return Ok(());
        }
        search.over(ends, &mut Piece { motion: OfMotion::Standing(loads), acting, records })
    })
}

/// Looks at every piece with the loads that represent the motion and the pulses that act on them.
fn for_each_of_pulses(
    pulses: &Pulses,
    span: [f64; 2],
    mut look: impl FnMut([f64; 2], &[f64], Acting<'_>) -> Result<(), StrengthError>,
) -> Result<(), StrengthError> {
    for_each_piece(pulses, span, |from, to| {
        pulses.sides(from).try_for_each(|side| {
            pulses.acting(from).try_for_each(|acting| look([from, to], &side.loads, acting))
        })
    })
}

fn for_each_piece(
    pulses: &Pulses,
    [start, end]: [f64; 2],
    mut look: impl FnMut(f64, f64) -> Result<(), StrengthError>,
) -> Result<(), StrengthError> {
    let mut from = start;
    while from < end {
        let to = pulses.next_after(from).map_or(end, |next| next.min(end));
        look(from, to)?;
        from = to;
    }
    Ok(())
}
