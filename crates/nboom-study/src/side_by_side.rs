//! Cases of one thread that run side by side.

use std::future::{Future, poll_fn};
use std::pin::pin;

use nboom_scalar::{Batch, Kernel};
use nboom_sim::{Lanes, Task};

use crate::cases::Cases;
use crate::selected::FirstSelected;
use crate::workers::Worker;
use crate::{Runner, Study};

/// Runs of one thread that go on at once. Twice as many fill a few more lanes, but what they need leaves less of a
/// core's cache.
const AT_ONCE: usize = 8;

impl Study {
    /// What runs cases in one thread, by this generated code, and tells which code computed them.
    pub(crate) fn worker<'s>(
        &'s self,
        kernels: &'static [Kernel],
        right_sides: &'static [Batch],
        selected: &'s FirstSelected,
    ) -> Worker<'s> {
        let at_once = if self.run.lanes { AT_ONCE } else { 1 };
        let first = Runner::new(self, kernels, right_sides).telling(selected);
        let others = (1..at_once).map(|_| first.beside());
        let mut runners: Vec<Runner<'_>> = others.collect();
        runners.push(first);
        let lanes = Lanes::new();
        Box::new(move |cases| {
            let task = |runner| -> Task<'_> { Box::pin(self.follow(runner, &lanes, cases)) };
            lanes.carry_out(runners.iter_mut().map(task).collect());
        })
    }

    /// Runs one case after the other, beside others that do the same.
    async fn follow(&self, runner: &mut Runner<'_>, lanes: &Lanes, cases: &Cases<'_>) {
        while let Some(number) = cases.next() {
            let case = self.case(number);
            let mut run = pin!(runner.run_in(lanes, &case, cases.interrupted()));
            let go_on = poll_fn(|context| {
                cases.go_on(number);
                run.as_mut().poll(context)
            });
            cases.add(number, go_on.await);
        }
    }
}
