use nboom_model::{HingeState, Mode, Release, Scene};
use nboom_scalar::Number;

/// The times at which the scene itself changes the mode, of releases, of what acts from outside and
/// of prescribed motions; and that at which a control law is asked next.
#[derive(Clone, Debug)]
pub(crate) struct Schedule<R> {
    /// When each hinge is released if it is unreleased then; infinite as long as that is not known.
    releases: Vec<R>,
    /// When the control law is asked next; infinite without one.
    pub sample: f64,
}

impl<R: Number> Schedule<R> {
    /// With room for that of `scene`; [`begin`](Self::begin) writes it.
    pub fn new(scene: &Scene) -> Self {
        let releases = vec![R::constant(f64::INFINITY); scene.bodies.len()];
        Self { releases, sample: f64::INFINITY }
    }

    /// Makes it that of the beginning of `scene`.
    pub fn begin(&mut self, scene: &Scene) {
        let starts_locked =
            |hinge: usize| scene.bodies[hinge].hinge.start.state == HingeState::Locked;
        let at = |release| match release {
            Release::Time(at) => R::constant(at),
            Release::AfterLock { hinge, delay } if starts_locked(hinge) => {
                R::constant(scene.initial.time) + R::constant(delay)
            }
            _ => R::constant(f64::INFINITY),
        };
        self.sample = f64::INFINITY;
        self.releases.clear();
        self.releases.extend(scene.bodies.iter().map(|body| at(body.hinge.release)));
    }

    /// Enters the releases that wait for the lock-ups of the hinges `locks` at `time`.
    pub fn note_lock_ups(&mut self, scene: &Scene, locks: &[usize], time: R) {
        for (at, body) in self.releases.iter_mut().zip(&scene.bodies) {
            if let Release::AfterLock { hinge, delay } = body.hinge.release
                && locks.contains(&hinge)
            {
                *at = time + R::constant(delay);
            }
        }
    }

    /// Whether hinge `i` is released up to `time`, if it is unreleased until then.
    pub fn releases_by(&self, time: f64, i: usize) -> bool {
        self.releases[i].to_f64() <= time
    }

    /// The next time after `time` at which the scene itself changes `mode` or a control law is
    /// asked, or its end.
    pub fn next(&self, scene: &Scene, mode: &Mode, time: f64) -> R {
        let unreleased = |(_, state): &(&R, &HingeState)| **state == HingeState::Unreleased;
        let releases = self.releases.iter().zip(&mode.hinges).filter(unreleased).map(|(&at, _)| at);
        let courses = scene.externals.iter().zip(&mode.externals);
        let changes = courses.filter_map(|(one, &piece)| one.course.end_of(piece));
        let rotors = scene.rotors.iter().zip(&mode.rotors);
        let bends = rotors.filter_map(|(rotor, &piece)| rotor.speed.end_of(piece));
        let changes = changes.chain(scene.base.end_of(mode.drive)).chain(bends);
        let sample = [R::constant(self.sample)];
        let later =
            releases.chain(changes.map(R::constant)).chain(sample).filter(|at| at.to_f64() > time);
        let end = R::constant(scene.end_time);
        later.fold(end, |first, at| if at.to_f64() < first.to_f64() { at } else { first })
    }
}
