//! How far a line's length comes within a step.

use nboom_dynamics::{LineJoint, Recursive};
use nboom_model::Joint;
use nboom_ode::Bernstein;

/// Share of the square of what lengths are made of that covers the rounding of squared lengths.
const ROUNDING: f64 = 1e-13;

/// The free hinges that move a line's end, with their angles over a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinePath {
    line: usize,
    hinges: Vec<Moving>,
    /// The square of the length where the step starts.
    squared: f64,
    /// How far the hinges move together, at most: radians, and what slides as a share of the length.
    pub turned: f64,
    /// How far the end moves, at most.
    displaced: f64,
}

/// A hinge that moves a line's end.
#[derive(Clone, Copy, Debug)]
struct Moving {
    /// Position among the free hinges.
    hinge: usize,
    joint: Joint,
    angle: Bernstein,
    /// How far it moves from where it starts, at most.
    excursion: f64,
    /// How fast the line's end moves at a rate of one, at most: its distance, or one where the hinge slides.
    reach: f64,
    /// The derivative of the squared length with respect to the angle, where the step starts.
    slope: f64,
}

impl Moving {
    /// The largest second derivative of the line's end by this coordinate and another.
    fn bends_at_most(&self, other: &Self) -> f64 {
        match [self.joint, other.joint] {
            [Joint::Revolute, Joint::Revolute] => self.reach.min(other.reach),
            [Joint::Prismatic, Joint::Prismatic] => 0.0,
            _ => 1.0,
        }
    }
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
        (self.line, self.turned, self.displaced) = (line, 0.0, 0.0);
        let mut from_end = 0.0;
        for LineJoint { position: hinge, joint, arm } in dynamics.line_joints(line) {
            let angle = angle(hinge);
            let excursion = angle.excursion();
            from_end += arm;
            let reach = match joint {
                Joint::Revolute => from_end,
                Joint::Prismatic => 1.0,
            };
            self.displaced += excursion * reach;
            if joint.slides() {
                from_end += angle.coefficients()[0].abs() + excursion;
            } else {
                self.turned += excursion;
            }
            self.hinges.push(Moving { hinge, joint, angle, excursion, reach, slope: 0.0 });
        }
        let at_start = |j: usize| self.hinge(j).angle.coefficients()[0];
        self.squared = dynamics.line_length_squared(line, at_start);
        let slid = self.hinges.iter().filter(|of| of.joint.slides()).map(|of| of.excursion);
        self.turned += slid.sum::<f64>() / self.squared.sqrt().max(f64::MIN_POSITIVE);
    }

    /// The square of the length at a fraction of the step.
    pub fn squared_at(&self, dynamics: &Recursive<f64>, fraction: f64) -> f64 {
        dynamics.line_length_squared(self.line, |j| self.hinge(j).angle.at(fraction))
    }

    /// Whether the length cannot come to `limit`, on whose side of this `sign` it is, within the step.
    pub fn keeps_side(&mut self, dynamics: &Recursive<f64>, limit: f64, sign: f64) -> bool {
        let length = self.squared.sqrt();
        if (length - limit).abs() > self.displaced {
            return true;
        }
        self.find_slopes(dynamics);
        let from_limit = sign * (self.squared - limit * limit) + self.least_linear_change(sign);
        let rounding = ROUNDING * (length + self.displaced + limit).powi(2);
        from_limit > self.most_bending(length) + rounding
    }

    fn hinge(&self, j: usize) -> &Moving {
        let found = self.hinges.iter().find(|of| of.hinge == j);
        found.expect("the path moves the line")
    }

    fn find_slopes(&mut self, dynamics: &Recursive<f64>) {
        for i in 0..self.hinges.len() {
            let turns = |j: usize| f64::from(u8::from(j == self.hinges[i].hinge));
            let at_start = |j: usize| [self.hinge(j).angle.coefficients()[0], turns(j)];
            self.hinges[i].slope = dynamics.line_length(self.line, at_start).squared_rate;
        }
    }

    /// The least value over the step of `sign` times Σ gᵢ δᵢ, where δᵢ is what an angle has changed by and
    /// gᵢ its slope, or less: a polynomial lies between its coefficients.
    fn least_linear_change(&self, sign: f64) -> f64 {
        let count = self.hinges.iter().map(|of| of.angle.coefficients().len()).max().unwrap_or(0);
        let change = |of: &Moving, k: usize| {
            let c = of.angle.coefficients();
            of.slope * (c[k] - c[0])
        };
        let coefficient = |k| sign * self.hinges.iter().map(|of| change(of, k)).sum::<f64>();
        (0..count).map(coefficient).fold(0.0, f64::min)
    }

    /// By how much the squared length departs from linear changes over the step, at most.
    ///
    /// That is ½ Σ Hᵢⱼ δᵢ δⱼ with second derivatives H somewhere on the way. The end x̄ turns about hinge
    /// i at the distance rᵢ at most, so that |∂x̄/∂βᵢ| ≤ rᵢ and |∂²x̄/∂βᵢ∂βⱼ| ≤ min(rᵢ, rⱼ): the outer one
    /// of two hinges is nearer to the end. Where one of the two slides, the other one turns its direction at
    /// most, and rᵢ and |∂²x̄/∂βᵢ∂βⱼ| are at most 1. With |δᵢ| ≤ eᵢ and |x̄| ≤ |x̄₀| + Σ rᵢ eᵢ,
    /// ½ |Σ Hᵢⱼ δᵢ δⱼ| ≤ (Σ rᵢ eᵢ)² + (|x̄₀| + Σ rᵢ eᵢ) Σ bᵢⱼ eᵢ eⱼ with bᵢⱼ these bounds.
    fn most_bending(&self, length: f64) -> f64 {
        let pairs = self.hinges.iter().flat_map(|a| self.hinges.iter().map(move |b| (a, b)));
        let turning = pairs.map(|(a, b)| a.bends_at_most(b) * a.excursion * b.excursion);
        self.displaced * self.displaced + (length + self.displaced) * turning.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use nboom_model::{HingeState, Mode};
    use rand_xoshiro::SplitMix64;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    /// A number from 0 to below 1.
    fn below_one(numbers: &mut SplitMix64) -> f64 {
        (numbers.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The recursion of the sample deck with all hinges free.
    fn sample_deck() -> Recursive<f64> {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/n-boom-1970.nml");
        let scene = nboom_io::read_scene(path.as_ref()).expect("a valid deck").scene;
        let mut mode = Mode::at_start(&scene);
        mode.hinges.fill(HingeState::Free);
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &vec![0.0; scene.bodies.len()]);
        dynamics
    }

    #[test]
    fn a_length_that_keeps_its_side_stays_there() {
        let (dynamics, mut path) = (sample_deck(), LinePath::default());
        let mut numbers = SplitMix64::seed_from_u64(1);
        let mut random = || below_one(&mut numbers);
        let (mut by_slopes, mut of_several) = (0, 0);
        for _ in 0..2000 {
            for line in 0..dynamics.elements().lines().len() {
                let size = 0.5 * random();
                let angles: Vec<Bernstein> = dynamics
                    .free_hinges()
                    .iter()
                    .map(|_| {
                        let start = 6.0 * random() - 3.0;
                        let mut turned = || start + size * (2.0 * random() - 1.0);
                        Bernstein::new(&std::array::from_fn::<f64, 8, _>(|_| turned()))
                    })
                    .collect();
                path.follow(&dynamics, line, |j| angles[j]);
                let length = path.squared.sqrt();
                let limit = length * (0.5 + random());
                let sign = (length - limit).signum();
                if !path.keeps_side(&dynamics, limit, sign) {
                    continue;
                }
                by_slopes += usize::from((length - limit).abs() <= path.displaced);
                of_several += usize::from(path.hinges.len() > 1);
                let from_limit =
                    |i| path.squared_at(&dynamics, f64::from(i) / 50.0) - limit * limit;
                assert!((0..=50).all(|i| sign * from_limit(i) > 0.0), "{path:?} {limit}");
            }
        }
        assert!(by_slopes > 100 && of_several > 100, "{by_slopes} {of_several}");
    }
}
