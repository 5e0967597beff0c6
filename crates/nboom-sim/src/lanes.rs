//! Where runs meet that take their steps side by side, one in each lane of a register.

use std::cell::RefCell;
use std::fmt;
use std::future::{Future, poll_fn};
use std::mem::take;
use std::pin::{Pin, pin};
use std::task::{Context, Poll, Waker};
use std::thread::yield_now;

use nboom_ode::{EightSteps, RungeKutta};
use nboom_scalar::Eight;

use crate::code::right_side::{RightSide, RightSides};
use crate::equations::layout::VariableLayout;

/// Where runs in one thread meet that take the steps of explicit methods side by side.
///
/// A run that has a step to take puts it into a lane and waits. Eight steps that the same code
/// evaluates are taken together, and when all runs wait, as many as there are. A step does not depend
/// on those beside it, so neither does a run. Where no task is carried out, each step is taken at once.
#[derive(Default)]
pub struct Lanes {
    meeting: RefCell<Meeting>,
}

impl fmt::Debug for Lanes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let meeting = self.meeting.borrow();
        let [steps, packs] = meeting.taken;
        f.debug_struct("Lanes")
            .field("steps", &steps)
            .field("packs", &packs)
            .finish_non_exhaustive()
    }
}

#[derive(Default)]
struct Meeting {
    /// Whether tasks are carried out here.
    is_open: bool,
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
    /// Whose steps they are, lane by lane; of one that was given up, nobody's.
    tasks: Vec<Option<usize>>,
    /// How many have still to be fetched, once they are taken.
    waiting: Option<usize>,
    /// How often its lanes were all made free.
    round: usize,
    /// How often others came first.
    passed_over: usize,
}

/// How often a pack is passed over until that counts as much as one more step in it.
const PATIENCE: usize = 8;

/// A run, or several one after the other, that may take steps beside others. A task that waits for something else is
/// polled until it is ready.
pub type Task<'a> = Pin<Box<dyn Future<Output = ()> + 'a>>;

impl Lanes {
    /// Where no run has come yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Brings tasks to their ends, which meet here.
    ///
    /// # Panics
    /// Where one of the tasks carries out others in the same lanes.
    pub fn carry_out(&self, tasks: Vec<Task<'_>>) {
        let _open = Opened::new(self);
        let mut context = Context::from_waker(Waker::noop());
        let mut awake: Vec<usize> = (0..tasks.len()).collect();
        let mut tasks: Vec<Option<Task<'_>>> = tasks.into_iter().map(Some).collect();
        loop {
            for number in awake.drain(..) {
                self.meeting.borrow_mut().task = number;
                let polled = tasks[number].as_mut().map(|task| task.as_mut().poll(&mut context));
                if polled.is_some_and(|polled| polled.is_ready()) {
                    tasks[number] = None;
                }
            }
            if tasks.iter().all(Option::is_none) {
                return;
            }
            awake = self.meeting.borrow_mut().advance(awake);
            if awake.is_empty() {
                yield_now();
                awake.extend(0..tasks.len());
            }
        }
    }

    /// Brings one task to its end, beside which there is none.
    ///
    /// # Panics
    /// As [`carry_out`](Self::carry_out).
    pub fn finish<T>(&self, task: impl Future<Output = T>) -> T {
        let _open = Opened::new(self);
        let mut context = Context::from_waker(Waker::noop());
        let mut task = pin!(task);
        loop {
            if let Poll::Ready(found) = task.as_mut().poll(&mut context) {
                return found;
            }
            let mut meeting = self.meeting.borrow_mut();
            let woken = take(&mut meeting.woken);
            meeting.woken = meeting.advance(woken);
            if meeting.woken.is_empty() {
                yield_now();
            }
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
        let lane = self.meeting.borrow_mut().put(pack, explicit, right_sides, length);
        let round = self.meeting.borrow().packs[pack].round;
        let place = Lane { lanes: self, pack, round, lane };
        poll_fn(|_| if place.is_taken() { Poll::Ready(()) } else { Poll::Pending }).await;
        let Pack { steps, .. } = &self.meeting.borrow().packs[pack];
        steps.get(lane, explicit);
        steps.evaluations()
    }
}

/// Lanes in which tasks are carried out. Nothing of them is left there at the end, however it comes.
struct Opened<'a>(&'a Lanes);

impl<'a> Opened<'a> {
    fn new(lanes: &'a Lanes) -> Self {
        let was_open = std::mem::replace(&mut lanes.meeting.borrow_mut().is_open, true);
        assert!(!was_open, "a task carries out others in the lanes in which it is carried out");
        Self(lanes)
    }
}

impl Drop for Opened<'_> {
    fn drop(&mut self) {
        let mut meeting = self.0.meeting.borrow_mut();
        meeting.is_open = false;
        meeting.packs.iter_mut().for_each(Pack::clear);
    }
}

/// A lane that has a step, until it is fetched or given up.
struct Lane<'a> {
    lanes: &'a Lanes,
    pack: usize,
    /// The round of the pack.
    round: usize,
    lane: usize,
}

impl Lane<'_> {
    /// Whether the step is taken. Who asks too early asks again.
    fn is_taken(&self) -> bool {
        let pack = &self.lanes.meeting.borrow().packs[self.pack];
        assert!(pack.round == self.round, "a run goes on after the tasks that it was one of");
        pack.waiting.is_some()
    }
}

impl Drop for Lane<'_> {
    fn drop(&mut self) {
        let pack = &mut self.lanes.meeting.borrow_mut().packs[self.pack];
        if pack.round == self.round {
            pack.leave(self.lane);
        }
    }
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
                    round: 0,
                    passed_over: 0,
                };
                self.packs.push(pack);
                self.packs.len() - 1
            }
        };
        let pack = &mut self.packs[place];
        if pack.waiting.is_some() {
            pack.clear();
            pack.waiting = None;
        }
        pack.tasks.push(Some(self.task));
        Some(place)
    }

    /// Puts a step into the lane that was kept for it last; returns which. Nobody waits for others where no task is
    /// carried out.
    fn put(
        &mut self,
        pack: usize,
        explicit: &RungeKutta,
        right_sides: &RightSides,
        length: f64,
    ) -> usize {
        let Self { packs, is_open, taken, .. } = self;
        let pack = &mut packs[pack];
        let lane = pack.put(explicit, right_sides, length);
        if !*is_open {
            pack.take();
            taken[0] += 1;
            taken[1] += 1;
        }
        lane
    }

    /// Takes the steps of one pack, the fullest unless others have waited for long; adds to `woken` whose they
    /// are.
    fn advance(&mut self, mut woken: Vec<usize>) -> Vec<usize> {
        let open = self.packs.iter_mut().filter(|pack| pack.waiting.is_none());
        let urgency = |pack: &&mut Pack| PATIENCE * pack.tasks.len() + pack.passed_over;
        if let Some(next) = open.max_by_key(urgency) {
            next.take();
            let before = woken.len();
            woken.extend(next.tasks.iter().flatten());
            self.taken[0] += woken.len() - before;
            self.taken[1] += 1;
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
        *waiting = Some(tasks.iter().flatten().count());
    }

    /// Waits no longer for a lane.
    fn leave(&mut self, lane: usize) {
        match &mut self.waiting {
            Some(waiting) => *waiting -= 1,
            None => self.tasks[lane] = None,
        }
    }

    /// Makes all lanes free.
    fn clear(&mut self) {
        self.tasks.clear();
        self.waiting = Some(0);
        self.round += 1;
        self.passed_over = 0;
    }
}
