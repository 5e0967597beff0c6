use std::env;
use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressStyle};
use nboom_model::Scene;

const PARTS: u64 = 1000;

/// How far the run has come, on a terminal's standard error; elsewhere nothing.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    start: f64,
    span: f64,
}

impl Progress {
    pub(crate) fn of(scene: &Scene, quiet: bool) -> Self {
        Self {
            bar: bar(PARTS, quiet),
            start: scene.initial.time,
            span: scene.end_time - scene.initial.time,
        }
    }

    pub(crate) fn reach(&self, time: f64) {
        let share = ((time - self.start) / self.span).clamp(0.0, 1.0);
        self.bar.set_position((share * PARTS as f64) as u64);
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// How many cases of a sweep are done, likewise.
#[derive(Debug)]
pub(crate) struct Cases {
    bar: ProgressBar,
}

impl Cases {
    pub(crate) fn new(quiet: bool) -> Self {
        Self { bar: bar(0, quiet) }
    }

    pub(crate) fn reach(&self, done: u64, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(done);
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn bar(length: u64, quiet: bool) -> ProgressBar {
    let is_dumb = env::var_os("TERM").is_some_and(|kind| kind == "dumb");
    if quiet || is_dumb || !io::stderr().is_terminal() {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(length).with_style(style())
    }
}

fn style() -> ProgressStyle {
    let template = "{wide_bar} {percent:>3} %  {elapsed}, about {eta} left";
    ProgressStyle::with_template(template).expect("the template is well formed")
}
