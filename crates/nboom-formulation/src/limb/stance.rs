//! How a link stands to its mount, and what stands on it.

use nboom_scalar::{Real, Twist, Vec3, Wrench};

use crate::limb::turn::Turn;
use crate::parameters::Mount;

/// How a link stands, and by how much it turns what it carries.
#[derive(Clone, Copy)]
pub(super) struct Stance<R> {
    /// From the axes of the mount to those in which all of the link is written.
    pub axes_turned: Turn<R>,
    /// How far the link has turned from these axes.
    pub turned: Turn<R>,
    /// From the mount to the link's origin along ê₁.
    pub travel: R,
    /// Angular bias acceleration ω × ê₁ σ, along the link's own axes; the first component is zero.
    pub bias: Vec3<R>,
}

impl<R: Real> Stance<R> {
    /// The way from the mount to the link's origin.
    pub fn along(&self) -> Vec3<R> {
        Vec3::new(self.travel, R::zero(), R::zero())
    }

    /// The accelerations at the link's origin when those of its mount are these and its joint has none.
    pub fn carried_by(&self, at_mount: Twist<R>) -> Twist<R> {
        self.axes_turned.twist_back(at_mount).at(self.along())
    }

    /// The accelerations of a mount on the link, along the axes there, when the link has these, but for
    /// its bias.
    pub fn carries(&self, mount: &Mount<R>, of_link: Twist<R>) -> Twist<R> {
        match mount {
            Mount::Parallel(way) => of_link.at(self.way(*way)),
            Mount::Across { rot, point } => {
                let Twist { angular, linear } = self.turned.twist_back(of_link).at(*point);
                Twist {
                    angular: rot.transpose_mul(angular + self.bias),
                    linear: rot.transpose_mul(linear),
                }
            }
        }
    }

    /// A wrench on the link as one at its mount, along the axes there.
    pub fn wrench_at_mount(&self, wrench: Wrench<R>) -> Wrench<R> {
        self.axes_turned.wrench(wrench.seen_from(self.along()))
    }

    /// A wrench at a mount on the link, along the axes there, as one on the link.
    pub fn wrench_carried(&self, mount: &Mount<R>, wrench: Wrench<R>) -> Wrench<R> {
        match mount {
            Mount::Parallel(way) => wrench.seen_from(self.way(*way)),
            Mount::Across { rot, point } => {
                self.turned.wrench(wrench.rotated(rot).seen_from(*point))
            }
        }
    }

    /// The way from the link's joint to a parallel one, along the axes of both.
    pub fn way(&self, way: [R; 2]) -> Vec3<R> {
        self.turned.vector(Vec3::new(R::zero(), way[0], way[1]))
    }
}
