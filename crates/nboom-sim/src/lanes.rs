//! Where runs meet that take their steps side by side, one in each lane of a register.

use std::cell::RefCell;
use std::future::{Future, poll_fn};
use std::mem::{replace, take};
use std::pin::{Pin, pin};
use std::task::{Context, Poll, Waker};

use nboom_ode::{EightSteps, RungeKutta};
use nboom_scalar::Eight;

use crate::code::right_side::{RightSide, RightSides};
use crate::equations::layout::VariableLayout;

/// Where runs in one thread meet that take the steps of explicit methods side by side.
///
/// A run that has a step to take puts it into a lane and waits. Eight steps that the same code
/// evaluates are taken together, and when all runs wait, as many as there are. A step does not depend
/// on those beside it, so neither does a run.
#[derive(Default)]
pub struct Lanes {
    meeting: RefCell<Meeting>,
}

#[derive(Default)]
struct Meeting {
    packs: Vec<Pack>,
    /// The task that goes on at present.
    task: usize,
    /// Tasks whose step is taken.
    woken: Vec<usize>,
    /// Steps that were taken, and packs of them.
    taken: [usize; 2],
}

/// Steps that are taken together.
struct Pack {
    right_side: RightSide<Eight>,
    layout: VariableLayout,
    steps: EightSteps,
    /// Whose steps they are, lane by lane.
    tasks: Vec<usize>,
    /// How many have still to be fetched, once they are taken.
    waiting: Option<usize>,
    /// How often others came first.
    passed_over: usize,
}

/// How often a pack is passed over until that counts as much as one more step in it.
const PATIENCE: usize = 8;

/// A run, or several one after the other, that may take steps beside others.
pub type Task<'a> = Pin<Box<dyn Future<Output = ()> + 'a>>;

impl Lanes {
    /// Where no run has come yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Brings tasks to their ends, which meet here.
    pub fn carry_out(&self, mut tasks: Vec<Task<'_>>) {
        let mut context = Context::from_waker(Waker::noop());
        let mut left = tasks.len();
        let mut awake: Vec<usize> = (0..left).collect();
        loop {
            for task in awake.drain(..) {
                self.meeting.borrow_mut().task = task;
                left -= usize::from(tasks[task].as_mut().poll(&mut context).is_ready());
            }
            if left == 0 {
                return;
            }
            awake = self.meeting.borrow_mut().advance(awake);
        }
    }

    /// Brings one task to its end, beside which there is none.
    pub fn finish<T>(&self, task: impl Future<Output = T>) -> T {
        let mut context = Context::from_waker(Waker::noop());
        let mut task = pin!(task);
        loop {
            if let Poll::Ready(found) = task.as_mut().poll(&mut context) {
                return found;
            }
            let mut meeting = self.meeting.borrow_mut();
            let woken = take(&mut meeting.woken);
            meeting.woken = meeting.advance(woken);
            meeting.woken.clear();
        }
    }

    /// How many steps were taken here.
    pub fn steps(&self) -> usize {
        self.meeting.borrow().taken[0]
    }

    /// How many packs they were taken in, each of which has eight lanes.
    pub fn packs(&self) -> usize {
        self.meeting.borrow().taken[1]
    }

    /// Takes a step of this length by `explicit`, whatever its error, `with_dense` with the stages for dense
    /// output, in a mode with these right sides, which take eight states. Returns how many evaluations it
    /// took.
    pub(crate) async fn step(
        &self,
        explicit: &mut RungeKutta,
        (right_sides, layout): (&RightSides, &VariableLayout),
        (length, with_dense): (f64, bool),
    ) -> usize {
        let joined = self.meeting.borrow_mut().join(explicit, right_sides, layout, with_dense);
        let Some(pack) = joined else { return 0 };
        let lane = self.meeting.borrow_mut().packs[pack].put(explicit, right_sides, length);
        turn().await;
        self.meeting.borrow_mut().packs[pack].fetch(lane, explicit)
    }
}

/// Waits until the task goes on.
async fn turn() {
    let mut has_waited = false;
    let wait = |_: &mut Context<'_>| {
        if replace(&mut has_waited, true) { Poll::Ready(()) } else { Poll::Pending }
    };
    poll_fn(wait).await;
}

impl Meeting {
    /// A pack with a lane free for a step of `explicit`, which the task now has; none where no code takes
    /// eight states.
    fn join(
        &mut self,
        explicit: &RungeKutta,
        right_sides: &RightSides,
        layout: &VariableLayout,
        with_dense: bool,
    ) -> Option<usize> {
        let suits = |pack: &Pack| {
            pack.layout == *layout
                && pack.steps.are_like(explicit, with_dense)
                && right_sides.are_like(&pack.right_side)
        };
        let open = |pack: &Pack| pack.waiting.is_none() && pack.tasks.len() < 8;
        let idle = |pack: &Pack| pack.waiting == Some(0);
        let place = self.packs.iter().position(|pack| open(pack) && suits(pack));
        let place = place.or_else(|| self.packs.iter().position(|pack| idle(pack) && suits(pack)));
        let place = match place {
            Some(place) => place,
            None => {
                let pack = Pack {
                    right_side: right_sides.of_eight_scenes()?,
                    layout: *layout,
                    steps: EightSteps::like(explicit, with_dense),
                    tasks: Vec::with_capacity(8),
                    waiting: None,
                    passed_over: 0,
                };
                self.packs.push(pack);
                self.packs.len() - 1
            }
        };
        let pack = &mut self.packs[place];
        if pack.waiting.take().is_some() {
            pack.tasks.clear();
            pack.passed_over = 0;
        }
        pack.tasks.push(self.task);
        Some(place)
    }

    /// Takes the steps of one pack, the fullest unless others have waited for long; adds to `woken` whose they
    /// are.
    fn advance(&mut self, mut woken: Vec<usize>) -> Vec<usize> {
        let open = self.packs.iter_mut().filter(|pack| pack.waiting.is_none());
        let urgency = |pack: &&mut Pack| PATIENCE * pack.tasks.len() + pack.passed_over;
        if let Some(next) = open.max_by_key(urgency) {
            next.take();
            self.taken[0] += next.tasks.len();
            self.taken[1] += 1;
            woken.extend(&next.tasks);
        }
        self.packs.iter_mut().for_each(|pack| pack.passed_over += 1);
        woken
    }
}

impl Pack {
    /// Puts a step into the lane that was kept for it last; returns which.
    fn put(&mut self, explicit: &RungeKutta, right_sides: &RightSides, length: f64) -> usize {
        let lane = self.tasks.len() - 1;
        self.steps.put(lane, explicit, length);
        right_sides.write_to(lane, &mut self.right_side);
        lane
    }

    /// Takes the steps.
    fn take(&mut self) {
        let Self { right_side, layout, steps, tasks, waiting, .. } = self;
        if tasks.len() < 8 {
            steps.repeat_first_from(tasks.len());
            right_side.repeat_first_from(tasks.len());
        }
        steps.take(|_, y, dy| {
            let power = right_side.write(y, dy);
            if let [work] = &mut dy[layout.dashpot_work()] {
                *work = power;
            }
        });
        *waiting = Some(tasks.len());
    }

    /// Gives `explicit` the step in a lane; returns how many evaluations it took.
    fn fetch(&mut self, lane: usize, explicit: &mut RungeKutta) -> usize {
        self.steps.get(lane, explicit);
        self.waiting = self.waiting.map(|waiting| waiting - 1);
        self.steps.evaluations()
    }
}
