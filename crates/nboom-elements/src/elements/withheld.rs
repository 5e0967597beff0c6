use nboom_model::{Mode, Scene, WeldedTree, Withheld};
use nboom_scalar::{Real, Vec3};

use crate::{Line, Placed};

/// The moment of a line about a hinge, which does not turn a hinge inboard of it; there is one only
/// with [`Departures`](nboom_model::Departures).
#[derive(Clone, Copy, Debug)]
pub(crate) struct WithheldMoment<R> {
    /// The link whose hinge is not turned.
    pub link: usize,
    line: Line<R>,
    /// The link in which the outboard hinge sits, which may be held, and where.
    outboard: usize,
    point: Vec3<R>,
}

impl<R: Real> WithheldMoment<R> {
    /// All of the lines that act.
    pub fn all(
        scene: &Scene,
        mode: &Mode,
        tree: &WeldedTree<R>,
        lines: &[Line<R>],
    ) -> impl Iterator<Item = Self> {
        let of = move |withheld: &Withheld| {
            let line = *lines.iter().find(|line| line.hinge == withheld.line && line.acts)?;
            let inboard = Some(withheld.inboard).filter(|&i| mode.is_free(i))?;
            let (link, member) = (tree.members[inboard].link?, tree.members[withheld.outboard]);
            Some(Self { link, line, outboard: member.link?, point: member.point })
        };
        scene.departures().withheld.iter().filter_map(of)
    }

    /// The hinge of the line.
    pub fn hinge(&self) -> usize {
        self.line.hinge
    }

    /// The moment about the axis.
    #[inline(always)]
    pub fn torque<P: Placed<R>>(&self, links: &[P]) -> R {
        let (end, force) = self.line.end_and_force(links);
        let outboard = &links[self.outboard];
        let hinge = outboard.position() + *outboard.rot() * self.point;
        links[self.link].axis().dot((end - hinge).cross(force))
    }
}
