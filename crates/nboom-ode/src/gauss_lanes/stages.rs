use nboom_scalar::{Eight, Work, vectorised};

use super::collocation::{Collocation, Columns, product};
use crate::gauss::coefficients::STAGES;
use crate::{Part, Role, System};

/// The stages of a step side by side: for each variable one number of each.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages {
    pub roles: Roles,
    /// K = h f(Y).
    pub slopes: Vec<Eight>,
    /// Y.
    pub values: Vec<Eight>,
    /// f(Y).
    pub derivatives: Vec<Eight>,
    /// One state and its derivative, for systems that take one at a time.
    pub argument: Vec<f64>,
    pub derivative: Vec<f64>,
}

/// Variables by their role.
#[derive(Clone, Debug, Default)]
pub(super) struct Roles {
    coupled: Vec<usize>,
    /// Each with the variable that is its derivative.
    pub integrals: Vec<(usize, usize)>,
    pub followers: Vec<usize>,
}

impl Roles {
    pub fn of(&self, part: Part) -> &[usize] {
        match part {
            Part::Coupled => &self.coupled,
            Part::Followers => &self.followers,
        }
    }

    /// Variables whose derivatives are evaluated.
    pub fn evaluated(&self) -> impl Iterator<Item = usize> {
        self.coupled.iter().chain(&self.followers).copied()
    }

    fn integrals_of(&self, part: Part) -> &[(usize, usize)] {
        if part == Part::Coupled { &self.integrals } else { &[] }
    }

    fn assign(&mut self, system: &dyn System, size: usize) {
        self.coupled.clear();
        self.integrals.clear();
        self.followers.clear();
        for i in 0..size {
            match system.role(i) {
                Role::Coupled => self.coupled.push(i),
                Role::Integral(of) => self.integrals.push((i, of)),
                Role::Follower => self.followers.push(i),
            }
        }
        debug_assert!(self.integrals.iter().all(|(_, of)| self.coupled.contains(of)));
    }
}

/// Where a step begins, and what its errors are measured in.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub state: &'a [f64],
    /// What rounding has taken from the variables.
    pub lost: &'a [f64],
    /// One over the error allowed, zero for variables that are not controlled.
    pub per_tolerance: &'a [f64],
}

impl Stages {
    pub fn start(&mut self, system: &dyn System, size: usize) {
        self.roles.assign(system, size);
        for buffer in [&mut self.slopes, &mut self.values, &mut self.derivatives] {
            buffer.clear();
            buffer.resize(size, Eight::default());
        }
        for buffer in [&mut self.argument, &mut self.derivative] {
            buffer.clear();
            buffer.resize(size, 0.0);
        }
    }

    /// Evaluates derivatives at the values; returns how many evaluations it took, followers'
    /// in lanes not counted.
    pub fn evaluate(&mut self, system: &mut dyn System, parts: &[Part], times: &Eight) -> usize {
        let Self { roles, values, derivatives, argument, derivative, .. } = self;
        let there_are = |part: &&Part| !roles.of(**part).is_empty();
        let mut in_lanes = |&part: &Part| system.derivatives(part, times, values, derivatives);
        if parts.iter().filter(there_are).all(&mut in_lanes) {
            return if parts.contains(&Part::Coupled) { STAGES } else { 0 };
        }
        for (lane, &time) in times.0.iter().enumerate() {
            for (one, of_all) in argument.iter_mut().zip(&*values) {
                *one = of_all.0[lane];
            }
            system.derivative(time, argument, derivative);
            for (of_all, one) in derivatives.iter_mut().zip(&*derivative) {
                of_all.0[lane] = *one;
            }
        }
        STAGES
    }

    /// Takes the derivatives of a part for its slopes; returns the largest change of a stage, as root
    /// of the sum of squares over the controlled variables, in units of the tolerance.
    pub fn absorb(&mut self, part: Part, step: f64, start: &Start<'_>) -> f64 {
        let Self { roles, slopes, derivatives, .. } = self;
        let (mut change, per_tolerance) = (0.0, start.per_tolerance);
        let members = roles.of(part);
        vectorised(Absorb {
            members,
            step,
            per_tolerance,
            derivatives,
            slopes,
            change: &mut change,
        });
        change.sqrt()
    }

    /// Puts the stages of a part where their slopes place them.
    pub fn place(&mut self, part: Part, step: f64, start: &Start<'_>, collocation: &Collocation) {
        let Self { roles, slopes, values, .. } = self;
        let (members, integrals) = (roles.of(part), roles.integrals_of(part));
        let matrix = &collocation.stages;
        vectorised(Place { members, integrals, step, start: *start, matrix, slopes, values });
    }

    /// Guesses slopes from those of another step, whose polynomial is continued from a fraction of it
    /// over `ratio` times its length.
    pub fn predict(&mut self, known: &[Eight], from: f64, ratio: f64, collocation: &Collocation) {
        let Self { roles, slopes, .. } = self;
        vectorised(Predict { roles, known, from, ratio, collocation, slopes });
    }
}

struct Absorb<'a> {
    members: &'a [usize],
    step: f64,
    per_tolerance: &'a [f64],
    derivatives: &'a [Eight],
    slopes: &'a mut [Eight],
    /// The largest sum of squares of a stage.
    change: &'a mut f64,
}

impl Work for Absorb<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let mut squares = [0.0; STAGES];
        for &i in self.members {
            let (weight, derivative) = (self.per_tolerance[i], &self.derivatives[i]);
            let slopes = &mut self.slopes[i];
            for lane in 0..STAGES {
                let slope = self.step * derivative.0[lane];
                let change = (slope - slopes.0[lane]) * weight;
                squares[lane] += change * change;
                slopes.0[lane] = slope;
            }
        }
        // Not a number stays what it is.
        let larger = |a: f64, b: f64| if b <= a { a } else { b };
        *self.change = squares.into_iter().fold(0.0, larger);
    }
}

struct Place<'a> {
    members: &'a [usize],
    integrals: &'a [(usize, usize)],
    step: f64,
    start: Start<'a>,
    matrix: &'a Columns<STAGES>,
    slopes: &'a mut [Eight],
    values: &'a mut [Eight],
}

impl Place<'_> {
    #[inline(always)]
    fn place(&mut self, i: usize) {
        let (state, lost) = (self.start.state[i], self.start.lost[i]);
        let increments = product(self.matrix, &self.slopes[i].0);
        self.values[i] = Eight(increments.map(|increment| state + (lost + increment)));
    }
}

impl Work for Place<'_> {
    #[inline(always)]
    fn carry_out(mut self) {
        for &i in self.members {
            self.place(i);
        }
        for &(i, of) in self.integrals {
            self.slopes[i] = Eight(self.values[of].0.map(|rate| self.step * rate));
            self.place(i);
        }
    }
}

struct Predict<'a> {
    roles: &'a Roles,
    known: &'a [Eight],
    from: f64,
    ratio: f64,
    collocation: &'a Collocation,
    slopes: &'a mut [Eight],
}

impl Work for Predict<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let matrix = self.collocation.continuation(self.from, self.ratio);
        for i in self.roles.evaluated() {
            self.slopes[i] = Eight(product(&matrix, &self.known[i].0));
        }
    }
}
