use nboom_model::{Body, KickOffSpring, Mode, Scene, WeldedTree};
use nboom_scalar::{Mat3, Real, Vec3};

use crate::{KickOffLaw, Kind};

/// Where a link is, main-body axes.
pub trait Placed<R> {
    /// Turns link components into main-body components.
    fn rot(&self) -> &Mat3<R>;

    /// The link's hinge from O.
    fn position(&self) -> Vec3<R>;

    /// Unit vector along the hinge axis.
    fn axis(&self) -> Vec3<R>;
}

/// Between which points the force on the body of a hinge acts, if there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// On the hinged body, from its hinge, body axes.
    pub body_point: Vec3<f64>,
    /// On the main body, from O, main-body axes.
    pub main_body_point: Vec3<f64>,
}

impl Ends {
    /// Those of the force on the body of hinge `i`.
    pub fn of(scene: &Scene, i: usize) -> Option<Self> {
        scene.bodies[i].hinge.kick_off.map(|spring| Self::of_spring(&spring))
    }

    fn of_spring(spring: &KickOffSpring) -> Self {
        Self { body_point: spring.body_point, main_body_point: spring.main_body_point }
    }
}

/// A force along the line between a point of a hinged body and one of the main body, by its length:
/// on the body, and its reaction on the main body; which gives eqs. (6.17) and (6.20), corrected:
/// notes 7 and 8.
#[derive(Clone, Copy, Debug)]
pub struct Line<R> {
    /// What kind of force it is.
    pub kind: Kind,
    /// The hinge of the body.
    pub hinge: usize,
    /// Whether the force acts in the mode.
    pub acts: bool,
    /// The link that the body belongs to; `None` is the main link, whose length does not change.
    pub link: Option<usize>,
    /// The end on the body from the link's hinge, link axes.
    pub point: Vec3<R>,
    /// The end on the main body, from O.
    pub main_body_point: Vec3<R>,
    /// Distances of the ends from the body's hinge and from O, added up.
    pub size: f64,
    law: KickOffLaw<R>,
    limit: f64,
}

impl<R: Real> Line<R> {
    /// All of a scene in `mode`, whose links are those of `tree`, by hinge.
    pub fn all(scene: &Scene, mode: &Mode, tree: &WeldedTree<R>) -> impl Iterator<Item = Self> {
        let spring = |(hinge, body): (usize, &Body)| Some((hinge, body.hinge.kick_off?));
        let springs = scene.bodies.iter().enumerate().filter_map(spring);
        // Lines come first among the elements of a mode.
        let of_spring = move |((hinge, spring), &piece): ((usize, KickOffSpring), &usize)| {
            let (ends, member) = (Ends::of_spring(&spring), tree.members[hinge]);
            let in_link = member.rot_link_from_body * Vec3::constant(ends.body_point);
            Self {
                kind: Kind::KickOff,
                hinge,
                acts: piece == 0,
                link: member.link,
                point: member.point + in_link,
                main_body_point: Vec3::constant(ends.main_body_point),
                size: ends.main_body_point.norm() + ends.body_point.norm(),
                law: KickOffLaw::new(spring.coefficients),
                limit: spring.limit_length,
            }
        };
        springs.zip(&mode.pieces).map(of_spring)
    }

    /// The end on the body from O, and from the end on the main body; main-body axes.
    #[inline(always)]
    pub fn end_and_span<P: Placed<R>>(&self, links: &[P]) -> (Vec3<R>, Vec3<R>) {
        let end = match self.link {
            Some(link) => links[link].position() + *links[link].rot() * self.point,
            None => self.point,
        };
        (end, end - self.main_body_point)
    }

    /// The end on the body from O, and the force on it while it acts; main-body axes.
    #[inline(always)]
    pub fn end_and_force<P: Placed<R>>(&self, links: &[P]) -> (Vec3<R>, Vec3<R>) {
        let (end, span) = self.end_and_span(links);
        (end, self.law.push(span))
    }

    /// The force by the line's length, while it acts.
    pub fn law(&self) -> &KickOffLaw<R> {
        &self.law
    }
}

impl Line<f64> {
    /// What it is at `length`.
    pub fn reading(&self, length: f64) -> LineReading {
        let Self { kind, hinge, acts, .. } = *self;
        let force = if acts { self.law.force(length) } else { 0.0 };
        LineReading { kind, hinge, acts, force, length }
    }

    /// Potential energy at `length`; where the force has ended, that of its end.
    pub fn potential(&self, length: f64) -> f64 {
        self.law.potential(length.min(self.limit))
    }
}

/// A line at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineReading {
    /// The kind of force.
    pub kind: Kind,
    /// The hinge of its body.
    pub hinge: usize,
    /// Whether the force acts.
    pub acts: bool,
    /// The force; zero unless it acts.
    pub force: f64,
    /// Distance of the ends.
    pub length: f64,
}

impl LineReading {
    /// The force over the length, its force density; zero unless it acts.
    pub fn density(&self) -> f64 {
        if self.force == 0.0 { 0.0 } else { self.force / self.length }
    }
}
