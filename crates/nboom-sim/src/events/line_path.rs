//! A line's length over a step.

use nboom_dynamics::Recursive;
use nboom_ode::Bernstein;
use nboom_scalar::{Eight, EightNumbers, WorkOnEight, in_registers};

/// The free hinges that move a line's end, with their angles over a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinePath {
    line: usize,
    /// Positions among the free hinges, and angles.
    hinges: Vec<(usize, Bernstein)>,
    /// How far the hinges move together, at most: radians, and what slides as a share of the length.
    pub turned: f64,
}

impl LinePath {
    /// Makes room for so many hinges that move a line.
    pub fn make_room(&mut self, hinges: usize) {
        self.hinges.clear();
        self.hinges.reserve(hinges);
    }

    /// Takes up `line` over a step in which `angle` gives the angle of each free hinge.
    pub fn follow(
        &mut self,
        dynamics: &Recursive<f64>,
        line: usize,
        mut angle: impl FnMut(usize) -> Bernstein,
    ) {
        self.hinges.clear();
        (self.line, self.turned) = (line, 0.0);
        let mut slid = 0.0;
        for (hinge, joint) in dynamics.line_joints(line) {
            let angle = angle(hinge);
            *(if joint.slides() { &mut slid } else { &mut self.turned }) += angle.excursion();
            self.hinges.push((hinge, angle));
        }
        if slid > 0.0 {
            let at_start = |j: usize| self.angle(j).coefficients()[0];
            let length = dynamics.line_length_squared(line, at_start).sqrt();
            self.turned += slid / length.max(f64::MIN_POSITIVE);
        }
    }

    /// The squares of the length at eight fractions of the step.
    pub fn squares_at(&self, dynamics: &Recursive<f64>, fractions: Eight) -> Eight {
        in_registers(Squares { path: self, dynamics, fractions })
    }

    fn angle(&self, j: usize) -> &Bernstein {
        let found = self.hinges.iter().find(|(hinge, _)| *hinge == j);
        &found.expect("the path moves the line").1
    }
}

/// Finds squares of a line's length.
struct Squares<'a> {
    path: &'a LinePath,
    dynamics: &'a Recursive<f64>,
    fractions: Eight,
}

impl WorkOnEight for Squares<'_> {
    type Output = Eight;

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) -> Eight {
        let Self { path, dynamics, fractions } = self;
        let (fractions, mut found) = (R::load(&fractions), Eight::default());
        let angle = |j: usize| path.angle(j).at(fractions);
        dynamics.line_length_squared(path.line, angle).store(&mut found);
        found
    }
}
