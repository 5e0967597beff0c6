use std::ops::Range;

use crate::{System, Window};

/// f at the start and at the end of a step, evaluated when first asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct EndSlopes {
    start: Vec<f64>,
    end: Vec<f64>,
    knows_start: bool,
    knows_end: bool,
}

impl EndSlopes {
    pub fn reset(&mut self, size: usize) {
        for slope in [&mut self.start, &mut self.end] {
            slope.clear();
            slope.resize(size, 0.0);
        }
        (self.knows_start, self.knows_end) = (false, false);
    }

    /// The slope at the start.
    pub fn start(&mut self, system: &mut dyn System, window: &mut Window) -> &[f64] {
        if !self.knows_start {
            system.derivative(window.time, &window.state, &mut self.start);
            window.counts.evaluations += 1;
            self.knows_start = true;
        }
        &self.start
    }

    /// The slope at the start, if it was asked for.
    pub fn known_start(&self) -> Option<&[f64]> {
        self.knows_start.then_some(&self.start)
    }

    /// The slopes at the start and at the end.
    pub fn both(&mut self, system: &mut dyn System, window: &mut Window) -> [&[f64]; 2] {
        self.start(system, window);
        if !self.knows_end {
            system.derivative(window.end_time, &window.end_state, &mut self.end);
            window.counts.evaluations += 1;
            self.knows_end = true;
        }
        [&self.start, &self.end]
    }

    /// The step ends elsewhere.
    pub fn forget_end(&mut self) {
        self.knows_end = false;
    }

    pub fn advance(&mut self) {
        std::mem::swap(&mut self.start, &mut self.end);
        (self.knows_start, self.knows_end) = (self.knows_end, false);
    }

    pub fn scale(&mut self, range: Range<usize>, factor: f64) {
        self.start[range].iter_mut().for_each(|slope| *slope *= factor);
    }
}
