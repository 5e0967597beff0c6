//! How a link stands to its mount, and what stands on it.

use nboom_model::{LimbJoint, LimbLink};
use nboom_scalar::{Real, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::limb::turn::Turn;
use crate::parameters::{Mount, Reader};

/// Which axes all of a link is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The link slides along ê₁ of axes that are fixed in its mount.
    Sliding,
    /// The link turns from axes that stay those of its mount, for parallel joints have them in common.
    Turning,
    /// The axes turn with the link.
    WithAxes,
}

impl Standing {
    /// That of link `i` of a limb of these `links`.
    pub fn of(links: &[LimbLink], i: usize) -> Self {
        let follows = |link: &LimbLink| {
            link.joint == LimbJoint::Parallel && link.inboard.map(usize::from) == Some(i)
        };
        match links[i].joint {
            LimbJoint::Prismatic => Self::Sliding,
            LimbJoint::Parallel => Self::Turning,
            LimbJoint::Revolute if links.iter().any(follows) => Self::Turning,
            LimbJoint::Revolute => Self::WithAxes,
        }
    }

    /// How far the axes turn, and how far the link turns from them, if the joint is at `turn`.
    pub(crate) fn turns<R: Real>(self, turn: Turn<R>) -> [Turn<R>; 2] {
        match self {
            Self::Sliding => [Turn::still(); 2],
            Self::Turning => [Turn::still(), turn],
            Self::WithAxes => [turn, Turn::still()],
        }
    }
}

/// How a link stands, and by how much it turns what it carries.
#[derive(Clone, Copy)]
pub(crate) struct Stance<R> {
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
    #[inline]
    pub fn carried_by(&self, at_mount: Twist<R>) -> Twist<R> {
        self.axes_turned.twist_back(at_mount).at(self.along())
    }

    /// The accelerations of a mount on the link, along the axes there, when the link has these, but for
    /// its bias.
    #[inline]
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

    /// What the link's joint transmits, at its mount and along the axes there.
    pub fn share_at_mount(&self, share: &AtOrigin<R>) -> AtOrigin<R> {
        let inertia = share.inertia.seen_from(self.along());
        AtOrigin {
            inertia: self.axes_turned.inertia(&inertia),
            wrench: self.wrench_at_mount(share.wrench),
        }
    }

    /// What a joint at a mount on the link transmits, at the link's origin and along its axes.
    pub fn share_carried(&self, mount: &Mount<R>, share: &AtOrigin<R>) -> AtOrigin<R> {
        match mount {
            Mount::Parallel(way) => share.seen_from(self.way(*way)),
            Mount::Across { rot, point } => {
                let AtOrigin { inertia, mut wrench } = share.rotated(rot);
                wrench.add(Wrench {
                    moment: inertia.angular * self.bias,
                    force: inertia.coupling.transpose_mul(self.bias),
                });
                let AtOrigin { inertia, wrench } = AtOrigin { inertia, wrench }.seen_from(*point);
                AtOrigin {
                    inertia: self.turned.inertia(&inertia),
                    wrench: self.turned.wrench(wrench),
                }
            }
        }
    }

    /// A wrench on the link as one at its mount, along the axes there.
    #[inline]
    pub fn wrench_at_mount(&self, wrench: Wrench<R>) -> Wrench<R> {
        self.axes_turned.wrench(wrench.seen_from(self.along()))
    }

    /// A wrench at a mount on the link, along the axes there, as one on the link.
    #[inline]
    pub fn wrench_carried(&self, mount: &Mount<R>, wrench: Wrench<R>) -> Wrench<R> {
        match mount {
            Mount::Parallel(way) => wrench.seen_from(self.way(*way)),
            Mount::Across { rot, point } => {
                self.turned.wrench(wrench.rotated(rot).seen_from(*point))
            }
        }
    }

    /// The way from the link's joint to a parallel one, along the axes of both.
    #[inline]
    pub fn way(&self, way: [R; 2]) -> Vec3<R> {
        self.turned.vector(Vec3::new(R::zero(), way[0], way[1]))
    }

    /// The numbers that vary; of sine and cosine there is one pair, for either the axes or the link stays.
    pub fn flat(&self, standing: Standing) -> [R; 5] {
        let Self { axes_turned, turned, travel, bias } = *self;
        let turn = if standing == Standing::WithAxes { axes_turned } else { turned };
        [turn.sin, turn.cos, bias.y, bias.z, travel]
    }

    /// Those of a link that stands so.
    pub fn read(standing: Standing, reader: &mut Reader<impl Iterator<Item = R>>) -> Self {
        let [axes_turned, turned] = standing.turns(Turn { sin: reader.next(), cos: reader.next() });
        let bias = Vec3::new(R::zero(), reader.next(), reader.next());
        Self { axes_turned, turned, travel: reader.next(), bias }
    }
}
