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
    /// How far the hinges move together, at most: radians, and what slides as a share of the limit or, if that is
    /// greater, of the length where the step starts.
    pub turned: f64,
}

impl LinePath {
    /// Makes room for so many hinges that move a line.
    pub fn make_room(&mut self, hinges: usize) {
        self.hinges.clear();
        self.hinges.reserve(hinges);
    }

    /// Takes up `line`, whose length may come to `limit`, over a step in which `angle` gives the angle of each free
    /// hinge.
    pub fn follow(
        &mut self,
        dynamics: &Recursive<f64>,
        (line, limit): (usize, f64),
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
            self.turned += slid / length.max(limit).max(f64::MIN_POSITIVE);
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

#[cfg(test)]
mod tests {
    use nboom_model::{
        Body, Hinge, HingeState, Joint, KickOffSpring, MassProperties, Mode, Mount, Scene,
        SceneDescription,
    };
    use nboom_scalar::{Sym3, Vec3};
    use rand_xoshiro::SplitMix64;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    #[test]
    fn squares_of_eight_places_are_those_of_one_after_the_other() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/n-boom-1970.nml");
        let scene = nboom_io::read_scene(path.as_ref()).expect("a valid deck").scene;
        let mut mode = Mode::at_start(&scene);
        mode.hinges.fill(HingeState::Free);
        let mut dynamics = Recursive::new(&scene);
        dynamics.set_mode(&mode, &vec![0.0; scene.bodies.len()]);
        let mut numbers = SplitMix64::seed_from_u64(1);
        let mut below_one = || (numbers.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let (mut path, mut of_several) = (LinePath::default(), 0);
        for _ in 0..200 {
            let mut angle = || std::array::from_fn::<f64, 8, _>(|_| 6.0 * below_one() - 3.0);
            let angles: Vec<Bernstein> =
                dynamics.free_hinges().iter().map(|_| Bernstein::new(&angle())).collect();
            let fractions = Eight(std::array::from_fn(|_| below_one()));
            for line in 0..dynamics.elements().lines().len() {
                path.follow(&dynamics, (line, 1.0), |j| angles[j]);
                let squares = path.squares_at(&dynamics, fractions).0;
                for (fraction, found) in fractions.0.into_iter().zip(squares) {
                    let at = |j: usize| [angles[j].at(fraction), 0.0];
                    let expected = dynamics.line_length(line, at).squared;
                    // Coordinates of up to some twenty lengths, sums of some ten products rounded once.
                    assert!((found - expected).abs() < 1e-11 * (1.0 + expected), "{line} {found}");
                }
                let turned = |(hinge, _): &(usize, Bernstein)| angles[*hinge].excursion();
                assert_eq!(path.turned, path.hinges.iter().map(turned).sum::<f64>());
                of_several += usize::from(path.hinges.len() > 1);
            }
        }
        assert!(of_several > 100, "{of_several}");
    }
    #[test]
    fn a_line_of_almost_no_length_that_slides_is_searched_in_few_pieces() {
        let mass_properties = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.2, 1.4));
        let mut description = SceneDescription::at_rest("slide", mass_properties, 1.0);
        let main_body_point = Vec3::unit_y();
        let (coefficients, limit_length) = ([1.0, 0.0, 0.0, 0.0], 0.5);
        let (body_point, start) = (Vec3::zero(), 1e-6);
        let spring = KickOffSpring { main_body_point, body_point, coefficients, limit_length };
        description.bodies = vec![Body {
            inboard: None,
            mount: Mount::at(main_body_point),
            joint: Joint::Prismatic,
            axis: Vec3::unit_x(),
            mass_properties,
            tip: Vec3::zero(),
            hinge: Hinge { kick_off: Some(spring), ..Hinge::free() },
        }];
        let dynamics = Recursive::new(&Scene::new(description).expect("a physical scene"));
        // From the start to three limits.
        let angle = Bernstein::of_powers(&[start, 3.0 * limit_length]);
        let mut path = LinePath::default();
        path.follow(&dynamics, (0, limit_length), |_| angle);
        assert!((path.turned - 3.0).abs() < 1e-12, "{}", path.turned);
        let fractions = Eight(std::array::from_fn(|i| i as f64 / 7.0));
        for (fraction, found) in
            fractions.0.into_iter().zip(path.squares_at(&dynamics, fractions).0)
        {
            let expected = (start + 3.0 * limit_length * fraction).powi(2);
            // The end's coordinates are of size one.
            assert!((found - expected).abs() < 1e-15 * (1.0 + expected), "{found} {expected}");
        }
    }
}
